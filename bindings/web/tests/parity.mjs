/** node tests/parity.mjs ENGINE.wasm NATIVE: both give the same numbers, to 1e-12 of the largest of each curve; single
 * orders, which are small differences of larger terms, of the whole. */

import { spawnSync } from "node:child_process";
import { engine, pack, REQUESTS, unpack } from "./requests.mjs";

const BOUND = 1e-12;
/** Of waves by rays: their phases are thousands of radians, whose last digits grow on the way. */
const BOUND_OF_RAYS = 1e-10;
const [, , wasm, native] = process.argv;
if (!wasm || !native) throw new Error("node tests/parity.mjs ENGINE.wasm NATIVE");
const ask = await engine(wasm);
const worst = { series: 0, rays: 0 };
let numbers = 0;
for (const request of REQUESTS) {
  const here = ask(request);
  const run = spawnSync(native, { input: pack(request), maxBuffer: 1 << 28 });
  if (run.status !== 0) throw new Error(`${native} failed: ${run.stderr}`);
  const there = unpack(new Uint8Array(run.stdout));
  if (here.header.error || there.header.error) throw new Error(`${JSON.stringify(request)}: ${JSON.stringify(here.header.error ?? there.header.error)}`);
  const kind = String(here.header.method).startsWith("rays") ? "rays" : "series";
  const bound = kind === "rays" ? BOUND_OF_RAYS : BOUND;
  for (const [name, values] of Object.entries(here.blocks)) {
    const others = there.blocks[name];
    if (!others || others.length !== values.length) throw new Error(`${request.op}: ${name} has another length`);
    // rays close to parallel meet far away: there the place says little
    const near = name === "foci" ? 10 : Infinity;
    const scale = name.startsWith("order") || name === "added" ? (here.blocks.whole ?? values) : values;
    const largest = scale.reduce((most, value) => (Math.abs(value) < near ? Math.max(most, Math.abs(value)) : most), 1e-300);
    values.forEach((value, i) => {
      const other = others[i];
      if (Number.isNaN(value) && Number.isNaN(other)) return;
      if (Math.abs(value) > near) return;
      const off = Math.abs(value - other) / largest;
      numbers += 1;
      worst[kind] = Math.max(worst[kind], off);
      if (!(off <= bound)) throw new Error(`${request.op} of ${JSON.stringify(request.drop)}, ${name}[${i}]: ${value} here, ${other} there (${off.toExponential(1)})`);
    });
  }
}
console.log(`parity: ${numbers} numbers of ${REQUESTS.length} requests agree to ${worst.series.toExponential(1)}, waves by rays to ${worst.rays.toExponential(1)}`);
