/** Bundles the page into dist: node build.mjs ENGINE.wasm */

import { build } from "esbuild";
import { mkdirSync, readFileSync, writeFileSync, copyFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const [, , engine] = process.argv;
if (!engine) throw new Error("node build.mjs ENGINE.wasm");
const common = { bundle: true, minify: true, format: "iife", target: "es2022", logLevel: "warning" };
const worker = await build({ ...common, entryPoints: ["src/engine/worker.ts"], write: false });
mkdirSync("dist", { recursive: true });
await build({
  ...common, entryPoints: { page: "src/main.ts" }, outdir: "dist", legalComments: "eof",
  define: { WORKER_SOURCE: JSON.stringify(worker.outputFiles[0].text) },
});
const packed = gzipSync(readFileSync(engine), { level: 9 }).toString("base64");
writeFileSync("dist/engine.js", `window.GONIO_ENGINE="${packed}";\n`);
copyFileSync("src/index.html", "dist/index.html");
