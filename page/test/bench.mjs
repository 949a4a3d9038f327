// How large pages are, how soon they show something, and how many frames a second they draw.
//
//   bench.mjs PAGE...    a table of what is measured in a browser that draws with the processor

import { statSync } from "node:fs";
import { basename, resolve } from "node:path";
import { openPage, startBrowser } from "./browser.mjs";

const seconds = 2; // for which frames are counted

/** Notes when the device has first drawn something, for which it is waited. */
const noteFirst = () => {
  const note = () => {
    const picture = document.querySelector("wheatstone-picture");
    if (!picture?.matches("[data-shown]")) return setTimeout(note, 5);
    const gl = picture.shadowRoot.querySelector("canvas").getContext("webgl2");
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    window.noted = performance.now();
  };
  note();
};

/** Notes when all of the picture is there. */
const noteAll = () => {
  const note = () => {
    if (!document.querySelector("wheatstone-picture")?.matches("[data-loaded]")) return setTimeout(note, 5);
    window.noted = performance.now();
  };
  note();
};

/** The page, and what was noted in it, in seconds. */
async function openNoting(browser, file, note) {
  const { page } = await openPage(browser, resolve(file), { reducedMotion: "reduce", width: 680, before: note });
  await page.waitForFunction(() => window.noted);
  return { page, seconds: (await page.evaluate(() => window.noted)) / 1000 };
}

/** Views from left to right and back for some seconds, and how many frames were drawn of them. */
const framesASecond = (page) =>
  page.evaluate(async (seconds) => {
    const picture = document.querySelector("wheatstone-picture");
    const canvas = picture.shadowRoot.querySelector("canvas");
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const gl = canvas.getContext("webgl2");
    const frame = async (i) => {
      const share = 0.5 + 0.45 * Math.sin(i / 10);
      canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: left + share * width, clientY: top + height / 2 }));
      await new Promise(requestAnimationFrame);
      // What the device has not done yet counts, too.
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      await new Promise((wait) => setTimeout(wait, 10));
    };
    for (let i = 0; i < 3; ++i) await frame(i);
    const begin = performance.now();
    const drawn = Number(canvas.dataset.frames);
    for (let i = 3; performance.now() < begin + 1000 * seconds; ++i) await frame(i);
    return (1000 * (Number(canvas.dataset.frames) - drawn)) / (performance.now() - begin);
  }, seconds);

const browser = await startBrowser();
console.log("| page | size | first picture | all of it | frames a second |\n|---|---|---|---|---|");
for (const file of process.argv.slice(2)) {
  const first = await openNoting(browser, file, noteFirst);
  await first.page.close();
  const { page, seconds: all } = await openNoting(browser, file, noteAll);
  const rate = await framesASecond(page);
  console.log(
    `| ${basename(file, ".html")} | ${(statSync(file).size / 1e6).toFixed(1)} MB | ${first.seconds.toFixed(2)} s | ${all.toFixed(2)} s | ${rate.toFixed(1)} |`,
  );
  await page.close();
}
await browser.close();
