/** A picture's file: what kind, how large, which lens; looked at before it is decoded. */

export interface PhotoFile {
  width: number;
  height: number;
  /** Focal length on film of 36 mm, where the file tells it. */
  focal35?: number;
}

const LARGEST_BYTES = 60e6;
const LARGEST_PIXELS = 60e6;

/** Throws with what is accepted. */
export function inspected(bytes: ArrayBuffer): PhotoFile {
  if (bytes.byteLength === 0) throw new Error("the file is empty");
  if (bytes.byteLength > LARGEST_BYTES) throw new Error(`the file has ${Math.round(bytes.byteLength / 1e6)} MB: accepted are up to 60`);
  const view = new DataView(bytes);
  const found = png(view) ?? jpeg(view);
  if (!found) throw new Error("this is no whole PNG or JPEG, and only these are accepted");
  if (found.width < 16 || found.height < 16) throw new Error("the picture is too small: 16 pixels a side at least");
  if (found.width * found.height > LARGEST_PIXELS) throw new Error(`the picture has ${Math.round((found.width * found.height) / 1e6)} megapixels: accepted are up to 60`);
  return found;
}

function png(view: DataView): PhotoFile | undefined {
  if (view.byteLength < 24 || view.getUint32(0) !== 0x89504e47 || view.getUint32(12) !== 0x49484452) return undefined;
  return { width: view.getUint32(16), height: view.getUint32(20) };
}

function jpeg(view: DataView): PhotoFile | undefined {
  if (view.byteLength < 4 || view.getUint16(0) !== 0xffd8) return undefined;
  let place = 2;
  let focal35: number | undefined;
  while (place + 10 < view.byteLength) {
    const marker = view.getUint16(place);
    const length = view.getUint16(place + 2);
    if (marker < 0xff00 || length < 2) return undefined;
    const frame = marker >= 0xffc0 && marker <= 0xffcf && ![0xffc4, 0xffc8, 0xffcc].includes(marker);
    if (frame) return { height: view.getUint16(place + 5), width: view.getUint16(place + 7), ...(focal35 ? { focal35 } : {}) };
    if (marker === 0xffe1) focal35 ??= exif(view, place + 4, Math.min(place + 2 + length, view.byteLength));
    place += 2 + length;
  }
  return undefined;
}

/** Tag 0xA405 of the Exif block, which hangs on tag 0x8769 of the first one. */
function exif(view: DataView, from: number, to: number): number | undefined {
  try {
    if (view.getUint32(from) !== 0x45786966) return undefined;
    const start = from + 6;
    const little = view.getUint16(start) === 0x4949;
    const u16 = (at: number): number => (start + at + 2 <= to ? view.getUint16(start + at, little) : 0);
    const u32 = (at: number): number => (start + at + 4 <= to ? view.getUint32(start + at, little) : 0);
    const find = (block: number, wanted: number): number | undefined => {
      const count = Math.min(u16(block), 500);
      for (let i = 0; i < count; i += 1) if (u16(block + 2 + 12 * i) === wanted) return block + 2 + 12 * i;
      return undefined;
    };
    const pointer = find(u32(4), 0x8769);
    const entry = pointer === undefined ? undefined : find(u32(pointer + 8), 0xa405);
    const value = entry === undefined ? 0 : u16(entry + 8);
    return value > 0 ? value : undefined;
  } catch {
    return undefined;
  }
}
