/** The worker: one engine, one question after the other. Bundled into the page as text. */

import { Instance } from "./instance";
import type { Header, Reply } from "./message";

/** First the module, then questions. */
export type ToWorker =
  | { kind: "module"; module: WebAssembly.Module }
  | { kind: "ask"; id: number; steps: Step[] };

/** One question of several that belong together; its numbers may be the `xyz` of an earlier answer. */
export interface Step {
  header: Header;
  numbers?: Float64Array;
  /** Which one. */
  of?: number;
}

export type FromWorker =
  | { kind: "reply"; id: number; replies: Reply[]; held: number; ms: number }
  | { kind: "broken"; id: number; message: string };

let module: WebAssembly.Module | undefined;
let instance: Promise<Instance> | undefined;

const post = (message: FromWorker, transfer: Transferable[] = []): void =>
  (self as unknown as DedicatedWorkerGlobalScope).postMessage(message, transfer);

self.onmessage = async (event: MessageEvent<ToWorker>) => {
  const told = event.data;
  if (told.kind === "module") {
    module = told.module;
    instance = Instance.of(told.module);
    return;
  }
  let engine: Instance | undefined;
  try {
    if (!module) throw new Error("no engine");
    instance ??= Instance.of(module);
    engine = await instance;
    const begun = performance.now();
    const replies: Reply[] = [];
    for (const { header, numbers, of } of told.steps) {
      const own = of === undefined ? numbers : replies[of]?.f64["xyz"];
      const reply = engine.ask(header, own ?? new Float64Array(0));
      replies.push(reply);
      if ("error" in reply.header) break;
    }
    const ms = performance.now() - begun;
    const buffers = replies.flatMap((reply) => [...Object.values(reply.f64), ...Object.values(reply.u8)].map((block) => block.buffer as ArrayBuffer));
    post({ kind: "reply", id: told.id, replies, held: engine.held, ms }, buffers);
  } catch (error) {
    // a panic leaves an instance in pieces: the next question gets a new one
    instance = undefined;
    post({ kind: "broken", id: told.id, message: engine?.lastWords() || (error instanceof Error ? error.message : String(error)) });
  }
};
