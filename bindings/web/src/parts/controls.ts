/** One control per field of the state: a label, an input, a slider where it helps, and room for a message. */

import { type Field, HIGHEST_ORDER, read, type Shown, SPECS, type Spec, type NumberSpec, type State } from "../state";
import { make } from "./dom";
import { digits, sizeFactor, sizeUnit } from "./units";

/** Radii, which are shown in the unit that was chosen. */
const SIZES: readonly Field[] = ["radius_um", "other_um", "lee_from_um", "lee_to_um"];
/** Positions of a slider. */
const TICKS = 1000;

export interface Control {
  element: HTMLElement;
  show(state: State): void;
  tell(message: string | undefined): void;
}

export type Change = (field: Field, value: State[Field]) => void;

export function control(field: Field, state: () => State, change: Change): Control {
  const spec: Spec = SPECS[field];
  const message = make("p", { class: "message", id: `message-${field}`, role: "alert", hidden: true });
  const tell = (text: string | undefined): void => {
    message.textContent = text ?? "";
    message.hidden = text === undefined;
    for (const input of element.querySelectorAll("input, select")) input.setAttribute("aria-invalid", String(text !== undefined));
  };
  const take = (typed: string, shown?: Shown): void => {
    const found = read(field, typed, shown);
    if ("message" in found) tell(found.message);
    else {
      tell(undefined);
      change(field, found.value);
    }
  };
  const body = inputs(field, spec, state, take);
  const element = make("div", { class: `control ${spec.kind}`, "data-field": field }, ...body.nodes, message);
  return { element, tell, show: body.show };
}

interface Inputs {
  nodes: Node[];
  show(state: State): void;
}

function inputs(field: Field, spec: Spec, state: () => State, take: (typed: string, shown?: Shown) => void): Inputs {
  const id = `field-${field}`;
  const described = { id, "aria-describedby": `message-${field} hint-${field}` };
  const hint = make("span", { class: "hint", id: `hint-${field}` }, "hint" in spec && spec.hint ? spec.hint : "");
  switch (spec.kind) {
    case "number":
      return numeric(field, spec, state, take, described, hint);
    case "choice": {
      const options = spec.options.map(([word, label]) => make("option", { value: word }, label));
      const select = make("select", { ...described, change: () => take(select.value) }, ...options);
      return { nodes: [make("label", { for: id }, spec.label), select, hint], show: (now) => void (select.value = String(now[field])) };
    }
    case "text": {
      const input = make("input", { ...described, type: "text", autocomplete: "off", spellcheck: "false", change: () => take(input.value) });
      if (field === "medium" || field === "core_medium") input.setAttribute("list", "media");
      return { nodes: [make("label", { for: id }, spec.label), input, hint], show: (now) => shown(input, String(now[field])) };
    }
    case "tick": {
      const input = make("input", { ...described, type: "checkbox", change: () => take(input.checked ? "1" : "0") });
      return { nodes: [make("label", { for: id, class: "tick" }, input, spec.label), hint], show: (now) => void (input.checked = Boolean(now[field])) };
    }
    case "orders": {
      const boxes = Array.from({ length: HIGHEST_ORDER + 1 }, (_, order) =>
        make("input", { type: "checkbox", id: `${id}-${order}`, value: String(order), change: () => take(boxes.filter((box) => box.checked).map((box) => box.value).join(".")) }));
      const labels = boxes.map((box, order) => make("label", { class: "order", style: `--order: var(--order-${order})`, title: NAMES[order] ?? "" }, box, String(order)));
      const legend = make("legend", {}, spec.label);
      return {
        nodes: [make("fieldset", { id }, legend, ...labels)],
        show: (now) => boxes.forEach((box, order) => (box.checked = (now[field] as number[]).includes(order))),
      };
    }
  }
}

/** What the orders are to the eye. */
const NAMES = ["outer reflection", "straight through", "primary bow", "secondary bow", "third bow", "fourth bow", "fifth bow"];

function numeric(
  field: Field, spec: NumberSpec, state: () => State, take: (typed: string, shown?: Shown) => void,
  described: Record<string, string>, hint: HTMLElement,
): Inputs {
  const factor = (now: State): number => (SIZES.includes(field) ? sizeFactor(now) : 1);
  const label = make("label", { for: described["id"] }, spec.label);
  const unit = make("span", { class: "unit" }, spec.unit);
  // text and not a number field: what is wrong is to be seen and told
  const input = make("input", {
    ...described, type: "text", inputmode: "decimal", autocomplete: "off",
    change: () => take(input.value, SIZES.includes(field) ? { factor: sizeFactor(state()), unit: sizeUnit(state()) } : undefined),
  });
  const [from, to] = spec.log ? [Math.log(spec.from), Math.log(spec.to)] : [spec.from, spec.to];
  const steps = spec.log ? TICKS : Math.round((to - from) / spec.step);
  const slider = make("input", {
    type: "range", min: "0", max: String(steps), step: "1", "aria-label": `${spec.label}, slider`,
    input: () => {
      const place = from + (Number(slider.value) / steps) * (to - from);
      take(spec.log ? digits(Math.min(Math.max(Math.exp(place), spec.from), spec.to), 4) : String(Number((spec.from + Number(slider.value) * spec.step).toPrecision(10))));
    },
  });
  return {
    nodes: [label, make("div", { class: "entry" }, input, unit), slider, hint],
    show(now) {
      const value = now[field] as number;
      const text = digits(value * factor(now), 6);
      shown(input, text);
      unit.textContent = SIZES.includes(field) ? sizeUnit(now) : spec.unit;
      if (SIZES.includes(field)) label.textContent = spec.label.replace("Radius", now.size_as === "diameter" ? "Diameter" : "Radius");
      slider.value = String(Math.round((((spec.log ? Math.log(value) : value) - from) / (to - from)) * steps));
      slider.setAttribute("aria-valuetext", `${text} ${unit.textContent}`);
    },
  };
}

/** Nobody's typing is overwritten. */
function shown(input: HTMLInputElement, text: string): void {
  if (document.activeElement === input && input.getAttribute("aria-invalid") === "true") return;
  input.value = text;
}
