// The picture on a wall in a headset, or in a light field display: anything that WebXR gives views for.

import { Gl, makeProgram, Program, useTexture } from "./gl";
import { Look, Stage, windowOf } from "./stage";

const eyesApartMetres = 0.063;
const wallMetres = 2; // from the eyes to the picture
const widthMetres = 2;
const viewStep = 1 / 256; // of the eye separation: less movement of the head shows nothing new

const quadShader = `
out vec2 place;
uniform mat4 projection, viewFromWorld;
uniform vec2 halfSize;
uniform float depth;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  place = vec2(corner.x, 1.0 - corner.y);
  gl_Position = projection * viewFromWorld * vec4((2.0 * corner - 1.0) * halfSize, -depth, 1.0);
}`;
const pictureShader = `
in vec2 place;
out vec4 shown;
uniform sampler2D picture;
uniform vec2 size;
uniform vec3 window;  // first column, width, height
void main() {
  shown = vec4(texture(picture, vec2(window.x + place.x * window.y, place.y * window.z) / size).rgb, 1.0);
}`;

/** Where the eye of an XR view stands, as a view position of the picture. */
export function viewPositionOf(eyeMetres: number, look: Look): number {
  const exact = (eyeMetres / eyesApartMetres) * look.separation;
  return Math.round(exact / viewStep) * viewStep;
}

class Headset {
  private readonly program: Program;
  constructor(
    private readonly stage: Stage,
    private readonly look: () => Look,
    private readonly ended: () => void,
  ) {
    this.program = makeProgram(stage.gl, quadShader, pictureShader);
  }

  async start(): Promise<void> {
    const gl = this.stage.gl;
    const session = await navigator.xr!.requestSession("immersive-vr");
    await gl.makeXRCompatible();
    await session.updateRenderState({ baseLayer: new XRWebGLLayer(session, gl) });
    const space = await session.requestReferenceSpace("local");
    const frame = (_now: number, xrFrame: XRFrame): void => {
      session.requestAnimationFrame(frame);
      const pose = xrFrame.getViewerPose(space);
      if (pose) this.draw(session.renderState.baseLayer!, pose);
    };
    this.stage.isElsewhere = true;
    session.addEventListener("end", () => {
      this.stage.isElsewhere = false;
      this.ended();
    });
    session.requestAnimationFrame(frame);
  }

  private draw(layer: XRWebGLLayer, pose: XRViewerPose): void {
    const gl: Gl = this.stage.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, layer.framebuffer);
    gl.clearColor(0.05, 0.05, 0.05, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const slots = 2; // two eyes' views are kept while the head is still
    pose.views.forEach((view, i) => this.drawView(layer, view, i % slots));
  }

  private drawView(layer: XRWebGLLayer, view: XRView, slot: number): void {
    const { gl, picture } = this.stage;
    const look: Look = { ...this.look(), mode: "parallel" };
    const { facts } = picture;
    const position = Math.min(Math.max(viewPositionOf(view.transform.position.x, look), facts.first), facts.last);
    const seen = this.stage.viewAt(position, 1, slot);
    const window = windowOf(picture, look);
    const viewport = layer.getViewport(view)!;
    gl.bindFramebuffer(gl.FRAMEBUFFER, layer.framebuffer);
    gl.viewport(viewport.x, viewport.y, viewport.width, viewport.height);
    gl.useProgram(this.program.program);
    useTexture(gl, this.program, "picture", 0, seen.texture);
    gl.uniformMatrix4fv(this.program.at("projection"), false, view.projectionMatrix);
    gl.uniformMatrix4fv(this.program.at("viewFromWorld"), false, view.transform.inverse.matrix);
    gl.uniform2f(this.program.at("halfSize"), widthMetres / 2, (widthMetres / 2) * (window.height / window.width));
    gl.uniform1f(this.program.at("depth"), wallMetres);
    gl.uniform2f(this.program.at("size"), facts.width, facts.height);
    gl.uniform3f(this.program.at("window"), window.begin(position), window.width, window.height);
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }
}

/** Adds a button that enters VR, where the browser has a headset; `ended` is called when somebody comes back. */
export function addHeadsetButton(bar: HTMLElement, stage: Stage, look: () => Look, ended: () => void): void {
  bar.querySelector(".headset")?.remove();
  if (!navigator.xr) return;
  void navigator.xr.isSessionSupported("immersive-vr").then((isSupported) => {
    if (!isSupported) return;
    const button = document.createElement("button");
    button.className = "headset";
    button.textContent = "Enter VR";
    button.addEventListener("click", () => void new Headset(stage, look, ended).start());
    bar.append(button);
  });
}
