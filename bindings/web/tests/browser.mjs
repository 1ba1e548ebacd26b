/** A headless browser with the page from the file system, and what all tests of it need. */

import { existsSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const here = dirname(fileURLToPath(import.meta.url));
const dist = resolve(here, "../dist");
export const PAGE = pathToFileURL(resolve(dist, "index.html")).href;

const candidates = [process.env.GONIO_CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
export const executable = candidates.find((path) => path && existsSync(path));

/** A browser, or nothing where there is none. */
export const launch = () => chromium.launch({ executablePath: executable, args: ["--no-sandbox", "--enable-precise-memory-info"] });

/** A page that remembers what it should not do: errors, and requests that leave its folder. */
export async function opened(browser, hash = "", options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  const wrong = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && wrong.push(message.text()));
  page.on("pageerror", (error) => wrong.push(String(error)));
  page.on("request", (request) => {
    const own = request.url().startsWith(pathToFileURL(dist).href) || /^(blob|data):/.test(request.url());
    if (!own) wrong.push(`request: ${request.url()}`);
  });
  await page.goto(`${PAGE}#${hash}`);
  await page.waitForFunction(() => window.gonio, null, { timeout: 60_000 });
  return { page, wrong, close: () => context.close() };
}

export const settled = (page, timeout = 120_000) =>
  page.waitForFunction(() => window.gonio.settled(), null, { timeout, polling: 50 });

/** Change the state by the address, as a link does. */
export async function go(page, hash) {
  await page.evaluate((to) => { location.hash = to; }, hash);
  // the view starts with the event of the new address
  await page.waitForTimeout(30);
}

/** What a view shows, as one text. */
export const shown = (page, view) => page.evaluate((name) => {
  const panel = document.querySelector(`#panel-${name}`);
  const canvases = [...panel.querySelectorAll("canvas")].filter((canvas) => canvas.offsetParent !== null).map((canvas) => canvas.width * canvas.height > 0 ? canvas.toDataURL() : "");
  const drawing = (panel.querySelector(".drawing")?.innerHTML ?? "") + (panel.querySelector(".photo-frame svg")?.outerHTML ?? "");
  const words = [...panel.querySelectorAll(".legend, .u-legend, .lee-x, .lee-y")].map((element) => element.textContent).join("|");
  const cursor = panel.querySelector(".cursor")?.style.left ?? "";
  return canvases.join("|") + drawing + words + cursor;
}, view);

/** Type into the control of a field. */
export async function type(page, field, text) {
  await page.fill(`#field-${field}`, text);
  await page.press(`#field-${field}`, "Enter");
}
