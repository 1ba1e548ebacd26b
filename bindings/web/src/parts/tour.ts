/** Six steps through what the page can show, each with one thing to do. */

import { initialState, type State } from "../state";
import type { Page } from "../views/view";
import { make } from "./dom";

interface Step {
  title: string;
  text: string;
  todo: string;
  state: Partial<State>;
  done(state: State): boolean;
}

const STEPS: readonly Step[] = [
  {
    title: "Descartes’ bow",
    text: "Sunlight meets a drop, goes in, is reflected once and leaves (order 2). Most rays leave near one angle, 138° from the sun: there is the rainbow.",
    todo: "Drag the coloured ray up and down until it leaves at the angle of the rainbow.",
    state: { view: "rays", shape: "sphere", orders: [2], light: "one", impact: 0.5, radius_um: 500 },
    done: (state) => Math.abs(Math.abs(state.impact) - 0.86) < 0.05,
  },
  {
    title: "Colours",
    text: "Water bends blue light more than red, so every colour has its own bow.",
    todo: "Switch the light to daylight and see the one ray part into colours.",
    state: { view: "rays", shape: "sphere", orders: [2], light: "one", impact: 0.86, fan: false, radius_um: 500 },
    done: (state) => state.light === "daylight",
  },
  {
    title: "Supernumerary bows",
    text: "Two rays leave at each angle inside the bow, and interfere: fringes follow the main bow. The whole is the exact series, order 2 one term of it.",
    todo: "Make the drop smaller, below 100 µm of radius, and see the fringes widen.",
    state: { view: "scattered", shape: "sphere", light: "one", orders: [2], radius_um: 400, from_deg: 130, to_deg: 160, log: false, sun_disc: true },
    done: (state) => state.radius_um < 100,
  },
  {
    title: "The white bow",
    text: "In fog the drops are so small that the bows of all colours overlap.",
    todo: "Take drops of fog: a radius below 15 µm.",
    state: { view: "sky", shape: "sphere", light: "daylight", radius_um: 300, ground: false, fov_deg: 110 },
    done: (state) => state.radius_um < 15,
  },
  {
    title: "Polarisation",
    text: "The reflection inside is near Brewster’s angle, so the bow is polarised across the scattering plane.",
    todo: "Look through a filter along the scattering plane: the bow nearly goes out.",
    state: { view: "scattered", shape: "sphere", light: "one", orders: [2, 3], radius_um: 200, from_deg: 120, to_deg: 150, log: false },
    done: (state) => state.polarisation === "parallel",
  },
  {
    title: "Flat drops",
    text: "Large drops fall as flattened bodies. At the top of the bow light goes through their flat side, and the bow is elsewhere than that of a sphere.",
    todo: "Change the axis ratio and see how far the rainbow moves.",
    state: { view: "rays", shape: "spheroid", axis_ratio: 0.95, orders: [2], light: "one", impact: 0.86, radius_um: 800, sun_elevation_deg: 5 },
    done: (state) => state.axis_ratio !== 0.95,
  },
];

export function tour(page: Page): HTMLElement {
  let at = -1;
  const box = make("section", { class: "tour", hidden: true, "aria-label": "Tour", "aria-live": "polite" });
  const end = (): void => {
    at = -1;
    box.hidden = true;
    toggle.setAttribute("aria-expanded", "false");
  };
  const go = (step: number): void => {
    const next = STEPS[step];
    if (!next) return end();
    at = step;
    // how people like their units stays
    const { size_as, size_unit, angle_from } = page.state();
    page.change({ ...initialState(), size_as, size_unit, angle_from, ...next.state });
    show();
  };
  const show = (): void => {
    const step = STEPS[at];
    box.hidden = !step;
    toggle.setAttribute("aria-expanded", String(Boolean(step)));
    if (!step) return;
    const done = make("p", { class: "todo" }, step.todo);
    box.replaceChildren(
      make("h2", {}, `${at + 1} of ${STEPS.length}: ${step.title}`), make("p", {}, step.text), done,
      make("p", { class: "buttons" },
        make("button", { type: "button", ...(at === 0 ? { disabled: true } : {}), click: () => go(at - 1) }, "Back"),
        make("button", { type: "button", click: () => go(at + 1) }, at === STEPS.length - 1 ? "Finish" : "Next"),
        make("button", { type: "button", click: end }, "Leave")),
    );
  };
  const toggle = make("button", { type: "button", class: "tour-button", "aria-expanded": "false", click: () => (at < 0 ? go(0) : end()) }, "Tour");
  // the state is looked at, so that whatever way leads there counts
  setInterval(() => {
    const step = STEPS[at];
    if (step) box.querySelector(".todo")?.classList.toggle("done", step.done(page.state()));
  }, 200);
  return make("div", { class: "tour-place" }, toggle, box);
}
