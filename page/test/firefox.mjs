// What a picture looks like in Firefox, which draws WebGL with Mesa on a screen that is none.

import { spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";

export const hasFirefox = () => ["firefox-esr", "xvfb-run"].every((program) => existsSync(`/usr/bin/${program}`));

/** The page in a folder, with the code of the element beside it, at its left eye's view, as a PNG file. */
export async function shotInFirefox(folder, file, width) {
  const page = `<!doctype html><script src="wheatstone-picture.js"></script>
    <wheatstone-picture src="${file}" flat="left" style="display: block; width: ${width}px; --height: 5000px"></wheatstone-picture>
    <script>
      const picture = document.querySelector("wheatstone-picture");
      const send = (body) => fetch("/shot", { method: "POST", body });
      picture.addEventListener("error", () => send(picture.shadowRoot.querySelector(".alarm").textContent));
      picture.addEventListener("load", () => {
        picture.zeroParallax = picture.zeroParallax === 0 ? 1 : 0; // another view has to be drawn
        picture.zeroParallax = 0;
        requestAnimationFrame(() => send(picture.shadowRoot.querySelector("canvas").toDataURL()));
      });
    </script>`;
  const profile = `${folder}/firefox`;
  mkdirSync(profile, { recursive: true });
  writeFileSync(`${profile}/user.js`, 'user_pref("webgl.force-enabled", true);\n');
  let answer;
  const answered = new Promise((resolve) => (answer = resolve));
  const server = createServer(async (request, response) => {
    const { url } = request;
    if (url !== "/shot") {
      response.setHeader("content-type", url.endsWith(".js") ? "text/javascript" : "text/html");
      response.end(url === "/" ? page : existsSync(folder + url) ? readFileSync(folder + url) : "");
      return;
    }
    const parts = [];
    for await (const part of request) parts.push(part);
    response.end();
    answer(Buffer.concat(parts).toString());
  }).listen(0, "127.0.0.1");
  await once(server, "listening");
  const address = `http://127.0.0.1:${server.address().port}/`;
  const firefox = spawn("xvfb-run", ["--auto-servernum", "firefox-esr", "--headless", "--no-remote", "--profile", profile, address], {
    stdio: "ignore",
    detached: true,
    env: { ...process.env, LIBGL_ALWAYS_SOFTWARE: "1" },
  });
  const late = setTimeout(() => answer("Firefox did not answer within a minute"), 60_000);
  const told = await answered;
  clearTimeout(late);
  process.kill(-firefox.pid); // the screen, too
  server.close();
  server.closeAllConnections();
  if (!told.startsWith("data:")) throw new Error(told);
  return Buffer.from(told.split(",")[1], "base64");
}
