/** Two drops side by side, or rays against the exact series with the error. */

import type { Reply } from "../engine/message";
import { dropOf, isRound, SHAPES, type State } from "../state";
import { Chart, type Curve, range } from "../parts/chart";
import { columnOf, SKETCH } from "../parts/column";
import { make, themed } from "../parts/dom";
import { drawn, PLOT, table } from "../parts/picture";
import { angleName, angleShown, digits, sizeText } from "../parts/units";
import { chosen } from "./scattered";
import type { Page, View } from "./view";

const COARSE = 241;
const FINE = 1201;
/** Scattering angles at which colours are compared. */
const LIMITS = { from: 90, to: 170 };
/** Degrees over which the error of rays is averaged: their single ripples mean nothing. */
const BAND = 1;

export function compareView(page: Page): View {
  const zoom = (a: number, b: number): void => {
    const [from, to] = page.state().angle_from === "antisolar" ? [180 - b, 180 - a] : [a, b];
    page.change({ from_deg: Math.max(0, Number(from.toFixed(2))), to_deg: Math.min(180, Number(Math.max(to, from + 0.5).toFixed(2))) });
  };
  const chart = new Chart("Both over the angle", zoom);
  const error = new Chart("The second against the first", zoom);
  const words = make("p", { class: "legend" });
  const element = make("section", { class: "view-compare" }, chart.element, error.element, words);
  let shown: { at: number[]; curves: Curve[] } = { at: [], curves: [] };

  const shape = (name: string): string => SHAPES.find(([word]) => word === name)?.[1] ?? name;
  const show = (state: State, a: Float64Array, b: Float64Array, deg: Float64Array): void => {
    const flip = state.angle_from === "antisolar";
    const order = <T>(values: ArrayLike<T>): T[] => (flip ? Array.from(values).reverse() : Array.from(values));
    const at = order(deg).map((value) => angleShown(state, value));
    const second = state.other === "rays" ? "rays with phase" : `${shape(state.other_shape)}, ${sizeText(state, state.other_um)}`;
    const first = state.other === "rays" ? "Lorenz–Mie" : `${shape(state.shape)}, ${sizeText(state, state.radius_um)}`;
    const curves: Curve[] = [
      { name: first, colour: themed("--accent"), values: order(chosen(state, a)), width: 1.6 },
      { name: second, colour: themed("--order-2"), values: order(chosen(state, b)) },
    ];
    const intensity = state.curve === "intensity";
    const [from, to] = [angleShown(state, state.from_deg), angleShown(state, state.to_deg)];
    const x = { label: angleName(state), from: Math.min(from, to), to: Math.max(from, to) };
    const log = state.log && intensity;
    chart.show({ x, y: { label: intensity ? "intensity (1/sr)" : "degree of polarisation", log, ...(intensity ? range(curves, log) : { from: -1, to: 1 }) }, at, curves, marks: [] });
    const means = curves.map((curve) => smoothed(at, Array.from(curve.values)));
    const ratio = at.map((_, i) => {
      const [p, q] = [means[0]?.[i] ?? NaN, means[1]?.[i] ?? NaN];
      return intensity ? (q - p) / p : q - p;
    });
    const off: Curve[] = [{ name: intensity ? `relative difference, means over ${BAND}°` : `difference, means over ${BAND}°`, colour: themed("--order-4"), values: ratio }];
    const largest = Math.min(10, Math.max(0.02, ...ratio.map((value) => (Number.isFinite(value) ? Math.abs(value) : 0))));
    error.show({ x, y: { label: intensity ? "(second − first) / first" : "second − first", from: -1.05 * largest, to: 1.05 * largest }, at, curves: off, marks: [] });
    shown = { at, curves: [...curves, ...off] };
    const middle = ratio.map(Math.abs).filter(Number.isFinite).sort((p, q) => p - q);
    words.textContent = `Half of the angles differ by less than ${digits(100 * (middle[Math.floor(middle.length / 2)] ?? NaN), 3)} %, the worst by ${digits(100 * (middle.at(-1) ?? NaN), 3)} %.`;
  };

  const scattered = (state: State, other: boolean, fine: boolean) => {
    const rays = state.other === "rays" && other;
    const own = other && !rays ? { shape: state.other_shape, radius_um: state.other_um } : {};
    const round = isRound(String(own.shape ?? state.shape)) && !rays;
    const drop = { ...dropOf(state), ...own, ...(fine ? {} : { spread: 0 }) };
    return {
      op: "scattered", drop, wavelength_nm: state.wavelength_nm, theta_deg: [state.from_deg, state.to_deg], points: fine ? FINE : COARSE,
      azimuth_deg: state.azimuth_deg, orders: round || fine ? [] : [2], sun_disc: fine && state.sun_disc, sizes: 24,
      tolerance: fine ? 0.02 : 0.1, by_rays: rays, whole: round || fine,
    };
  };
  const curve = (reply: Reply): Float64Array => reply.f64["whole"] ?? reply.f64["order 2"] ?? new Float64Array();

  return {
    element,
    fields: ["other", "other_shape", "other_um", "curve", "log", "from_deg", "to_deg"],
    async update(alive) {
      const state = page.state();
      if (state.other === "rays" && state.shape !== "sphere") {
        throw new Error("rays are compared with the exact series of a sphere: choose the sphere as the drop");
      }
      if (state.light === "daylight" && state.other === "drop") {
        if (state.to_deg <= LIMITS.from || state.from_deg >= LIMITS.to - 0.5) {
          throw new Error(`in daylight drops are compared from ${LIMITS.from} to ${LIMITS.to}° from the sun: choose angles there, or one wavelength`);
        }
        // near the axis colours take longest, and this is about bows
        const stretch = { from: Math.max(state.from_deg, LIMITS.from), to: Math.min(state.to_deg, LIMITS.to), points: COARSE };
        const both = (fineness: number, points: number, lane: "quickly" | "finely"): Promise<Reply[]> =>
          page.engine[lane]([{}, { shape: state.other_shape, radius_um: state.other_um }].map((own) => {
            const sketch = isRound(String(own.shape ?? state.shape)) || lane === "finely" ? {} : { wavelength_nm: 560, sun_disc: false };
            return { header: columnOf(state, { ...stretch, points }, fineness, { drop: { ...dropOf(state), ...own }, ...sketch }) };
          }));
        const luminance = (reply: Reply | undefined): Float64Array => {
          const xyz = reply?.f64["xyz"] ?? new Float64Array();
          return Float64Array.from({ length: xyz.length / 3 }, (_, i) => xyz[6 * (i >> 1) + (i % 2 === 0 ? 1 : 4)] ?? NaN);
        };
        for (const [fineness, points, lane] of [[SKETCH, 121, "quickly"], [0.4, 601, "finely"]] as const) {
          const [a, b] = await both(fineness, points, lane);
          if (lane === "finely" && !alive()) return;
          show(state, luminance(a), luminance(b), a?.f64["theta_deg"] ?? new Float64Array());
          page.status(lane === "quickly" ? "coarse: luminance in daylight, few wavelengths" : `luminance in daylight, ${LIMITS.from} to ${LIMITS.to}° from the sun`, lane === "quickly");
          if (!alive()) return;
        }
        return;
      }
      const [a, b] = await page.engine.quickly([false, true].map((other) => ({ header: scattered(state, other, false) })));
      if (!a || !b) return;
      const single = !isRound(state.shape) || state.other === "rays" || !isRound(state.other_shape);
      show(state, curve(a), curve(b), a.f64["theta_deg"] ?? new Float64Array());
      page.status(`coarse${single ? ": of rays order 2 alone" : ""}${state.sun_disc ? ", a point of light" : ""}`, true);
      if (!alive()) return;
      const fineA = await page.engine.fine(scattered(state, false, true));
      if (!alive()) return;
      const fineB = await page.engine.fine(scattered(state, true, true));
      if (!alive()) return;
      show(state, curve(fineA), curve(fineB), fineA.f64["theta_deg"] ?? new Float64Array());
      page.status(`${digits(state.wavelength_nm)} nm: ${String(fineA.header["method"])} and ${String(fineB.header["method"])}`, false);
    },
    canvas: () => drawn(chart.svg(""), PLOT.width, PLOT.height),
    svg: () => chart.svg(""),
    csv: () => table("two drops compared", [["angle_deg", shown.at], ...shown.curves.map((each) => [each.name, each.values] as const)]),
  };
}

/** Means over a band about each angle (both ascending). */
function smoothed(at: readonly number[], values: readonly number[]): number[] {
  let [low, high, sum] = [0, 0, 0];
  return at.map((deg) => {
    while (high < at.length && (at[high] ?? Infinity) <= deg + BAND / 2) sum += values[high++] ?? 0;
    while ((at[low] ?? Infinity) < deg - BAND / 2) sum -= values[low++] ?? 0;
    return sum / (high - low);
  });
}
