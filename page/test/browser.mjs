// A browser that draws WebGL with the processor, and what tests ask of a page in it.

import { readFileSync } from "node:fs";
import { chromium } from "playwright-core";

export async function startBrowser() {
  return chromium.launch({
    executablePath: "/usr/bin/chromium-headless-shell",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
}

const pngAddress = (bytes) => `data:image/png;base64,${bytes.toString("base64")}`;

/** Opens a page and waits until its picture is whole, or says why it is not. Returns the page and what it asked for. */
export async function openPage(browser, file, { before, reducedMotion = "no-preference", width = 360 } = {}) {
  const page = await browser.newPage({ viewport: { width, height: width }, reducedMotion });
  const requests = [];
  const troubles = [];
  page.on("request", (request) => requests.push(request.url()));
  page.on("pageerror", (error) => troubles.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") troubles.push(message.text());
  });
  if (before === fakeHeadset) await before(page);
  else if (before) await page.addInitScript(before);
  await page.goto(file.includes("://") ? file : `file://${file}`);
  await page.waitForFunction(() => {
    const picture = document.querySelector("wheatstone-picture");
    return !picture || picture.matches("[data-loaded]") || picture.shadowRoot.querySelector(".alarm").textContent !== "";
  });
  return { page, requests, troubles };
}

export const alarmOf = (page) => page.evaluate(() => document.querySelector("wheatstone-picture").shadowRoot.querySelector(".alarm").textContent);

/** Shows the picture as wide as this, looked at in this way, and returns what then stands on the screen. */
export async function shotOf(page, width, look) {
  await page.setViewportSize({ width: width + 40, height: 400 });
  await page.evaluate(
    async ([width, look]) => {
      const picture = document.querySelector("wheatstone-picture");
      picture.style.width = `${width}px`;
      picture.style.setProperty("--height", "5000px");
      Object.assign(picture, look);
      // A frame draws; the one after it is shown.
      for (let i = 0; i < 3; ++i) await new Promise(requestAnimationFrame);
    },
    [width, look],
  );
  return page.locator("wheatstone-picture canvas").screenshot();
}

/** Over all channels, in dB, of a rectangle of one picture and all of another one, as PNG files, as browsers
 * scale it. At the rectangle's edge, where there are no whole pixels, `inset` pixels are left out. */
export async function picturesAlike(page, whole, part, place, inset = 1) {
  return page.evaluate(
    async ([whole, part, { x, y, width, height }, inset]) => {
      const [screen, picture] = await Promise.all(
        [whole, part].map(async (address) => {
          const image = new Image();
          image.src = address;
          await image.decode();
          return image;
        }),
      );
      const drawn = (draw) => {
        const context = new OffscreenCanvas(screen.width, screen.height).getContext("2d");
        draw(context);
        return context.getImageData(Math.ceil(x) + inset, Math.ceil(y) + inset, Math.floor(width) - 3 * inset, Math.floor(height) - 3 * inset).data;
      };
      const [a, b] = [drawn((to) => to.drawImage(screen, 0, 0)), drawn((to) => to.drawImage(picture, x, y, width, height))];
      let sum = 0;
      for (let i = 0; i < a.length; ++i) sum += i % 4 === 3 ? 0 : (a[i] - b[i]) ** 2;
      return 10 * Math.log10((255 * 255 * a.length * 3) / 4 / sum);
    },
    [pngAddress(whole), pngAddress(part), place, inset],
  );
}

/** Over all channels, in dB, of two pictures as PNG files; a sentence where their sizes differ. */
export async function psnr(page, a, b) {
  const [x, y] = [sizeOf(a), sizeOf(b)];
  if (x.join() !== y.join()) return `${x.join("x")} is not ${y.join("x")}`;
  return picturesAlike(page, a, b, { x: 0, y: 0, width: x[0], height: x[1] }, 0);
}

/** Width and height of a PNG file. */
export const sizeOf = (png) => [png.readUInt32BE(16), png.readUInt32BE(20)];

export const pngAt = (path) => readFileSync(path);

/** Has pages find a headset that is none: eyes 63 mm apart look straight ahead, a quarter turn wide and high. */
export const fakeHeadset = async (page) => {
  await page.addInitScript({ path: new URL("./node_modules/iwer/build/iwer.js", import.meta.url).pathname });
  await page.addInitScript(() => {
    const device = new window.IWER.XRDevice(window.IWER.metaQuest3, { stereoEnabled: true, ipd: 0.063, fovy: Math.PI / 2 });
    device.installRuntime({ forceInstall: true });
  });
};
