/** The page in a real browser: every control moves every view, links restore, bad input is told, nothing leaves. */

import assert from "node:assert/strict";
import { deflateSync } from "node:zlib";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { executable, go, launch, opened, settled, shown, type } from "./browser.mjs";

const VIEWS = ["rays", "scattered", "lee", "sky", "compare"];
let browser;
before(async () => { browser = executable && (await launch()); });
after(async () => { await browser?.close(); });
const inBrowser = (name, work) => test(name, { skip: executable ? false : "no chromium here", timeout: 600_000 }, work);

/** Changes of one field each, and the views that have nothing of it. Rays know no waves: no polarisation, no sun's
 * disc, no spread; of spheres no sun's elevation but where the sky is. */
const round = "shape=sphere&light=one&radius_um=40&lee_from_um=20&lee_to_um=60&other_um=70&from_deg=130&to_deg=150";
const ROUND = [
  ["radius_um=90", ["rays"]], ["spread=0.2", ["rays"]], ["medium=1.36", []], ["temperature_c=80", []], ["sun_disc=0", ["rays"]],
  ["wavelength_nm=450", []], ["light=daylight", []], ["polarisation=parallel", ["rays"]], ["angle_from=antisolar", ["sky"]],
  ["sun_elevation_deg=45", ["rays", "scattered", "lee", "compare"]], ["size_as=diameter", ["rays", "scattered", "sky"]], ["size_unit=mm", ["rays", "scattered", "sky"]],
  ["shape=layered", ["none"]], ["shape=gradient", ["none"]],
];
const QUICK = 20_000;

/** First picture after a change: coarse is enough to see that something moves. */
async function picture(page, view, hash) {
  await go(page, `view=${view}&${hash}`);
  await page.waitForFunction(() => Number.isFinite(window.gonio.latency()) || window.gonio.settled(), null, { timeout: QUICK });
  await settled(page);
  assert.equal(await page.evaluate(() => [...document.querySelectorAll(".message")].find((m) => !m.hidden)?.textContent), undefined, `${view}&${hash}`);
  return shown(page, view);
}

inBrowser("every control moves every view of a round drop", async () => {
  const { page, wrong, close } = await opened(browser);
  for (const view of VIEWS) {
    await picture(page, view, round);
    // the second time charts have found their size
    const start = await picture(page, view, round);
    for (const [change, without] of ROUND) {
      const now = await picture(page, view, `${round}&${change}`);
      assert.equal(now !== start, !without.includes(view), `${change} in ${view}`);
    }
  }
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("drops that are not round: shape, axis ratio, sun, azimuth", async () => {
  const { page, wrong, close } = await opened(browser);
  const flat = "shape=spheroid&radius_um=60&light=one&from_deg=130&to_deg=150&whole=0";
  for (const view of ["rays", "scattered"]) {
    await picture(page, view, flat);
    const start = await picture(page, view, flat);
    for (const change of ["axis_ratio=0.8", "sun_elevation_deg=50", "shape=raindrop&radius_um=900", ...(view === "rays" ? [] : ["azimuth_deg=90"])]) {
      assert.notEqual(await picture(page, view, `${flat}&${change}`), start, `${change} in ${view}`);
    }
  }
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("controls of single views move them", async () => {
  const { page, wrong, close } = await opened(browser);
  const own = {
    rays: ["orders=1.3", "impact=0.4", "fan=0", "caustic=0"],
    scattered: ["orders=2.3", "whole=0", "added=1&orders=0.2", "curve=polarisation", "log=0", "from_deg=120", "to_deg=148"],
    lee: ["lee_from_um=30", "lee_to_um=90"],
    sky: ["fov_deg=60", "camera_deg=30", "pan_deg=20", "stops=2", "ground=0"],
    compare: ["other=rays", "other_um=55", "other_shape=gradient", "curve=polarisation", "log=0"],
  };
  for (const [view, changes] of Object.entries(own)) {
    const start = await picture(page, view, round);
    for (const change of changes) assert.notEqual(await picture(page, view, `${round}&${change}`), start, `${change} in ${view}`);
  }
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("by hand: slider, typing, keys, and the link that restores all of it", async () => {
  const { page, wrong, close } = await opened(browser, "view=scattered&light=one");
  await settled(page);
  await type(page, "radius_um", "77,5");
  await page.selectOption("#field-size_unit", "mm");
  assert.equal(await page.inputValue("#field-radius_um"), "0.0775");
  await page.check("#field-orders-3");
  await page.selectOption("#field-angle_from", "antisolar");
  await page.focus("#tab-scattered");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.getAttribute("#tab-lee", "aria-selected"), "true");
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  await page.focus("[data-field=wavelength_nm] input[type=range]");
  for (let i = 0; i < 5; i += 1) await page.keyboard.press("ArrowRight");
  assert.equal(await page.inputValue("#field-wavelength_nm"), "594");
  await page.focus(".chart");
  await page.keyboard.press("ArrowRight");
  assert.match(await page.textContent(".u-legend"), /\d\.\d/);
  await page.waitForTimeout(300);
  await settled(page);
  const [address, picture] = [page.url(), await shown(page, "scattered")];
  const { page: other, wrong: wrongThere, close: closeOther } = await opened(browser, address.split("#")[1]);
  await settled(other);
  for (const field of ["radius_um", "wavelength_nm", "size_unit", "angle_from"]) {
    assert.equal(await other.inputValue(`#field-${field}`), await page.inputValue(`#field-${field}`), field);
  }
  assert.ok(await other.isChecked("#field-orders-3"));
  const strip = (text) => text.replace(/\|.*/s, "");
  assert.equal(strip(await shown(other, "scattered")).length > 100, strip(picture).length > 100);
  assert.deepEqual([...wrong, ...wrongThere], []);
  await closeOther();
  await close();
});

inBrowser("the impact is dragged, the Lee diagram picks a radius", async () => {
  const { page, wrong, close } = await opened(browser, "light=one");
  await settled(page);
  const box = await page.locator(".drawing.rays").boundingBox();
  await page.mouse.move(box.x + 100, box.y + 0.5 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 100, box.y + 0.4 * box.height, { steps: 4 });
  await page.mouse.up();
  assert.ok(Math.abs(Number(await page.inputValue("#field-impact")) - 0.52) < 0.02);
  await go(page, "view=lee&lee_from_um=10&lee_to_um=100");
  await page.waitForTimeout(500);
  const lee = await page.locator("canvas.lee").boundingBox();
  await page.mouse.click(lee.x + lee.width / 2, lee.y + 50);
  assert.ok(Math.abs(Number(await page.inputValue("#field-radius_um")) - 31.6) < 1);
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("a fast sequence of changes ends in the picture of the last", async () => {
  const { page, wrong, close } = await opened(browser);
  const still = "light=one&lee_from_um=10&lee_to_um=14&from_deg=130&to_deg=150";
  for (const view of VIEWS) {
    await picture(page, view, `${still}&radius_um=12`);
    await page.evaluate(async () => {
      const slider = document.querySelector("[data-field=radius_um] input[type=range]");
      for (let i = 0; i < 60; i += 1) {
        slider.value = String(300 + 7 * i);
        slider.dispatchEvent(new Event("input"));
        await new Promise((resolve) => setTimeout(resolve, i % 5));
      }
    });
    await type(page, "radius_um", "33");
    await page.waitForTimeout(300);
    await settled(page);
    const ended = await shown(page, view);
    await picture(page, view, `${still}&radius_um=12`);
    assert.equal(ended, await picture(page, view, `${still}&radius_um=33`), view);
  }
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("bad input by hand and by link is told at its control, and nothing breaks", async () => {
  const { page, wrong, close } = await opened(browser, "view=scattered&light=one&radius_um=50");
  await settled(page);
  for (const bad of ["-3", "0", "1e99", "NaN", "", "abc", "Infinity", "<b>1</b>"]) {
    await type(page, "radius_um", bad);
    assert.match(await page.textContent("#message-radius_um"), /accepted/, bad);
    assert.equal(await page.getAttribute("#field-radius_um", "aria-invalid"), "true");
  }
  await type(page, "radius_um", "60");
  assert.ok(await page.isHidden("#message-radius_um"));
  await type(page, "medium", "watr");
  await page.waitForFunction(() => /water/.test(document.querySelector("#message-medium").textContent));
  await type(page, "medium", "-1.5");
  await page.waitForFunction(() => !document.querySelector("#message-medium").hidden);
  await type(page, "medium", "water");
  const links = {
    "radius_um=-5": "radius_um", "radius_um=NaN": "radius_um", "radius_um=1e400": "radius_um", "shape=cube": "shape", "light=%E0%A4%A": "light",
    "orders=99": "orders", "wavelength_nm=12": "wavelength_nm", "sun_disc=maybe": "sun_disc", "medium=%00%00": "medium", "from_deg=170&to_deg=20": "to_deg",
    "lee_from_um=900&lee_to_um=5": "lee_to_um",
  };
  for (const [link, field] of Object.entries(links)) {
    await go(page, `view=${field.startsWith("lee") ? "lee" : "scattered"}&${link}`);
    await page.waitForFunction((id) => document.querySelector(`#message-${id}`)?.hidden === false, field, { timeout: 10_000 });
  }
  for (const link of ["nonsense=1", "__proto__=1", "constructor=2", `radius_um=${"9".repeat(5000)}`, "<script>alert(1)</script>"]) {
    await go(page, link);
    await page.waitForFunction(() => !document.querySelector(".message.general").hidden, null, { timeout: 10_000 });
  }
  await go(page, "view=scattered&light=one&radius_um=50");
  await settled(page);
  assert.ok(await page.isHidden(".message.general"));
  assert.match(await page.textContent(".status"), /Lorenz/);
  assert.deepEqual(wrong, []);
  await close();
});

/** A PNG whose header says one size. */
function png(width, height, rows) {
  const crcTable = Array.from({ length: 256 }, (_, n) => { let c = n; for (let k = 0; k < 8; k += 1) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1; return c >>> 0; });
  const chunk = (name, data) => {
    const body = Buffer.concat([Buffer.from(name), data]);
    let crc = 0xffffffff;
    for (const byte of body) crc = crcTable[(crc ^ byte) & 255] ^ (crc >>> 8);
    const out = Buffer.alloc(8 + body.length);
    out.writeUInt32BE(data.length, 0);
    body.copy(out, 4);
    out.writeUInt32BE((crc ^ 0xffffffff) >>> 0, 4 + body.length);
    return out;
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk("IHDR", header), chunk("IDAT", deflateSync(rows)), chunk("IEND", Buffer.alloc(0))]);
}

inBrowser("hostile pictures are refused", async () => {
  const { page, wrong, close } = await opened(browser, "view=photo");
  await settled(page);
  const files = {
    "empty.png": Buffer.alloc(0), "huge.png": png(10_000, 10_000, Buffer.alloc(10)), "endless.png": png(2 ** 31 - 1, 2 ** 31 - 1, Buffer.alloc(10)),
    "tiny.png": png(1, 1, Buffer.alloc(4)), "damaged.png": png(64, 64, Buffer.alloc(64 * 193)).subarray(0, 50), "text.jpg": Buffer.from("no picture at all"),
    "cut.jpg": Buffer.from([0xff, 0xd8, 0xff, 0xe1, 0xff, 0xff, 0x45, 0x78, 0x69, 0x66, 0, 0]), "page.svg": Buffer.from("<svg xmlns='http://www.w3.org/2000/svg'/>"),
  };
  for (const [name, buffer] of Object.entries(files)) {
    await page.setInputFiles("input[type=file]", { name, mimeType: "image/png", buffer });
    await page.waitForFunction(() => /Not taken/.test(document.querySelector("#panel-photo .legend").textContent), null, { timeout: 10_000 });
    await page.evaluate(() => { document.querySelector("#panel-photo .legend").textContent = ""; });
    assert.ok(await page.isHidden(".photo-frame"), name);
  }
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("controls of the photograph move it", async () => {
  const { page, wrong, close } = await opened(browser, "view=photo");
  const rows = Buffer.concat(Array.from({ length: 200 }, () => Buffer.from([0, ...Array(3 * 320).fill(40)])));
  const start = "photo_fov_deg=60&photo_x=0.5&photo_y=1.8&radius_um=40&sun_elevation_deg=20";
  await go(page, `view=photo&${start}`);
  await page.setInputFiles("input[type=file]", { name: "grey.png", mimeType: "image/png", buffer: png(320, 200, rows) });
  await page.waitForSelector(".photo-frame:not([hidden])");
  await settled(page);
  const before = await picture(page, "photo", start);
  for (const change of ["photo_fov_deg=70", "photo_x=0.4", "photo_y=1.6", "photo_tilt_deg=10", "photo_stops=1", "photo_sector_deg=70",
    "radius_um=90", "spread=0.2", "medium=1.36", "temperature_c=80", "sun_elevation_deg=30", "polarisation=parallel", "sun_disc=0"]) {
    assert.notEqual(await picture(page, "photo", `${start}&${change}`), before, change);
  }
  assert.equal(await picture(page, "photo", start), before);
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("a rendered bow is recovered from its picture within 3 %", async () => {
  const { page, wrong, close } = await opened(browser);
  for (const [radius, spread] of [[150, 0], [60, 0.05]]) {
    // the camera looks at the top of the bow; the antisolar point is 20° below the horizon
    await go(page, `view=sky&radius_um=${radius}&spread=${spread}&fov_deg=60&camera_deg=20&ground=0`);
    await settled(page);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(".exports button:text-is('PNG')")]);
    const buffer = readFileSync(await download.path());
    const [width, height] = [1200, 720];
    const below = (width / 2) * (Math.tan((40 * Math.PI) / 180) / Math.tan((30 * Math.PI) / 180));
    await go(page, `view=photo&photo_fov_deg=60&photo_x=0.5&photo_y=${((height / 2 + below) / height).toFixed(4)}`);
    await page.setInputFiles("input[type=file]", { name: "bow.png", mimeType: "image/png", buffer });
    await page.waitForSelector(".photo-frame:not([hidden])");
    await settled(page);
    await page.click("text=Fit radius and spread");
    await page.waitForFunction(() => /Best fit|No fit/.test(document.querySelector("#panel-photo .legend").textContent), null, { timeout: 300_000 });
    const words = await page.textContent("#panel-photo .legend");
    const found = Number(/radius ([\d.]+) µm/.exec(words)?.[1]);
    assert.ok(Math.abs(found / radius - 1) < 0.03, `${radius} µm: ${words}`);
    console.log(`fit: ${radius} µm, spread ${spread}: ${words}`);
  }
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("exports: picture, numbers, scene", async () => {
  const { page, wrong, close } = await opened(browser);
  const save = async (label) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(`.exports button:text-is('${label}')`)]);
    return readFileSync(await download.path());
  };
  for (const view of ["rays", "scattered", "lee", "sky", "compare"]) {
    await go(page, `view=${view}&radius_um=30&lee_from_um=20&lee_to_um=40&light=one`);
    await settled(page);
    assert.equal((await save("PNG")).subarray(1, 4).toString(), "PNG", view);
    assert.match((await save("SVG")).toString(), /^<svg [^]*<\/svg>$/, view);
    const csv = (await save("CSV")).toString().trim().split("\n");
    const columns = csv[1].split(",").length;
    assert.ok(csv.length > 2 && csv.slice(2).every((line) => line.split(",").length === columns), view);
  }
  assert.match((await save("Scene (TOML)")).toString(), /radius_um = 30/);
  assert.match((await save("Python")).toString(), /gonio\.table\(scene\)/);
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("the tour has six steps, each of which can be done", async () => {
  const { page, wrong, close } = await opened(browser);
  await page.click(".tour-button");
  const doing = [
    () => type(page, "impact", "0.86"), () => page.selectOption("#field-light", "daylight"), () => type(page, "radius_um", "80"),
    () => type(page, "radius_um", "10"), () => page.selectOption("#field-polarisation", "parallel"), () => type(page, "axis_ratio", "0.8"),
  ];
  for (const [step, work] of doing.entries()) {
    assert.match(await page.textContent(".tour h2"), new RegExp(`${step + 1} of 6`));
    await page.waitForTimeout(300);
    assert.equal(await page.locator(".todo.done").count(), 0, `step ${step + 1} is not done at first`);
    await work();
    await page.waitForSelector(".todo.done", { timeout: 5000 });
    await page.click(step === 5 ? "text=Finish" : "text=Next");
  }
  assert.ok(await page.isHidden(".tour"));
  assert.deepEqual(wrong, []);
  await close();
});

inBrowser("all that can be used has a name, at 360 px nothing runs out of the page", async () => {
  for (const width of [360, 1920]) {
    for (const colorScheme of ["light", "dark"]) {
      const { page, wrong, close } = await opened(browser, "", { viewport: { width, height: 800 }, colorScheme });
      if (width < 760) await page.click("summary");
      for (const view of [...VIEWS, "photo"]) {
        await go(page, `view=${view}&radius_um=20&lee_from_um=10&lee_to_um=20`);
        await page.waitForTimeout(200);
        const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, canvas, [tabindex]")].filter((element) => {
          if (element.offsetParent === null || element.closest(".uplot")) return false;
          const labelled = element.labels?.length > 0 || element.getAttribute("aria-label") || element.textContent.trim();
          return !labelled && !element.classList.contains("over");
        }).map((element) => element.outerHTML.slice(0, 80)));
        assert.deepEqual(nameless, [], view);
        const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.ok(over <= 0, `${view} at ${width}: ${over} px too wide`);
      }
      assert.deepEqual(wrong, []);
      await close();
    }
  }
});
