/**
 * The engine as the page sees it: two workers, so that a quick answer never waits for a fine one.
 *
 * Quick questions: while one is answered, only the newest of those that come meanwhile is kept. Fine ones: a
 * change of the controls drops them, by ending their worker when it is busy; the compiled module is kept, so
 * that a new one is there at once.
 */

import type { FromWorker, Step, ToWorker } from "./worker";
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
  steps: Step[];
  /** Whether a newer question makes it needless. */
  fleeting: boolean;
  resolve(replies: Reply[]): void;
  reject(error: Error): void;
}

function first(replies: Reply[]): Reply {
  const [reply] = replies;
  if (!reply) throw new Dropped();
  return reply;
}

class Lane {
  private worker: Worker | undefined;
  private asked: Question | undefined;
  private waiting: Question[] = [];
  private last = 0;
  /** Bytes that the worker's engine holds. */
  held = 0;

  constructor(private readonly module: WebAssembly.Module, private readonly source: string) {}

  ask(steps: Step[], fleeting: boolean): Promise<Reply[]> {
    return new Promise((resolve, reject) => {
      if (fleeting) {
        for (const question of this.waiting) if (question.fleeting) question.reject(new Dropped());
        this.waiting = this.waiting.filter((question) => !question.fleeting);
      }
      this.waiting.push({ steps, fleeting, resolve, reject });
      this.next();
    });
  }

  drop(): void {
    for (const question of this.waiting) question.reject(new Dropped());
    this.waiting = [];
    if (!this.asked) return;
    this.worker?.terminate();
    this.worker = undefined;
    this.held = 0;
    this.asked.reject(new Dropped());
    this.asked = undefined;
  }

  private next(): void {
    if (this.asked) return;
    this.asked = this.waiting.shift();
    if (!this.asked) return;
    this.worker ??= this.started();
    this.last += 1;
    this.tell({ kind: "ask", id: this.last, steps: this.asked.steps });
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
      const refusal = told.replies.at(-1)?.header["error"] as Refusal | undefined;
      if (refusal) reject(new Refused(refusal));
      else resolve(told.replies);
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

  /** Questions that belong together, to be answered at once; newer ones make those that wait needless. */
  quickly(steps: Step[]): Promise<Reply[]> {
    return this.quickLane.ask(steps, true);
  }

  async quick(header: Header): Promise<Reply> {
    return first(await this.quickly([{ header }]));
  }

  /** One question that no newer one makes needless. */
  async beside(header: Header): Promise<Reply> {
    return first(await this.quickLane.ask([{ header }], false));
  }

  finely(steps: Step[]): Promise<Reply[]> {
    return this.fineLane.ask(steps, false);
  }

  async fine(header: Header, numbers?: Float64Array): Promise<Reply> {
    return first(await this.finely([{ header, ...(numbers ? { numbers } : {}) }]));
  }

  /** Forget what the fine worker does. */
  dropFine(): void {
    this.fineLane.drop();
  }

  get held(): number {
    return this.quickLane.held + this.fineLane.held;
  }
}
