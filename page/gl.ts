// The little of WebGL 2 that all drawing shares. Pictures in textures have their first row at the top: row 0 of a
// texture, and of a framebuffer that is drawn to, is the picture's first.

export type Gl = WebGL2RenderingContext;

export interface Program {
  readonly program: WebGLProgram;
  /** The place of a uniform variable; null where the shader does not use it. */
  at(name: string): WebGLUniformLocation | null;
}

const head = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp sampler2DArray;\n";

/** The device compiles it while the page does other things: whether it links is found out, and thrown, at its first use. */
export function makeProgram(gl: Gl, vertex: string, fragment: string, attributes: string[] = []): Program {
  const program = gl.createProgram()!;
  for (const [type, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, head + source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  attributes.forEach((name, place) => gl.bindAttribLocation(program, place, name));
  gl.linkProgram(program);
  let isChecked = false;
  const places = new Map<string, WebGLUniformLocation | null>();
  return {
    get program() {
      if (!isChecked && !gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
        const told = gl.getAttachedShaders(program)!.map((shader) => gl.getShaderInfoLog(shader));
        throw new Error(`A shader does not link: ${gl.getProgramInfoLog(program)} ${told.join(" ")}`);
      }
      isChecked = true;
      return program;
    },
    at: (name) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name)!;
    },
  };
}

/** A vertex shader for a triangle over everything; `place` runs from 0 to 1 over the picture. */
export const wholePicture = `out vec2 place;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  place = corner * 0.5 + 0.5;
  gl_Position = vec4(corner, 0.0, 1.0);
}`;

export function drawWholePicture(gl: Gl): void {
  gl.bindVertexArray(null);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

export function makeTexture(gl: Gl, filter: number = gl.NEAREST, target: number = gl.TEXTURE_2D): WebGLTexture {
  const texture = gl.createTexture()!;
  gl.bindTexture(target, texture);
  for (const [name, value] of [
    [gl.TEXTURE_MIN_FILTER, filter],
    [gl.TEXTURE_MAG_FILTER, filter],
    [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
    [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
  ] as const)
    gl.texParameteri(target, name, value);
  return texture;
}

/** Four numbers a pixel, for a shader to fetch. */
export function fillWithFloats(gl: Gl, texture: WebGLTexture, width: number, height: number, values: Float32Array): void {
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, values);
}

export function useTexture(gl: Gl, program: Program, name: string, unit: number, texture: WebGLTexture, target: number = gl.TEXTURE_2D): void {
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(target, texture);
  gl.uniform1i(program.at(name), unit);
}

/** A picture that is drawn to. */
export interface Target {
  readonly framebuffer: WebGLFramebuffer;
  readonly texture: WebGLTexture;
  readonly width: number;
  readonly height: number;
}

export interface TargetKind {
  /** Of the colours: more than eight bits where the device can blend them. */
  precise?: boolean;
  depth?: boolean;
  filter?: number;
}

export function makeTarget(gl: Gl, width: number, height: number, kind: TargetKind = {}): Target {
  const texture = makeTexture(gl, kind.filter ?? gl.NEAREST);
  const isPrecise = kind.precise && gl.getExtension("EXT_color_buffer_float") !== null;
  gl.texStorage2D(gl.TEXTURE_2D, 1, isPrecise ? gl.RGBA16F : gl.RGBA8, width, height);
  const framebuffer = gl.createFramebuffer()!;
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  if (kind.depth) {
    const depth = gl.createRenderbuffer()!;
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
  }
  return { framebuffer, texture, width, height };
}

export function deleteTarget(gl: Gl, target: Target): void {
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
  const depth = gl.getFramebufferAttachmentParameter(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE);
  if (depth === gl.RENDERBUFFER) {
    const name = gl.FRAMEBUFFER_ATTACHMENT_OBJECT_NAME;
    gl.deleteRenderbuffer(gl.getFramebufferAttachmentParameter(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, name) as WebGLRenderbuffer);
  }
  gl.deleteTexture(target.texture);
  gl.deleteFramebuffer(target.framebuffer);
}

export function drawTo(gl: Gl, target: Target): void {
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
  gl.viewport(0, 0, target.width, target.height);
}

/** One target, made anew where another size is wanted. */
export class TargetKeeper {
  private kept: Target | undefined;

  /** As large as that one. */
  like(gl: Gl, size: { width: number; height: number }, kind: TargetKind): Target {
    if (this.kept && (this.kept.width !== size.width || this.kept.height !== size.height)) {
      deleteTarget(gl, this.kept);
      this.kept = undefined;
    }
    return (this.kept ??= makeTarget(gl, size.width, size.height, kind));
  }
}
