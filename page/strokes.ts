// Strokes of a brush, drawn for any view: each is a chain of segments, laid over what is behind it as far as no surface
// hides it. The same picture as src/wheatstone/drawing/draw_strokes.cpp, from back to front.

import { bristlesRule } from "./bristles";
import { Chains, readLayer, texelsAStroke } from "./chains";
import { deleteTarget, drawTo, drawWholePicture, fillWithFloats, Gl, makeProgram, makeTarget, makeTexture, Program, Target, TargetKeeper, useTexture, wholePicture } from "./gl";
import { gapRule, hidingRule, PlannedIn } from "./hiding";
import { PicturesOnSurfaces } from "./layered";
import { StrokesFacts } from "./manifest";
import { inflated, Source, streamsOf } from "./parts";
import { Picture } from "./picture";
import { Surfaces } from "./surfaces";

const strokesARow = 512;
const verticesARow = 2048;
const mostPlans = 16;

const vertexShader = `
uniform sampler2D vertices;  // x in the central view, y, disparity, stroke
uniform sampler2D strokes;
uniform vec2 size;       // of the picture
uniform float scale;     // drawn pixels for one of the picture
uniform float view;
uniform float firstOrder, orderStep;
uniform bool fillsGaps;
uniform vec4 plans[${mostPlans}];  // kind, first view, last view
#ifdef VARIES
uniform sampler2D along;  // of four vertices: length of the stroke's chain up to them, in the central view
flat out vec4 chainAlong; // of the four vertices; drawn pixels
flat out vec4 change;     // what is added to the colour along the stroke; length of its chain
flat out uint seed;
#endif
flat out vec3 seenBefore, seenFrom, seenTo, seenAfter;  // drawn pixels and disparity
flat out vec4 paint;
flat out vec2 brush;     // middle and width of the rim
flat out int kind;

vec4 vertexAt(int i) { return texelFetch(vertices, ivec2(i % ${verticesARow}, i / ${verticesARow}), 0); }
#ifdef VARIES
float alongAt(int i) {
  int texel = i >> 2;
  return scale * texelFetch(along, ivec2(texel % ${verticesARow / 4}, texel / ${verticesARow / 4}), 0)[i & 3];
}
#endif
vec3 seenAt(vec4 vertex) { return vec3((vertex.x - view * vertex.z) * scale, vertex.y * scale, vertex.z); }

void main() {
  int segment = gl_VertexID >> 2;
  vec4 before = vertexAt(segment), from = vertexAt(segment + 1), to = vertexAt(segment + 2), after = vertexAt(segment + 3);
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (from.w < 0.0 || from.w != to.w) return;
  int texel = int(from.w) * ${texelsAStroke};
  ivec2 place = ivec2(texel % ${strokesARow * texelsAStroke}, texel / ${strokesARow * texelsAStroke});
  vec4 shape = texelFetch(strokes, place + ivec2(1, 0), 0);
  vec4 plan = plans[int(shape.y)];
  if (view < plan.y || view > plan.z) return;
  paint = texelFetch(strokes, place, 0);
  kind = fillsGaps ? ${PlannedIn.gaps} : int(plan.x);

  float radius = shape.x * scale;
  float rim = radius > 10.0 ? 0.1 * radius : 1.0;
  brush = vec2(0.95 * radius, rim);
  float reach = brush.x + rim / 2.0;
  bool isFirst = before.w != from.w, isLast = after.w != to.w;
  seenFrom = seenAt(from);
  seenTo = seenAt(to);
  seenBefore = isFirst ? seenFrom : seenAt(before);
  seenAfter = isLast ? seenTo : seenAt(after);
#ifdef VARIES
  chainAlong = vec4(alongAt(segment), alongAt(segment + 1), alongAt(segment + 2), alongAt(segment + 3));
  change = texelFetch(strokes, place + ivec2(2, 0), 0);
  change.a *= scale;
  seed = uint(shape.z) << 16 | uint(shape.w);
#endif

  // A segment paints the rectangle beside it, and at its end what lies outside the bend.
  const float rounding = 1.0 / 32.0;
  vec2 step = seenTo.xy - seenFrom.xy, stepAfter = seenAfter.xy - seenTo.xy;
  float lengthHere = length(step), lengthAfter = length(stepAfter);
  vec2 course = lengthHere > 0.0 ? step / lengthHere : vec2(1.0, 0.0);
  float beyond = reach + rounding;
  if (lengthHere > 0.0 && lengthAfter > 0.0) {
    vec2 courseAfter = stepAfter / lengthAfter;
    if (dot(course, courseAfter) > 0.0)
      beyond = (reach + rounding) * abs(course.x * courseAfter.y - course.y * courseAfter.x) + rounding;
  }
  float ahead = isFirst || lengthHere == 0.0 ? reach + rounding : rounding;
  vec2 corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1);
  vec2 at = seenFrom.xy + course * mix(-ahead, lengthHere + beyond, corner.x) +
            vec2(-course.y, course.x) * (reach + rounding) * (2.0 * corner.y - 1.0);
  // What a stroke has covered, its next segment leaves as it is: all of a stroke lies at one depth of its own.
  gl_Position = vec4(at / (size * scale) * 2.0 - 1.0, 1.0 - (firstOrder + from.w + 1.0) * orderStep, 1.0);
}`;

const fragmentShader = `
flat in vec3 seenBefore, seenFrom, seenTo, seenAfter;
flat in vec4 paint;
flat in vec2 brush;
flat in int kind;
out vec4 drawn;
const float far = 1e30;
${hidingRule}
float squaredDistance(vec3 a, vec3 b, vec2 pixel, float leastDisparity) {
  vec2 along = b.xy - a.xy, to = pixel - a.xy;
  float t = clamp(dot(to, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
  if (mix(a.z, b.z, t) < leastDisparity) return far;
  vec2 off = to - t * along;
  return dot(off, off);
}
#ifdef VARIES
flat in vec4 chainAlong;
flat in vec4 change;
${bristlesRule}
// On a segment, or beyond its ends by as many times its length.
Place placeOn(vec2 a, vec2 b, vec2 alongs, vec2 beyond, vec2 pixel) {
  const vec2 light = vec2(0.6, 0.8);
  vec2 step = b - a, to = pixel - a;
  float size = length(step);
  vec2 course = size > 0.0 ? step / size : vec2(1.0, 0.0);
  float t = size > 0.0 ? clamp(dot(to, course) / size, -beyond.x, 1.0 + beyond.y) : 0.0;
  return Place(0.0, mix(alongs.x, alongs.y, t), course.x * to.y - course.y * to.x, light.x * course.y - light.y * course.x);
}
#endif
void main() {
  vec2 pixel = gl_FragCoord.xy;
  float leastDisparity = leastSeenOf(kind, surfacesAt(pixel));
  bool isFirst = seenBefore == seenFrom, isLast = seenAfter == seenTo;
  float squared = squaredDistance(seenFrom, seenTo, pixel, leastDisparity);
  float before = isFirst ? far : squaredDistance(seenBefore, seenFrom, pixel, leastDisparity);
  float after = isLast ? far : squaredDistance(seenTo, seenAfter, pixel, leastDisparity);
  float distance = sqrt(min(squared, min(before, after)));
  float cover = clamp((brush.x - distance) / brush.y + 0.5, 0.0, 1.0);
  if (cover == 0.0) discard;
  vec3 colour = paint.rgb;
#ifdef VARIES
  Place place;
  if (before <= min(squared, after)) place = placeOn(seenBefore.xy, seenFrom.xy, chainAlong.xy, vec2(0.0), pixel);
  else if (squared <= after) place = placeOn(seenFrom.xy, seenTo.xy, chainAlong.yz, vec2(isFirst ? 1e6 : 0.0, isLast ? 1e6 : 0.0), pixel);
  else place = placeOn(seenTo.xy, seenAfter.xy, chainAlong.zw, vec2(0.0), pixel);
  place.distance = distance;
  Paint here = paintAt(place, brush.x, brush.y, change.a);
  // Where a bristle has no paint, the stroke's other segments leave none either.
  cover = here.cover;
  colour = clamp(colour + here.share * change.rgb + here.tone / 255.0, 0.0, 1.0);
#endif
  float share = cover * paint.a;
  drawn = vec4(colour * share, share);
}`;

const finishShader = `
in vec2 place;
out vec4 finished;
uniform sampler2D painted;
uniform vec3 canvas;
uniform bool isOpaque;
${hidingRule}
${gapRule}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 paint = texelFetch(painted, at, 0);
  finished = vec4(isOpaque ? continued(painted, at) : paint.rgb + (1.0 - paint.a) * canvas, 1.0);
}`;

/** The corners of each segment's rectangle, as two triangles. A draw call for each would cost some devices too much. */
class SegmentIndices {
  private buffer: WebGLBuffer | undefined;
  private count = 0;
  constructor(private readonly gl: Gl) {}

  /** Binds the corners of so many segments. */
  bind(segments: number): void {
    const { gl } = this;
    this.buffer ??= gl.createBuffer()!;
    gl.bindVertexArray(null);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffer);
    if (segments <= this.count) return;
    const indices = new Uint32Array(6 * segments);
    for (let segment = 0; segment < segments; ++segment)
      [0, 1, 2, 2, 1, 3].forEach((corner, i) => (indices[6 * segment + i] = 4 * segment + corner));
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    this.count = segments;
  }
}

/** A texture of rows of four numbers each. */
function textureOf(gl: Gl, values: Float32Array, texelsARow: number): WebGLTexture {
  const texture = makeTexture(gl);
  const rows = Math.max(Math.ceil(values.length / 4 / texelsARow), 1);
  const texels = new Float32Array(4 * texelsARow * rows);
  texels.set(values);
  fillWithFloats(gl, texture, texelsARow, rows, texels);
  return texture;
}

/** The picture of a brush, as src/wheatstone/marks/brush_picture.h has it, and its reductions. */
function brushTexture(gl: Gl, cover: Uint8Array): WebGLTexture {
  const texture = makeTexture(gl, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, 4);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, 256, 64, 0, gl.RED, gl.UNSIGNED_BYTE, cover);
  gl.generateMipmap(gl.TEXTURE_2D);
  return texture;
}

/** Strokes in the device's memory. */
class DeviceChains {
  readonly strokeCount: number;
  private readonly segments: number;
  private readonly vertices: WebGLTexture;
  private readonly along: WebGLTexture;
  private readonly strokes: WebGLTexture;

  constructor(
    private readonly gl: Gl,
    private readonly indices: SegmentIndices,
    chains: Chains,
  ) {
    this.strokeCount = chains.strokeCount;
    this.segments = chains.strokeCount > 0 ? chains.vertexCount - 2 : 0;
    this.vertices = textureOf(gl, chains.vertices, verticesARow);
    this.along = textureOf(gl, chains.along, verticesARow / 4);
    this.strokes = textureOf(gl, chains.strokes, strokesARow * texelsAStroke);
  }

  draw(program: Program, firstOrder: number): void {
    if (this.segments === 0) return;
    const { gl } = this;
    useTexture(gl, program, "strokes", 1, this.strokes);
    useTexture(gl, program, "vertices", 2, this.vertices);
    useTexture(gl, program, "along", 3, this.along);
    gl.uniform1f(program.at("firstOrder"), firstOrder);
    this.indices.bind(this.segments);
    gl.drawElements(gl.TRIANGLES, 6 * this.segments, gl.UNSIGNED_INT, 0);
  }
}

export class StrokesPicture implements Picture {
  private readonly program: Program;
  private readonly finish: Program;
  private readonly seen: WebGLTexture;
  private brushPicture: WebGLTexture | undefined;
  private seenView: number | undefined;
  surfaces: Surfaces | undefined;
  readonly detail: { readonly layers: number; shown: number };
  private readonly targets = new TargetKeeper();
  private readonly loaded: { all: DeviceChains; beside: DeviceChains }[] = [];
  private readonly indices: SegmentIndices;
  /** Pictures of the views that photographs show, which the surfaces carry to the others while the view moves. */
  private quick: { pictures: WebGLTexture; views: PicturesOnSurfaces; surfaces: Surfaces; strokes: number } | undefined;

  constructor(
    private readonly gl: Gl,
    readonly facts: StrokesFacts,
    private readonly source: Source,
  ) {
    this.detail = { layers: facts.layers.length, shown: facts.layers.length };
    const kind = facts.brush ? "#define VARIES\n" : "";
    this.program = makeProgram(gl, kind + vertexShader, kind + fragmentShader);
    this.finish = makeProgram(gl, wholePicture, finishShader);
    this.seen = makeTexture(gl);
    this.indices = new SegmentIndices(gl);
  }

  async load(changed: () => void): Promise<void> {
    const { source, facts } = this;
    const surfaces = (this.surfaces = await Surfaces.fromPhotographs(source, facts.surfaces));
    if (facts.brush?.hasPicture)
      this.brushPicture = brushTexture(this.gl, new Uint8Array(await inflated(await source.bytes("brush"))));
    await this.loadLayer(0, surfaces);
    changed();
    // The coarse strokes are seen before the rest is decoded.
    await nextFrame();
    this.surfaces = await surfaces.withContinued(source, facts.surfaces);
    this.seenView = undefined;
    if (facts.layers.length === 1) changed();
    for (let layer = 1; layer < facts.layers.length; ++layer) {
      await this.loadLayer(layer, surfaces);
      changed();
    }
  }

  private async loadLayer(layer: number, surfaces: Surfaces): Promise<void> {
    const { gl, indices, facts } = this;
    const isBeside = (view: number) => plannedIn(view, surfaces) !== PlannedIn.reference;
    const { all, beside } = readLayer(await streamsOf(this.source, `layer-${layer}`), facts, isBeside);
    this.loaded.push({ all: new DeviceChains(gl, indices, all), beside: new DeviceChains(gl, indices, beside) });
  }

  get isUnfinished(): boolean {
    return this.loaded.length < this.facts.layers.length;
  }

  draw(view: number, target: Target): void {
    const { gl, facts, surfaces } = this;
    if (!surfaces) return;
    this.see(view, surfaces);
    const canvas = this.targets.like(gl, target, { precise: true, depth: true });
    drawTo(gl, canvas);
    gl.depthMask(true);
    gl.clearColor(0, 0, 0, 0);
    gl.clearDepth(1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.drawStrokes(view, canvas.width / facts.width);
    gl.disable(gl.BLEND);
    gl.disable(gl.DEPTH_TEST);

    drawTo(gl, target);
    gl.useProgram(this.finish.program);
    useTexture(gl, this.finish, "painted", 1, canvas.texture);
    this.useSeen(this.finish, canvas.width / facts.width);
    gl.uniform3f(this.finish.at("canvas"), facts.canvas[0] / 255, facts.canvas[1] / 255, facts.canvas[2] / 255);
    gl.uniform1i(this.finish.at("isOpaque"), facts.opaque ? 1 : 0);
    drawWholePicture(gl);
  }

  drawQuickly(view: number, target: Target): void {
    const { gl, surfaces } = this;
    if (!surfaces || surfaces.isEmpty) return this.draw(view, target);
    const { strokes, views, surfaces: seen } = (this.quick ??= this.quickWith(surfaces));
    if (strokes !== this.strokeCount) this.keepPictures(surfaces);
    gl.disable(gl.BLEND);
    views.draw(seen, view, target);
  }

  private quickWith(surfaces: Surfaces): NonNullable<StrokesPicture["quick"]> {
    const { gl, facts } = this;
    const pictures = makeTexture(gl, gl.LINEAR, gl.TEXTURE_2D_ARRAY);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGBA8, facts.width, facts.height, surfaces.facts.length);
    return { pictures, views: new PicturesOnSurfaces(gl, pictures, facts), surfaces: surfaces.ofPhotographs(), strokes: 0 };
  }

  private keepPictures(surfaces: Surfaces): void {
    const { gl, facts } = this;
    const target = makeTarget(gl, facts.width, facts.height);
    surfaces.facts.forEach(({ view, continued }, i) => {
      if (continued) return;
      this.draw(view, target);
      gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.quick!.pictures);
      gl.copyTexSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, i, 0, 0, facts.width, facts.height);
    });
    deleteTarget(gl, target);
    this.quick!.strokes = this.strokeCount;
  }

  /** Of the layers that are drawn. */
  private get strokeCount(): number {
    return this.shown.reduce((sum, layer) => sum + layer.all.strokeCount + layer.beside.strokeCount, 0);
  }
  private get shown(): { all: DeviceChains; beside: DeviceChains }[] {
    return this.loaded.slice(0, this.detail.shown);
  }

  private drawStrokes(view: number, scale: number): void {
    const { gl, program, facts, shown } = this;
    gl.useProgram(program.program);
    this.useSeen(program, scale);
    gl.uniform2f(program.at("size"), facts.width, facts.height);
    gl.uniform1f(program.at("scale"), scale);
    gl.uniform1f(program.at("view"), view);
    gl.uniform1f(program.at("orderStep"), 2 / (this.strokeCount + 2));
    gl.uniform4fv(program.at("plans[0]"), this.plans());
    const brush = facts.brush ?? { bristle: 0, streaks: 0, ridge: 0, dry: 0, hasPicture: false };
    gl.uniform1f(program.at("bristle"), brush.bristle * scale);
    gl.uniform1f(program.at("streaks"), brush.streaks);
    gl.uniform1f(program.at("ridge"), brush.ridge);
    gl.uniform1i(program.at("hasPicture"), this.brushPicture ? 1 : 0);
    if (this.brushPicture) useTexture(gl, program, "brushPicture", 4, this.brushPicture);
    // Behind everything, what other views planned fills the gaps that the reference view's strokes leave.
    let order = 0;
    for (const gaps of [true, false]) {
      gl.uniform1i(program.at("fillsGaps"), gaps ? 1 : 0);
      shown.forEach((layer, i) => {
        const chains = gaps ? layer.beside : layer.all;
        // The coarsest layer is the ground of the others: it leaves paint everywhere.
        gl.uniform1f(program.at("dry"), i === 0 ? 0 : brush.dry);
        chains.draw(program, order);
        order += chains.strokeCount;
      });
    }
  }

  private plans(): Float32Array {
    const plans = new Float32Array(4 * mostPlans);
    this.facts.planned.slice(0, mostPlans).forEach((plan, i) => {
      plans.set([plannedIn(plan.reference, this.surfaces!), plan.first, plan.last, 0], 4 * i);
    });
    return plans;
  }

  private see(view: number, surfaces: Surfaces): void {
    if (this.seenView === view) return;
    const { width, height } = this.facts;
    fillWithFloats(this.gl, this.seen, width, height, surfaces.seenFrom(view, width, height));
    this.seenView = view;
  }

  private useSeen(program: Program, scale: number): void {
    useTexture(this.gl, program, "seen", 0, this.seen);
    this.gl.uniform2f(program.at("seenScale"), 1 / scale, 1 / scale);
    this.gl.uniform1f(program.at("tolerance"), this.surfaces!.tolerance);
  }
}

/** Resolves once a frame has been shown; soon, where none is, as in a window that nobody sees. */
function nextFrame(): Promise<void> {
  const longestMilliseconds = 100;
  return new Promise((shown) => {
    requestAnimationFrame(() => setTimeout(shown, 0));
    setTimeout(shown, longestMilliseconds);
  });
}

/** By what the surfaces may hide what was planned in a view. */
export function plannedIn(view: number, surfaces: Surfaces): PlannedIn {
  if (surfaces.isEmpty || view === surfaces.reference) return PlannedIn.reference;
  const [first, last] = surfaces.photographed;
  return view >= first && view <= last ? PlannedIn.photographed : PlannedIn.other;
}
