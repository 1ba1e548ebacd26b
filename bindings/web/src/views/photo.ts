/** A photograph with the computed bow over it, and the drops that fit a cut across it. Nothing leaves the page. */

import { dropOf, type State } from "../state";
import { columnOf, SKETCH } from "../parts/column";
import { make } from "../parts/dom";
import { canvasOf, table } from "../parts/picture";
import { inspected } from "../parts/photo_file";
import { digits, sizeText } from "../parts/units";
import type { Page, View } from "./view";

/** Widest that a photograph is kept. */
const WIDTH = 1100;
const HIGHEST = 1600;
/** Width of the bow that is drawn at once. */
const SKETCH_WIDTH = 275;
/** The bow's column, and the cut that is fitted. */
const BOW = { from: 100, to: 165, points: 651 };
const CUT = { from: 131, to: 148, points: 205 };
/** Half width of the cut's sector, degrees. */
const SECTOR = 25;
/** Radii and spreads that are tried first; then ever smaller steps about the best. */
const RADII = { from: 15, to: 1200, count: 19 };
const SPREADS = [0, 0.1];
const HALVINGS = 6;
const FINENESS = 0.3;

export function photoView(page: Page): View {
  const file = make("input", { type: "file", accept: "image/png,image/jpeg", "aria-label": "Choose a photograph", change: () => void take(file.files?.[0]) });
  const zone = make("div", { class: "drop-zone" }, make("p", {}, "Drop a photograph of a rainbow here (PNG or JPEG), or choose one. It stays on your machine."), file);
  const picture = make("canvas", { role: "img", "aria-label": "The photograph" });
  const over = make("canvas", { class: "over" });
  const lines = make("div", { class: "over" });
  const frame = make("div", { class: "photo-frame", hidden: true, tabindex: "0", role: "application", "aria-label": "Photograph. Drag, or use the arrow keys, to move the antisolar point." }, picture, over, lines);
  const fitButton = make("button", { type: "button", disabled: true, click: () => void fit() }, "Fit radius and spread to the cut");
  const words = make("p", { class: "legend", role: "status" });
  const element = make("section", { class: "view-photo" }, zone, frame, make("p", { class: "buttons" }, fitButton), words);
  let pixels: Float64Array | undefined;
  let cutShown: { measured: Float64Array; fitted: Float64Array } | undefined;
  let fitting = 0;

  const take = async (chosen: File | undefined): Promise<void> => {
    if (!chosen) return;
    try {
      const bytes = await chosen.arrayBuffer();
      const about = inspected(bytes);
      const bitmap = await createImageBitmap(new Blob([bytes])).catch(() => {
        throw new Error("the picture is damaged");
      });
      const scale = Math.min(1, WIDTH / bitmap.width, HIGHEST / bitmap.height);
      [picture.width, picture.height] = [Math.round(bitmap.width * scale), Math.round(bitmap.height * scale)];
      const context = picture.getContext("2d", { willReadFrequently: true });
      context?.drawImage(bitmap, 0, 0, picture.width, picture.height);
      bitmap.close();
      const data = context?.getImageData(0, 0, picture.width, picture.height).data ?? new Uint8ClampedArray();
      pixels = Float64Array.from({ length: 3 * picture.width * picture.height }, (_, i) => data[4 * Math.floor(i / 3) + (i % 3)] ?? 0);
      frame.hidden = false;
      fitButton.disabled = false;
      words.textContent = about.focal35 ? `The file tells a lens of ${about.focal35} mm on 36 mm film: the field of view is set by it.` : "The file does not tell the lens: set the field of view.";
      cutShown = undefined;
      // 36 mm lie along the longer side
      const across = about.width >= about.height ? 36 : (36 * about.width) / about.height;
      page.change(about.focal35 ? { photo_fov_deg: Number(((360 / Math.PI) * Math.atan(across / (2 * about.focal35))).toFixed(1)) } : {});
    } catch (error) {
      page.refuse(error instanceof Error ? new Error(error.message) : error);
      words.textContent = `Not taken: ${error instanceof Error ? error.message : String(error)}.`;
    }
    file.value = "";
  };
  for (const place of [zone, frame]) {
    place.addEventListener("dragover", (event) => {
      event.preventDefault();
      zone.classList.add("over");
    });
    place.addEventListener("dragleave", () => zone.classList.remove("over"));
    place.addEventListener("drop", (event) => {
      event.preventDefault();
      zone.classList.remove("over");
      void take(event.dataTransfer?.files[0]);
    });
  }

  const viewOf = (state: State) => ({
    width: picture.width, height: picture.height, fov_deg: state.photo_fov_deg,
    antisolar: [state.photo_x * picture.width, state.photo_y * picture.height] as [number, number],
  });

  const clamp = (value: number): number => Number(Math.min(4, Math.max(-3, value)).toFixed(4));
  const move = (dx: number, dy: number): void => {
    const state = page.state();
    page.change({ photo_x: clamp(state.photo_x + dx), photo_y: clamp(state.photo_y + dy) });
  };
  let held: "antisolar" | "horizon" | "tilt" | undefined;
  frame.addEventListener("pointerdown", (event) => {
    held = ((event.target as Element).getAttribute("data-hold") as typeof held) ?? "antisolar";
    frame.setPointerCapture(event.pointerId);
  });
  frame.addEventListener("pointerup", () => (held = undefined));
  frame.addEventListener("pointermove", (event) => {
    if (!held || event.buttons !== 1) return;
    const state = page.state();
    const box = frame.getBoundingClientRect();
    const [dx, dy] = [event.movementX / box.width, event.movementY / box.height];
    if (held === "antisolar") move(dx, dy);
    if (held === "horizon") page.change({ sun_elevation_deg: Number(Math.min(90, Math.max(0, state.sun_elevation_deg - (dy * box.height * state.photo_fov_deg) / box.width)).toFixed(2)) });
    if (held === "tilt") page.change({ photo_tilt_deg: Number(Math.min(90, Math.max(-90, state.photo_tilt_deg - dy * 90)).toFixed(2)) });
  });
  frame.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 0.05 : 0.005;
    const way = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] } as Record<string, [number, number]>)[event.key];
    if (!way) return;
    event.preventDefault();
    move(way[0] * step, way[1] * step);
  });

  const drawLines = (state: State): void => {
    const { width, height, antisolar: [x, y] } = viewOf(state);
    const focal = width / 2 / Math.tan((state.photo_fov_deg * Math.PI) / 360);
    // towards the antisolar point, and up across it
    const a = [x - width / 2, height / 2 - y, focal];
    const length = Math.hypot(...a);
    const [ax, ay, az] = a.map((v) => v / length) as [number, number, number];
    const tilt = (state.photo_tilt_deg * Math.PI) / 180;
    const [ux, uy] = [Math.sin(tilt), Math.cos(tilt)];
    const along = ux * ax + uy * ay;
    let up = [ux - along * ax, uy - along * ay, -along * az];
    const norm = Math.hypot(...up) || 1;
    up = up.map((v) => v / norm);
    const e = (state.sun_elevation_deg * Math.PI) / 180;
    const h = [ax, ay, az].map((v, k) => v * Math.cos(e) + (up[k] ?? 0) * Math.sin(e)) as [number, number, number];
    const side = [ay * (up[2] ?? 0) - az * (up[1] ?? 0), az * (up[0] ?? 0) - ax * (up[2] ?? 0), ax * (up[1] ?? 0) - ay * (up[0] ?? 0)];
    const project = (v: number[]): [number, number] => [width / 2 + ((v[0] ?? 0) / (v[2] ?? 1)) * focal, height / 2 - ((v[1] ?? 0) / (v[2] ?? 1)) * focal];
    const [hx, hy] = project(h);
    const [sx, sy] = project(h.map((v, k) => v + 0.3 * (side[k] ?? 0)));
    const [dx, dy] = [sx - hx, sy - hy];
    const far = (2 * width) / (Math.hypot(dx, dy) || 1);
    const near = (0.35 * width) / (Math.hypot(dx, dy) || 1);
    const horizon = h[2] > 0.05 ? `<path d="M${hx - far * dx} ${hy - far * dy}L${hx + far * dx} ${hy + far * dy}" stroke="#fff" stroke-width="1.5" stroke-dasharray="8 6"/>
<circle cx="${hx}" cy="${hy}" r="9" fill="#fff8" stroke="#fff" data-hold="horizon"><title>horizon: drag up or down for the sun's elevation</title></circle>
<circle cx="${hx - near * dx}" cy="${hy - near * dy}" r="7" fill="#fff8" stroke="#fff" data-hold="tilt"><title>drag for the tilt</title></circle>` : "";
    const turn = (deg: number): string => `L${x + 4 * width * Math.cos((deg * Math.PI) / 180)} ${y - 4 * width * Math.sin((deg * Math.PI) / 180)}`;
    const sector = `<path d="M${x} ${y}${turn(state.photo_sector_deg - SECTOR)}M${x} ${y}${turn(state.photo_sector_deg + SECTOR)}" stroke="#ffffff90" stroke-width="1"/>`;
    lines.innerHTML = `<svg viewBox="0 0 ${width} ${height}" fill="none">${sector}${horizon}<path d="M${x - 12} ${y}h24M${x} ${y - 12}v24" stroke="#fff" stroke-width="2"/></svg>`;
  };

  // the middles of the bins
  const half = (CUT.to - CUT.from) / CUT.points / 2;
  const middles = { ...CUT, from: CUT.from + half, to: CUT.to - half };
  const asked = (state: State, radius: number, spread: number) =>
    columnOf({ ...state, light: "daylight", shape: "sphere" }, middles, FINENESS, { drop: { ...dropOf(state), shape: "sphere", radius_um: radius, spread } });

  const fit = async (): Promise<void> => {
    const state = page.state();
    if (!pixels) return;
    fitting += 1;
    const mine = fitting;
    fitButton.disabled = true;
    try {
      const found = await page.engine.fine({ op: "cut", view: viewOf(state), theta_deg: [CUT.from, CUT.to], bins: CUT.points, sector_deg: [state.photo_sector_deg, SECTOR] }, pixels);
      const [rgb, count] = [found.f64["rgb"] ?? new Float64Array(), found.f64["count"] ?? new Float64Array()];
      const numbers = new Float64Array([...Array.from(rgb, (v) => (Number.isFinite(v) ? v : 0)), ...count]);
      let tried = 0;
      const misfit = async (radius: number, spread: number): Promise<{ rms: number; curve: Float64Array; strength: number }> => {
        if (mine !== fitting) throw new Error("the fit was given up");
        tried += 1;
        words.textContent = `Fitting: ${tried} drops tried …`;
        const reply = await page.engine.fine({ op: "misfit", column: asked(state, radius, spread) }, numbers);
        return { rms: reply.header["rms"] as number, strength: reply.header["strength"] as number, curve: reply.f64["rgb"] ?? new Float64Array() };
      };
      const ratio = (RADII.to / RADII.from) ** (1 / (RADII.count - 1));
      let best = { radius: 0, spread: 0, rms: Infinity, strength: 0, curve: new Float64Array() };
      const better = async (radius: number, spread: number): Promise<void> => {
        const here = await misfit(radius, spread);
        // light cannot be taken away
        if (here.strength > 0 && here.rms < best.rms) best = { radius, spread, ...here, curve: new Float64Array(here.curve) };
      };
      for (const spread of SPREADS) for (let i = 0; i < RADII.count; i += 1) await better(RADII.from * ratio ** i, spread);
      if (best.radius === 0) throw new Error("no bow is found along the cut: is the antisolar point where the shadow of the camera was?");
      let [step, wide] = [Math.sqrt(ratio), 0.05];
      for (let halving = 0; halving < HALVINGS; halving += 1) {
        for (const [radius, spread] of [[best.radius * step, best.spread], [best.radius / step, best.spread], [best.radius, best.spread + wide], [best.radius, Math.max(0, best.spread - wide)]] as const) {
          if (spread <= 0.5 && (radius !== best.radius || spread !== best.spread)) await better(radius, spread);
        }
        [step, wide] = [Math.sqrt(step), wide / 2];
      }
      cutShown = { measured: rgb, fitted: best.curve };
      words.textContent = `Best fit: radius ${digits(best.radius, 3)} µm (${sizeText(state, best.radius)} as ${state.size_as}), spread ${digits(best.spread, 2)}; the cut is missed by ${digits(best.rms, 2)} of white. ${tried} drops were tried, all spheres.`;
      page.change({ shape: "sphere", radius_um: Number(digits(best.radius, 4)), spread: Number(best.spread.toFixed(4)) });
    } catch (error) {
      page.refuse(error);
      words.textContent = `No fit: ${error instanceof Error ? error.message : String(error)}.`;
    } finally {
      fitButton.disabled = false;
    }
  };

  return {
    element,
    fields: ["photo_fov_deg", "photo_x", "photo_y", "photo_tilt_deg", "photo_stops", "photo_sector_deg"],
    async update(alive) {
      const state = page.state();
      if (!pixels) {
        page.status("no photograph yet", false);
        return;
      }
      drawLines(state);
      const overlay = async (from: typeof BOW, fineness: number, lane: "quickly" | "finely"): Promise<void> => {
        const drop = { ...dropOf(state), shape: "sphere" };
        const whole = viewOf(state);
        const scale = lane === "quickly" ? Math.min(1, SKETCH_WIDTH / whole.width) : 1;
        const [width, height] = [Math.max(2, Math.round(whole.width * scale)), Math.max(2, Math.round(whole.height * scale))];
        const view = { ...whole, width, height, antisolar: [state.photo_x * width, state.photo_y * height] };
        const columns = { theta_deg: [from.from, from.to], points: from.points, azimuths_deg: [0], polarisation: state.polarisation };
        const [, reply] = await page.engine[lane]([{ header: columnOf(state, from, fineness, { drop }) }, { header: { op: "photograph", view, stops: state.photo_stops, columns }, of: 0 }]);
        if (lane === "finely" && !alive()) return;
        [over.width, over.height] = [picture.width, picture.height];
        over.getContext("2d")?.drawImage(canvasOf(reply?.u8["rgba"] ?? new Uint8Array(4 * width * height), width, height), 0, 0, over.width, over.height);
      };
      await overlay({ from: 125, to: 150, points: 251 }, SKETCH, "quickly");
      page.status("coarse: few wavelengths", true);
      if (!alive()) return;
      await overlay(BOW, 0.3, "finely");
      if (alive()) page.status(state.shape === "sphere" ? "exact series; drops are spheres" : "here all drops are spheres", false);
    },
    async canvas() {
      const both = document.createElement("canvas");
      [both.width, both.height] = [picture.width, picture.height];
      for (const layer of [picture, over]) both.getContext("2d")?.drawImage(layer, 0, 0);
      return both;
    },
    svg: () => `<svg xmlns="http://www.w3.org/2000/svg" width="${picture.width}" height="${picture.height}"><image href="${picture.toDataURL("image/jpeg")}" width="${picture.width}" height="${picture.height}"/><image href="${over.toDataURL("image/png")}" width="${picture.width}" height="${picture.height}"/></svg>`,
    csv() {
      const part = (from: Float64Array | undefined, c: number): number[] => Array.from({ length: CUT.points }, (_, i) => from?.[3 * i + c] ?? NaN);
      const angles = Array.from({ length: CUT.points }, (_, i) => CUT.from + ((CUT.to - CUT.from) * (i + 0.5)) / CUT.points);
      return table("cut across the bow, linear sRGB, and the fit", [["scattering_angle_deg", angles],
        ...["r", "g", "b"].map((name, c) => [`measured_${name}`, part(cutShown?.measured, c)] as const),
        ...["r", "g", "b"].map((name, c) => [`fitted_${name}`, part(cutShown?.fitted, c)] as const)]);
    },
  };
}
