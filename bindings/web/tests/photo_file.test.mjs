/** What a picture's file tells before it is decoded. */

import assert from "node:assert/strict";
import { build } from "esbuild";
import { test } from "node:test";

const built = await build({ entryPoints: ["src/parts/photo_file.ts"], bundle: true, format: "esm", write: false });
const { inspected } = await import(`data:text/javascript;base64,${Buffer.from(built.outputFiles[0].contents).toString("base64")}`);

/** A JPEG's head with an Exif block of either byte order, and a frame of 4000 × 3000. */
function jpeg(little, focal) {
  const exif = Buffer.alloc(6 + 8 + 2 + 12 + 4 + 2 + 12 + 4);
  exif.write("Exif");
  const at = 6;
  exif.write(little ? "II" : "MM", at);
  const u16 = (value, place) => (little ? exif.writeUInt16LE(value, at + place) : exif.writeUInt16BE(value, at + place));
  const u32 = (value, place) => (little ? exif.writeUInt32LE(value, at + place) : exif.writeUInt32BE(value, at + place));
  u16(42, 2); u32(8, 4);
  u16(1, 8); u16(0x8769, 10); u16(4, 12); u32(1, 14); u32(26, 18); u32(0, 22);
  u16(1, 26); u16(0xa405, 28); u16(3, 30); u32(1, 32); u16(focal, 36);
  const head = Buffer.from([0xff, 0xd8, 0xff, 0xe1, 0, exif.length + 2]);
  const frame = Buffer.from([0xff, 0xc0, 0, 17, 8, 3000 >> 8, 3000 & 255, 4000 >> 8, 4000 & 255, 3, 1, 0x22, 0, 2, 0x11, 1, 3, 0x11, 1]);
  return Buffer.concat([head, exif, frame]);
}
const buffer = (bytes) => new Uint8Array(bytes).buffer;

test("size and lens of a JPEG, in both byte orders", () => {
  for (const little of [true, false]) {
    assert.deepEqual(inspected(buffer(jpeg(little, 28))), { width: 4000, height: 3000, focal35: 28 });
  }
  assert.deepEqual(inspected(buffer(jpeg(true, 0))), { width: 4000, height: 3000 });
});

test("every cut of a file is refused or read, and never breaks", () => {
  const whole = jpeg(false, 28);
  for (let length = 0; length < whole.length; length += 1) {
    try {
      inspected(buffer(whole.subarray(0, length)));
    } catch (error) {
      assert.match(error.message, /empty|no whole PNG or JPEG/);
    }
  }
  for (let i = 0; i < whole.length; i += 1) {
    const changed = Buffer.from(whole);
    changed[i] ^= 0xff;
    try {
      inspected(buffer(changed));
    } catch (error) {
      assert.ok(!(error instanceof RangeError), `byte ${i}: ${error}`);
    }
  }
});
