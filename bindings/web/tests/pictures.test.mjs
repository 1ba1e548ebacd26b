/** What stands on the page, pixel by pixel and number by number, against other ways of the library, run natively
 * (engine/examples/reference.rs). GONIO_REFERENCE names that program. */

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { executable, go, launch, opened, settled } from "./browser.mjs";

const reference = process.env.GONIO_REFERENCE;
let browser;
before(async () => { browser = executable && (await launch()); });
after(async () => { await browser?.close(); });
const skip = !executable ? "no chromium here" : !reference ? "GONIO_REFERENCE is not set" : false;
const compared = (name, work) => test(name, { skip, timeout: 600_000 }, work);

const native = (question) => {
  const run = spawnSync(reference, { input: JSON.stringify(question), maxBuffer: 1 << 28 });
  assert.equal(run.status, 0, String(run.stderr));
  return run.stdout;
};

/** Levels of 255: wavelengths and angles of the two are not the same. The worst channel, and the mean of all. */
const LEVELS = { worst: 8, mean: 0.6 };

compared("skies are the ones that are rendered natively", async () => {
  const { page, wrong, close } = await opened(browser);
  for (const [radius_um, fov_deg, elevation_deg, azimuth_deg] of [[20, 95, 18, 0], [10, 60, 25, -10], [60, 80, 18, 12]]) {
    await go(page, `view=sky&radius_um=${radius_um}&fov_deg=${fov_deg}&camera_deg=${elevation_deg}&pan_deg=${azimuth_deg}`);
    await settled(page);
    const seen = await page.evaluate(() => {
      const canvas = document.querySelector("canvas.sky");
      // a copy: the browser warns of reading from what is drawn to be seen
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [canvas.width, canvas.height];
      const context = copy.getContext("2d", { willReadFrequently: true });
      context.drawImage(canvas, 0, 0);
      const { data } = context.getImageData(0, 0, copy.width, copy.height);
      let text = "";
      for (let i = 0; i < data.length; i += 4096) text += String.fromCharCode(...data.subarray(i, i + 4096));
      return { width: canvas.width, height: canvas.height, rgba: btoa(text) };
    });
    const { width, height } = seen;
    assert.equal(width, 1200);
    const rgba = Buffer.from(seen.rgba, "base64");
    const rgb = native({ kind: "picture", radius_um, sun_elevation_deg: 20, fov_deg, elevation_deg, azimuth_deg, width, height });
    assert.equal(rgb.length, 3 * width * height);
    let [worst, sum, bright] = [0, 0, 0];
    for (let i = 0; i < width * height; i += 1) {
      for (let c = 0; c < 3; c += 1) {
        const off = Math.abs(rgba[4 * i + c] - rgb[3 * i + c]);
        worst = Math.max(worst, off);
        sum += off;
        bright = Math.max(bright, rgb[3 * i + c]);
      }
    }
    const mean = sum / rgb.length;
    console.log(`sky of ${radius_um} µm: at most ${worst} of 255 levels off, ${mean.toFixed(3)} in the mean`);
    assert.ok(bright > 150, `a bow is in the picture: ${bright}`);
    assert.ok(worst <= LEVELS.worst && mean <= LEVELS.mean, `${radius_um} µm: ${worst}, ${mean}`);
  }
  assert.deepEqual(wrong, []);
  await close();
});

compared("numbers of a chart are the ones that are computed natively", async () => {
  const { page, wrong, close } = await opened(browser);
  for (const radius_um of [5, 100, 500]) {
    await go(page, `view=scattered&light=one&sun_disc=0&radius_um=${radius_um}&from_deg=120&to_deg=160`);
    await settled(page);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(".exports button:text-is('CSV')")]);
    const [, names, ...rows] = readFileSync(await download.path(), "utf8").trim().split("\n");
    assert.deepEqual(names.split(","), ["angle_deg", "whole", "order 2"]);
    const here = rows.map((row) => row.split(",").map(Number));
    assert.equal(here.length, 1801);
    const bytes = native({ kind: "curve", radius_um, wavelength_nm: 589, theta_deg: [120, 160], points: 1801 });
    const there = new Float64Array(new Uint8Array(bytes).buffer);
    let worst = 0;
    for (const column of [0, 1, 2]) {
      const largest = Math.max(...here.map((row) => row[column === 2 ? 1 : column]), 1e-300);
      here.forEach((row, i) => { worst = Math.max(worst, Math.abs(row[column] - there[3 * i + column]) / largest); });
    }
    console.log(`numbers of ${radius_um} µm: ${worst.toExponential(1)} of the largest`);
    assert.ok(worst < 1e-11, String(worst));
  }
  assert.deepEqual(wrong, []);
  await close();
});
