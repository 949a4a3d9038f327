// Strokes as the device draws them: each is a chain of segments. The same chains as src/wheatstone/drawing/flatten.cpp.

import { seedOf } from "./bristles";
import { StrokesFacts } from "./manifest";
import { NumberStream } from "./parts";

export const texelsAStroke = 3;

/** Vertices are x in the central view, y, disparity, and the number of the stroke. */
const valuesAVertex = 4;

/** Strokes as the device draws them. */
export interface Chains {
  vertices: Float32Array;
  /** Of each vertex: the length of its stroke's chain up to it, in the central view. */
  along: Float32Array;
  vertexCount: number;
  /**
   * Three texels each: red, green, blue, opacity; radius, number of its plan, the upper and the lower half of its seed;
   * what is added to red, green and blue along it, length of its chain.
   */
  strokes: Float32Array;
  strokeCount: number;
}

/** A spline's control points, in the central view; it is clamped to the outer ones, which stand three times. */
interface Controls {
  x: Float64Array;
  y: Float64Array;
  disparity: Float64Array;
  count: number;
}

/** Adds the vertices of a chain that leaves the spline by less than an eighth of the rim: drawing/flatten.cpp. */
function addVertices(controls: Controls, radius: number, add: (x: number, y: number, d: number) => void): void {
  const { x, y, disparity: d, count } = controls;
  const control = (i: number) => Math.min(Math.max(i - 2, 0), count - 1);
  const bendAt = (i: number): number => {
    const [a, b, c] = [control(i - 1), control(i), control(i + 1)];
    const depth = Math.abs(d[a]! - 2 * d[b]! + d[c]!) / 2;
    const bendX = Math.abs(x[a]! - 2 * x[b]! + x[c]!) + depth;
    const bendY = y[a]! - 2 * y[b]! + y[c]!;
    return bendX * bendX + bendY * bendY;
  };
  const addOn = (span: number, t: number): void => {
    const s = 1 - t;
    const wa = (s * s * s) / 6;
    const wb = (3 * t * t * t - 6 * t * t + 4) / 6;
    const wd = (t * t * t) / 6;
    const wc = 1 - wa - wb - wd;
    const [i, j, k, l] = [control(span), control(span + 1), control(span + 2), control(span + 3)];
    const along = (of: Float64Array) => wa * of[i]! + wb * of[j]! + wc * of[k]! + wd * of[l]!;
    add(along(x), along(y), along(d));
  };
  const rim = radius > 10 ? 0.1 * radius : 1;
  const most = rim * rim;
  const spans = count < 2 ? 0 : count + 1;
  add(x[0]!, y[0]!, d[0]!);
  for (let first = 0, end = 0; first < spans; first = end) {
    const bend = Math.max(bendAt(first + 1), bendAt(first + 2));
    let segments = 1;
    end = first + 1;
    if (bend > most) {
      segments = Math.min(Math.ceil(Math.sqrt(Math.sqrt(bend / most))), 16);
    } else {
      for (let largest = bend; end < spans; ++end) {
        largest = Math.max(largest, bendAt(end + 2));
        if (largest * (end + 1 - first) ** 4 > most) break;
      }
    }
    for (let i = 1; i <= segments; ++i) addOn(end - 1, i / segments);
  }
}

type Colour = [number, number, number];

/** What of a stroke its points do not tell. */
interface Look {
  colour: Colour;
  change: Colour;
  opacity: number;
  radius: number;
  plan: number;
  seed: number;
}

/** Gathers strokes. */
class ChainWriter {
  private readonly vertices: number[] = [0, 0, 0, -1]; // a segment has one vertex before it
  private readonly along: number[] = [0];
  private readonly strokes: number[] = [];

  add(controls: Controls, look: Look): void {
    const number = this.strokes.length / (4 * texelsAStroke);
    const { vertices, along } = this;
    const before = along.length;
    let length = 0;
    let [lastX, lastY] = [controls.x[0]!, controls.y[0]!];
    addVertices(controls, look.radius, (x, y, d) => {
      length += Math.sqrt((x - lastX) ** 2 + (y - lastY) ** 2);
      [lastX, lastY] = [x, y];
      vertices.push(x, y, d, number);
      along.push(length);
    });
    // A dot is a segment of no length.
    if (along.length === before + 1) {
      vertices.push(...vertices.slice(-valuesAVertex));
      along.push(0);
    }
    const { colour, opacity, radius, plan, seed, change } = look;
    this.strokes.push(...colour, opacity, radius, plan, seed >>> 16, seed & 0xffff, ...change, length);
  }

  finish(): Chains {
    const vertexCount = this.vertices.length / valuesAVertex;
    this.vertices.push(0, 0, 0, -1, 0, 0, 0, -1);
    return {
      vertices: Float32Array.from(this.vertices),
      along: Float32Array.from(this.along),
      vertexCount,
      strokes: Float32Array.from(this.strokes),
      strokeCount: this.strokes.length / (4 * texelsAStroke),
    };
  }
}

/** Reads the points of strokes, as `Places` of src/wheatstone/share/strokes_part.cpp wrote one of their coordinates. */
class Places {
  private first = 0;
  constructor(
    private readonly stream: NumberStream,
    private readonly stepsAPixel: number,
    private readonly goesOn: boolean,
  ) {}

  read(count: number): Float64Array {
    const places = new Float64Array(count);
    let place = (this.first += this.stream.signed());
    places[0] = place / this.stepsAPixel;
    for (let i = 1, step = 0; i < count; ++i) {
      const change = this.stream.signed();
      step = this.goesOn ? step + change : change;
      place += step;
      places[i] = place / this.stepsAPixel;
    }
    return places;
  }
}

/** A layer's strokes, and those of them that were planned in other views than the reference. */
interface LayerChains {
  all: Chains;
  beside: Chains;
}

export function readLayer(streams: NumberStream[], facts: StrokesFacts, isBeside: (view: number) => boolean): LayerChains {
  const [counts, xs, ys, disparities, greens, reds, blues, radii, opacities, plans, ...varied] = streams;
  const [numbers, greenChanges, redChanges, blueChanges] = varied; // where strokes are not even
  const column = new Places(xs!, facts.stepsAPixel, true);
  const row = new Places(ys!, facts.stepsAPixel, true);
  const depth = new Places(disparities!, 2 * facts.stepsAPixel, false);
  const all = new ChainWriter();
  const beside = new ChainWriter();
  const level = facts.colourStep / 255;
  const colourOf = (greens: NumberStream, reds: NumberStream, blues: NumberStream): Colour => {
    const green = greens.signed();
    return [(green + reds.signed()) * level, green * level, (green + blues.signed()) * level];
  };
  let number = 0;
  while (!counts!.ended) {
    const count = counts!.whole();
    const plan = plans!.whole();
    const view = facts.planned[plan]!.reference;
    const controls: Controls = { x: column.read(count), y: row.read(count), disparity: depth.read(count), count };
    for (let i = 0; i < count; ++i) controls.x[i]! += view * controls.disparity[i]!;
    const look: Look = {
      colour: colourOf(greens!, reds!, blues!),
      change: facts.brush ? colourOf(greenChanges!, redChanges!, blueChanges!) : [0, 0, 0],
      opacity: opacities!.whole() / 65535,
      radius: radii!.whole() / 256,
      plan,
      seed: facts.brush ? seedOf((number += numbers!.signed())) : 0,
    };
    all.add(controls, look);
    if (isBeside(view)) beside.add(controls, look);
  }
  return { all: all.finish(), beside: beside.finish() };
}
