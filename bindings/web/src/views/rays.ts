/** Rays through the drop: one that is dragged, in colours, and a fan with its caustic. */

import { Dropped } from "../engine/engine";
import type { Reply } from "../engine/message";
import { dropOf, isRound, type State } from "../state";
import { escaped, make } from "../parts/dom";
import { drawn, table } from "../parts/picture";
import { angleShown, digits } from "../parts/units";
import type { Page, View } from "./view";

/** Wavelengths of the dragged ray in daylight, nm. */
const COLOURS = [420, 470, 510, 550, 589, 620, 680];
/** Rays of the fan, drawn and for the caustic. */
const DRAWN = 41;
const FINE = 401;
/** Half width of the picture, in radii; pixels. */
const REACH = 2.6;
const SIDE = 640;
const SCALE = SIDE / (2 * REACH);

const pixel = (x: number, z: number): string => `${((z + REACH) * SCALE).toFixed(1)},${((REACH - x) * SCALE).toFixed(1)}`;

interface Bow {
  order: number;
  nm: number;
  impact: number;
  deg: number;
}

export function raysView(page: Page): View {
  const drawing = make("div", { class: "drawing rays", tabindex: "0", role: "application", "aria-label": "Rays through the drop. Arrow up and down move the impact of the coloured ray." });
  const legend = make("p", { class: "legend" });
  const element = make("section", { class: "view-rays" }, drawing, legend);
  let fine: { coarse: Reply; caustic: Reply | undefined } | undefined;

  const drag = (event: PointerEvent): void => {
    if (event.buttons !== 1) return;
    const box = drawing.getBoundingClientRect();
    const x = REACH - ((event.clientY - box.top) / box.height) * 2 * REACH;
    page.change({ impact: Number(Math.min(0.999, Math.max(-0.999, x)).toFixed(3)) });
  };
  drawing.addEventListener("pointerdown", (event) => {
    drawing.setPointerCapture(event.pointerId);
    drag(event);
  });
  drawing.addEventListener("pointermove", drag);
  drawing.addEventListener("keydown", (event) => {
    const step = { ArrowUp: 0.01, ArrowDown: -0.01 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    page.change({ impact: Number(Math.min(0.999, Math.max(-0.999, page.state().impact + step)).toFixed(3)) });
  });

  const question = (state: State, more: Record<string, unknown>) => ({
    op: "rays", drop: dropOf(state), orders: state.orders, impacts: [] as number[], fan: 0, rainbows: false, wavelengths_nm: [state.wavelength_nm], ...more,
  });

  const show = (state: State): void => {
    if (!fine) return;
    drawing.innerHTML = svgOf(state, fine.coarse, fine.caustic);
    legend.innerHTML = words(state, fine.coarse, fine.caustic);
  };

  return {
    element,
    fields: ["orders", "impact", "fan", "caustic"],
    async update(alive) {
      const state = page.state();
      const wavelengths = state.light === "daylight" ? COLOURS : [state.wavelength_nm];
      const coarse = await page.engine.quick(question(state, { impacts: [state.impact], wavelengths_nm: wavelengths }));
      fine = { coarse, caustic: fine?.caustic };
      const stale = { ...fine, caustic: undefined };
      fine = stale;
      show(state);
      page.status("rays of geometrical optics", false);
      if (!alive()) return;
      try {
        const fan = state.fan || state.caustic ? FINE : 2;
        const caustic = await page.engine.fine(question(state, { fan: state.shape === "layered" || state.shape === "gradient" ? 121 : fan, impacts: impacts(), wavelengths_nm: [state.wavelength_nm], rainbows: true }));
        if (!alive()) return;
        fine = { coarse, caustic };
        show(state);
        page.status(`rays of geometrical optics; caustic and rainbows at ${digits(state.wavelength_nm)} nm`, false);
      } catch (error) {
        if (!(error instanceof Dropped)) throw error;
      }
    },
    canvas: () => drawn(standalone(page.state(), fine), SIDE, SIDE),
    svg: () => standalone(page.state(), fine),
    csv() {
      const rows = (fine?.coarse.header["paths"] ?? []) as [number, number, number, number][];
      const column = (k: 0 | 1 | 2 | 3): number[] => rows.map((row) => row[k]);
      return table("rays: impact in radii of the sphere of equal volume", [["order", column(0)], ["wavelength_nm", column(1)], ["impact", column(2)], ["scattering_angle_deg", column(3)]]);
    },
  };
}

const impacts = (): number[] => Array.from({ length: DRAWN }, (_, i) => -0.995 + (1.99 * i) / (DRAWN - 1));

type Path = [order: number, nm: number, impact: number, deg: number, count: number, colour: [number, number, number]];

/** Each ray as a line from the left edge to far away. */
function lines(reply: Reply, style: (path: Path) => string): string {
  const points = reply.f64["points"] ?? new Float64Array();
  let place = 0;
  return ((reply.header["paths"] ?? []) as Path[]).map((path) => {
    const count = path[4];
    const at = (i: number): [number, number] => [points[place + 2 * i] ?? NaN, points[place + 2 * i + 1] ?? NaN];
    const inside = Array.from({ length: count }, (_, i) => at(i));
    const [first, last, end] = [at(0), at(count - 1), at(count)];
    place += 2 * (count + 1);
    const far: [number, number] = [last[0] + 8 * end[0], last[1] + 8 * end[1]];
    const way = [[first[0], -2 * REACH] as [number, number], ...inside, far].map(([x, z]) => pixel(x, z)).join(" ");
    return `<polyline points="${way}" ${style(path)}/>`;
  }).join("");
}

function svgOf(state: State, coarse: Reply, fine: Reply | undefined): string {
  const outline = coarse.f64["outline"] ?? new Float64Array();
  const rim = Array.from({ length: outline.length / 2 }, (_, i) => pixel(outline[2 * i] ?? 0, outline[2 * i + 1] ?? 0)).join(" ");
  const fan = state.fan && fine ? lines(fine, ([order]) => `stroke="var(--order-${order})" stroke-width="0.7" opacity="0.5"`) : "";
  const single = lines(coarse, ([, , , , , [r, g, b]]) => `stroke="rgb(${r} ${g} ${b})" stroke-width="1.6"`);
  const caustics = state.caustic && fine ? foci(fine) : "";
  const down = isRound(state.shape) ? "" : upright(state);
  return `<svg viewBox="0 0 ${SIDE} ${SIDE}" role="img" aria-label="Rays of orders ${state.orders.join(", ")}" fill="none">
<polygon points="${rim}" fill="var(--drop)" stroke="var(--accent)" stroke-width="1.5"/>${down}${fan}${caustics}${single}
<text x="10" y="${(REACH * SCALE - 8).toFixed(0)}" fill="var(--muted)" font-size="14">sunlight →</text></svg>`;
}

/** The vertical of a drop whose axis the light meets aslant. */
function upright(state: State): string {
  const elevation = (state.sun_elevation_deg * Math.PI) / 180;
  const [x, z] = [Math.cos(elevation), -Math.sin(elevation)];
  return `<polyline points="${pixel(-1.4 * x, -1.4 * z)} ${pixel(1.4 * x, 1.4 * z)}" stroke="var(--muted)" stroke-dasharray="6 4"/>`;
}

function foci(reply: Reply): string {
  const all = reply.f64["foci"] ?? new Float64Array();
  let place = 0;
  return ((reply.header["caustics"] ?? []) as [number, number, number][]).map(([order, , count]) => {
    // light comes through the real ones, and seems to come from the others
    const kinds = [0, 1].map((wanted) => {
      const parts: string[] = [];
      let open = false;
      for (let i = 0; i < count; i += 1) {
        const [x, z, real] = [all[place + 3 * i] ?? NaN, all[place + 3 * i + 1] ?? NaN, all[place + 3 * i + 2]];
        const near = Math.hypot(x, z) < 6 && real === wanted;
        if (near) parts.push(`${open ? "L" : "M"}${pixel(x, z)}`);
        open = near;
      }
      return `<path d="${parts.join("")}" stroke="var(--order-${order})" stroke-width="2.2"${wanted === 0 ? ' stroke-dasharray="5 4" opacity="0.7"' : ""}/>`;
    });
    place += 3 * count;
    return kinds.join("");
  }).join("");
}

function words(state: State, coarse: Reply, fine: Reply | undefined): string {
  const paths = (coarse.header["paths"] ?? []) as Path[];
  const middle = (order: number): Path | undefined => {
    const own = paths.filter((path) => path[0] === order);
    return own[Math.floor(own.length / 2)];
  };
  const lines = state.orders.map((order) => {
    const ray = middle(order);
    const bows = ((fine?.header["rainbows"] ?? []) as Bow[]).filter((bow) => bow.order === order);
    const leaves = ray ? `leaves at ${angleShown(state, ray[3]).toFixed(2)}°` : "no ray leaves from this impact";
    const told = [...new Set(bows.map((bow) => angleShown(state, bow.deg).toFixed(2)))].map((deg) => `${deg}°`).join(", ");
    return `<span style="color:var(--order-${order})">■</span> order ${order}: ${escaped(leaves)}${told === "" ? "" : `; rainbow at <b>${told}</b>`}`;
  });
  const caustic = state.caustic && state.orders.length > 0 ? "<br>Thick: the caustic, where neighbouring rays cross; dashed where they only seem to come from." : "";
  return lines.join("<br>") + caustic;
}

/** With colours of its own instead of the page's. */
function standalone(state: State, replies: { coarse: Reply; caustic: Reply | undefined } | undefined): string {
  if (!replies) return "";
  const style = getComputedStyle(document.documentElement);
  const body = svgOf(state, replies.coarse, replies.caustic).replace(/var\((--[a-z0-9-]+)\)/g, (_, name: string) => style.getPropertyValue(name).trim());
  return body.replace("<svg ", `<svg xmlns="http://www.w3.org/2000/svg" width="${SIDE}" height="${SIDE}" font-family="sans-serif" `);
}
