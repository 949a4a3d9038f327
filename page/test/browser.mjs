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
export async function openPage(browser, file, { before, reducedMotion = "no-preference" } = {}) {
  const page = await browser.newPage({ viewport: { width: 360, height: 400 }, reducedMotion });
  const requests = [];
  const troubles = [];
  page.on("request", (request) => requests.push(request.url()));
  page.on("pageerror", (error) => troubles.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") troubles.push(message.text());
  });
  if (before) await page.addInitScript(before);
  await page.goto(`file://${file}`);
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

/** Over all channels, in dB, of two pictures as PNG files; a sentence where their sizes differ. */
export async function psnr(page, a, b) {
  return page.evaluate(
    async (addresses) => {
      const [x, y] = await Promise.all(
        addresses.map(async (address) => {
          const image = new Image();
          image.src = address;
          await image.decode();
          const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
          context.drawImage(image, 0, 0);
          return context.getImageData(0, 0, image.width, image.height);
        }),
      );
      if (x.width !== y.width || x.height !== y.height) return `${x.width}x${x.height} is not ${y.width}x${y.height}`;
      let sum = 0;
      for (let i = 0; i < x.data.length; ++i) sum += i % 4 === 3 ? 0 : (x.data[i] - y.data[i]) ** 2;
      return 10 * Math.log10((255 * 255 * x.data.length * 3) / 4 / sum);
    },
    [pngAddress(a), pngAddress(b)],
  );
}

/** Width and height of a PNG file. */
export const sizeOf = (png) => [png.readUInt32BE(16), png.readUInt32BE(20)];

export const pngAt = (path) => readFileSync(path);
