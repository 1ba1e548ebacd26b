/**
 * The engine as the page sees it: two workers, so that a quick answer never waits for a fine one.
 *
 * Quick questions: while one is answered, only the newest of those that come meanwhile is kept. Fine ones: a
 * change of the controls drops them, by ending their worker when it is busy; the compiled module is kept, so
 * that a new one is there at once.
 */

import type { FromWorker, ToWorker } from "./worker";
import type { Header, Refusal, Reply } from "./message";

declare const WORKER_SOURCE: string;

/** A question that nobody waits for any more. */
export class Dropped extends Error {}

/** The engine refused, with the control it is about. */
export class Refused extends Error {
  constructor(readonly refusal: Refusal) {
    super(refusal.message);
  }
}

interface Question {
  header: Header;
  numbers: Float64Array;
  resolve(reply: Reply): void;
  reject(error: Error): void;
}

const NOTHING = new Float64Array(0);

class Lane {
  private worker: Worker | undefined;
  private asked: Question | undefined;
  private waiting: Question | undefined;
  private last = 0;
  /** Bytes that the worker's engine holds. */
  held = 0;

  constructor(private readonly module: WebAssembly.Module, private readonly source: string) {}

  ask(header: Header, numbers: Float64Array): Promise<Reply> {
    return new Promise((resolve, reject) => {
      this.waiting?.reject(new Dropped());
      this.waiting = { header, numbers, resolve, reject };
      this.next();
    });
  }

  drop(): void {
    this.waiting?.reject(new Dropped());
    this.waiting = undefined;
    if (!this.asked) return;
    this.worker?.terminate();
    this.worker = undefined;
    this.asked.reject(new Dropped());
    this.asked = undefined;
  }

  private next(): void {
    if (this.asked || !this.waiting) return;
    this.asked = this.waiting;
    this.waiting = undefined;
    this.worker ??= this.started();
    this.last += 1;
    this.tell({ kind: "ask", id: this.last, header: this.asked.header, numbers: this.asked.numbers });
  }

  private tell(message: ToWorker): void {
    this.worker?.postMessage(message);
  }

  private started(): Worker {
    const worker = new Worker(this.source);
    worker.postMessage({ kind: "module", module: this.module } satisfies ToWorker);
    worker.onmessage = (event: MessageEvent<FromWorker>) => this.hear(event.data);
    worker.onerror = (event) => this.hear({ kind: "broken", id: this.last, message: event.message });
    return worker;
  }

  private hear(told: FromWorker): void {
    if (told.id !== this.last || !this.asked) return;
    const { resolve, reject } = this.asked;
    this.asked = undefined;
    if (told.kind === "broken") {
      reject(new Refused({ field: "", message: `the engine broke off (${told.message})` }));
    } else {
      this.held = told.held;
      const refusal = told.reply.header["error"] as Refusal | undefined;
      if (refusal) reject(new Refused(refusal));
      else resolve(told.reply);
    }
    this.next();
  }
}

export class Engine {
  private readonly quickLane: Lane;
  private readonly fineLane: Lane;

  private constructor(module: WebAssembly.Module) {
    const source = URL.createObjectURL(new Blob([WORKER_SOURCE], { type: "text/javascript" }));
    this.quickLane = new Lane(module, source);
    this.fineLane = new Lane(module, source);
  }

  /** Of the module's bytes, gzipped and in base64. */
  static async of(base64: string): Promise<Engine> {
    const packed = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const bytes = await new Response(stream).arrayBuffer();
    return new Engine(await WebAssembly.compile(bytes));
  }

  quick(header: Header, numbers = NOTHING): Promise<Reply> {
    return this.quickLane.ask(header, numbers);
  }

  fine(header: Header, numbers = NOTHING): Promise<Reply> {
    return this.fineLane.ask(header, numbers);
  }

  /** Forget what the fine worker does. */
  dropFine(): void {
    this.fineLane.drop();
  }

  get held(): number {
    return this.quickLane.held + this.fineLane.held;
  }
}
