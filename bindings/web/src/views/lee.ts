/** The Lee diagram, column by column, with a cursor that picks a radius. */

import { Dropped } from "../engine/engine";
import { dropOf, isRound, type State } from "../state";
import { columnOf, PER_ANGLE, SKETCH } from "../parts/column";
import { make } from "../parts/dom";
import { type Axis, canvasOf, drawn, framed, INSIDE, place, PLOT, short, table, ticks, toX } from "../parts/picture";
import { angleName, angleShown, digits, sizeFactor, sizeName, sizeText, sizeUnit } from "../parts/units";
import type { Page, View } from "./view";

const COLUMNS = 96;
const ROWS = 241;
/** Angles, degrees from the sun. */
const FROM = 125;
const TO = 160;

export function leeView(page: Page): View {
  const canvas = make("canvas", { width: String(COLUMNS), height: String(ROWS), class: "lee", tabindex: "0", role: "application", "aria-label": "Lee diagram: colours by size and angle. Left and right pick the size." });
  const cursor = make("div", { class: "cursor" });
  const frame = make("div", { class: "lee-frame" }, canvas, cursor);
  const [across, up] = [make("div", { class: "lee-x" }), make("div", { class: "lee-y" })];
  const [acrossName, upName] = [make("p", { class: "lee-x-name" }), make("p", { class: "lee-y-name" })];
  const read = make("p", { class: "legend" });
  const about = make("p", { class: "note" });
  const element = make("section", { class: "view-lee" }, make("div", { class: "lee-grid" }, upName, up, frame, across, acrossName), read, about);
  const columns = new Map<number, Float64Array>();
  let rgb = new Map<number, Uint8Array>();
  let key = "";
  let painted = "";
  /** Columns that are as good as they get. */
  const done = new Set<number>();

  const radiusAt = (state: State, column: number): number => state.lee_from_um * (state.lee_to_um / state.lee_from_um) ** (column / (COLUMNS - 1));
  const columnAt = (state: State, radius: number): number => ((COLUMNS - 1) * Math.log(radius / state.lee_from_um)) / Math.log(state.lee_to_um / state.lee_from_um);

  const pick = (event: PointerEvent): void => {
    if (event.buttons !== 1) return;
    const box = canvas.getBoundingClientRect();
    const share = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    page.change({ radius_um: Number(digits(radiusAt(page.state(), share * (COLUMNS - 1)), 4)) });
  };
  canvas.addEventListener("pointerdown", pick);
  canvas.addEventListener("pointermove", (event) => {
    pick(event);
    const state = page.state();
    const box = canvas.getBoundingClientRect();
    const column = ((event.clientX - box.left) / box.width) * (COLUMNS - 1);
    const deg = TO - ((event.clientY - box.top) / box.height) * (TO - FROM);
    read.textContent = `${sizeName(state)} ${sizeText(state, radiusAt(state, column))}, ${angleShown(state, deg).toFixed(2)}°`;
  });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const state = page.state();
    const column = Math.min(COLUMNS - 1, Math.max(0, Math.round(columnAt(state, state.radius_um)) + step));
    page.change({ radius_um: Number(digits(radiusAt(state, column), 4)) });
  });

  /** Gaps are filled by the nearest column to the left. */
  const draw = (): void => {
    const rgba = new Uint8Array(4 * COLUMNS * ROWS).fill(255);
    let last: Uint8Array | undefined;
    for (let column = 0; column < COLUMNS; column += 1) {
      last = rgb.get(column) ?? last;
      for (let row = 0; row < ROWS; row += 1) {
        const from = 3 * (ROWS - 1 - row);
        const to = 4 * (row * COLUMNS + column);
        for (let c = 0; c < 3; c += 1) rgba[to + c] = last?.[from + c] ?? 0;
      }
    }
    canvas.getContext("2d")?.drawImage(canvasOf(rgba, COLUMNS, ROWS), 0, 0);
  };

  const mark = (state: State): void => {
    const share = columnAt(state, state.radius_um) / (COLUMNS - 1);
    cursor.hidden = share < 0 || share > 1;
    cursor.style.left = `${100 * share}%`;
    read.textContent = `The line: ${sizeName(state)} ${sizeText(state, state.radius_um)}. Drag it to choose the drop of all views.`;
    const { x, y } = axes(state);
    across.replaceChildren(...ticks(x).map((tick) => make("span", { style: `left:${(100 * place(x, tick)).toFixed(2)}%` }, short(tick, true))));
    up.replaceChildren(...ticks(y).map((tick) => make("span", { style: `bottom:${(100 * place(y, tick)).toFixed(2)}%` }, short(tick, false))));
    [acrossName.textContent, upName.textContent] = [x.label, y.label];
    about.textContent = `What the eye sees at each angle, of ${state.light === "one" ? `light of ${digits(state.wavelength_nm)} nm` : "daylight"}. Every size is exposed by itself: colours compare from left to right, brightness does not.`;
  };

  const axes = (state: State): { x: Axis; y: Axis } => {
    const factor = sizeFactor(state);
    return {
      x: { label: `${sizeName(state)} (${sizeUnit(state)})`, from: state.lee_from_um * factor, to: state.lee_to_um * factor, log: true },
      y: { label: angleName(state), from: angleShown(state, FROM), to: angleShown(state, TO) },
    };
  };

  const svg = (): string => {
    const state = page.state();
    const { x, y } = axes(state);
    const factor = sizeFactor(state);
    const image = `<image href="${canvas.toDataURL("image/png")}" x="${INSIDE.x}" y="${INSIDE.y}" width="${INSIDE.width}" height="${INSIDE.height}" preserveAspectRatio="none"/>`;
    const at = toX(x, state.radius_um * factor);
    const line = cursor.hidden ? "" : `<path d="M${at.toFixed(1)} ${INSIDE.y}v${INSIDE.height}" stroke="white" stroke-dasharray="4 4"/>`;
    return framed(x, y, image + line, "");
  };

  return {
    element,
    fields: ["lee_from_um", "lee_to_um"],
    async update(alive) {
      const state = page.state();
      mark(state);
      // what is on the sheet already stays, as long as it is the same sheet
      const { radius_um: _, ...drop } = dropOf(state);
      const wanted = JSON.stringify([drop, state.light, state.light === "one" ? state.wavelength_nm : 0, state.sun_disc, state.azimuth_deg, state.lee_from_um, state.lee_to_um]);
      if (wanted !== key) {
        columns.clear();
        done.clear();
        rgb = new Map();
        key = wanted;
      }
      const painting = { op: "paint", polarisation: state.polarisation, stops: 0 };
      const stretch = { from: FROM, to: TO, points: ROWS };
      const ask = async (column: number, fineness: number, lane: "quickly" | "finely", more = {}): Promise<void> => {
        const drop = { ...dropOf(state), radius_um: radiusAt(state, column) };
        const [found, painted] = await page.engine[lane]([{ header: columnOf(state, stretch, fineness, { drop, ...more }) }, { header: painting, of: 0 }]);
        if (lane === "finely" && !alive()) return;
        columns.set(column, found?.f64["xyz"] ?? new Float64Array());
        rgb.set(column, painted?.u8["rgb"] ?? new Uint8Array());
        draw();
      };
      const middle = Math.round(Math.min(COLUMNS - 1, Math.max(0, columnAt(state, state.radius_um))));
      if (columns.size === 0) {
        await ask(middle, SKETCH, "quickly", isRound(state.shape) ? {} : { wavelength_nm: 560, sun_disc: false });
        page.status("coarse: one column", true);
      } else if (painted !== state.polarisation) {
        const known = [...columns.keys()];
        const replies = await page.engine.quickly(known.map((column) => ({ header: painting, numbers: columns.get(column) ?? new Float64Array() })));
        known.forEach((column, i) => rgb.set(column, replies[i]?.u8["rgb"] ?? new Uint8Array()));
        draw();
      }
      painted = state.polarisation;
      // coarsely all over, then every column as it should be
      const fineness = isRound(state.shape) ? 0.3 : 0.1;
      let refused: unknown;
      const passes: [step: number, fineness: number][] = [[16, 0.1], [4, fineness], [1, fineness]];
      for (const [step, fine] of passes) {
        for (let column = 0; column < COLUMNS; column += step) {
          if (!alive()) return;
          if (done.has(column) || (step === 16 && columns.has(column))) continue;
          try {
            await ask(column, fine, "finely");
            if (step < 16) done.add(column);
          } catch (error) {
            // one size may be outside of what a shape or a method serves: the others are drawn all the same
            if (error instanceof Dropped || !alive()) return;
            done.add(column);
            refused = error;
          }
          page.status(`coarse: ${columns.size} of ${COLUMNS} columns`, true);
        }
      }
      if (refused !== undefined) page.refuse(refused);
      page.status(`${columns.size} columns; ${isRound(state.shape) ? "exact series" : "rays with phase"}`, false);
    },
    canvas: () => drawn(svg(), PLOT.width, PLOT.height),
    svg,
    csv() {
      const state = page.state();
      const filled = [...columns.keys()].sort((a, b) => a - b);
      const rows = filled.flatMap((column) => Array.from({ length: ROWS }, (_, row) => ({ column, row })));
      const value = (part: number) => rows.map(({ column, row }) => {
        const six = columns.get(column);
        return (six?.[row * PER_ANGLE + part] ?? NaN) + (six?.[row * PER_ANGLE + 3 + part] ?? NaN);
      });
      return table("Lee diagram: XYZ of all light, 1/sr", [
        ["radius_um", rows.map(({ column }) => radiusAt(state, column))],
        ["scattering_angle_deg", rows.map(({ row }) => FROM + ((TO - FROM) * row) / (ROWS - 1))],
        ["X", value(0)], ["Y", value(1)], ["Z", value(2)],
      ]);
    },
  };
}
