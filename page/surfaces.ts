// The scene's surfaces, and what of them a view sees: src/wheatstone/drawing/seen_surface.cpp and depth/warp_row.h.

import { SurfaceFacts, SurfacesFacts } from "./manifest";
import { inflated, PageError, Source } from "./parts";

/** Stands for "no surface is known", farther than anything. */
export const unknown = -1e9;

const stepsAPixel = 16;
const joined = 1; // neighbours that differ by more are different surfaces
const widestCrack = 2;

/** What one view sees: runs of columns whose disparities are known, row by row. */
interface KnownPart extends SurfaceFacts {
  disparities: Float32Array;
  /** Number of its picture, where surfaces have some. */
  picture: number;
  /** Of each run its row's first and last column, in the surface. */
  runs: Int32Array;
  firstRun: Int32Array;
}

/** Where a view's pixels come from: which surface it is, and which of its columns. */
export const columnsASurface = 8192;

/** Undoes `encode_disparities` of src/wheatstone/marks/disparity_code.cpp; NaN is unknown. */
async function decodedDisparities(bytes: Uint8Array, width: number, height: number): Promise<Float32Array> {
  const planes = new Uint8Array(await inflated(bytes));
  const count = width * height;
  if (planes.length !== 4 * count) throw new PageError("The depth of this picture is damaged.");
  const disparities = new Float32Array(count);
  const above = new Int32Array(width + 1);
  for (let y = 0, i = 0; y < height; ++y) {
    let left = above[0]!;
    let aboveLeft = left;
    for (let x = 0; x < width; ++x, ++i) {
      const up = above[x]!;
      const expected = Math.min(Math.max(left + up - aboveLeft, Math.min(left, up)), Math.max(left, up));
      const code = planes[i]! | (planes[count + i]! << 8) | (planes[2 * count + i]! << 16) | (planes[3 * count + i]! << 24);
      const isKnown = code !== -1;
      const steps = isKnown ? expected + ((code >>> 1) ^ -(code & 1)) : expected;
      disparities[i] = isKnown ? steps / stepsAPixel : NaN;
      aboveLeft = up;
      above[x] = left = steps;
    }
  }
  return disparities;
}

function knownPart(facts: SurfaceFacts, disparities: Float32Array, picture: number): KnownPart {
  const runs: number[] = [];
  const firstRun = new Int32Array(facts.height + 1);
  for (let y = 0; y < facts.height; ++y) {
    firstRun[y] = runs.length / 2;
    const row = y * facts.width;
    for (let begin = 0; begin < facts.width; ++begin) {
      if (Number.isNaN(disparities[row + begin])) continue;
      let end = begin;
      while (end < facts.width && !Number.isNaN(disparities[row + end])) ++end;
      runs.push(begin, end);
      begin = end;
    }
  }
  firstRun[facts.height] = runs.length / 2;
  return { ...facts, disparities, picture, runs: Int32Array.from(runs), firstRun };
}

/** A row of a view that surfaces are warped to. */
class Row {
  readonly nearest: Float32Array;
  readonly source: Float32Array;
  constructor(readonly width: number) {
    this.nearest = new Float32Array(width);
    this.source = new Float32Array(width);
  }
  clear(): void {
    this.nearest.fill(unknown);
  }
  copy(from: Row): void {
    this.nearest.set(from.nearest);
    this.source.set(from.source);
  }
  land(x: number, exact: number, source: number): void {
    const disparity = Math.fround(exact); // as it is kept: what is as near does not replace it
    if (x < 0 || x >= this.width || this.nearest[x]! >= disparity) return;
    this.nearest[x] = disparity;
    this.source[x] = source;
  }
}

/** Carries a row of a surface to a view `separation` eye separations to its right; what is nearer stays. */
function warp(part: KnownPart, y: number, separation: number, sourceBase: number, over: Row): void {
  if (y >= part.height) return;
  const row = y * part.width;
  for (let run = part.firstRun[y]!; run < part.firstRun[y + 1]!; ++run) {
    const begin = part.runs[2 * run]!;
    const end = part.runs[2 * run + 1]!;
    let joinedBefore = false;
    let here = part.left + begin + 0.5 - separation * part.disparities[row + begin]!;
    for (let x = begin; x < end; ++x) {
      const d = part.disparities[row + x]!;
      const after = x + 1 < end ? part.disparities[row + x + 1]! : Infinity;
      const joinedAfter = Math.abs(after - d) <= joined;
      const next = part.left + x + 1.5 - separation * after;
      // What lies between two pixels of one surface covers the centres between the places where they land; only the
      // ends of a surface land where they are.
      if (!(joinedBefore && joinedAfter)) over.land(Math.floor(here), d, sourceBase + x + 0.5);
      if (joinedAfter) {
        const last = Math.floor(next - 0.5);
        for (let target = Math.ceil(here - 0.5); target <= last; ++target) {
          const t = next > here ? (target + 0.5 - here) / (next - here) : 0;
          over.land(target, d + t * (after - d), sourceBase + x + 0.5 + t);
        }
      }
      joinedBefore = joinedAfter;
      here = next;
    }
  }
}

/** Gives unknown runs of at most two pixels, which a stretched surface leaves, the farther of their neighbours. */
function closeCracks(row: Row): void {
  const { nearest, source, width } = row;
  for (let begin = 1; begin + 1 < width; ++begin) {
    if (nearest[begin] !== unknown || nearest[begin - 1] === unknown) continue;
    let end = begin;
    while (end < width && nearest[end] === unknown) ++end;
    if (end < width && end - begin <= widestCrack) {
      const from = nearest[begin - 1]! <= nearest[end]! ? begin - 1 : end;
      nearest.fill(nearest[from]!, begin, end);
      source.fill(source[from]!, begin, end);
    }
    begin = end;
  }
}

/** Gives what is unknown in a row the farther disparity of what lies on both sides of it. */
function goOn(row: Float32Array): void {
  for (let begin = 0; begin < row.length; ++begin) {
    if (row[begin] !== unknown) continue;
    let end = begin;
    while (end < row.length && row[end] === unknown) ++end;
    const sides = [row[begin - 1], row[end]].filter((d): d is number => d !== undefined);
    row.fill(sides.length > 0 ? Math.min(...sides) : 0, begin, end);
    begin = end;
  }
}

/** Those of the surfaces that are wanted. */
function knownParts(source: Source, facts: SurfacesFacts, isWanted: (surface: SurfaceFacts) => boolean): Promise<KnownPart[]> {
  const wanted = Array.from(facts.seen.entries()).filter(([, surface]) => isWanted(surface));
  const parts = wanted.map(async ([i, surface]) =>
    knownPart(surface, await decodedDisparities(await source.bytes(`surface-${i}`), surface.width, surface.height), i),
  );
  return Promise.all(parts);
}

export class Surfaces {
  readonly reference: number;
  /** From the leftmost to the rightmost view that a photograph shows. */
  readonly photographed: [number, number];
  private constructor(
    readonly tolerance: number,
    private readonly parts: KnownPart[],
  ) {
    this.reference = parts[0]?.view ?? 0;
    const views = parts.filter((part) => !part.continued).map((part) => part.view);
    this.photographed = [Math.min(this.reference, ...views), Math.max(this.reference, ...views)];
  }

  static async from(source: Source, facts: SurfacesFacts): Promise<Surfaces> {
    return new Surfaces(facts.tolerance, await knownParts(source, facts, () => true));
  }

  /** Only what photographs show, which is there sooner, and is all that most of a view between the eyes needs. */
  static async fromPhotographs(source: Source, facts: SurfacesFacts): Promise<Surfaces> {
    return new Surfaces(facts.tolerance, await knownParts(source, facts, (surface) => !surface.continued));
  }

  /** With what no photograph shows. */
  async withContinued(source: Source, facts: SurfacesFacts): Promise<Surfaces> {
    const continued = await knownParts(source, facts, (surface) => surface.continued);
    return new Surfaces(this.tolerance, [...this.parts, ...continued].sort((a, b) => a.picture - b.picture));
  }

  /** The same with another view as the reference, which sees all of what the surfaces show; one of them is its own. */
  seenFirstFrom(own: number, width: number, height: number): Surfaces {
    const { view } = this.parts[own]!;
    const seen = this.seenFrom(view, width, height);
    const disparities = Float32Array.from({ length: width * height }, (_, i) => seen[4 * i]!);
    for (let y = 0; y < height; ++y) goOn(disparities.subarray(y * width, (y + 1) * width));
    const facts = { view, left: 0, width, height, continued: false };
    return new Surfaces(this.tolerance, [knownPart(facts, disparities, own), ...this.parts]);
  }

  /** Only what the views see that are as large as the picture: those that photographs show. */
  ofPhotographs(): Surfaces {
    return new Surfaces(this.tolerance, this.parts.filter((part) => !part.continued));
  }

  get isEmpty(): boolean {
    return this.parts.length === 0;
  }

  get facts(): readonly SurfaceFacts[] {
    return this.parts;
  }

  /** The disparity that the reference view sees at a place; undefined where it sees none. */
  disparityAt(x: number, y: number): number | undefined {
    const part = this.parts[0];
    if (!part || x < 0 || y < 0 || x >= part.width || y >= part.height) return undefined;
    const d = part.disparities[Math.floor(y) * part.width + Math.floor(x)]!;
    return Number.isNaN(d) ? undefined : d;
  }

  /**
   * What a view sees, four numbers a pixel: the nearest surface's disparity, the reference view's, the nearest that
   * photographs show, and where the nearest comes from (its surface × columnsASurface + its column).
   */
  seenFrom(view: number, width: number, height: number): Float32Array {
    const seen = new Float32Array(4 * width * height).fill(unknown);
    const reference = new Row(width);
    const photographed = new Row(width);
    const continued = new Row(width);
    for (let y = 0; y < height; ++y) {
      for (const row of [reference, photographed, continued]) row.clear();
      this.parts.forEach((part, i) => {
        const over = i === 0 ? reference : part.continued ? continued : photographed;
        warp(part, y, view - part.view, part.picture * columnsASurface, over);
        if (i > 0) return;
        closeCracks(reference);
        photographed.copy(reference);
      });
      for (let x = 0, at = 4 * y * width; x < width; ++x, at += 4) {
        const shown = photographed.nearest[x] === unknown ? continued : photographed;
        seen[at] = shown.nearest[x]!;
        seen[at + 1] = reference.nearest[x]!;
        seen[at + 2] = photographed.nearest[x]!;
        seen[at + 3] = shown.source[x]!;
      }
    }
    return seen;
  }
}
