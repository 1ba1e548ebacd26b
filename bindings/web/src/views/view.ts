/** What every view is to the page. */

import type { Engine } from "../engine/engine";
import type { Field, State } from "../state";

/** What a view may use of the page. */
export interface Page {
  engine: Engine;
  state(): State;
  change(changes: Partial<State>): void;
  /** A line below the view: what is coarse, who computed. `approximate` marks what is not the last word. */
  status(text: string, approximate: boolean): void;
  /** A message at a control, or in general. */
  refuse(error: unknown): void;
}

export interface Picture {
  /** Drawn, for PNG. */
  canvas(): Promise<HTMLCanvasElement>;
  svg(): string;
  /** Numbers, comma-separated, with a header. */
  csv(): string;
}

export interface View extends Picture {
  element: HTMLElement;
  /** Controls of its own, beside those of all. */
  fields: readonly Field[];
  /** Draw the state: something at once, better things later. `alive` turns false when it has changed. */
  update(alive: () => boolean): Promise<void>;
}
