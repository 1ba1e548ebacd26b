/** Columns of colours over the scattering angle, as the engine is asked for them. */

import type { Header } from "../engine/message";
import { dropOf, type State } from "../state";

export interface Stretch {
  from: number;
  to: number;
  points: number;
}

/** Fineness of first answers: few wavelengths, and the fine fringes are smoothed away. */
export const SKETCH = 0.03;

export function columnOf(state: State, stretch: Stretch, fineness: number, more: Record<string, unknown> = {}): Header {
  return {
    op: "column", drop: dropOf(state), theta_deg: [stretch.from, stretch.to], points: stretch.points,
    azimuth_deg: state.azimuth_deg, sun_disc: state.sun_disc, fineness,
    wavelength_nm: state.light === "one" ? state.wavelength_nm : null, ...more,
  };
}

/** Numbers per angle of a column: XYZ along the scattering plane and across it. */
export const PER_ANGLE = 6;

/** A column with nothing in it. */
export const empty = (points: number): Float64Array => new Float64Array(points * PER_ANGLE);
