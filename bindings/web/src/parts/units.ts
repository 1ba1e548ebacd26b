/** Sizes and angles as people choose them; inside they are radii in µm and scattering angles. */

import type { State } from "../state";

export function sizeFactor(state: State): number {
  return (state.size_as === "diameter" ? 2 : 1) * (state.size_unit === "mm" ? 1e-3 : 1);
}

export const sizeUnit = (state: State): string => (state.size_unit === "mm" ? "mm" : "µm");

export const sizeName = (state: State): string => (state.size_as === "diameter" ? "diameter" : "radius");

/** With up to five digits. */
export const digits = (value: number, count = 5): string => String(Number(value.toPrecision(count)));

export const sizeText = (state: State, radiusUm: number): string => `${digits(radiusUm * sizeFactor(state))} ${sizeUnit(state)}`;

/** A scattering angle as it is shown, and back. */
export const angleShown = (state: State, deg: number): number => (state.angle_from === "antisolar" ? 180 - deg : deg);

export const angleName = (state: State): string =>
  state.angle_from === "antisolar" ? "angle from the antisolar point (°)" : "scattering angle, from the sun (°)";
