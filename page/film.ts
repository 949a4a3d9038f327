// A film of several views in each frame: the texture that shows its present frame, and what plays it.

import { Gl, makeTexture } from "./gl";
import { ViewsFacts } from "./manifest";
import { PageError, Source } from "./parts";
import * as words from "./words";

const jumpSeconds = 5;

export class Film {
  readonly video = document.createElement("video");
  readonly texture: WebGLTexture;
  /** The subtitles of this moment. */
  readonly said = document.createElement("p");

  private constructor(private readonly gl: Gl) {
    this.texture = makeTexture(gl, gl.LINEAR);
    Object.assign(this.video, { muted: true, loop: true, playsInline: true, preload: "auto" });
  }

  /** Opens the film, and shows its first frame; `changed` is called whenever another frame is shown. */
  static async open(gl: Gl, source: Source, facts: ViewsFacts, changed: () => void): Promise<Film> {
    const film = new Film(gl);
    const { video } = film;
    const inside = facts.file === undefined ? new Blob([(await source.bytes("views")) as BlobPart], { type: facts.type }) : undefined;
    const canPlay = new Promise<void>((loaded, failed) => {
      video.addEventListener("loadeddata", () => loaded());
      video.addEventListener("error", () => failed(new PageError(words.noFilm(video.error?.code === MediaError.MEDIA_ERR_NETWORK ? undefined : facts.codec))));
    });
    if (facts.hasSubtitles) film.subtitle(await source.bytes("subtitles"));
    video.src = inside ? URL.createObjectURL(inside) : new URL(facts.file!, source.address).href;
    await canPlay;
    try {
      film.takeFrame();
    } catch (error) {
      if (!(error instanceof DOMException)) throw error;
      // From a file, browsers play what lies beside a page, but do not let the page see it.
      video.controls = true;
      throw new PageError(words.filmNeedsServer, video);
    }
    const shown = (): void => {
      if (gl.isContextLost()) return;
      film.takeFrame();
      changed();
      video.requestVideoFrameCallback(shown);
    };
    video.requestVideoFrameCallback(shown);
    return film;
  }

  private subtitle(file: Uint8Array): void {
    const { video } = this;
    const element = document.createElement("track");
    element.src = URL.createObjectURL(new Blob([file as BlobPart], { type: "text/vtt" }));
    video.append(element);
    element.track.mode = "hidden"; // it is read, and the page shows its text
    element.addEventListener("load", () => this.say());
  }

  /** Browsers tell of subtitles only while a film plays, so that they are looked for with each frame. */
  private say(): void {
    const { said, video } = this;
    const cues = Array.from(video.textTracks[0]?.cues ?? []) as VTTCue[];
    const present = cues.filter((cue) => cue.startTime <= video.currentTime && video.currentTime < cue.endTime);
    said.replaceChildren(...present.map((cue) => cue.getCueAsHTML()));
  }

  private takeFrame(): void {
    const { gl, texture, video } = this;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, video);
    this.say();
  }

  close(): void {
    this.video.pause();
    if (this.video.src.startsWith("blob:")) URL.revokeObjectURL(this.video.src);
    this.video.removeAttribute("src");
  }

  toggle(): void {
    if (this.video.paused) void this.video.play();
    else this.video.pause();
  }

  /** Whether the key is one of those that play the film. */
  press(key: string): boolean {
    const { video } = this;
    const go = (seconds: number): void => {
      video.currentTime = Math.min(Math.max(video.currentTime + seconds, 0), video.duration);
    };
    if (key === " " || key === "k") this.toggle();
    else if (key === "j") go(-jumpSeconds);
    else if (key === "l") go(jumpSeconds);
    else if (key === "m") video.muted = !video.muted;
    else return false;
    return true;
  }
}

/** Adds buttons and a slider that play the film, and above them its subtitles. */
export function addFilmControls(bar: HTMLElement, film: Film, hasSound: boolean): void {
  bar.querySelector(".film")?.remove();
  bar.parentNode!.querySelector(".said")?.remove();
  film.said.className = "said";
  bar.before(film.said);
  const { video } = film;
  const controls = document.createElement("span");
  controls.className = "film";
  const play = document.createElement("button");
  const sound = document.createElement("button");
  const time = document.createElement("input");
  Object.assign(time, { type: "range", min: "0", max: String(video.duration), step: "any" });
  time.setAttribute("aria-label", "Time");
  const tell = (): void => {
    play.textContent = video.paused ? "Play" : "Pause";
    sound.textContent = video.muted ? "Sound on" : "Sound off";
    time.value = String(video.currentTime);
  };
  play.addEventListener("click", () => film.toggle());
  sound.hidden = !hasSound;
  sound.addEventListener("click", () => (video.muted = !video.muted));
  time.addEventListener("input", () => (video.currentTime = Number(time.value)));
  for (const event of ["play", "pause", "volumechange", "timeupdate", "seeked"]) video.addEventListener(event, tell);
  tell();
  controls.append(play, time, sound);
  bar.append(controls);
}
