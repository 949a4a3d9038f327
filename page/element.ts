// <wheatstone-picture src="…">: a picture with its depth. What stands inside it, a still picture, is shown until the
// depth is there, and where it cannot be.
//
//   src           "#id" of data in this document, or the address of a page that `wheatstone share` wrote
//   flat          left, right, wiggle or anaglyph: how it begins, as <stereo-img> has it
//   mode          any of the modes of stage.ts: how it begins
//   controlslist  what is shown of the controls: mode, detail, fullscreen, vr; all of them by default

import { addFilmControls } from "./film";
import { Gl } from "./gl";
import { addHeadsetButton } from "./headset";
import { openPicture } from "./open_picture";
import { PageError, sourceAt } from "./parts";
import { disparityInView } from "./pointing";
import { contextOf, isSideBySide, Look, Mode, modes, Stage, viewsOf, windowOf } from "./stage";
import { styles } from "./styles";
import * as words from "./words";

const wiggleMilliseconds = 160;
const slowMilliseconds = 60;
const leastEffort = 0.25;
const restMilliseconds = 250;

export class WheatstonePicture extends HTMLElement {
  static readonly observedAttributes = ["src"];

  private readonly canvas = document.createElement("canvas");
  private readonly how = document.createElement("p");
  private readonly alarm = document.createElement("p");
  private readonly bar = document.createElement("div");
  private readonly modeChoice = document.createElement("select");
  private readonly detailSlider = document.createElement("input");
  private stage: Stage | undefined;
  private look: Look = { mode: "flat", view: 0, separation: 1, zeroParallax: 0 };
  private isWanted = false;
  private hasContent = false;
  /** What a picture that moves gets, of the effort that one at rest gets. */
  private effort = 1;
  private movedAt = -Infinity;
  private rest = 0;
  private opening = 0;

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [styles()];
    const frame = document.createElement("div");
    frame.className = "frame";
    frame.append(this.canvas, document.createElement("slot"));
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.alarm.setAttribute("role", "alert");
    this.alarm.className = "alarm";
    this.how.className = "how";
    this.bar.className = "bar";
    root.append(frame, this.alarm, this.bar, this.how);
    this.addControls();
    this.listen();
  }

  connectedCallback(): void {
    void this.open();
  }
  attributeChangedCallback(_name: string, before: string | null): void {
    if (before !== null && this.isConnected) void this.open();
  }
  disconnectedCallback(): void {
    this.close();
  }

  // How it is looked at, for scripts.

  get mode(): Mode {
    return this.look.mode;
  }
  set mode(mode: Mode) {
    if (!modes.includes(mode)) throw new RangeError(`mode: there is no '${mode}', expected ${modes.join(", ")}`);
    this.change({ mode });
  }
  get view(): number {
    return this.look.view;
  }
  set view(view: number) {
    this.change({ view });
  }
  get zeroParallax(): number {
    return this.look.zeroParallax;
  }
  set zeroParallax(zeroParallax: number) {
    this.change({ zeroParallax });
  }
  get separation(): number {
    return this.look.separation;
  }
  set separation(separation: number) {
    this.change({ separation });
  }
  get detail(): number {
    return Number(this.detailSlider.value);
  }
  set detail(layers: number) {
    this.detailSlider.value = String(layers);
    const { stage } = this;
    if (!stage?.picture.detail) return;
    stage.picture.detail.shown = layers;
    stage.forget();
    this.redraw();
  }

  /** Ends what is shown, and whatever is still being opened. */
  private close(): number {
    this.stage?.picture.film?.close();
    this.stage = undefined;
    return ++this.opening;
  }

  private async open(): Promise<void> {
    const opening = this.close();
    const address = this.getAttribute("src");
    if (!address) return;
    this.fail("");
    delete this.dataset.shown;
    try {
      const source = await sourceAt(address, this.ownerDocument);
      if (opening !== this.opening) return;
      const gl = contextOf(this.canvas);
      if (!gl) throw new PageError(words.noWebgl);
      const { facts } = source;
      const stage = new Stage(gl, openPicture(gl, source));
      this.stage = stage;
      this.hasContent = false;
      this.begin(facts.title, facts.separation, facts.zeroParallax);
      await stage.picture.load(() => {
        if (opening !== this.opening) return;
        this.hasContent = true;
        stage.forget();
        this.redraw();
      });
      const { film } = stage.picture;
      if (opening !== this.opening) {
        film?.close();
        return;
      }
      if (film) {
        addFilmControls(this.bar, film, facts.kind === "views" && facts.hasSound === true);
        if (!prefersNoMotion()) void film.video.play();
        this.change({});
      }
      if (this.shows("vr")) addHeadsetButton(this.bar, stage, () => this.look, () => this.redraw());
      this.dataset.loaded = "";
      this.dispatchEvent(new Event("load"));
    } catch (error) {
      if (opening === this.opening) this.giveUp(error);
    }
  }

  /** The picture cannot be shown, and the page says why. */
  private giveUp(error: unknown): void {
    this.close();
    if (!(error instanceof PageError)) console.error(error);
    this.fail(error instanceof PageError ? error.message : words.notShown);
    if (error instanceof PageError && error.instead) this.replaceChildren(error.instead);
    this.dispatchEvent(new Event("error"));
  }

  private begin(title: string, separation: number, zeroParallax: number): void {
    const picture = this.stage!.picture;
    this.canvas.setAttribute("aria-label", this.querySelector("img")?.alt || title);
    const layers = picture.detail?.layers ?? 1;
    this.detailSlider.max = String(layers);
    this.detailSlider.value = String(layers);
    this.detailSlider.parentElement!.hidden = layers < 2 || !this.shows("detail");
    this.modeChoice.hidden = !this.shows("mode");
    const flat = this.getAttribute("flat");
    const [left, right] = viewsOf(picture, { ...this.look, mode: "flat" });
    const view = flat === "left" ? left : flat === "right" ? right : (left + right) / 2;
    const wanted = (this.getAttribute("mode") ?? flat ?? "flat") as Mode;
    this.change({ mode: modes.includes(wanted) ? wanted : "flat", view, separation, zeroParallax });
  }

  /** Whether a control is to be shown. */
  private shows(control: string): boolean {
    const list = this.getAttribute("controlslist");
    return list === null || list.split(/\s+/).includes(control);
  }

  private change(change: Partial<Look>): void {
    this.look = { ...this.look, ...change };
    this.modeChoice.value = this.look.mode;
    const byHand = this.look.mode === "wiggle" && prefersNoMotion();
    this.how.textContent =
      (byHand ? words.wiggleByHand : words.howToLook[this.look.mode]) + (this.stage?.picture.film ? words.playKeys : "");
    this.redraw();
  }

  private redraw(): void {
    if (!this.stage || this.isWanted) return;
    this.isWanted = true;
    requestAnimationFrame((now) => this.frame(now));
  }

  private frame(now: number): void {
    this.isWanted = false;
    const { stage, canvas, look } = this;
    if (!stage || !this.hasContent || stage.isElsewhere || stage.gl.isContextLost()) return;
    this.dataset.shown = ""; // what is not shown has no size
    this.fit();
    const moves = now - this.movedAt < this.restTime;
    const effort = moves ? this.effort : 1;
    const begin = performance.now();
    try {
      const isNew = stage.draw(this.shownLook(now, look), effort);
      if (isNew && effort === 1) this.measure(stage.gl, begin);
    } catch (error) {
      this.giveUp(error);
      return;
    }
    canvas.dataset.frames = String(Number(canvas.dataset.frames ?? 0) + 1);
    const wiggles = look.mode === "wiggle" && !prefersNoMotion();
    if (wiggles) this.redraw();
  }

  /** After so many milliseconds without a movement the exact picture is drawn, which stops a slow device for a while. */
  private get restTime(): number {
    return restMilliseconds / this.effort;
  }

  /** How long the device takes for what it was told to draw: one that is slow is asked for less while the view moves. */
  private measure(gl: Gl, begin: number): void {
    const drawn = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = (): void => {
      if (!drawn || gl.isContextLost()) return;
      const took = performance.now() - begin;
      if (gl.clientWaitSync(drawn, 0, 0) === gl.TIMEOUT_EXPIRED) {
        setTimeout(look, 5);
        return;
      }
      gl.deleteSync(drawn);
      this.effort = Math.min(Math.max(Math.sqrt(slowMilliseconds / took), leastEffort), 1);
    };
    setTimeout(look, 0);
  }

  private shownLook(now: number, look: Look): Look {
    if (look.mode !== "wiggle" || prefersNoMotion()) return look;
    const [left, right] = viewsOf(this.stage!.picture, look);
    return { ...look, view: Math.floor(now / wiggleMilliseconds) % 2 === 0 ? left : right };
  }

  /** Gives the canvas the shape of what it shows, and as many pixels as the screen has there. */
  private fit(): void {
    const { canvas, look } = this;
    const window = windowOf(this.stage!.picture, look);
    const width = window.width * (isSideBySide(look.mode) ? 2 : 1);
    canvas.style.setProperty("--aspect", String(width / window.height));
    const box = canvas.getBoundingClientRect();
    const most = 4096;
    const pixels = Math.min(devicePixelRatio, most / Math.max(box.width, 1));
    const size = [Math.max(Math.round(box.width * pixels), 1), Math.max(Math.round(box.height * pixels), 1)] as const;
    if (canvas.width !== size[0]) canvas.width = size[0];
    if (canvas.height !== size[1]) canvas.height = size[1];
  }

  private addControls(): void {
    for (const mode of modes) this.modeChoice.add(new Option(words.nameOf[mode], mode));
    this.modeChoice.setAttribute("aria-label", "Way of looking");
    this.modeChoice.addEventListener("change", () => (this.mode = this.modeChoice.value as Mode));
    const label = document.createElement("label");
    label.textContent = "Detail ";
    label.hidden = true;
    Object.assign(this.detailSlider, { type: "range", min: "1", max: "1", step: "1" });
    this.detailSlider.addEventListener("input", () => (this.detail = this.detail));
    label.append(this.detailSlider);
    const full = document.createElement("button");
    full.textContent = "Full screen";
    full.addEventListener("click", () => this.toggleFullScreen());
    full.hidden = !this.requestFullscreen;
    this.bar.append(this.modeChoice, label, full);
  }

  private toggleFullScreen(): void {
    if (document.fullscreenElement === this) void document.exitFullscreen();
    else void this.requestFullscreen();
  }

  private listen(): void {
    const { canvas } = this;
    canvas.addEventListener("pointermove", (event) => this.lookFrom(event.offsetX / canvas.clientWidth));
    canvas.addEventListener("click", (event) => this.pick(event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight));
    canvas.addEventListener("keydown", (event) => {
      if (this.press(event.key)) event.preventDefault();
    });
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.close();
      this.fail(words.contextLost);
    });
    canvas.addEventListener("webglcontextrestored", () => void this.open());
    new ResizeObserver(() => this.redraw()).observe(this);
    window.addEventListener("deviceorientation", (event) => {
      const widestDegrees = 20;
      if (event.gamma !== null && !prefersNoMotion()) this.lookFrom(0.5 + event.gamma / (2 * widestDegrees));
    });
  }

  /** `place` runs from 0, as far left as there is something to see, to 1. */
  private lookFrom(place: number): void {
    const { stage, look } = this;
    if (!stage || look.mode !== "flat" || this.hasAttribute("flat")) return;
    const [left, right] = viewsOf(stage.picture, look);
    this.movedAt = performance.now();
    this.change({ view: left + Math.min(Math.max(place, 0), 1) * (right - left) });
    clearTimeout(this.rest);
    this.rest = window.setTimeout(() => this.redraw(), this.restTime + 10);
  }

  /** What lies there comes onto the screen. */
  private pick(x: number, y: number): void {
    const { stage, look } = this;
    if (!stage) return;
    if (look.mode === "wiggle" && prefersNoMotion()) {
      this.otherEye();
      return;
    }
    const [left, right] = viewsOf(stage.picture, look);
    const beside = isSideBySide(look.mode);
    const isSecond = beside && x >= 0.5;
    const view = look.mode === "flat" ? look.view : isSecond === (look.mode === "parallel") ? right : left;
    const window = windowOf(stage.picture, look);
    const column = window.begin(view) + (beside ? (2 * x) % 1 : x) * window.width;
    const disparity = disparityInView(stage.picture.surfaces, column, y * window.height, view);
    if (disparity !== undefined) this.change({ zeroParallax: disparity });
  }

  private otherEye(): void {
    const [left, right] = viewsOf(this.stage!.picture, this.look);
    this.change({ view: this.look.view === left ? right : left });
  }

  private press(key: string): boolean {
    if (!this.stage) return false;
    const [left, right] = viewsOf(this.stage.picture, this.look);
    const step = (right - left) / 20;
    const moved = (by: number) => Math.min(Math.max(this.look.view + by, left), right);
    const number = Number(key);
    if (key === "ArrowLeft") this.view = moved(-step);
    else if (key === "ArrowRight") this.view = moved(step);
    else if (key === "Home") this.view = (left + right) / 2;
    else if (key === "f" || key === "F") this.toggleFullScreen();
    else if (key === "+" || key === "-") this.detail += key === "+" ? 1 : -1;
    else if (key === " " && this.look.mode === "wiggle" && prefersNoMotion()) this.otherEye();
    else if (this.stage.picture.film?.press(key)) return true;
    else if (number >= 1 && number <= modes.length) this.mode = modes[number - 1]!;
    else return false;
    return true;
  }

  /** Says why the still picture is all that there is; "": nothing is wrong. */
  private fail(sentence: string): void {
    this.alarm.textContent = sentence;
    if (sentence) {
      delete this.dataset.shown;
      this.how.textContent = "";
    }
  }
}

function prefersNoMotion(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
