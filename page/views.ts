// Ready views in one picture or film, as a quilt holds them; between two of them the nearer one is shown.

import { drawTo, drawWholePicture, Gl, makeProgram, makeTexture, Program, Target, useTexture, wholePicture } from "./gl";
import { Film } from "./film";
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
  film: Film | undefined;
  private readonly program: Program;
  private views: WebGLTexture | undefined;

  constructor(
    private readonly gl: Gl,
    readonly facts: ViewsFacts,
    private readonly source: Source,
  ) {
    this.program = makeProgram(gl, wholePicture, viewShader);
  }

  async load(changed: () => void): Promise<void> {
    const { gl, facts, source } = this;
    if (facts.type.startsWith("video/")) {
      this.film = await Film.open(gl, source, facts, changed);
      this.views = this.film.texture;
    } else {
      const image = await decodedImage(await source.bytes("views"), facts.type);
      this.views = makeTexture(gl, gl.LINEAR);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
    }
    changed();
  }

  draw(view: number, target: Target): void {
    if (!this.views) return;
    const { gl, facts, program } = this;
    const { columns, rows, first, last } = facts;
    const count = columns * rows;
    const number = last > first ? Math.min(Math.max(Math.round(((view - first) / (last - first)) * (count - 1)), 0), count - 1) : 0;
    const row = Math.floor(number / columns);
    const column = facts.leftwards ? columns - 1 - (number % columns) : number % columns;
    drawTo(gl, target);
    gl.useProgram(program.program);
    useTexture(gl, program, "views", 0, this.views);
    gl.uniform2f(program.at("corner"), column / columns, (facts.upwards ? rows - 1 - row : row) / rows);
    gl.uniform2f(program.at("size"), 1 / columns, 1 / rows);
    gl.uniform2f(program.at("halfPixel"), 0.5 / (columns * facts.width), 0.5 / (rows * facts.height));
    drawWholePicture(gl);
  }
}
