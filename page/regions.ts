// Regions of one colour, drawn for any view: src/wheatstone/drawing/draw_regions.cpp. Samples of a pixel belong to one
// region each, so that neighbours leave no seam; which region that is depends on the order and the depth of all, which
// the processor tells more simply than a graphics device.

import { Gl, Target } from "./gl";
import { RegionsFacts } from "./manifest";
import { NumberStream, Source, streamsOf } from "./parts";
import { Picture } from "./picture";
import { Surfaces, unknown } from "./surfaces";

const rowsABand = 8;
const hidesPixels = 1; // of disparity, by which something must be nearer to hide a later region
const nothing = -1;

interface Region {
  /** Points of its rings, one after another; each ring is closed. */
  firstRing: number;
  endRing: number;
  colour: [number, number, number];
  reference: number;
  first: number;
  last: number;
  top: number;
  bottom: number;
}

interface Outlines {
  x: Float64Array;
  y: Float64Array;
  disparity: Float64Array;
  /** Of each ring its first point, and behind the last one the number of points. */
  firstPoint: number[];
  regions: Region[];
}

/** Reads the part, as src/wheatstone/share/regions_part.cpp wrote it. */
function readOutlines(streams: NumberStream[], facts: RegionsFacts): Outlines {
  const [ringCounts, pointCounts, xs, ys, disparities, greens, reds, blues, plans] = streams;
  const points: [number[], number[], number[]] = [[], [], []];
  const firstPoint: number[] = [];
  const regions: Region[] = [];
  const last = [0, 0, 0];
  while (!ringCounts!.ended) {
    const rings = ringCounts!.whole();
    const green = greens!.signed();
    const colour: [number, number, number] = [green + reds!.signed(), green, green + blues!.signed()];
    const plan = facts.planned[plans!.whole()]!;
    const region = { ...plan, firstRing: firstPoint.length, endRing: firstPoint.length + rings, colour, top: Infinity, bottom: -Infinity };
    for (let ring = 0; ring < rings; ++ring) {
      firstPoint.push(points[0].length);
      for (let count = pointCounts!.whole(); count > 0; --count) {
        [xs!, ys!, disparities!].forEach((stream, axis) => {
          last[axis]! += stream.signed();
          points[axis]!.push(last[axis]! / facts.stepsAPixel);
        });
        region.top = Math.min(region.top, last[1]! / facts.stepsAPixel);
        region.bottom = Math.max(region.bottom, last[1]! / facts.stepsAPixel);
      }
    }
    regions.push(region);
  }
  firstPoint.push(points[0].length);
  const [x, y, disparity] = points.map((values) => Float64Array.from(values));
  return { x: x!, y: y!, disparity: disparity!, firstPoint, regions };
}

/** Samples of a few rows. */
class Band {
  readonly disparity: Float32Array;
  readonly region: Int32Array;
  readonly ofReference: Uint8Array;
  /** Of each line x and disparity of the outlines that cross it. */
  readonly crossings: number[][];
  firstLine = 0;

  constructor(
    readonly columns: number,
    readonly samples: number,
  ) {
    const lines = rowsABand * samples;
    this.disparity = new Float32Array(columns * lines);
    this.region = new Int32Array(columns * lines);
    this.ofReference = new Uint8Array(columns * lines);
    this.crossings = Array.from({ length: lines }, () => []);
  }

  cross(ax: number, ay: number, ad: number, bx: number, by: number, bd: number): void {
    // Neighbouring regions share edges: both must find the same crossings, whichever way round they go.
    if (by < ay || (by === ay && bx < ax)) [ax, ay, ad, bx, by, bd] = [bx, by, bd, ax, ay, ad];
    const { firstLine, samples } = this;
    const line = (y: number) => Math.min(Math.max(Math.ceil(y * samples - 0.5) - firstLine, 0), this.crossings.length);
    const end = line(by);
    for (let i = line(ay); i < end; ++i) {
      const t = ((i + firstLine + 0.5) / samples - ay) / (by - ay);
      this.crossings[i]!.push(ax + t * (bx - ax), ad + t * (bd - ad));
    }
  }

  /** Gives the samples between crossings, by the even-odd rule, to a region. */
  fill(region: number, isOwn: boolean): void {
    this.crossings.forEach((crossings, line) => {
      if (crossings.length === 0) return;
      sortPairs(crossings);
      for (let i = 0; i + 3 < crossings.length; i += 4)
        this.fillBetween(crossings[i]!, crossings[i + 1]!, crossings[i + 2]!, crossings[i + 3]!, line, region, isOwn);
      crossings.length = 0;
    });
  }

  private fillBetween(fromX: number, fromD: number, toX: number, toD: number, line: number, region: number, isOwn: boolean): void {
    const { columns, samples, disparity, ofReference } = this;
    const slope = toX > fromX ? (toD - fromD) / (toX - fromX) : 0;
    const sample = (x: number) => Math.min(Math.max(Math.ceil(x * samples - 0.5), 0), columns);
    const end = sample(toX);
    for (let i = sample(fromX), at = line * columns + i; i < end; ++i, ++at) {
      const d = fromD + slope * ((i + 0.5) / samples - fromX);
      if (d < disparity[at]! - hidesPixels) continue;
      if (!isOwn && ofReference[at] !== 0 && this.region[at] !== nothing) continue;
      disparity[at] = d;
      this.region[at] = region;
    }
  }
}

/** Sorts pairs of numbers by their first: there are few. */
function sortPairs(pairs: number[]): void {
  for (let i = 2; i < pairs.length; i += 2) {
    const [x, d] = [pairs[i]!, pairs[i + 1]!];
    let at = i;
    for (; at > 0 && pairs[at - 2]! > x; at -= 2) {
      pairs[at] = pairs[at - 2]!;
      pairs[at + 1] = pairs[at - 1]!;
    }
    pairs[at] = x;
    pairs[at + 1] = d;
  }
}

/** What a view sees of the surfaces, at any size. */
class SeenSurfaces {
  private readonly seen: Float32Array;
  constructor(
    surfaces: Surfaces,
    view: number,
    private readonly width: number,
    private readonly height: number,
  ) {
    this.seen = surfaces.seenFrom(view, width, height);
  }

  at(x: number, y: number, what: 0 | 1): number {
    return this.seen[4 * (y * this.width + x) + what]!;
  }

  /** The farthest at a pixel and beside it. Outlines are smoother than surfaces, and may fall short of them by a pixel. */
  farthestAbout(x: number, y: number): number {
    let farthest = Infinity;
    for (let row = Math.max(y - 1, 0); row <= Math.min(y + 1, this.height - 1); ++row)
      for (let column = Math.max(x - 1, 0); column <= Math.min(x + 1, this.width - 1); ++column)
        farthest = Math.min(farthest, this.at(column, row, 0));
    return farthest;
  }
}

export class RegionsPicture implements Picture {
  surfaces: Surfaces | undefined;
  private outlines: Outlines | undefined;

  constructor(
    private readonly gl: Gl,
    readonly facts: RegionsFacts,
    private readonly source: Source,
  ) {}

  async load(changed: () => void): Promise<void> {
    this.surfaces = await Surfaces.from(this.source, this.facts.surfaces);
    this.outlines = readOutlines(await streamsOf(this.source, "regions"), this.facts);
    changed();
  }

  draw(view: number, target: Target): void {
    if (!this.surfaces || !this.outlines) return;
    const { gl, facts } = this;
    const { width, height } = target;
    const scale = width / facts.width;
    const band = new Band(width * (scale > 1.5 ? 2 : 4), scale > 1.5 ? 2 : 4);
    const seen = new SeenSurfaces(this.surfaces, view, facts.width, facts.height);
    const pixels = new Uint8Array(4 * width * height);
    for (let row = 0; row < height; row += rowsABand) {
      this.hide(seen, row, scale, band);
      for (const own of [true, false]) this.drawBand(view, row, scale, own, band);
      for (let y = row; y < Math.min(row + rowsABand, height); ++y) this.finishRow(band, y - row, pixels.subarray(4 * y * width, 4 * (y + 1) * width));
    }
    gl.bindTexture(gl.TEXTURE_2D, target.texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  }

  /** Notes what surfaces hide in a band's samples. */
  private hide(seen: SeenSurfaces, firstRow: number, scale: number, band: Band): void {
    const { samples, columns } = band;
    const { tolerance } = this.surfaces!;
    const { width, height } = this.facts;
    band.firstLine = firstRow * samples;
    band.region.fill(nothing);
    for (let row = 0; row < rowsABand; ++row) {
      const y = Math.min(Math.floor((firstRow + row + 0.5) / scale), height - 1);
      const begin = row * samples * columns;
      for (let column = 0; column * samples < columns; ++column) {
        const x = Math.min(Math.floor((column + 0.5) / scale), width - 1);
        const farthest = seen.farthestAbout(x, y);
        const below = farthest === unknown ? -Infinity : farthest - tolerance + hidesPixels;
        const reference = seen.at(x, y, 1);
        const isReference = reference !== unknown && seen.at(x, y, 0) <= reference + tolerance;
        const from = begin + column * samples;
        band.disparity.fill(below, from, from + samples);
        band.ofReference.fill(isReference ? 1 : 0, from, from + samples);
      }
      for (let line = 1; line < samples; ++line) {
        band.disparity.copyWithin(begin + line * columns, begin, begin + columns);
        band.ofReference.copyWithin(begin + line * columns, begin, begin + columns);
      }
    }
  }

  private drawBand(view: number, firstRow: number, scale: number, own: boolean, band: Band): void {
    const { x, y, disparity, firstPoint, regions } = this.outlines!;
    const surfaces = this.surfaces!;
    const [top, bottom] = [firstRow / scale, (firstRow + rowsABand) / scale];
    regions.forEach((region, number) => {
      if (region.bottom < top || region.top > bottom || view < region.first || view > region.last) return;
      if ((surfaces.isEmpty || region.reference === surfaces.reference) !== own) return;
      const moved = view - region.reference;
      for (let ring = region.firstRing; ring < region.endRing; ++ring) {
        const begin = firstPoint[ring]!;
        const end = firstPoint[ring + 1]!;
        for (let i = begin, before = end - 1; i < end; before = i++) {
          const [ad, bd] = [disparity[before]!, disparity[i]!];
          band.cross((x[before]! - moved * ad) * scale, y[before]! * scale, ad, (x[i]! - moved * bd) * scale, y[i]! * scale, bd);
        }
      }
      band.fill(number, own);
    });
  }

  /** The means of the samples; what none covers takes the colour beside it on the farther side. */
  private finishRow(band: Band, row: number, to: Uint8Array): void {
    const { samples, columns, region, disparity } = band;
    const width = columns / samples;
    const { regions } = this.outlines!;
    let before = -1;
    let depthBefore = Infinity;
    for (let x = 0, gap = 0; x < width; ++x) {
      let [red, green, blue, depth, covered] = [0, 0, 0, 0, 0];
      for (let line = row * samples; line < (row + 1) * samples; ++line)
        for (let at = line * columns + x * samples, end = at + samples; at < end; ++at) {
          if (region[at] === nothing) continue;
          const { colour } = regions[region[at]!]!;
          red += colour[0];
          green += colour[1];
          blue += colour[2];
          depth += disparity[at]!;
          ++covered;
        }
      if (covered === 0) {
        ++gap;
        if (x + 1 === width && before >= 0) copyPixel(to, before, x + 1 - gap, x + 1);
        continue;
      }
      to.set([red / covered + 0.5, green / covered + 0.5, blue / covered + 0.5, 255], 4 * x);
      copyPixel(to, before < 0 || depth / covered < depthBefore ? x : before, x - gap, x);
      [before, depthBefore, gap] = [x, depth / covered, 0];
    }
  }
}

function copyPixel(pixels: Uint8Array, from: number, begin: number, end: number): void {
  for (let x = begin; x < end; ++x) pixels.copyWithin(4 * x, 4 * from, 4 * from + 4);
}
