// What the page says.

import { Mode } from "./stage";

export const nameOf: Record<Mode, string> = {
  flat: "Flat",
  wiggle: "Wiggle",
  anaglyph: "Anaglyph",
  parallel: "Side by side, parallel",
  "cross-eyed": "Side by side, cross-eyed",
};

/** How to look at each mode's picture, in a sentence. */
export const howToLook: Record<Mode, string> = {
  flat: "Move the pointer over the picture, or tilt the device, to look at it from another side.",
  wiggle: "The picture changes between the views of the two eyes, which shows its depth without glasses.",
  anaglyph: "Look through red and cyan glasses, with the red glass before the left eye.",
  parallel: "Look through the screen into the distance until the two pictures become three, and look at the middle one.",
  "cross-eyed": "Look at a finger halfway to the screen until the two pictures become three, and look at the middle one.",
};

export const wiggleByHand = "Press the space bar or click the picture to change between the views of the two eyes.";
/** Of how its frames are coded; undefined: the film is not there. */
export const noFilm = (codec: string | undefined): string =>
  codec
    ? `This browser cannot play the film, whose frames are coded as ${codec}, so that a still picture is shown.`
    : "The film that belongs beside this page cannot be loaded, so that a still picture is shown.";
export const filmNeedsServer =
  "Browsers let a page use a film that lies beside it only where a server sends both, so that the film plays here as it is.";
export const playKeys = " The space bar plays and pauses the film; J and L go five seconds back and on.";

export const noWebgl = "This browser has no WebGL 2, which the picture needs for its depth, so that it is shown still.";
export const contextLost = "The graphics device was lost, so that the picture is shown still until it comes back.";
export const notShown = "This picture cannot be shown with its depth, so that it is shown still.";
export const inHeadset = "Put on the headset, and move your head to look at the picture from another side.";
