/** All that the page shows hangs on this: one state, in the address behind `#`. */

import { sizeText } from "./parts/units";

/** A number that a control sets. */
export interface NumberSpec {
  kind: "number";
  label: string;
  unit: string;
  from: number;
  to: number;
  /** Of the slider; `log` sliders go by ratio. */
  step: number;
  log?: true;
  initial: number;
  hint?: string;
}

/** One of a few words. */
export interface ChoiceSpec {
  kind: "choice";
  label: string;
  options: readonly (readonly [value: string, label: string])[];
  initial: string;
  hint?: string;
}

export interface TextSpec {
  kind: "text";
  label: string;
  initial: string;
  hint?: string;
}

export interface TickSpec {
  kind: "tick";
  label: string;
  initial: boolean;
  hint?: string;
}

export interface OrdersSpec {
  kind: "orders";
  label: string;
  initial: readonly number[];
}

export type Spec = NumberSpec | ChoiceSpec | TextSpec | TickSpec | OrdersSpec;

const number = (label: string, unit: string, from: number, to: number, step: number, initial: number, more: { log?: true; hint?: string } = {}): NumberSpec => ({
  kind: "number", label, unit, from, to, step, initial, ...more,
});
const tick = (label: string, initial: boolean, hint?: string): TickSpec => ({ kind: "tick", label, initial, ...(hint === undefined ? {} : { hint }) });
const text = (label: string, initial: string, hint: string): TextSpec => ({ kind: "text", label, initial, hint });
const choice = (label: string, options: ChoiceSpec["options"], initial: string, hint?: string): ChoiceSpec => ({
  kind: "choice", label, options, initial, ...(hint === undefined ? {} : { hint }),
});

/** The highest order with a box of its own. */
export const HIGHEST_ORDER = 6;

export const SHAPES = [
  ["sphere", "sphere"],
  ["spheroid", "spheroid"],
  ["raindrop", "falling raindrop"],
  ["layered", "layered sphere"],
  ["gradient", "sphere with a gradient"],
] as const;

export const SPECS = {
  view: choice("View", [["rays", "Rays"], ["scattered", "Scattered light"], ["lee", "Lee diagram"], ["sky", "Sky"], ["compare", "Compare"], ["photo", "Photograph"]], "rays"),
  shape: choice("Drop", SHAPES, "sphere"),
  radius_um: number("Radius", "µm", 0.1, 4500, 0.001, 300, { log: true, hint: "of the sphere of equal volume" }),
  axis_ratio: number("Axis ratio", "", 0.5, 1.5, 0.005, 0.9, { hint: "vertical over horizontal diameter" }),
  medium: text("Material", "water", "a name, an index, or n+ki as 1.5+0.001i"),
  temperature_c: number("Temperature", "°C", 0, 90, 1, 20, { hint: "of water" }),
  core_fraction: number("Core", "of the radius", 0.05, 0.95, 0.01, 0.6),
  core_medium: text("Core's material", "1.45", "a name or an index"),
  centre_index: number("Index at the centre", "", 1.05, 2, 0.001, 1.36),
  surface_index: number("Index at the surface", "", 1.05, 2, 0.001, 1.33),
  sun_elevation_deg: number("Sun's elevation", "°", 0, 90, 0.5, 20),
  spread: number("Spread of sizes", "", 0, 0.5, 0.005, 0, { hint: "standard deviation of ln radius" }),
  light: choice("Light", [["daylight", "daylight"], ["one", "one wavelength"]], "daylight"),
  wavelength_nm: number("Wavelength", "nm", 380, 720, 1, 589),
  polarisation: choice("Seen", [["total", "all light"], ["parallel", "along the scattering plane"], ["perpendicular", "across the scattering plane"]], "total"),
  sun_disc: tick("Sun's disc of 0.53°", true, "off: a point of light"),
  azimuth_deg: number("Azimuth", "°", 0, 180, 1, 180, { hint: "of drops that are not round: 180 is the top of the bow" }),
  orders: { kind: "orders", label: "Orders (chords inside)", initial: [2] } as OrdersSpec,
  size_as: choice("Sizes as", [["radius", "radius"], ["diameter", "diameter"]], "radius"),
  size_unit: choice("in", [["um", "µm"], ["mm", "mm"]], "um"),
  angle_from: choice("Angles from", [["sun", "the sun"], ["antisolar", "the antisolar point"]], "sun"),
  impact: number("Impact", "of the radius", -0.999, 0.999, 0.001, 0.86),
  fan: tick("Fan of rays", true),
  caustic: tick("Caustic", true),
  from_deg: number("From", "°", 0, 179, 0.1, 90, { hint: "from the sun" }),
  to_deg: number("To", "°", 1, 180, 0.1, 180, { hint: "from the sun" }),
  curve: choice("Curve", [["intensity", "intensity"], ["polarisation", "degree of polarisation"]], "intensity"),
  log: tick("Logarithmic", true),
  whole: tick("Whole", true),
  added: tick("Ticked orders added as waves", false),
  lee_from_um: number("Radius from", "µm", 1, 1000, 0.1, 10, { log: true }),
  lee_to_um: number("Radius to", "µm", 2, 2000, 0.1, 1000, { log: true }),
  fov_deg: number("Field of view", "°", 10, 200, 1, 95),
  camera_deg: number("Camera's elevation", "°", -45, 90, 1, 18),
  pan_deg: number("Camera's azimuth", "°", -180, 180, 1, 0),
  stops: number("Exposure", "stops", -6, 6, 0.1, 0),
  ground: tick("Ground hides the lower part", true),
  other: choice("Against", [["rays", "rays through the same sphere"], ["drop", "another drop"]], "drop"),
  other_shape: choice("Other drop", SHAPES, "sphere"),
  other_um: number("Other size", "µm", 0.1, 4500, 0.001, 100, { log: true }),
  photo_fov_deg: number("Field of view", "°", 1, 150, 0.1, 65),
  photo_x: number("Antisolar point, across", "of the width", -3, 4, 0.001, 0.5),
  photo_y: number("Antisolar point, down", "of the height", -3, 4, 0.001, 1.2),
  photo_tilt_deg: number("Horizon's tilt", "°", -90, 90, 0.1, 0),
  photo_stops: number("Overlay", "stops", -6, 6, 0.1, 0),
  photo_sector_deg: number("Cut towards", "°", -180, 180, 1, 90, { hint: "from the antisolar point: 90 is up" }),
} as const satisfies Record<string, Spec>;

export type Field = keyof typeof SPECS;

type Value<S> = S extends { kind: "number" } ? number : S extends { kind: "tick" } ? boolean : S extends { kind: "orders" } ? number[] : string;
export type State = { -readonly [F in Field]: Value<(typeof SPECS)[F]> };

export type Messages = Partial<Record<Field | "", string>>;

export const FIELDS = Object.keys(SPECS) as Field[];

export function initialState(): State {
  const entries = FIELDS.map((field) => {
    const { initial } = SPECS[field];
    return [field, Array.isArray(initial) ? [...(initial as number[])] : initial];
  });
  return Object.fromEntries(entries) as State;
}

/** Longest words of a text field, and longest addresses. */
const LONGEST_TEXT = 60;
const LONGEST_ADDRESS = 4000;

/** How a number is shown: in which unit, and how many of it one of the state's is. */
export interface Shown {
  factor: number;
  unit: string;
}

/** A value as it is typed or stands in an address; or what is wrong with it. `shown` says in what a number was typed, and
 * its message is in that. */
export function read(field: Field, typed: string, shown?: Shown): { value: State[Field] } | { message: string } {
  const spec: Spec = SPECS[field];
  switch (spec.kind) {
    case "number": {
      const { factor, unit } = shown ?? { factor: 1, unit: spec.unit };
      const told = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i.test(typed.trim()) ? Number(typed.trim().replace(",", ".")) : NaN;
      const [from, to] = [spec.from, spec.to].map((end) => Number((end * factor).toPrecision(12)));
      const accepted = `accepted are ${from} to ${to} ${unit}`.trim();
      if (!Number.isFinite(told)) return { message: `“${shorten(typed)}” is no number: ${accepted}` };
      const value = Number((told / factor).toPrecision(12));
      if (value < spec.from || value > spec.to) return { message: `${told}: ${accepted}` };
      return { value };
    }
    case "choice": {
      const known = spec.options.map(([word]) => word);
      return known.includes(typed) ? { value: typed } : { message: `“${shorten(typed)}” is not known; accepted: ${known.join(", ")}` };
    }
    case "tick":
      return typed === "1" || typed === "0" ? { value: typed === "1" } : { message: `“${shorten(typed)}”: accepted are 0 and 1` };
    case "orders": {
      const orders = typed === "" ? [] : typed.split(".").map(Number);
      const fits = orders.every((order) => Number.isInteger(order) && order >= 0 && order <= HIGHEST_ORDER);
      return fits ? { value: [...new Set(orders)].sort((a, b) => a - b) } : { message: `“${shorten(typed)}”: accepted are orders 0 to ${HIGHEST_ORDER}` };
    }
    case "text": {
      const value = typed.trim();
      if (value === "" || value.length > LONGEST_TEXT) return { message: `accepted are 1 to ${LONGEST_TEXT} characters` };
      return { value };
    }
  }
}

const shorten = (typed: string): string => (typed.length > 24 ? `${typed.slice(0, 24)}…` : typed);

const written = (value: State[Field]): string =>
  Array.isArray(value) ? value.join(".") : typeof value === "boolean" ? (value ? "1" : "0") : String(value);

/** What differs from the start, behind `#`. */
export function toAddress(state: State): string {
  const start = initialState();
  const parts = FIELDS.filter((field) => written(state[field]) !== written(start[field])).map(
    (field) => `${field}=${encodeURIComponent(written(state[field]))}`,
  );
  return parts.join("&");
}

/** The state of an address; what is wrong with it is told, and stays at its start. */
export function fromAddress(address: string): { state: State; messages: Messages } {
  const state = initialState();
  const messages: Messages = {};
  const bare = address.replace(/^#/, "");
  if (bare.length > LONGEST_ADDRESS) return { state, messages: { "": "the address is too long: it was left aside" } };
  for (const part of bare.split("&").filter((part) => part !== "")) {
    const [name = "", ...rest] = part.split("=");
    const typed = decoded(rest.join("="));
    if (!Object.hasOwn(SPECS, name)) {
      messages[""] = `the address has “${shorten(name)}”, which is not known here`;
      continue;
    }
    const field = name as Field;
    const found = read(field, typed);
    if ("message" in found) messages[field] = found.message;
    else Object.assign(state, { [field]: found.value });
  }
  return { state, messages: { ...messages, ...contradictions(state) } };
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

/** What no single field shows; empty where all is well. */
export function contradictions(state: State): Messages {
  const messages: Messages = {};
  if (state.to_deg < state.from_deg + 0.5) messages.to_deg = `${state.to_deg}: must be at least 0.5° above ${state.from_deg}`;
  if (state.lee_to_um < 1.2 * state.lee_from_um) messages.lee_to_um = `${sizeText(state, state.lee_to_um)}: must be at least 1.2 times ${sizeText(state, state.lee_from_um)}`;
  return messages;
}

/** The drop as the engine takes it. */
export function dropOf(state: State): Record<string, unknown> {
  const { shape, radius_um, axis_ratio, medium, temperature_c, core_fraction, core_medium, centre_index, surface_index, sun_elevation_deg, spread } = state;
  return { shape, radius_um, axis_ratio, medium, temperature_c, core_fraction, core_medium, centre_index, surface_index, sun_elevation_deg, spread };
}

export const isRound = (shape: string): boolean => shape !== "spheroid" && shape !== "raindrop";
