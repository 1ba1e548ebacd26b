/** The worker: one engine, one question after the other. Bundled into the page as text. */

import { Instance } from "./instance";
import type { Header, Reply } from "./message";

/** First the module, then questions. */
export type ToWorker =
  | { kind: "module"; module: WebAssembly.Module }
  | { kind: "ask"; id: number; header: Header; numbers: Float64Array };

export type FromWorker =
  | { kind: "reply"; id: number; reply: Reply; held: number; ms: number }
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
  try {
    if (!module) throw new Error("no engine");
    instance ??= Instance.of(module);
    const engine = await instance;
    const begun = performance.now();
    const reply = engine.ask(told.header, told.numbers);
    const ms = performance.now() - begun;
    const buffers = [...Object.values(reply.f64), ...Object.values(reply.u8)].map((block) => block.buffer as ArrayBuffer);
    post({ kind: "reply", id: told.id, reply, held: engine.held, ms }, buffers);
  } catch (error) {
    // a panic leaves an instance in pieces: the next question gets a new one
    instance = undefined;
    post({ kind: "broken", id: told.id, message: error instanceof Error ? error.message : String(error) });
  }
};
