// What browsers have and the compiler's own declarations of them lack: WebXR, and streams that inflate.

declare class DecompressionStream implements GenericTransformStream {
  constructor(format: "deflate");
  readonly readable: ReadableStream;
  readonly writable: WritableStream;
}

interface Navigator {
  readonly xr?: XRSystem;
}
interface WebGL2RenderingContext {
  makeXRCompatible(): Promise<void>;
}

interface XRSystem {
  isSessionSupported(mode: "immersive-vr"): Promise<boolean>;
  requestSession(mode: "immersive-vr"): Promise<XRSession>;
}
declare class XRReferenceSpace {}
interface XRSession extends EventTarget {
  readonly renderState: { readonly baseLayer?: XRWebGLLayer };
  updateRenderState(state: { baseLayer: XRWebGLLayer }): Promise<void>;
  requestReferenceSpace(type: "local"): Promise<XRReferenceSpace>;
  requestAnimationFrame(callback: (now: number, frame: XRFrame) => void): number;
}
declare class XRWebGLLayer {
  constructor(session: XRSession, gl: WebGL2RenderingContext);
  readonly framebuffer: WebGLFramebuffer;
  getViewport(view: XRView): { x: number; y: number; width: number; height: number } | undefined;
}
interface XRFrame {
  getViewerPose(space: XRReferenceSpace): XRViewerPose | undefined;
}
interface XRRigidTransform {
  readonly matrix: Float32Array;
  readonly position: DOMPointReadOnly;
  readonly inverse: XRRigidTransform;
}
interface XRView {
  readonly projectionMatrix: Float32Array;
  readonly transform: XRRigidTransform;
}
interface XRViewerPose {
  readonly views: readonly XRView[];
}

interface HTMLVideoElement {
  requestVideoFrameCallback(callback: () => void): number;
}
