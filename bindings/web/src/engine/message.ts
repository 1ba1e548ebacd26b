/** Messages to and from the engine, as `engine/src/message.rs` has them. */

export type Header = Record<string, unknown> & { op: string };

/** An answer: its header, and its numbers by name. */
export interface Reply {
  header: Record<string, unknown>;
  f64: Record<string, Float64Array<ArrayBuffer>>;
  u8: Record<string, Uint8Array<ArrayBuffer>>;
}

/** Why the engine refuses, and the control it belongs to (or ""). */
export interface Refusal {
  field: string;
  message: string;
}

const up = (length: number): number => Math.ceil(length / 8) * 8;

/** JSON has no NaN: it arrives as null, and is refused there. */
export function pack(header: Header, numbers: Float64Array): Uint8Array {
  const text = new TextEncoder().encode(JSON.stringify(header));
  const bytes = new Uint8Array(8 + up(text.length) + 8 * numbers.length).fill(32, 8);
  new DataView(bytes.buffer).setBigUint64(0, BigInt(up(text.length)), true);
  bytes.set(text, 8);
  bytes.set(new Uint8Array(numbers.buffer, numbers.byteOffset, numbers.byteLength), 8 + up(text.length));
  return bytes;
}

/** `bytes` are a copy of their own. */
export function unpack(bytes: Uint8Array): Reply {
  const length = Number(new DataView(bytes.buffer, bytes.byteOffset).getBigUint64(0, true));
  const text = new TextDecoder().decode(bytes.subarray(8, 8 + length));
  const header = JSON.parse(text) as Record<string, unknown>;
  const reply: Reply = { header, f64: {}, u8: {} };
  let place = 8 + length;
  for (const [name, kind, count] of header["blocks"] as [string, string, number][]) {
    if (kind === "f64") {
      reply.f64[name] = new Float64Array(bytes.slice(place, place + 8 * count).buffer);
      place += 8 * count;
    } else {
      reply.u8[name] = bytes.slice(place, place + count);
      place += up(count);
    }
  }
  return reply;
}
