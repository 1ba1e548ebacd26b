/** One instance of the WebAssembly module, behind one function. */

import { type Header, pack, type Reply, unpack } from "./message";

interface Exports {
  memory: WebAssembly.Memory;
  reserve(length: number): number;
  answer(room: number, length: number): number;
  release(place: number): void;
}

export class Instance {
  private constructor(private readonly exports: Exports) {}

  static async of(module: WebAssembly.Module): Promise<Instance> {
    const instance = await WebAssembly.instantiate(module, {});
    return new Instance(instance.exports as unknown as Exports);
  }

  /** Throws where the engine breaks off; the instance is not to be used after that. */
  ask(header: Header, numbers: Float64Array): Reply {
    const request = pack(header, numbers);
    const room = this.exports.reserve(request.length);
    new Uint8Array(this.exports.memory.buffer, room, request.length).set(request);
    const place = this.exports.answer(room, request.length);
    const length = Number(new DataView(this.exports.memory.buffer, place).getBigUint64(0, true));
    const bytes = new Uint8Array(this.exports.memory.buffer, place + 8, length).slice();
    this.exports.release(place);
    return unpack(bytes);
  }

  /** Bytes that the instance holds. */
  get held(): number {
    return this.exports.memory.buffer.byteLength;
  }
}
