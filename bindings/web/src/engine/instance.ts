/** One instance of the WebAssembly module, behind one function. */

import { type Header, pack, type Reply, unpack } from "./message";

interface Exports {
  memory: WebAssembly.Memory;
  reserve(length: number): number;
  answer(room: number, length: number): number;
  release(place: number): void;
  listen(): void;
  last_words(): number;
}

export class Instance {
  private constructor(private readonly exports: Exports) {}

  static async of(module: WebAssembly.Module): Promise<Instance> {
    const instance = await WebAssembly.instantiate(module, {});
    const exports = instance.exports as unknown as Exports;
    exports.listen();
    return new Instance(exports);
  }

  /** Throws where the engine breaks off; the instance is not to be used after that. */
  ask(header: Header, numbers: Float64Array): Reply {
    const request = pack(header, numbers);
    const room = this.exports.reserve(request.length);
    new Uint8Array(this.exports.memory.buffer, room, request.length).set(request);
    return unpack(this.taken(this.exports.answer(room, request.length)));
  }

  /** What the engine said when it broke off. */
  lastWords(): string {
    try {
      return new TextDecoder().decode(this.taken(this.exports.last_words()));
    } catch {
      return "";
    }
  }

  private taken(place: number): Uint8Array {
    const length = Number(new DataView(this.exports.memory.buffer, place).getBigUint64(0, true));
    const bytes = new Uint8Array(this.exports.memory.buffer, place + 8, length).slice();
    this.exports.release(place);
    return bytes;
  }

  /** Bytes that the instance holds. */
  get held(): number {
    return this.exports.memory.buffer.byteLength;
  }
}
