/** The page: controls on one side, one view on the other, all of one state. */

import "uplot/dist/uPlot.min.css";
import "./style.css";
import { Dropped, Engine, Refused } from "./engine/engine";
import { control, type Control } from "./parts/controls";
import { make, onFrame } from "./parts/dom";
import { exports } from "./parts/exports";
import { contradictions, type Field, fromAddress, type Messages, SPECS, type State, toAddress } from "./state";
import { tour } from "./parts/tour";
import { compareView } from "./views/compare";
import { leeView } from "./views/lee";
import { photoView } from "./views/photo";
import { raysView } from "./views/rays";
import { scatteredView } from "./views/scattered";
import { skyView } from "./views/sky";
import type { Page, View } from "./views/view";

declare global {
  interface Window {
    GONIO_ENGINE: string;
    /** For tests: what the engine holds, and how often it was asked. */
    gonio?: { held(): number; settled(): boolean; latency(): number };
  }
}

/** Controls of the drop and of the light, by the heading they stand under. */
const GROUPS: readonly [heading: string, fields: readonly Field[]][] = [
  ["Drop", ["shape", "radius_um", "spread", "axis_ratio", "medium", "temperature_c", "core_fraction", "core_medium", "centre_index", "surface_index"]],
  ["Light", ["sun_elevation_deg", "sun_disc", "light", "wavelength_nm", "polarisation", "azimuth_deg"]],
  ["Shown as", ["size_as", "size_unit", "angle_from"]],
];

/** Controls that only some drops or lights have. */
const SHOWN: Partial<Record<Field, (state: State) => boolean>> = {
  axis_ratio: (state) => state.shape === "spheroid" || (state.view === "compare" && state.other_shape === "spheroid"),
  medium: (state) => state.shape !== "gradient",
  temperature_c: (state) => state.shape !== "gradient",
  core_fraction: (state) => state.shape === "layered",
  core_medium: (state) => state.shape === "layered",
  centre_index: (state) => state.shape === "gradient",
  surface_index: (state) => state.shape === "gradient",
  azimuth_deg: (state) => state.shape === "spheroid" || state.shape === "raindrop",
  other_shape: (state) => state.other === "drop",
  other_um: (state) => state.other === "drop",
};

async function start(): Promise<void> {
  const engine = await Engine.of(window.GONIO_ENGINE);
  let { state, messages } = fromAddress(location.hash);
  let generation = 0;
  let working = 0;
  let asked = 0;
  let latency = NaN;

  const status = make("p", { class: "status", role: "status" });
  const trouble = make("p", { class: "message general", role: "alert", hidden: true });
  const controls = new Map<Field, Control>();
  const tell = (found: Messages): void => {
    for (const [field, each] of controls) each.tell(found[field]);
    // what has no control, as the view, is told above all
    const general = (Object.keys(found) as (Field | "")[]).filter((field) => field === "" || !controls.has(field)).map((field) => `${field === "" ? "" : `${field}: `}${found[field] ?? ""}`);
    trouble.textContent = general.join("; ");
    trouble.hidden = general.length === 0;
  };

  const page: Page = {
    engine,
    state: () => state,
    change(changes) {
      state = { ...state, ...changes };
      messages = {};
      changed();
    },
    status(text, approximate) {
      latency = Number.isNaN(latency) ? performance.now() - asked : latency;
      status.textContent = text;
      status.classList.toggle("approximate", approximate);
    },
    refuse(error) {
      if (error instanceof Dropped) return;
      const { field, message } = error instanceof Refused ? error.refusal : { field: "", message: error instanceof Error ? error.message : String(error) };
      tell({ [controls.has(field as Field) ? field : ""]: message });
      status.textContent = "";
    },
  };

  const views: Record<string, View> = {
    rays: raysView(page), scattered: scatteredView(page), lee: leeView(page), sky: skyView(page), compare: compareView(page), photo: photoView(page),
  };
  const change = (field: Field, value: State[Field]): void => page.change({ [field]: value });
  const one = (field: Field): HTMLElement => {
    const made = control(field, () => state, change);
    controls.set(field, made);
    return made.element;
  };
  const groups = GROUPS.map(([heading, fields]) => make("fieldset", { class: "group" }, make("legend", {}, heading), ...fields.map(one)));
  const own = new Map<string, HTMLElement>();
  for (const [name, view] of Object.entries(views)) {
    const fresh = view.fields.filter((field) => !controls.has(field)).map((field): [Field, HTMLElement] => [field, one(field)]);
    for (const [field, element] of fresh) own.set(field, element);
    view.element.id = `panel-${name}`;
    view.element.setAttribute("role", "tabpanel");
    view.element.setAttribute("aria-labelledby", `tab-${name}`);
  }

  const tabs = SPECS.view.options.map(([name, label]) => make("button", {
    type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}`, click: () => page.change({ view: name }),
  }, label));
  const bar = make("div", { role: "tablist", "aria-label": "Views" }, ...tabs);
  bar.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step === undefined) return;
    const now = tabs.findIndex((tab) => tab.getAttribute("aria-selected") === "true");
    const next = tabs[(now + step + tabs.length) % tabs.length];
    next?.click();
    next?.focus();
  });

  const viewControls = make("div", { class: "own" });
  const stage = make("div", { class: "stage" });
  const main = make("main", {}, trouble, viewControls, stage, status, exports(page, () => views[state.view]));
  const details = make("details", { open: innerWidth > 760, class: "controls" }, make("summary", {}, "Controls"), ...groups);
  const aside = make("aside", { "aria-label": "Controls of all views" }, details);
  const header = make("header", {}, make("h1", {}, "gonio"), make("span", { class: "slogan" }, "how a drop scatters light"), bar, tour(page));
  document.body.replaceChildren(header, make("div", { class: "columns" }, aside, main));

  /** A kind of media list for the text fields. */
  const media = make("datalist", { id: "media" });
  document.body.append(media);
  void engine.beside({ op: "about" }).then((reply) => {
    media.append(...(reply.header["media"] as string[]).map((name) => make("option", { value: name })));
  }).catch(() => undefined);

  let view: View | undefined;
  const layOut = (): void => {
    const next = views[state.view];
    if (next && next !== view) {
      view = next;
      stage.replaceChildren(next.element);
      viewControls.replaceChildren(...next.fields.flatMap((field) => own.get(field) ?? []));
    }
    for (const tab of tabs) {
      const selected = tab.id === `tab-${state.view}`;
      tab.setAttribute("aria-selected", String(selected));
      tab.tabIndex = selected ? 0 : -1;
    }
    for (const [field, each] of controls) {
      each.show(state);
      each.element.hidden = !(SHOWN[field]?.(state) ?? true);
    }
  };

  const run = (found: Messages): void => {
    generation += 1;
    const mine = generation;
    engine.dropFine();
    asked = performance.now();
    latency = NaN;
    tell(found);
    if (Object.keys(contradictions(state)).length > 0 || !view) return;
    working += 1;
    void view.update(() => mine === generation)
      .catch((error: unknown) => {
        if (mine === generation) page.refuse(error);
      })
      .finally(() => {
        working -= 1;
      });
  };

  // what is wrong with a link is told until something changes, also where a frame comes in between
  const follow = onFrame(() => run({ ...messages, ...contradictions(state) }));
  let writing: number | undefined;
  function changed(): void {
    layOut();
    follow();
    // browsers refuse addresses that change too often
    clearTimeout(writing);
    writing = window.setTimeout(() => history.replaceState(null, "", `#${toAddress(state)}`), 150);
  }
  addEventListener("hashchange", () => {
    ({ state, messages } = fromAddress(location.hash));
    layOut();
    run(messages);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => changed());

  window.gonio = { held: () => engine.held, settled: () => working === 0, latency: () => latency };
  layOut();
  run(messages);
}

start().catch((error: unknown) => {
  const text = `The engine does not start here: ${error instanceof Error ? error.message : String(error)}. It needs a browser with WebAssembly and its vector instructions (Chrome 91, Firefox 89, Safari 16.4 or later).`;
  document.body.replaceChildren(make("p", { class: "message general", role: "alert" }, text));
});
