// A picture of any kind, as the stage knows it.

import { Film } from "./film";
import { Facts } from "./manifest";
import { Target } from "./gl";
import { Surfaces } from "./surfaces";

/** Draws the views of one picture. What only some kinds have, the others leave out. */
export interface Picture {
  readonly facts: Facts;
  /** Decodes the rest, a part at a time; calls `changed` after each part, and of a film at each moment. */
  load(changed: () => void): Promise<void>;
  /** The picture as the view at this position sees it; the target has the picture's shape, in any size. */
  draw(view: number, target: Target): void;
  /** The same sooner and less exactly, for while the view moves. */
  drawQuickly?(view: number, target: Target): void;
  /** More is still being decoded, so that what is drawn will soon be drawn again. */
  readonly isUnfinished?: boolean;
  /** Layers of detail, and how many of them are drawn. */
  readonly detail?: { readonly layers: number; shown: number };
  /** What tells how deep the scene is, once it is loaded. */
  readonly surfaces?: Surfaces | undefined;
  /** What plays, once it is loaded. */
  readonly film?: Film | undefined;
}
