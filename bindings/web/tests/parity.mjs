/** node tests/parity.mjs ENGINE.wasm NATIVE ALIKE: all give the same numbers, to a share of the largest of each curve; single
 * orders, which are small differences of larger terms, of the whole.
 *
 * NATIVE has the system's elementary functions, whose last digits are not those of WebAssembly's: phases of waves by rays
 * are thousands of radians, and a last digit on the way becomes 1e-11 there. ALIKE has the same functions as the engine. */

import { spawnSync } from "node:child_process";
import { engine, pack, REQUESTS, unpack } from "./requests.mjs";

const [, , wasm, native, alike] = process.argv;
if (!wasm || !native || !alike) throw new Error("node tests/parity.mjs ENGINE.wasm NATIVE ALIKE");
const PROGRAMS = [
  { name: "the system's functions", path: native, bounds: { series: 1e-12, rays: 1e-10 } },
  { name: "the same functions", path: alike, bounds: { series: 1e-12, rays: 1e-12 } },
];
const ask = await engine(wasm);
for (const { name, path, bounds } of PROGRAMS) {
  const worst = { series: 0, rays: 0 };
  let numbers = 0;
  for (const request of REQUESTS) {
    const here = ask(request);
    const run = spawnSync(path, { input: pack(request), maxBuffer: 1 << 28 });
    if (run.status !== 0) throw new Error(`${path} failed: ${run.stderr}`);
    const there = unpack(new Uint8Array(run.stdout));
    if (here.header.error || there.header.error) throw new Error(`${JSON.stringify(request)}: ${JSON.stringify(here.header.error ?? there.header.error)}`);
    const kind = String(here.header.method).startsWith("rays") ? "rays" : "series";
    for (const [block, values] of Object.entries(here.blocks)) {
      const others = there.blocks[block];
      if (!others || others.length !== values.length) throw new Error(`${request.op}: ${block} has another length`);
      // rays close to parallel meet far away: there the place says little
      const near = block === "foci" ? 10 : Infinity;
      const scale = block.startsWith("order") || block === "added" ? (here.blocks.whole ?? values) : values;
      const largest = scale.reduce((most, value) => (Math.abs(value) < near ? Math.max(most, Math.abs(value)) : most), 1e-300);
      values.forEach((value, i) => {
        const other = others[i];
        if (Number.isNaN(value) && Number.isNaN(other)) return;
        if (Math.abs(value) > near) return;
        const off = Math.abs(value - other) / largest;
        numbers += 1;
        worst[kind] = Math.max(worst[kind], off);
        if (!(off <= bounds[kind])) throw new Error(`${name}: ${request.op} of ${JSON.stringify(request.drop)}, ${block}[${i}]: ${value} here, ${other} there (${off.toExponential(1)})`);
      });
    }
  }
  console.log(`parity, ${name}: ${numbers} numbers of ${REQUESTS.length} requests agree to ${worst.series.toExponential(1)}, waves by rays to ${worst.rays.toExponential(1)}`);
}
