// Ready views in one picture, as a quilt holds them; between two of them the nearer one is shown.

import { drawTo, drawWholePicture, Gl, makeProgram, makeTexture, Program, Target, useTexture, wholePicture } from "./gl";
import { decodedImage } from "./images";
import { ViewsFacts } from "./manifest";
import { Source } from "./parts";
import { Picture } from "./picture";

const viewShader = `
in vec2 place;
out vec4 shown;
uniform sampler2D views;
uniform vec2 corner, size;  // of the view, as shares of the whole
uniform vec2 halfPixel;     // of the whole, likewise: neighbours do not bleed into the view
void main() { shown = vec4(texture(views, corner + clamp(place * size, halfPixel, size - halfPixel)).rgb, 1.0); }`;

export class ViewsPicture implements Picture {
  readonly moves = false;
  readonly layers = 1;
  private readonly program: Program;
  private readonly views: WebGLTexture;
  private isLoaded = false;

  constructor(
    private readonly gl: Gl,
    readonly facts: ViewsFacts,
    private readonly source: Source,
  ) {
    this.program = makeProgram(gl, wholePicture, viewShader);
    this.views = makeTexture(gl, gl.LINEAR);
  }

  setDetail(): void {}

  async load(changed: () => void): Promise<void> {
    const { gl } = this;
    const image = await decodedImage(await this.source.bytes("views"), this.facts.type);
    gl.bindTexture(gl.TEXTURE_2D, this.views);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
    this.isLoaded = true;
    changed();
  }

  /** Views do not tell how deep they are. */
  disparityAt(): undefined {
    return undefined;
  }

  draw(view: number, target: Target): void {
    if (!this.isLoaded) return;
    const { gl, facts, program } = this;
    const { columns, rows, first, last } = facts;
    const count = columns * rows;
    const number = last > first ? Math.min(Math.max(Math.round(((view - first) / (last - first)) * (count - 1)), 0), count - 1) : 0;
    const row = Math.floor(number / columns);
    drawTo(gl, target);
    gl.useProgram(program.program);
    useTexture(gl, program, "views", 0, this.views);
    gl.uniform2f(program.at("corner"), (number % columns) / columns, (facts.upwards ? rows - 1 - row : row) / rows);
    gl.uniform2f(program.at("size"), 1 / columns, 1 / rows);
    gl.uniform2f(program.at("halfPixel"), 0.5 / (columns * facts.width), 0.5 / (rows * facts.height));
    drawWholePicture(gl);
  }
}
