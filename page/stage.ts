// What the canvas shows: one view, or two eyes' in one of the ways in which screens show them.

import { drawWholePicture, Gl, makeProgram, Program, Target, TargetKeeper, useTexture, wholePicture } from "./gl";
import { Picture } from "./picture";

export const modes = ["flat", "wiggle", "anaglyph", "parallel", "cross-eyed"] as const;
export type Mode = (typeof modes)[number];

/** How the picture is looked at. */
export interface Look {
  mode: Mode;
  /** Of the one view that is shown flat. */
  view: number;
  /** Of the views of two eyes: their distance, as a share of the picture's own eye separation. */
  separation: number;
  /** Disparity at full eye separation that lies on the screen, in pixels of the picture. */
  zeroParallax: number;
}

/** The part of its picture that each view shows: all that every view has once the screen plane has no parallax. */
export interface Window {
  width: number;
  height: number;
  /** The column at which a view's part begins. */
  begin(view: number): number;
}

/** Of the pixels' number along each side, for a picture of which more is on its way: it is there sooner. */
const unfinishedShare = 0.5;

function isPair(mode: Mode): boolean {
  return mode === "anaglyph" || isSideBySide(mode);
}
export function isSideBySide(mode: Mode): boolean {
  return mode === "parallel" || mode === "cross-eyed";
}

/** The view positions that a mode shows: those of two eyes, or where one may look from. */
export function viewsOf(picture: Picture, look: Look): [number, number] {
  const { first, last } = picture.facts;
  const clamped = (view: number) => Math.min(Math.max(view, first), last);
  if (isPair(look.mode)) return [clamped(-look.separation / 2), clamped(look.separation / 2)];
  return [clamped(-0.5), clamped(0.5)];
}

/** As `set_convergence` of src/wheatstone/display/arrange.cpp cuts two views. */
export function windowOf(picture: Picture, look: Look): Window {
  const { width, height } = picture.facts;
  const [leftmost, rightmost] = viewsOf(picture, look);
  const apart = rightmost - leftmost;
  const shift = Math.max(Math.min(Math.round(apart * look.zeroParallax), width - 1), 1 - width);
  const first = Math.max(shift, 0);
  const begin = (view: number) => (apart > 0 ? first - ((view - leftmost) / apart) * shift : 0);
  return { width: width - Math.abs(shift), height, begin };
}

// Dubois' least-squares matrices for red and cyan: src/wheatstone/display/anaglyph.cpp.
const composeShader = `
in vec2 place;
out vec4 shown;
uniform sampler2D left, right;
uniform vec2 size;             // of a view's whole picture
uniform vec4 window;           // columns at which the left and the right view's parts begin, and the parts' size
uniform int mode;              // 0: the left view alone; 1: anaglyph; 2: side by side
vec3 viewAt(sampler2D view, float begin, vec2 at) {
  return texture(view, vec2(begin + at.x * window.z, at.y * window.w) / size).rgb;
}
vec3 linear(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
vec3 encoded(vec3 c) { return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
void main() {
  vec2 at = vec2(place.x, 1.0 - place.y);
  vec3 colour;
  if (mode == 2) {
    colour = at.x < 0.5 ? viewAt(left, window.x, vec2(2.0 * at.x, at.y)) : viewAt(right, window.y, vec2(2.0 * at.x - 1.0, at.y));
  } else if (mode == 1) {
    vec3 l = linear(viewAt(left, window.x, at)), r = linear(viewAt(right, window.y, at));
    vec3 fromLeft = vec3(dot(vec3(0.437, 0.449, 0.164), l), dot(vec3(-0.062, -0.062, -0.024), l), dot(vec3(-0.048, -0.050, -0.017), l));
    vec3 fromRight = vec3(dot(vec3(-0.011, -0.032, -0.007), r), dot(vec3(0.377, 0.761, 0.009), r), dot(vec3(-0.026, -0.093, 1.234), r));
    colour = encoded(min(clamp(fromLeft, 0.0, 1.0) + clamp(fromRight, 0.0, 1.0), 1.0));
  } else {
    colour = viewAt(left, window.x, at);
  }
  shown = vec4(colour, 1.0);
}`;

/** A view's picture, kept until it changes. */
interface KeptView {
  keeper: TargetKeeper;
  target: Target;
  view: number;
  isCurrent: boolean;
}

/** The context of a canvas; undefined where the browser gives none. */
export function contextOf(canvas: HTMLCanvasElement): Gl | undefined {
  return canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, powerPreference: "high-performance" }) ?? undefined;
}

export class Stage {
  private readonly compose: Program;
  /** A headset shows the picture, and has the canvas. */
  isElsewhere = false;
  private viewsDrawn = 0;
  private readonly kept: (KeptView | undefined)[] = [];

  constructor(
    readonly gl: Gl,
    readonly picture: Picture,
  ) {
    this.compose = makeProgram(gl, wholePicture, composeShader);
  }

  /** What was drawn is no longer what the picture shows. */
  forget(): void {
    for (const kept of this.kept) if (kept) kept.isCurrent = false;
  }

  /**
   * A view's picture at so many drawn pixels for one of the picture; `slot` tells views of one frame apart. `effort` is
   * less than 1 where what is drawn sooner has to do.
   */
  viewAt(view: number, scale: number, slot: number, effort = 1): Target {
    const { picture } = this;
    const { facts } = picture;
    const isQuick = effort < 1 && picture.drawQuickly !== undefined;
    const most = this.gl.getParameter(this.gl.MAX_TEXTURE_SIZE) as number;
    const share = picture.isUnfinished ? unfinishedShare : isQuick ? 1 : effort;
    const used = Math.min(scale * share, most / facts.width, most / facts.height);
    const width = Math.max(Math.round(facts.width * used), 1);
    const height = Math.max(Math.round(facts.height * used), 1);
    const keeper = this.kept[slot]?.keeper ?? new TargetKeeper();
    const target = keeper.like(this.gl, { width, height }, { filter: this.gl.LINEAR });
    let kept = this.kept[slot];
    if (kept?.target !== target) kept = this.kept[slot] = { keeper, target, view, isCurrent: false };
    if (kept.isCurrent && kept.view === view) return kept.target;
    ++this.viewsDrawn;
    if (isQuick) picture.drawQuickly!(view, kept.target);
    else picture.draw(view, kept.target);
    kept.view = view;
    kept.isCurrent = !isQuick;
    return kept.target;
  }

  /** Draws to the canvas; `effort` as of `viewAt`. Returns whether a view had to be drawn for it. */
  draw(look: Look, effort = 1): boolean {
    const { gl, picture, compose } = this;
    const window = windowOf(picture, look);
    const { width, height } = gl.canvas;
    const viewsBefore = this.viewsDrawn;
    const beside = isSideBySide(look.mode);
    const scale = width / (window.width * (beside ? 2 : 1));
    const [leftmost, rightmost] = viewsOf(picture, look);
    const single = Math.min(Math.max(look.view, leftmost), rightmost);
    const pair: [number, number] = !isPair(look.mode) ? [single, single] : look.mode === "cross-eyed" ? [rightmost, leftmost] : [leftmost, rightmost];
    // While a picture wiggles both its views are kept.
    const left = this.viewAt(pair[0], scale, look.mode === "wiggle" && single === rightmost ? 1 : 0, effort);
    const right = pair[1] === pair[0] ? left : this.viewAt(pair[1], scale, 1, effort);

    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.useProgram(compose.program);
    useTexture(gl, compose, "left", 0, left.texture);
    useTexture(gl, compose, "right", 1, right.texture);
    gl.uniform2f(compose.at("size"), picture.facts.width, picture.facts.height);
    gl.uniform4f(compose.at("window"), window.begin(pair[0]), window.begin(pair[1]), window.width, window.height);
    gl.uniform1i(compose.at("mode"), beside ? 2 : look.mode === "anaglyph" ? 1 : 0);
    drawWholePicture(gl);
    return this.viewsDrawn > viewsBefore;
  }
}
