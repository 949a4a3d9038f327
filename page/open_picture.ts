import { Gl } from "./gl";
import { PageError, Source } from "./parts";
import { Picture } from "./picture";
import { StrokesPicture } from "./strokes";

/** A picture of the kind that the facts tell. */
export function openPicture(gl: Gl, source: Source): Picture {
  const { facts } = source;
  switch (facts.kind) {
    case "strokes":
      return new StrokesPicture(gl, facts, source);
    default:
      throw new PageError("This page was written for a later version of its own program.");
  }
}
