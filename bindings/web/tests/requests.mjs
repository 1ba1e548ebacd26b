/** Questions to the engine, and what packs them: for tests in node. */

import { readFileSync } from "node:fs";

const up = (length) => Math.ceil(length / 8) * 8;

export function pack(header, numbers = new Float64Array(0)) {
  const text = new TextEncoder().encode(JSON.stringify(header));
  const bytes = new Uint8Array(8 + up(text.length) + 8 * numbers.length).fill(32, 8);
  new DataView(bytes.buffer).setBigUint64(0, BigInt(up(text.length)), true);
  bytes.set(text, 8);
  bytes.set(new Uint8Array(numbers.buffer, numbers.byteOffset, numbers.byteLength), 8 + up(text.length));
  return bytes;
}

export function unpack(bytes) {
  const length = Number(new DataView(bytes.buffer, bytes.byteOffset).getBigUint64(0, true));
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(8, 8 + length)));
  const blocks = {};
  let place = 8 + length;
  for (const [name, kind, count] of header.blocks) {
    const size = kind === "f64" ? 8 * count : count;
    const copy = bytes.slice(place, place + size);
    blocks[name] = kind === "f64" ? new Float64Array(copy.buffer) : copy;
    place += up(size);
  }
  return { header, blocks };
}

/** The engine of a wasm file, as a function. */
export async function engine(path) {
  const module = await WebAssembly.compile(readFileSync(path));
  const { exports } = await WebAssembly.instantiate(module, {});
  return (header, numbers) => {
    const request = pack(header, numbers);
    const room = exports.reserve(request.length);
    new Uint8Array(exports.memory.buffer, room, request.length).set(request);
    const place = exports.answer(room, request.length);
    const length = Number(new DataView(exports.memory.buffer, place).getBigUint64(0, true));
    const bytes = new Uint8Array(exports.memory.buffer, place + 8, length).slice();
    exports.release(place);
    return unpack(bytes);
  };
}

export const drop = (shape, radius_um, more = {}) => ({
  shape, radius_um, axis_ratio: 0.9, medium: "water", temperature_c: 20, core_fraction: 0.6, core_medium: "1.45",
  centre_index: 1.36, surface_index: 1.33, sun_elevation_deg: 20, spread: 0, ...more,
});

export const scattered = (what, more = {}) => ({
  op: "scattered", drop: what, wavelength_nm: 589, theta_deg: [120, 160], points: 201, azimuth_deg: 150, orders: [2, 3],
  sun_disc: false, sizes: 4, tolerance: 0.05, by_rays: false, whole: true, ...more,
});

export const column = (what, more = {}) => ({
  op: "column", drop: what, theta_deg: [130, 150], points: 81, azimuth_deg: 180, sun_disc: true, fineness: 0.1, wavelength_nm: null, ...more,
});

const rays = (what) => ({ op: "rays", drop: what, orders: [0, 1, 2, 3], impacts: [-0.7, 0.3, 0.86], fan: 41, rainbows: true, wavelengths_nm: [450, 650] });

/** One of every kind. */
export const REQUESTS = [
  scattered(drop("sphere", 5)), scattered(drop("sphere", 100)), scattered(drop("sphere", 800), { sun_disc: true, points: 51 }),
  scattered(drop("sphere", 30, { spread: 0.1, medium: "1.5+0.001i" })), scattered(drop("sphere", 100), { by_rays: true }),
  scattered(drop("layered", 20)), scattered(drop("gradient", 20)), scattered(drop("spheroid", 100), { orders: [2], whole: false }),
  // orders that cannot be followed: patches
  scattered(drop("spheroid", 60, { axis_ratio: 0.8 }), { theta_deg: [130, 150], azimuth_deg: 180, orders: [2], whole: false, tolerance: 0.02 }),
  scattered(drop("raindrop", 300), { orders: [2], whole: false }),
  column(drop("sphere", 10)), column(drop("sphere", 150, { spread: 0.05 })), column(drop("sphere", 100), { wavelength_nm: 500 }),
  column(drop("layered", 10)), column(drop("raindrop", 200), { wavelength_nm: 560, sun_disc: false }),
  ...["sphere", "spheroid", "raindrop", "layered", "gradient"].map((shape) => rays(drop(shape, 600))),
  { op: "scene", drop: drop("raindrop", 500), wavelength_nm: null, sun_disc: true },
];
