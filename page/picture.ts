// A picture of any kind, as the stage knows it.

import { Facts } from "./manifest";
import { Target } from "./gl";

/** Draws the views of one picture. */
export interface Picture {
  readonly facts: Facts;
  /** Decodes the rest, a part at a time; after each part `changed` is called. */
  load(changed: () => void): Promise<void>;
  /** The picture as the view at this position sees it; the target has the picture's shape, in any size. */
  draw(view: number, target: Target): void;
  /** How many layers of detail there are; 1: there is no choice. */
  readonly layers: number;
  /** The last layer that is drawn, from 1. */
  setDetail(layers: number): void;
  /** The disparity that lies at a place of the view at this position, in the picture's pixels. */
  disparityAt(x: number, y: number, view: number): number | undefined;
  /** Whether a film runs, so that each moment has another picture. */
  readonly moves: boolean;
}
