// Depth planes of particles: a view moves each by its parallax and adds them up, and then light becomes colours. The same
// as src/wheatstone/multiview/render_slices.cpp, with the light as src/wheatstone/share/slices_part.cpp wrote it.

import { drawTo, drawWholePicture, fillWithFloats, Gl, makeProgram, makeTexture, Program, Target, TargetKeeper, useTexture, wholePicture } from "./gl";
import { decodedImage } from "./images";
import { SlicesFacts } from "./manifest";
import { inflated, PageError, Source } from "./parts";
import { Picture } from "./picture";

/** Columns without light at both sides of a plane, for what is looked up beside it. */
const margin = 1;
const widestStretch = 30; // multiview/tone_map.cpp: softening

/** Light at a place of a plane, in its columns; `moved` is how far it was moved there. */
const sharpLookUp = `vec4 lightAt(int plane, int row, float x, float moved, int width) {
  float column = floor(x + 0.5) - sign(moved) * floor(abs(moved) + 0.5);
  return texelFetch(slices, ivec3(clamp(int(column), -1, width) + 1, row, plane), 0);
}`; // opaque edges stay sharp
const softLookUp = `vec4 lightAt(int plane, int row, float x, float moved, int width) {
  float at = x - moved, whole = floor(at);
  int left = clamp(int(whole), -1, width);
  return mix(texelFetch(slices, ivec3(left + 1, row, plane), 0),
             texelFetch(slices, ivec3(min(left + 2, width + 1), row, plane), 0), at - whole);
}`;

const lightShader = (count: number, hides: SlicesFacts["hides"]): string => `
in vec2 place;
out vec4 light;
uniform sampler2DArray slices;
uniform sampler2D planes;  // left, top, width, height; and below it the parallax
uniform float view;
uniform vec2 scale;        // pixels of the picture for one that is drawn
${hides === "sharply" ? sharpLookUp : softLookUp}
void main() {
  vec2 pixel = gl_FragCoord.xy * scale - 0.5;
  int row = int(floor(pixel.y + 0.5));
  vec4 sum = vec4(0.0);
  for (int i = 0; i < ${count}; ++i) {
    vec4 plane = texelFetch(planes, ivec2(i, 0), 0);
    int y = row - int(plane.y);
    float moved = view * texelFetch(planes, ivec2(i, 1), 0).x, x = pixel.x - plane.x;
    if (y < 0 || y >= int(plane.w) || x - moved < -1.0 || x - moved >= plane.z) continue;
    vec4 here = lightAt(i, y, x, moved, int(plane.z));
    ${hides === "nothing" ? "sum += here;" : "sum += (1.0 - sum.a) * here;"}
    ${hides === "nothing" ? "" : "if (sum.a > 1023.0 / 1024.0) break;"}
  }
  light = vec4(toned(sum.rgb), 1.0);
}`;

/** From sums of light to colours: multiview/tone_map.cpp. */
const toneRule = (facts: SlicesFacts): string => {
  const { tone } = facts;
  const number = (value: number) => value.toExponential();
  const encode = `
vec3 encoded(vec3 c) { return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }`;
  if (tone.shown === "light")
    return `${encode}
vec3 toned(vec3 sum) {
  vec3 exposed = max(sum * ${number(tone.exposure)}, 0.0);
  return encoded(${tone.stretch === "linear" ? "min(exposed, 1.0)" : "exposed / (exposed + 1.0)"});
}`;
  const range = tone.most - tone.least || 1;
  const ratio = Math.min(tone.least / tone.most, 0.999);
  const brightness = {
    asinh: `asinh(${widestStretch}.0 * clamp((value - ${number(tone.least)}) / ${number(range)}, 0.0, 1.0)) / ${number(Math.asinh(widestStretch))}`,
    log: `log(clamp(value / ${number(tone.most)}, ${number(ratio)}, 1.0) / ${number(ratio)}) / ${number(-Math.log(ratio))}`,
    linear: `clamp((value - ${number(tone.least)}) / ${number(range)}, 0.0, 1.0)`,
  }[tone.stretch];
  const rule = `float brightnessOf(float value) { return ${brightness}; }`;
  if (tone.shown === "colours")
    return `${encode}
${rule}
vec3 toned(vec3 sum) {
  float most = max(max(sum.r, sum.g), sum.b), b = brightnessOf(most);
  float factor = b <= 0.04045 ? b / 12.92 : pow((b + 0.055) / 1.055, 2.4);
  return most > 0.0 ? encoded(clamp(sum * factor / most, 0.0, 1.0)) : vec3(0.0);
}`;
  return `uniform sampler2D colours;
${rule}
vec3 toned(vec3 sum) {
  if (!(sum.r > 1e-30)) return vec3(0.0);
  float mean = sum.g / sum.r;
  vec2 last = vec2(textureSize(colours, 0) - 1);
  vec2 at = vec2(brightnessOf(${tone.shown === "mean" ? "mean" : "sum.r"}), 1.0 - clamp(mean, 0.0, 1.0));
  return texelFetch(colours, ivec2(at * last + 0.5), 0).rgb;
}`;
};

/** A number of at least 0 as the bits of a half float; what is too large for one becomes the largest. */
function halfOf(value: number): number {
  if (value < 2 ** -14) return Math.round(value * 2 ** 24);
  const exponent = Math.floor(Math.log2(value));
  return Math.min(((exponent + 15) << 10) + Math.round((value / 2 ** exponent - 1) * 1024), 0x7bff);
}

/** Planes of bytes, one after another, of which what neighbours let expect was taken off. */
function undoPrediction(bytes: Uint8Array, width: number, height: number): void {
  for (let begin = 0; begin < bytes.length; begin += width * height)
    for (let y = 0, i = begin; y < height; ++y)
      for (let x = 0; x < width; ++x, ++i) {
        const left = x > 0 ? bytes[i - 1]! : 0;
        const up = y > 0 ? bytes[i - width]! : 0;
        const both = left + up - (x > 0 && y > 0 ? bytes[i - width - 1]! : 0);
        const [low, high] = left < up ? [left, up] : [up, left];
        bytes[i]! += both < low ? low : both > high ? high : both;
      }
}

export class SlicesPicture implements Picture {
  private readonly program: Program;
  private readonly slices: WebGLTexture;
  private readonly colours: WebGLTexture;
  private readonly planes: WebGLTexture;
  private readonly targets = new TargetKeeper();
  private loaded = 0;

  constructor(
    private readonly gl: Gl,
    readonly facts: SlicesFacts,
    private readonly source: Source,
  ) {
    this.program = makeProgram(gl, wholePicture, toneRule(facts) + lightShader(facts.planes.length, facts.hides));
    this.colours = makeTexture(gl);
    this.planes = makeTexture(gl);
    const boxes = facts.planes.flatMap(({ left, top, width, height }) => [left, top, width, height]);
    const parallaxes = facts.planes.flatMap(({ parallax }) => [parallax, 0, 0, 0]);
    fillWithFloats(gl, this.planes, facts.planes.length, 2, Float32Array.of(...boxes, ...parallaxes));
    this.slices = makeTexture(gl, gl.NEAREST, gl.TEXTURE_2D_ARRAY);
    const largest = (of: "width" | "height") => Math.max(...facts.planes.map((plane) => plane[of]));
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, this.layout.stored, largest("width") + 2 * margin, largest("height"), facts.planes.length);
  }

  private get hasAlpha(): boolean {
    return this.facts.hides !== "nothing";
  }

  /** How many numbers a pixel has, and how the device keeps them. */
  private get layout(): { numbers: number; stored: number; given: number } {
    const { gl, facts } = this;
    if (this.hasAlpha) return { numbers: 4, stored: gl.RGBA16F, given: gl.RGBA };
    if (facts.tone.shown === "column") return { numbers: 1, stored: gl.R16F, given: gl.RED };
    if (facts.tone.shown === "ramp" || facts.tone.shown === "mean") return { numbers: 2, stored: gl.RG16F, given: gl.RG };
    return { numbers: 3, stored: gl.RGB16F, given: gl.RGB };
  }

  async load(changed: () => void): Promise<void> {
    const { gl, facts, source } = this;
    if (facts.tone.shown !== "light" && facts.tone.shown !== "colours") {
      const bar = await decodedImage(await source.bytes("colours"), "image/png");
      gl.bindTexture(gl.TEXTURE_2D, this.colours);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bar);
    }
    const lights = this.lights();
    await Promise.all(facts.planes.map(async ({ width, height }, i) => {
      const bytes = new Uint8Array(await inflated(await source.bytes(`slice-${i}`)));
      undoPrediction(bytes, width, height);
      const pixels = this.decoded(bytes, width * height, lights);
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.slices);
      gl.pixelStorei(gl.UNPACK_ALIGNMENT, 2);
      gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, margin, 0, i, width, height, 1, this.layout.given, gl.HALF_FLOAT, pixels);
      gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
    }));
    this.loaded = facts.planes.length;
    changed();
  }

  /** The light that each byte stands for. */
  private lights(): Float64Array {
    const { least, most, steps } = this.facts.light;
    return Float64Array.from({ length: 256 }, (_, code) => (code === 0 ? 0 : least * (most / least) ** ((code - 1) / (steps - 1))));
  }

  /** Numbers as half floats, from planes of bytes. */
  private decoded(bytes: Uint8Array, count: number, lights: Float64Array): Uint16Array {
    const { facts } = this;
    const { numbers } = this.layout;
    const { shown } = facts.tone;
    const planes = bytes.length / count;
    const pixels = new Uint16Array(count * numbers);
    const half = Uint16Array.from(lights, halfOf);
    if (planes !== (shown === "column" ? 1 : shown === "ramp" ? 2 : 3) + (this.hasAlpha ? 1 : 0))
      throw new PageError("The slices of this picture are damaged. Please load or copy the page again.");
    const short = new DataView(new ArrayBuffer(4));
    for (let i = 0, at = 0; i < count; ++i, at += numbers) {
      const code = bytes[i]!;
      const second = bytes[count + i]!;
      if (this.hasAlpha) pixels[at + 3] = halfOf(bytes[3 * count + i]! / 255);
      if (shown === "colours" || shown === "light") {
        pixels[at] = half[code]!;
        pixels[at + 1] = half[(code + second) & 255]!;
        pixels[at + 2] = half[(code + bytes[2 * count + i]!) & 255]!;
      } else if (code > 0) {
        pixels[at] = half[code]!;
        if (shown === "ramp") pixels[at + 1] = halfOf((lights[code]! * second) / 255);
        if (shown !== "mean") continue;
        short.setUint16(0, (second << 8) | bytes[2 * count + i]!);
        const sum = lights[code]! * short.getFloat32(0);
        pixels[at + 1] = halfOf(Math.abs(sum)) | (sum < 0 ? 0x8000 : 0);
      }
    }
    return pixels;
  }

  draw(view: number, target: Target): void {
    if (this.loaded === 0) return;
    const { gl, facts } = this;
    // There is nothing finer than the slices' own pixels.
    const isLarger = target.width > facts.width;
    const drawn = isLarger ? this.targets.like(gl, facts, { filter: gl.LINEAR }) : target;
    drawTo(gl, drawn);
    this.use(view, drawn);
    drawWholePicture(gl);
    if (!isLarger) return;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, drawn.framebuffer);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, target.framebuffer);
    gl.blitFramebuffer(0, 0, drawn.width, drawn.height, 0, 0, target.width, target.height, gl.COLOR_BUFFER_BIT, gl.LINEAR);
  }

  private use(view: number, drawn: Target): void {
    const { gl, facts, program } = this;
    gl.useProgram(program.program);
    useTexture(gl, program, "slices", 0, this.slices, gl.TEXTURE_2D_ARRAY);
    useTexture(gl, program, "colours", 1, this.colours);
    useTexture(gl, program, "planes", 2, this.planes);
    gl.uniform1f(program.at("view"), view);
    gl.uniform2f(program.at("scale"), facts.width / drawn.width, facts.height / drawn.height);
  }
}
