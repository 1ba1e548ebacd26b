/** The sky: both bows, cloud bow and glory, as a camera sees them. */

import type { Header, Reply } from "../engine/message";
import { dropOf, isRound, type State } from "../state";
import { columnOf, empty, PER_ANGLE, SKETCH, type Stretch } from "../parts/column";
import { make } from "../parts/dom";
import { canvasOf, table } from "../parts/picture";
import { digits, sizeText } from "../parts/units";
import type { Page, View } from "./view";

/** The whole column, and its part about the bows. */
const WHOLE: Stretch = { from: 90, to: 180, points: 1801 };
/** Beyond this, light that went straight back takes long; the glory of drops larger than this is not to be seen. */
const NEAR_AXIS = 165;
const LARGEST_GLORY_UM = 60;
/** Azimuths of a whole sky of drops that are not round; each takes seconds. */
const AZIMUTHS = [180, 150, 120, 90, 60, 30, 0];
const COARSE_WIDTH = 240;
const FINE_WIDTH = 1200;
const RATIO = 0.6;

interface Sheet {
  azimuths: number[];
  columns: Float64Array[];
}

export function skyView(page: Page): View {
  const canvas = make("canvas", { class: "sky", role: "img", "aria-label": "The sky with its bows" });
  const words = make("p", { class: "legend" });
  const element = make("section", { class: "view-sky" }, canvas, words);
  let sheet: Sheet | undefined;
  let key = "";
  let done = false;

  const camera = (state: State, width: number, stretch: Stretch, azimuths: readonly number[]): Header => ({
    op: "sky", sun_elevation_deg: state.sun_elevation_deg, fov_deg: state.fov_deg, elevation_deg: state.camera_deg,
    azimuth_deg: state.pan_deg, width, height: Math.round(width * RATIO), stops: state.stops, ground: state.ground,
    columns: { theta_deg: [stretch.from, stretch.to], points: stretch.points, azimuths_deg: azimuths, polarisation: state.polarisation },
  });
  const draw = (reply: Reply | undefined, width: number): void => {
    const height = Math.round(width * RATIO);
    const drawn = canvasOf(reply?.u8["rgba"] ?? new Uint8Array(4 * width * height), width, height);
    [canvas.width, canvas.height] = [width, height];
    canvas.getContext("2d")?.drawImage(drawn, 0, 0);
  };
  const picture = async (state: State, width: number, lane: "quickly" | "finely", from: Sheet, alive: () => boolean): Promise<void> => {
    const order = from.azimuths.map((_, i) => i).sort((a, b) => (from.azimuths[a] ?? 0) - (from.azimuths[b] ?? 0));
    const numbers = new Float64Array(from.columns.length * WHOLE.points * PER_ANGLE);
    order.forEach((i, place) => numbers.set(from.columns[i] ?? empty(WHOLE.points), place * WHOLE.points * PER_ANGLE));
    const [reply] = await page.engine[lane]([{ header: camera(state, width, WHOLE, order.map((i) => from.azimuths[i] ?? 0)), numbers }]);
    if (lane === "quickly" || alive()) draw(reply, width);
  };
  /** A column about the bows and its sky, at once. */
  const sketched = async (state: State, stretch: Stretch, more: Record<string, unknown>): Promise<void> => {
    const [, reply] = await page.engine.quickly([{ header: columnOf(state, stretch, SKETCH, more) }, { header: camera(state, COARSE_WIDTH, stretch, [0]), of: 0 }]);
    draw(reply, COARSE_WIDTH);
  };

  /** A stretch of a column, laid into the whole one. */
  const stretched = async (state: State, part: Stretch, fineness: number, into: Float64Array, more: Record<string, unknown> = {}): Promise<void> => {
    const reply = await page.engine.fine(columnOf(state, part, fineness, more));
    const found = reply.f64["xyz"] ?? new Float64Array();
    const step = (WHOLE.to - WHOLE.from) / (WHOLE.points - 1);
    for (let i = 0; i < WHOLE.points; i += 1) {
      const place = ((WHOLE.from + i * step - part.from) / (part.to - part.from)) * (part.points - 1);
      if (place < -1e-9 || place > part.points - 1 + 1e-9) continue;
      const cell = Math.min(Math.max(0, Math.floor(place)), part.points - 2);
      const share = place - cell;
      for (let k = 0; k < PER_ANGLE; k += 1) {
        into[i * PER_ANGLE + k] = (1 - share) * (found[cell * PER_ANGLE + k] ?? 0) + share * (found[(cell + 1) * PER_ANGLE + k] ?? 0);
      }
    }
  };

  const round = async (state: State, alive: () => boolean): Promise<void> => {
    const column = empty(WHOLE.points);
    sheet = { azimuths: [0], columns: [column] };
    await sketched(state, { from: 126, to: 146, points: 161 }, {});
    page.status("coarse: few wavelengths, about the bows alone", true);
    if (!alive()) return;
    await stretched(state, { from: 90, to: NEAR_AXIS, points: 1001 }, 0.3, column);
    if (!alive()) return;
    await picture(state, FINE_WIDTH, "finely", sheet, alive);
    if (state.radius_um <= LARGEST_GLORY_UM) {
      page.status("coarse: without the glory", true);
      await stretched(state, { from: NEAR_AXIS, to: 180, points: 301 }, 0.3, column);
    } else {
      // beyond 165° the light of large drops is nearly even
      level(column);
    }
    if (!alive()) return;
    await picture(state, FINE_WIDTH, "finely", sheet, alive);
    page.status("coarse: fewer wavelengths", true);
    await stretched(state, { from: 120, to: 160, points: 801 }, 1, column);
    if (!alive()) return;
    await picture(state, FINE_WIDTH, "finely", sheet, alive);
    done = true;
    const glory = state.radius_um <= LARGEST_GLORY_UM ? "" : `; no glory is computed above a radius of ${sizeText(state, LARGEST_GLORY_UM)}`;
    page.status(`exact series, sunlight scattered once${glory}`, false);
  };

  const flat = async (state: State, alive: () => boolean): Promise<void> => {
    const first = empty(WHOLE.points);
    sheet = { azimuths: [state.azimuth_deg], columns: [first] };
    const bow = { from: 128, to: 150, points: 89 };
    await sketched(state, bow, { wavelength_nm: 560, sun_disc: false, drop: { ...dropOf(state), spread: 0 } });
    page.status("coarse: the primary bow at one azimuth and 560 nm, for all azimuths", true);
    if (!alive()) return;
    const part = { from: 125, to: 165, points: 321 };
    for (const [i, azimuth] of [state.azimuth_deg, ...AZIMUTHS].entries()) {
      const column = empty(WHOLE.points);
      await stretched(state, part, 0.1, column, { azimuth_deg: azimuth });
      if (!alive()) return;
      if (i === 0) sheet = { azimuths: [azimuth], columns: [column] };
      else if (i === 1) sheet = { azimuths: [azimuth], columns: [column] };
      else sheet = { azimuths: [...sheet.azimuths, azimuth], columns: [...sheet.columns, column] };
      await picture(state, FINE_WIDTH, "finely", sheet, alive);
      if (!alive()) return;
      page.status(`coarse: colours at ${Math.max(1, i)} of ${AZIMUTHS.length} azimuths, in between and beyond from the nearest`, true);
    }
    done = true;
    page.status(`rays with phase, few wavelengths, ${AZIMUTHS.length} azimuths, in between interpolated; 125 to 165° from the sun`, true);
  };

  return {
    element,
    fields: ["fov_deg", "camera_deg", "pan_deg", "stops", "ground"],
    async update(alive) {
      const state = page.state();
      const { fov_deg, camera_deg, pan_deg, stops, ground, polarisation, ...rest } = state;
      const { light, wavelength_nm, sun_disc, azimuth_deg } = rest;
      const wanted = JSON.stringify([columnOf(state, WHOLE, 1), light, wavelength_nm, sun_disc, azimuth_deg]);
      words.textContent = `Sun ${digits(state.sun_elevation_deg)}° high behind the camera; the antisolar point lies ${digits(state.sun_elevation_deg)}° below the horizon.`;
      if (wanted === key && done && sheet) {
        await picture(state, COARSE_WIDTH, "quickly", sheet, alive);
        if (alive()) await picture(state, FINE_WIDTH, "finely", sheet, alive);
        return;
      }
      [key, done] = [wanted, false];
      await (isRound(state.shape) ? round : flat)(state, alive);
    },
    async canvas() {
      return canvas;
    },
    svg: () => `<svg xmlns="http://www.w3.org/2000/svg" width="${canvas.width}" height="${canvas.height}"><image href="${canvas.toDataURL("image/png")}" width="${canvas.width}" height="${canvas.height}"/></svg>`,
    csv() {
      const column = sheet?.columns[0] ?? empty(2);
      const part = (k: number): number[] => Array.from({ length: column.length / PER_ANGLE }, (_, i) => column[i * PER_ANGLE + k] ?? NaN);
      const names = ["X_along", "Y_along", "Z_along", "X_across", "Y_across", "Z_across"];
      const angles = Array.from({ length: column.length / PER_ANGLE }, (_, i) => WHOLE.from + ((WHOLE.to - WHOLE.from) * i) / (WHOLE.points - 1));
      return table("sky: XYZ over the scattering angle, 1/sr; 0 where nothing was computed", [["scattering_angle_deg", angles], ...names.map((name, k) => [name, part(k)] as const)]);
    },
  };
}

/** The last computed value, up to 180°. */
function level(column: Float64Array): void {
  const edge = Math.round(((NEAR_AXIS - WHOLE.from) / (WHOLE.to - WHOLE.from)) * (WHOLE.points - 1));
  for (let i = edge + 1; i < WHOLE.points; i += 1) {
    for (let k = 0; k < PER_ANGLE; k += 1) column[i * PER_ANGLE + k] = column[edge * PER_ANGLE + k] ?? 0;
  }
}
