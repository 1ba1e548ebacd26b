/** A chart of curves over an angle: uPlot, with cursor by mouse and keys, and zoom by dragging. */

import uPlot from "uplot";
import { themed } from "./dom";
import { type Axis, framed, toX, toY } from "./picture";

export interface Curve {
  name: string;
  colour: string;
  values: ArrayLike<number>;
  width?: number;
  dashed?: boolean;
}

export interface ChartData {
  x: Axis;
  y: Axis;
  /** As shown, ascending. */
  at: number[];
  curves: Curve[];
  /** Upright lines with a word, such as bows of geometrical optics. */
  marks: { at: number; word: string }[];
}

export class Chart {
  readonly element = document.createElement("div");
  private plot: uPlot | undefined;
  private data: ChartData | undefined;
  private shape = "";

  /** `zoomed` hears of a range that was dragged out. */
  constructor(label: string, private readonly zoomed: (from: number, to: number) => void) {
    this.element.className = "chart";
    this.element.tabIndex = 0;
    this.element.setAttribute("role", "application");
    this.element.setAttribute("aria-label", `${label}. Left and right move the cursor; its numbers stand below.`);
    this.element.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  show(data: ChartData): void {
    this.data = data;
    const shape = JSON.stringify([data.curves.map(({ name, colour, width, dashed }) => [name, colour, width, dashed]), data.x, data.y.label, data.y.log, themed("--text")]);
    const series = [data.at, ...data.curves.map((curve) => Array.from(curve.values, (value) => (data.y.log && !(value > 0) ? null : value)))] as uPlot.AlignedData;
    if (this.plot && shape === this.shape) {
      this.plot.setData(series, false);
      this.plot.batch(() => {
        this.plot?.setScale("x", { min: Math.min(data.x.from, data.x.to), max: Math.max(data.x.from, data.x.to) });
        this.plot?.setScale("y", { min: data.y.from, max: data.y.to });
      });
      return;
    }
    this.shape = shape;
    this.plot?.destroy();
    this.plot = new uPlot(this.options(data), series, this.element);
  }

  /** As an SVG text, on white. */
  svg(caption: string): string {
    const { data } = this;
    if (!data) return "";
    const lines = data.curves.map((curve) => {
      const parts: string[] = [];
      let open = false;
      data.at.forEach((at, i) => {
        const value = curve.values[i] ?? NaN;
        const drawn = Number.isFinite(value) && (!data.y.log || value > 0) && value >= data.y.from && value <= data.y.to;
        if (drawn) parts.push(`${open ? "L" : "M"}${toX(data.x, at).toFixed(2)} ${toY(data.y, value).toFixed(2)}`);
        open = drawn;
      });
      return `<path d="${parts.join("")}" fill="none" stroke="${curve.colour}" stroke-width="${curve.width ?? 1.3}"${curve.dashed ? ' stroke-dasharray="5 4"' : ""}/>`;
    });
    const names = data.curves.map((curve, i) => `<text x="86" y="${36 + 17 * i}" fill="${curve.colour}">${curve.name.replace(/[<&]/g, " ")}</text>`);
    return framed(data.x, data.y, lines.join("") + names.join(""), caption);
  }

  private options(data: ChartData): uPlot.Options {
    const [text, grid] = [themed("--text"), themed("--grid")];
    const axis = { stroke: text, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 } };
    const short = (value: number | null): string => (value === null ? "–" : value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e5) ? value.toExponential(3) : String(Number(value.toPrecision(5))));
    return {
      ...this.size(),
      // a white sheet under the curves is not needed: the page has its own
      scales: {
        x: { time: false, range: () => [Math.min(data.x.from, data.x.to), Math.max(data.x.from, data.x.to)] },
        y: { distr: data.y.log ? 3 : 1, range: () => [this.data?.y.from ?? 0, this.data?.y.to ?? 1] },
      },
      axes: [
        { ...axis, label: data.x.label, labelSize: 22 },
        { ...axis, label: data.y.label, labelSize: 22, size: 62, values: (_, splits) => splits.map((v) => (v === null ? "" : data.y.log ? (Math.abs(Math.log10(v) - Math.round(Math.log10(v))) < 1e-6 ? v.toExponential(0) : "") : short(v))) },
      ],
      series: [
        { label: data.x.label.replace(/ \(.*/, ""), value: (_, value) => (value === null ? "–" : `${value.toFixed(2)}°`) },
        ...data.curves.map((curve): uPlot.Series => ({
          label: curve.name, stroke: curve.colour, width: curve.width ?? 1.3, points: { show: false }, spanGaps: false,
          ...(curve.dashed ? { dash: [5, 4] } : {}), value: (_, value) => short(value),
        })),
      ],
      cursor: { drag: { x: true, y: false, setScale: false } },
      hooks: {
        setSelect: [(plot) => {
          const { left, width } = plot.select;
          if (width < 4) return;
          const [a, b] = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
          plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
          this.zoomed(a, b);
        }],
        draw: [(plot) => this.drawMarks(plot)],
      },
    };
  }

  private drawMarks(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = themed("--muted");
    ctx.fillStyle = themed("--muted");
    ctx.setLineDash([3, 4]);
    ctx.textAlign = "left";
    ctx.font = `${11 * devicePixelRatio}px sans-serif`;
    for (const { at, word } of this.data?.marks ?? []) {
      const x = plot.valToPos(at, "x", true);
      if (!(x >= bbox.left && x <= bbox.left + bbox.width)) continue;
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
      ctx.fillText(word, x + 3 * devicePixelRatio, bbox.top + 12 * devicePixelRatio);
    }
    ctx.restore();
  }

  private size(): { width: number; height: number } {
    const width = Math.max(240, this.element.clientWidth || 600);
    return { width, height: Math.max(290, Math.min(520, Math.round(width * 0.56))) };
  }

  private resize(): void {
    const size = this.size();
    if (this.plot && (this.plot.width !== size.width || this.plot.height !== size.height)) this.plot.setSize(size);
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step === undefined || !this.plot || !this.data) return;
    event.preventDefault();
    const last = this.data.at.length - 1;
    const now = this.plot.cursor.idx ?? Math.floor(last / 2);
    const next = Math.min(last, Math.max(0, now + step * (event.shiftKey ? 20 : 1)));
    const left = this.plot.valToPos(this.data.at[next] ?? 0, "x");
    this.plot.setCursor({ left, top: this.plot.bbox.height / (2 * devicePixelRatio) });
  }
}

/** A range of values that leaves a little room; of logarithms not more than so many decades. */
export function range(curves: readonly Curve[], log: boolean, decades = 7): { from: number; to: number } {
  let [low, high] = [Infinity, -Infinity];
  for (const { values } of curves) {
    for (let i = 0; i < values.length; i += 1) {
      const value = values[i] ?? NaN;
      if (!Number.isFinite(value) || (log && value <= 0)) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (!(high >= low)) return log ? { from: 1e-3, to: 1 } : { from: 0, to: 1 };
  if (log) {
    const to = 10 ** Math.ceil(Math.log10(high) - 1e-9);
    return { from: Math.max(10 ** Math.floor(Math.log10(low)), to / 10 ** decades), to: to === low ? 10 * to : to };
  }
  return { from: Math.min(0, low), to: high === 0 ? 1 : high * 1.05 };
}
