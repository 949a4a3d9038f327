// Pictures that lie on surfaces, seen from any view: each pixel takes its colour from where the surface that is seen
// there comes from.

import { drawTo, drawWholePicture, fillWithFloats, Gl, makeProgram, makeTexture, Program, Target, TargetKeeper, useTexture, wholePicture } from "./gl";
import { gapRule, hidingRule } from "./hiding";
import { LayeredFacts } from "./manifest";
import { Source } from "./parts";
import { Picture } from "./picture";
import { decodedImage } from "./images";
import { Surfaces } from "./surfaces";

const pictureShader = `
in vec2 place;
out vec4 drawn;
uniform sampler2DArray pictures;
${hidingRule}
void main() {
  vec4 surfaces = surfacesAt(gl_FragCoord.xy);
  if (surfaces.x == unknown) {
    drawn = vec4(0.0);
    return;
  }
  float picture = floor(surfaces.w / columnsASurface);
  vec2 at = vec2(surfaces.w - picture * columnsASurface, gl_FragCoord.y * seenScale.y);
  drawn = vec4(texture(pictures, vec3(at / vec2(textureSize(pictures, 0).xy), picture)).rgb, 1.0);
}`;

const finishShader = `
in vec2 place;
out vec4 finished;
uniform sampler2D painted;
${hidingRule}
${gapRule}
void main() { finished = vec4(continued(painted, ivec2(gl_FragCoord.xy)), 1.0); }`;

/** Draws views of pictures that lie on surfaces. */
export class PicturesOnSurfaces {
  private readonly program: Program;
  private readonly finish: Program;
  private readonly seen: WebGLTexture;
  private readonly targets = new TargetKeeper();

  /** The pictures are the layers of a texture, in the order of all surfaces; the views have this size. */
  constructor(
    private readonly gl: Gl,
    private readonly pictures: WebGLTexture,
    private readonly size: { width: number; height: number },
  ) {
    this.program = makeProgram(gl, wholePicture, pictureShader);
    this.finish = makeProgram(gl, wholePicture, finishShader);
    this.seen = makeTexture(gl);
  }

  /** Draws the view at this position; blended with what is there, where `isBlended`. */
  draw(surfaces: Surfaces, view: number, target: Target, isBlended = false): void {
    const { gl } = this;
    const { width, height } = this.size;
    fillWithFloats(gl, this.seen, width, height, surfaces.seenFrom(view, width, height));
    const drawn = this.targets.like(gl, target, {});
    drawTo(gl, drawn);
    this.use(this.program, target, surfaces);
    useTexture(gl, this.program, "pictures", 1, this.pictures, gl.TEXTURE_2D_ARRAY);
    drawWholePicture(gl);
    drawTo(gl, target);
    this.use(this.finish, target, surfaces);
    useTexture(gl, this.finish, "painted", 1, drawn.texture);
    if (isBlended) gl.enable(gl.BLEND);
    drawWholePicture(gl);
  }

  private use(program: Program, target: Target, surfaces: Surfaces): void {
    const { gl, size } = this;
    gl.useProgram(program.program);
    useTexture(gl, program, "seen", 0, this.seen);
    gl.uniform2f(program.at("seenScale"), size.width / target.width, size.height / target.height);
    gl.uniform1f(program.at("tolerance"), surfaces.tolerance);
  }
}

export class LayeredPicture implements Picture {
  private readonly pictures: WebGLTexture;
  private readonly views: PicturesOnSurfaces;
  surfaces: Surfaces | undefined;
  /** The same with the view at the other end of what photographs show as the reference. */
  private others: Surfaces | undefined;

  constructor(
    private readonly gl: Gl,
    readonly facts: LayeredFacts,
    private readonly source: Source,
  ) {
    this.pictures = makeTexture(gl, gl.LINEAR, gl.TEXTURE_2D_ARRAY);
    this.views = new PicturesOnSurfaces(gl, this.pictures, facts);
  }

  async load(changed: () => void): Promise<void> {
    const { gl, facts, source } = this;
    const { seen } = facts.surfaces;
    const images = await Promise.all(seen.map(async (_, i) => decodedImage(await source.bytes(`picture-${i}`), "image/jpeg")));
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.pictures);
    const [width, height] = [Math.max(...seen.map((one) => one.width)), Math.max(...seen.map((one) => one.height))];
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGBA8, width, height, seen.length);
    images.forEach((image, i) => {
      gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, i, image.width, image.height, 1, gl.RGBA, gl.UNSIGNED_BYTE, image);
    });
    const surfaces = await Surfaces.from(source, facts.surfaces);
    const own = seen.findIndex((one, i) => i > 0 && !one.continued && one.left === 0);
    if (own > 0) this.others = surfaces.seenFirstFrom(own, facts.width, facts.height);
    this.surfaces = surfaces;
    changed();
  }

  draw(view: number, target: Target): void {
    const { gl, surfaces, others } = this;
    if (!surfaces) return;
    // Each of two views is shown with its own colours, and what lies between them with those of both.
    const share = others ? Math.min(Math.max((view - surfaces.reference) / (others.reference - surfaces.reference), 0), 1) : 0;
    if (share < 1) this.views.draw(surfaces, view, target);
    if (!others || share === 0) return;
    gl.blendColor(0, 0, 0, share);
    gl.blendFunc(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA);
    this.views.draw(others, view, target, share < 1);
    gl.disable(gl.BLEND);
  }
}
