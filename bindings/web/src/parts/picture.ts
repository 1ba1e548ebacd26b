/** Pictures and numbers for export. */

import { escaped } from "./dom";

/** An SVG text, drawn. */
export async function drawn(svg: string, width: number, height: number): Promise<HTMLCanvasElement> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [2 * width, 2 * height];
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas;
}

export interface Axis {
  label: string;
  from: number;
  to: number;
  log?: boolean;
}

const [LEFT, RIGHT, TOP, BOTTOM] = [70, 20, 16, 52];
export const PLOT = { width: 900, height: 520 };

/** Steps of a logarithmic axis within a power of ten: the more, the fewer powers there are. */
const WITHIN = [[1], [1, 2, 5], [1, 2, 3, 4, 5, 6, 8]] as const;
const ENOUGH = 4;

/** Round numbers between two. */
export function ticks({ from, to, log }: Axis): number[] {
  const [low, high] = [Math.min(from, to), Math.max(from, to)];
  if (log && high > 2 * low) {
    const inside = (factors: readonly number[]): number[] => {
      const found: number[] = [];
      for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high) + 1e-9; power += 1) {
        found.push(...factors.map((factor) => Number((factor * 10 ** power).toPrecision(12))));
      }
      return found.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
    };
    return WITHIN.map(inside).find((found) => found.length >= ENOUGH) ?? inside(WITHIN[2]);
  }
  const raw = (high - low) / 8;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((candidate) => candidate >= raw) ?? raw;
  const found: number[] = [];
  for (let tick = Math.ceil(low / step); tick * step <= high * (1 + 1e-12); tick += 1) found.push(Number((tick * step).toPrecision(12)));
  return found;
}

/** Where a value stands between the ends of an axis, 0 to 1. */
export const place = (axis: Axis, value: number): number => {
  const of = (v: number): number => (axis.log ? Math.log10(v) : v);
  return (of(value) - of(axis.from)) / (of(axis.to) - of(axis.from));
};

export const toX = (axis: Axis, value: number): number => LEFT + place(axis, value) * (PLOT.width - LEFT - RIGHT);
export const toY = (axis: Axis, value: number): number => PLOT.height - BOTTOM - place(axis, value) * (PLOT.height - TOP - BOTTOM);

/** A tick's number. */
export const short = (value: number, log: boolean | undefined): string => (log && Math.abs(Math.log10(value)) > 3 ? value.toExponential(0) : String(Number(value.toPrecision(6))));

/** A frame with axes around `body`, which is drawn by [`toX`] and [`toY`]. */
export function framed(x: Axis, y: Axis, body: string, caption: string): string {
  const { width, height } = PLOT;
  const text = (at: string, anchor: string, words: string): string => `<text ${at} text-anchor="${anchor}">${escaped(words)}</text>`;
  const across = ticks(x).map((tick) => {
    const at = toX(x, tick).toFixed(1);
    return `<path d="M${at} ${height - BOTTOM}v5"/>${text(`x="${at}" y="${height - BOTTOM + 19}" stroke="none"`, "middle", short(tick, x.log))}`;
  });
  const up = ticks(y).map((tick) => {
    const at = toY(y, tick).toFixed(1);
    return `<path d="M${LEFT} ${at}h-5"/>${text(`x="${LEFT - 8}" y="${Number(at) + 4}" stroke="none"`, "end", short(tick, y.log))}`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" font-family="sans-serif" font-size="13">
<rect width="${width}" height="${height}" fill="white"/>${body}
<g stroke="#333" fill="#333" stroke-width="1">${across.join("")}${up.join("")}
<rect x="${LEFT}" y="${TOP}" width="${width - LEFT - RIGHT}" height="${height - TOP - BOTTOM}" fill="none"/>
${text(`x="${(LEFT + width - RIGHT) / 2}" y="${height - 14}" stroke="none"`, "middle", `${x.label}${caption === "" ? "" : `     ${caption}`}`)}
<text transform="translate(16 ${(TOP + height - BOTTOM) / 2}) rotate(-90)" text-anchor="middle" stroke="none">${escaped(y.label)}</text></g></svg>`;
}

/** Where the frame's inside lies. */
export const INSIDE = { x: LEFT, y: TOP, width: PLOT.width - LEFT - RIGHT, height: PLOT.height - TOP - BOTTOM };

/** Columns of numbers with names and a line about them. */
export function table(about: string, columns: readonly (readonly [name: string, values: ArrayLike<number>])[]): string {
  const rows = Math.max(...columns.map(([, values]) => values.length));
  const lines = [`# ${about.replace(/\s+/g, " ")}`, columns.map(([name]) => name.replaceAll(",", "")).join(",")];
  for (let row = 0; row < rows; row += 1) lines.push(columns.map(([, values]) => String(values[row] ?? "")).join(","));
  return `${lines.join("\n")}\n`;
}

/** Pixels as a canvas of their own. */
export function canvasOf(rgba: Uint8Array, width: number, height: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height];
  canvas.getContext("2d")?.putImageData(new ImageData(new Uint8ClampedArray(rgba), width, height), 0, 0);
  return canvas;
}
