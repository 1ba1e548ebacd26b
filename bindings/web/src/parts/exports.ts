/** What leaves the page: pictures, numbers, the scene, and the address. */

import { dropOf } from "../state";
import type { Page, View } from "../views/view";
import { make } from "./dom";

export function exports(page: Page, view: () => View | undefined): HTMLElement {
  const said = make("span", { role: "status", class: "said" });
  const save = (name: string, content: BlobPart, type: string): void => {
    const url = URL.createObjectURL(new Blob([content], { type }));
    make("a", { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
    said.textContent = `${name} saved`;
  };
  const button = (label: string, work: () => Promise<void> | void): HTMLElement =>
    make("button", { type: "button", click: () => void (async () => work())().catch((error: unknown) => page.refuse(error)) }, label);
  const name = (): string => `gonio-${page.state().view}`;
  const scene = async (): Promise<{ toml: string; python: string }> => {
    const state = page.state();
    const reply = await page.engine.beside({ op: "scene", drop: dropOf(state), wavelength_nm: state.light === "one" ? state.wavelength_nm : null, sun_disc: state.sun_disc });
    return { toml: String(reply.header["toml"]), python: String(reply.header["python"]) };
  };
  return make("div", { class: "exports", role: "group", "aria-label": "Export" },
    button("PNG", async () => {
      const canvas = await view()?.canvas();
      const blob = await new Promise<Blob | null>((resolve) => (canvas ? canvas.toBlob(resolve, "image/png") : resolve(null)));
      if (blob) save(`${name()}.png`, blob, "image/png");
    }),
    button("SVG", () => save(`${name()}.svg`, view()?.svg() ?? "", "image/svg+xml")),
    button("CSV", () => save(`${name()}.csv`, view()?.csv() ?? "", "text/csv")),
    button("Scene (TOML)", async () => save("scene.toml", (await scene()).toml, "application/toml")),
    button("Python", async () => save("scene.py", (await scene()).python, "text/x-python")),
    button("Copy link", async () => {
      await new Promise((resolve) => setTimeout(resolve, 200));
      await navigator.clipboard.writeText(location.href).then(() => (said.textContent = "link copied"), () => (said.textContent = "the address bar has the link"));
    }),
    said);
}
