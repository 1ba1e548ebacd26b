/** Scattered light over the angle: the whole, and by orders where there are any. */

import type { Header, Reply } from "../engine/message";
import type { Step } from "../engine/worker";
import { dropOf, isRound, type State } from "../state";
import { Chart, type Curve, range } from "../parts/chart";
import { columnOf, SKETCH } from "../parts/column";
import { make, themed } from "../parts/dom";
import { canvasOf, drawn, PLOT, table } from "../parts/picture";
import { angleName, angleShown, digits, sizeName, sizeText } from "../parts/units";
import type { Page, View } from "./view";

/** Angles of a coarse and of a fine curve; of large round drops a coarse one has fewer. */
const COARSE = 241;
const COARSE_OF_LARGE = 121;
const LARGE_UM = 200;
const FINE = 1801;
/** Sizes that stand for a spread. */
const SIZES = 48;

export function scatteredView(page: Page): View {
  const chart = new Chart("Scattered light over the angle", (a, b) => {
    const [from, to] = page.state().angle_from === "antisolar" ? [180 - b, 180 - a] : [a, b];
    page.change({ from_deg: Math.max(0, Number(from.toFixed(2))), to_deg: Math.min(180, Number(Math.max(to, from + 0.5).toFixed(2))) });
  });
  const strip = make("canvas", { class: "strip", width: "900", height: "1", role: "img", "aria-label": "Colours over the angle, as far as they are of daylight" });
  const whole = make("button", { type: "button", click: () => page.change({ from_deg: 0, to_deg: 180 }) }, "0 to 180°");
  const bow = make("button", { type: "button", click: () => page.change({ from_deg: 125, to_deg: 150 }) }, "the bows");
  const glory = make("button", { type: "button", click: () => page.change({ from_deg: 170, to_deg: 180 }) }, "the glory");
  const single = make("button", { type: "button", click: () => page.change({ light: "one" }) }, "Show orders at one wavelength");
  const note = make("p", { class: "note" }, "Orders stand apart in light of one wavelength. ", single);
  const element = make("section", { class: "view-scattered" }, chart.element, strip, make("p", { class: "buttons" }, whole, bow, glory, "drag in the chart to zoom"), note);
  let shown: { at: number[]; curves: Curve[] } = { at: [], curves: [] };
  let caption = "";

  const coarse = (state: State): number => (isRound(state.shape) && state.radius_um > LARGE_UM ? COARSE_OF_LARGE : COARSE);
  const question = (state: State, fine: boolean, whole: boolean) => ({
    op: "scattered", drop: fine ? dropOf(state) : { ...dropOf(state), spread: 0 }, wavelength_nm: state.wavelength_nm,
    theta_deg: [state.from_deg, state.to_deg], points: fine ? FINE : coarse(state), azimuth_deg: state.azimuth_deg,
    // of rays one order is quick, and the primary bow matters most
    orders: fine || isRound(state.shape) ? state.orders : [state.orders.includes(2) ? 2 : (state.orders[0] ?? 2)],
    sun_disc: fine && state.sun_disc, sizes: SIZES, tolerance: fine ? 0.02 : 0.1, by_rays: false, whole,
  });

  const show = (state: State, curves: Curve[], at: number[], marks: { at: number; word: string }[]): void => {
    const flip = state.angle_from === "antisolar";
    const shownAt = at.map((deg) => angleShown(state, deg));
    const turned = curves.map((curve) => ({ ...curve, values: flip ? Array.from(curve.values).reverse() : curve.values }));
    shown = { at: flip ? [...shownAt].reverse() : shownAt, curves: turned };
    const log = state.log && state.curve === "intensity";
    const y = state.curve === "polarisation" ? { from: -1, to: 1 } : range(turned, log);
    const [from, to] = [angleShown(state, state.from_deg), angleShown(state, state.to_deg)];
    chart.show({
      x: { label: angleName(state), from: Math.min(from, to), to: Math.max(from, to) },
      y: { label: state.curve === "polarisation" ? "degree of linear polarisation" : state.light === "daylight" ? "luminance (1/sr)" : "intensity (1/sr)", ...y, log },
      at: shown.at, curves: turned, marks: marks.map((mark) => ({ ...mark, at: angleShown(state, mark.at) })),
    });
    caption = `${sizeName(state)} ${sizeText(state, state.radius_um)}${state.light === "one" ? `, ${state.wavelength_nm} nm` : ""}`;
  };

  const ofWavelength = (state: State, reply: Reply): void => {
    const orders = reply.header["orders"] as number[];
    const curve = (name: string, block: Float64Array | undefined, colour: string, more: Partial<Curve> = {}): Curve[] =>
      block ? [{ name, colour, values: chosen(state, block), ...more }] : [];
    const curves = [
      ...(state.whole ? curve("whole", reply.f64["whole"], themed("--text"), { width: 1.5 }) : []),
      ...(state.added ? curve("ticked, added", reply.f64["added"], themed("--accent"), { dashed: true }) : []),
      ...orders.flatMap((order) => curve(`order ${order}`, reply.f64[`order ${order}`], themed(`--order-${order}`))),
    ];
    const bows = (reply.header["rainbows"] as [number, number][]).filter(([order]) => orders.includes(order));
    show(state, curves, Array.from(reply.f64["theta_deg"] ?? []), bows.map(([order, deg]) => ({ at: deg, word: `bow ${order - 1}${isRound(state.shape) ? "" : " of a sphere"}` })));
  };

  const ofDaylight = (state: State, reply: Reply): void => {
    const xyz = reply.f64["xyz"] ?? new Float64Array();
    const y = new Float64Array(xyz.length / 3);
    for (let i = 0; i < y.length / 2; i += 1) {
      y[2 * i] = xyz[6 * i + 1] ?? 0;
      y[2 * i + 1] = xyz[6 * i + 4] ?? 0;
    }
    const name = state.curve === "polarisation" ? "polarisation of the luminance" : "luminance";
    show(state, [{ name, colour: themed("--text"), values: chosen(state, y), width: 1.5 }], Array.from(reply.f64["theta_deg"] ?? []), []);
  };

  const paint = (state: State, rgb: Uint8Array, deg: Float64Array): void => {
    const count = rgb.length / 3;
    const rgba = new Uint8Array(4 * count);
    for (let i = 0; i < count; i += 1) {
      const from = state.angle_from === "antisolar" ? count - 1 - i : i;
      rgba.set([rgb[3 * from] ?? 0, rgb[3 * from + 1] ?? 0, rgb[3 * from + 2] ?? 0, 255], 4 * i);
    }
    // a coarse column may reach over a part of the chart alone
    const ends = [deg[0] ?? 0, deg.at(-1) ?? 180].map((end) => (end - state.from_deg) / (state.to_deg - state.from_deg));
    const shares = state.angle_from === "antisolar" ? ends.map((end) => 1 - end).reverse() : ends;
    const [left, right] = shares.map((share) => share * strip.width) as [number, number];
    const context = strip.getContext("2d");
    context?.clearRect(0, 0, strip.width, 1);
    context?.drawImage(canvasOf(rgba, count, 1), left, 0, right - left, 1);
  };
  /** A column and its colours. */
  const coloured = (state: State, [column, painted]: Reply[]): void => {
    if (!column) return;
    ofDaylight(state, column);
    paint(state, painted?.u8["rgb"] ?? new Uint8Array(), column.f64["theta_deg"] ?? new Float64Array());
  };
  const steps = (state: State, header: Header): Step[] => [{ header }, { header: { op: "paint", polarisation: state.polarisation, stops: 0 }, of: 0 }];

  return {
    element,
    fields: ["orders", "whole", "added", "curve", "log", "from_deg", "to_deg"],
    async update(alive) {
      const state = page.state();
      const daylight = state.light === "daylight";
      note.hidden = !daylight;
      strip.hidden = !daylight;
      if (!daylight) {
        const first = await page.engine.quick(question(state, false, isRound(state.shape)));
        ofWavelength(state, first);
        const method = String(first.header["method"]);
        page.status(`coarse: ${coarse(state)} angles${state.sun_disc ? ", a point of light" : ""}${state.spread > 0 ? ", one size" : ""}${isRound(state.shape) ? "" : ", one order alone"}; ${method}`, true);
        if (!alive()) return;
        const fine = await page.engine.fine(question(state, true, state.whole || isRound(state.shape)));
        if (!alive()) return;
        ofWavelength(state, fine);
        const sizes = fine.header["sizes"] as number;
        page.status(`${method}; size parameter ${digits(fine.header["size_parameter"] as number)}${sizes > 1 ? `; mean of ${sizes} sizes` : ""}`, false);
        return;
      }
      // The bows first: near the axis colours take longest.
      const round = isRound(state.shape);
      const [from, to] = [Math.max(state.from_deg, Math.min(125, state.to_deg - 1)), state.to_deg];
      const near = { from, to: Math.max(from + 0.5, Math.min(to, 146)), points: 201 };
      const sketch = round ? {} : { wavelength_nm: 560, sun_disc: false, drop: { ...dropOf(state), spread: 0 } };
      coloured(state, await page.engine.quickly(steps(state, columnOf(state, round ? near : { ...near, points: 81 }, SKETCH, sketch))));
      page.status(round ? "coarse: few wavelengths, about the bows" : "coarse: the primary bow alone, at 560 nm", true);
      if (!alive()) return;
      for (const [fineness, points] of round ? [[0.2, 601], [1, FINE]] as const : [[0.1, 301], [0.4, 601]] as const) {
        const stretch = { from: state.from_deg, to: state.to_deg, points };
        // rays are not averaged over the disc near the axis
        const inside = round || !state.sun_disc ? stretch : { ...stretch, from: Math.max(1.5, stretch.from), to: Math.min(178.5, stretch.to) };
        const found = await page.engine.finely(steps(state, columnOf(state, inside, fineness)));
        if (!alive()) return;
        coloured(state, found);
        const last = fineness >= 0.4;
        page.status(`${last ? "" : "coarse: few wavelengths; "}${String(found[0]?.header["method"])}, daylight`, !last);
      }
    },
    canvas: () => drawn(chart.svg(caption), PLOT.width, PLOT.height),
    svg: () => chart.svg(caption),
    csv: () => table(caption, [["angle_deg", shown.at], ...shown.curves.map((curve) => [curve.name, curve.values] as const)]),
  };
}

/** Pairs (along, across) as intensity through the filter, or as degree of polarisation. */
export function chosen(state: State, pairs: Float64Array): Float64Array {
  return Float64Array.from({ length: pairs.length / 2 }, (_, i) => {
    const [along, across] = [pairs[2 * i] ?? 0, pairs[2 * i + 1] ?? 0];
    if (state.curve === "polarisation") return (across - along) / (across + along);
    return state.polarisation === "total" ? along + across : state.polarisation === "parallel" ? along : across;
  });
}

