import { Gl } from "./gl";
import { PageError, Source } from "./parts";
import { Picture } from "./picture";
import { LayeredPicture } from "./layered";
import { RegionsPicture } from "./regions";
import { SlicesPicture } from "./slices";
import { StrokesPicture } from "./strokes";
import { ViewsPicture } from "./views";

/** A picture of the kind that the facts tell. */
export function openPicture(gl: Gl, source: Source): Picture {
  const { facts } = source;
  switch (facts.kind) {
    case "strokes":
      return new StrokesPicture(gl, facts, source);
    case "regions":
      return new RegionsPicture(gl, facts, source);
    case "layered":
      return new LayeredPicture(gl, facts, source);
    case "slices":
      return new SlicesPicture(gl, facts, source);
    case "views":
      return new ViewsPicture(gl, facts, source);
    default:
      throw new PageError("This page was written for a later version of its own program.");
  }
}
