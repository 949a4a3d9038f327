// What a page says of its picture, as JSON. The bytes stand beside it, as named parts (parts.ts).

/** A mark's reference view, and the view positions in which it may be drawn. */
export interface Planned {
  reference: number;
  first: number;
  last: number;
}

/** What one view sees of the scene (docs/painting.fbs, Surface). */
export interface SurfaceFacts {
  view: number;
  left: number;
  width: number;
  height: number;
  continued: boolean;
}

export interface SurfacesFacts {
  tolerance: number;
  seen: SurfaceFacts[];
}

/** What pictures of every kind have in common. Lengths are in pixels of the picture. */
interface Common {
  title: string;
  width: number;
  height: number;
  /** Eye separation at which two eyes look, as a share of the picture's own; their middle is the view position 0. */
  separation: number;
  /** Disparity, at full eye separation, that lies on the screen. */
  zeroParallax: number;
  /** The view positions that can be shown. */
  first: number;
  last: number;
}

export interface StrokesFacts extends Common {
  kind: "strokes";
  surfaces: SurfacesFacts;
  planned: Planned[];
  canvas: [number, number, number];
  /** Thin paint is drawn opaque, and goes on where there is none. */
  opaque: boolean;
  /** Of the points' places. */
  stepsAPixel: number;
  /** Of the strokes' colours, in levels of 256. */
  colourStep: number;
  /** Where strokes are not even discs along their curves: src/wheatstone/marks/brush.h. */
  brush?: { bristle: number; streaks: number; ridge: number; dry: number; hasPicture: boolean };
  /** Coarse to fine; the bytes of each are the part "layer-0" and so on. */
  layers: { radius: number }[];
}

export interface RegionsFacts extends Common {
  kind: "regions";
  surfaces: SurfacesFacts;
  planned: Planned[];
  /** Of the points' places. */
  stepsAPixel: number;
}

/** Pictures that lie on surfaces: the part "picture-0" and so on is a surface's picture, of its size, a JPEG file. */
export interface LayeredFacts extends Common {
  kind: "layered";
  surfaces: SurfacesFacts;
}

/** How sums of light become colours: src/wheatstone/multiview/tone.h. */
export type ToneFacts = { stretch: "asinh" | "log" | "linear" } & (
  | { shown: "light"; exposure: number }
  | { shown: "ramp" | "colours" | "column" | "mean"; least: number; most: number }
);

/**
 * Depth planes of particles, the nearest first; the part "slice-0" and so on is a plane's light. The part "colours" is
 * a PNG file: brightness to the right, hue upwards.
 */
export interface SlicesFacts extends Common {
  kind: "slices";
  planes: { parallax: number; left: number; top: number; width: number; height: number }[];
  /** Added up, or with an alpha laid over one another; sharply: what hides, hides all. */
  hides: "nothing" | "sharply" | "softly";
  /** The light of a byte: 0 is dark, and 1 to `steps` are even steps of a logarithm. */
  light: { least: number; most: number; steps: number };
  tone: ToneFacts;
}

/** Ready views in one picture or film: `columns` × `rows` of them, the leftmost view first. */
export interface ViewsFacts extends Common {
  kind: "views";
  columns: number;
  rows: number;
  /** The first view lies bottom left and rows go upwards, as in a quilt; else top left and downwards. */
  upwards: boolean;
  /** The first view lies on the right, and rows go to the left. */
  leftwards?: boolean;
  /** A picture's, or a film's if it begins with "video/". */
  type: string;
  /** Of a film: how its frames are coded, for people. */
  codec?: string;
  hasSound?: boolean;
  /** The part "subtitles" is a WebVTT file. */
  hasSubtitles?: boolean;
  /** Of a film that stands beside the page: its address from there; else the bytes are the part "views". */
  file?: string;
}

export type Facts = StrokesFacts | RegionsFacts | LayeredFacts | SlicesFacts | ViewsFacts;
