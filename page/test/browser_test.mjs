// Shared pages in a browser: their pixels against those that the program draws, and what they say where something is
// wrong. One browser and few programs for all of it.
//
//   browser_test.mjs WHEATSTONE FOLDER some|all    all: also what takes long

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { once } from "node:events";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { alarmOf, fakeHeadset, openPage, picturesAlike, pngAt, psnr, shotOf, sizeOf, startBrowser } from "./browser.mjs";
import { hasFirefox, shotInFirefox } from "./firefox.mjs";

const [wheatstone, folder, which] = process.argv.slice(2);
const run = (...words) => execFileSync(wheatstone, ["--quiet", ...words], { cwd: folder, stdio: ["ignore", "ignore", "inherit"] });
const at = (name) => `${folder}/${name}`;
const leastPsnr = 35;
const hostile = `"><script>document.body.textContent="taken"</script>`;
const browser = await startBrowser();
const failures = [];

async function test(name, body) {
  const begin = Date.now();
  try {
    const told = (await body()) ?? "";
    console.log(`ok      ${name} ${told} (${Date.now() - begin} ms)`);
  } catch (error) {
    failures.push(name);
    console.log(`FAILED  ${name}: ${error.message}`);
  }
}

/** Of what takes long, and differs little from what the others show. */
const longTest = async (name, body) => {
  if (which === "all") await test(name, body);
};

/** Each look with the file that it has to be like. */
async function comparePictures(page, folderOfViews, looks) {
  const told = [];
  for (const [look, file] of looks) {
    const expected = pngAt(at(`${folderOfViews}/${file}`));
    const [width] = sizeOf(expected);
    const found = await psnr(page, await shotOf(page, width, look), expected);
    assert.ok(found >= leastPsnr, `${JSON.stringify(look)}: ${found} dB to ${file}, expected at least ${leastPsnr}`);
    told.push(`${look.mode ?? "as it begins"} ${found.toFixed(1)} dB`);
  }
  return told.join(", ");
}

/** Sends the files of the folder. */
async function serve() {
  const server = createServer((request, answer) => answer.end(readFileSync(at(request.url.slice(1))))).listen(0, "127.0.0.1");
  await once(server, "listening");
  return { address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/** The sentence that is said, beside the still picture. */
async function expectStill(page, sentence) {
  assert.match(await alarmOf(page), sentence);
  assert.ok(await page.locator("wheatstone-picture img").isVisible(), "the still picture is not seen");
  assert.ok(!(await page.locator("wheatstone-picture canvas").isVisible()), "the canvas is seen");
}

const leftAndRight = [
  [{ mode: "flat", view: -0.5, zeroParallax: 0 }, "left.png"],
  [{ mode: "flat", view: 0.5, zeroParallax: 0 }, "right.png"],
];

run("synth", "still", "--size", "160x120", "--samples", "1", "-o", "still");

/** Paints the still life, shares it, and draws it again over its canvas. */
function paint(name, ...options) {
  // The light on paint needs more pixels than its smallest pictures have.
  const still = name === "relief" ? "larger" : "still";
  if (name === "relief") run("synth", "still", "--size", "240x180", "--samples", "1", "-o", still);
  run("paint", `${still}/left.png`, `${still}/right.png`, "--disparity", `${still}/left_disparity.pfm`, "--absolute-radii", ...options, "-o", name);
  run("paint", `${name}/painting.wst`, "-o", `${name}-drawn`);
  run("share", `${name}/painting.wst`, "-o", `${name}.html`, "--title", `Painting ${hostile}`, "--description", "Fruit", "--caption", hostile);
}

paint("impressionist");
run("pack", "impressionist-drawn/side_by_side.png", "--layout", "left-right", "--to", "right-left", "-o", "impressionist-drawn/crossed.png");
await test("strokes and modes are those of the command line, and no address is asked for anything", async () => {
  const { page, requests, troubles } = await openPage(browser, at("impressionist.html"));
  const { zeroParallax, separation } = await page.evaluate(() => {
    const { zeroParallax, separation } = document.querySelector("wheatstone-picture");
    return { zeroParallax, separation };
  });
  const pair = { zeroParallax, separation };
  const told = await comparePictures(page, "impressionist-drawn", [
    ...leftAndRight,
    [{ mode: "anaglyph", ...pair }, "anaglyph.png"],
    [{ mode: "parallel", ...pair }, "side_by_side.png"],
    [{ mode: "cross-eyed", ...pair }, "crossed.png"],
  ]);
  assert.deepEqual(requests.filter((address) => !address.startsWith("data:")), [`file://${at("impressionist.html")}`]);
  assert.deepEqual(troubles, []);
  assert.equal(await page.title(), `Painting ${hostile}`);
  assert.equal(await page.locator("wheatstone-picture canvas").getAttribute("aria-label"), "Fruit");
  assert.equal(await page.locator("figcaption").textContent(), hostile);
  await page.close();
  return told;
});

// With strong streaks and ridges, a mistake in any of the formulas of bristles costs many decibels.
for (const [name, scale, ...options] of [["oil", "2"], ["strong-oil", "0.5", "--streaks", "80", "--ridge", "80"], ["fan", "2", "--brush", "fan", "--streaks", "40"]]) {
  await test(`bristles and changes of colour of ${name} are those of the command line`, async () => {
    paint(name, "--style", "oil", ...options);
    run("paint", `${name}/painting.wst`, "--scale", scale, "-o", `${name}-${scale}`);
    const { page, troubles } = await openPage(browser, at(`${name}.html`));
    const told = await comparePictures(page, `${name}-drawn`, leftAndRight);
    // The right eye's view also shows the edges of surfaces, which the page keeps at the painting's own size.
    const scaled = await comparePictures(page, `${name}-${scale}`, [leftAndRight[0]]);
    assert.deepEqual(troubles, []);
    await page.close();
    return `${told}; ${scale} times as large ${scaled}`;
  });
}

await test("pointer, keys and clicks change what is seen; less detail is another picture", async () => {
  const { page } = await openPage(browser, at("impressionist.html"));
  const get = (name) => page.evaluate((name) => document.querySelector("wheatstone-picture")[name], name);
  const canvas = page.locator("wheatstone-picture canvas");
  await canvas.hover({ position: { x: 3, y: 50 } });
  assert.ok((await get("view")) < -0.4, "the pointer does not change the view");
  await canvas.press("Home");
  assert.equal(await get("view"), 0);
  const before = await get("zeroParallax");
  await canvas.click({ position: { x: 5, y: 5 } });
  assert.ok((await get("zeroParallax")) < before - 5, "the wall lies behind the nearest point");
  await canvas.press("3");
  assert.equal(await get("mode"), "anaglyph");
  const fine = await shotOf(page, 320, { mode: "flat" });
  const coarse = await shotOf(page, 320, { detail: 1 });
  assert.ok((await psnr(page, fine, coarse)) < leastPsnr, "less detail is the same picture");
  await page.close();
});

await test("on a slow device a picture that is nearly right stands in while the view moves", async () => {
  const { page } = await openPage(browser, at("impressionist.html"));
  await shotOf(page, 160, { mode: "flat", view: 0 });
  const moving = await page.evaluate(async () => {
    const picture = document.querySelector("wheatstone-picture");
    const canvas = picture.shadowRoot.querySelector("canvas");
    picture.effort = 0.25; // as a slow device gets
    const { left, width } = canvas.getBoundingClientRect();
    canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: left + 0.8 * width }));
    await new Promise(requestAnimationFrame);
    return { view: picture.view, png: canvas.toDataURL() };
  });
  const exact = await shotOf(page, 160, { view: moving.view, effort: 1 });
  const found = await psnr(page, Buffer.from(moving.png.split(",")[1], "base64"), exact);
  assert.ok(found > 25 && found < 60, `${found} dB`);
  await page.close();
  return `${found.toFixed(1)} dB`;
});

await test("who wants no motion gets none", async () => {
  const { page } = await openPage(browser, at("impressionist.html"), { reducedMotion: "reduce" });
  const first = await shotOf(page, 320, { mode: "wiggle" });
  await page.waitForTimeout(400);
  assert.ok(first.equals(await shotOf(page, 320, {})), "the picture moved by itself");
  await page.locator("wheatstone-picture canvas").press(" ");
  assert.ok(!first.equals(await shotOf(page, 320, {})), "the space bar shows the other eye's view");
  await page.close();
});

/** What a headset shows each eye, on a wall two metres away, against the pictures of these files. */
async function compareInHeadset(name, files) {
  const { page } = await openPage(browser, at(name), { before: fakeHeadset, reducedMotion: "reduce" });
  await page.setViewportSize({ width: 800, height: 400 });
  await page.evaluate(() => Object.assign(document.querySelector("wheatstone-picture"), { zeroParallax: 0, separation: 1 }));
  await page.getByRole("button", { name: "Enter VR" }).click();
  await page.waitForTimeout(1500);
  const shot = await page.screenshot();
  const told = [];
  for (const [file, eye, sign] of [
    [files[0], 0, 1],
    [files[1], 400, -1],
  ]) {
    // Two metres wide at two metres, a quarter turn to 400 pixels: 200 of them. The eye stands 31.5 mm beside the middle.
    const middle = eye + 200 + sign * (0.0315 / 2) * 200;
    const found = await picturesAlike(page, shot, pngAt(at(file)), { x: middle - 100, y: 125, width: 200, height: 150 });
    assert.ok(found >= leastPsnr, `${file}: ${found} dB`);
    told.push(`${found.toFixed(1)} dB`);
  }
  await page.close();
  return told.join(", ");
}

await test("a headset shows each eye its view, on a wall two metres away", () =>
  compareInHeadset("impressionist.html", ["impressionist-drawn/left.png", "impressionist-drawn/right.png"]),
);

for (const [name, ...options] of [["posterise"], ["diffusion"], ["relief", "--style", "impressionist", "--texture"]]) {
  await (name === "posterise" ? test : longTest)(`a painting of ${name} is that of the command line`, async () => {
    paint(name, ...(options.length > 0 ? options : ["--style", name]));
    const { page } = await openPage(browser, at(`${name}.html`));
    const told = await comparePictures(page, `${name}-drawn`, leftAndRight);
    await page.close();
    return told;
  });
}

await test("a photograph with its disparity is its two pictures", async () => {
  run("share", "still/left.png", "still/right.png", "--disparity", "still/left_disparity.pfm", "-o", "photograph.html");
  const { page } = await openPage(browser, at("photograph.html"));
  const told = await comparePictures(page, "still", leftAndRight);
  await page.close();
  return told;
});

await test("a quilt is its views", async () => {
  run("pack", "impressionist/painting.wst", "--to", "quilt", "--quilt", "3x2", "-o", "fruit");
  run("pack", "impressionist/painting.wst", "--to", "views", "--views", "6", "-o", "views");
  const quilt = readdirSync(folder).find((name) => name.startsWith("fruit_qs3x2"));
  run("share", quilt, "-o", "quilt.html");
  const { page } = await openPage(browser, at("quilt.html"));
  const told = await comparePictures(page, "views", [
    [{ mode: "flat", view: -0.5 }, "view_000.png"],
    [{ mode: "flat", view: 0.1 }, "view_003.png"],
  ]);
  await page.close();
  return told;
});

const threeViews = [-0.5, 0, 0.5].map((view, i) => [{ mode: "flat", view }, `view_00${i}.png`]);

/** Renders particles to slices, shares these, and renders their views. */
function renderSlices(name, ...options) {
  run("render", "universe.hdf5", "--size", "160x120", ...options, "--save-slices", `${name}.exr`, "-o", `${name}-particles`);
  run("render", `${name}.exr`, "--views", "3", "-o", name);
  run("share", `${name}.exr`, "-o", `${name}.html`);
}

run("synth", "universe", "--particles", "8000", "-o", "universe.hdf5");
for (const [name, ...options] of [
  ["mass"],
  ["means", "--quantity", "temperature"],
  ["column", "--quantity", "column-density", "--stretch", "log"],
  ["light", "--look", "thesis"],
  ["absorbing", "--look", "thesis", "--blend", "over"],
]) {
  await (name === "mass" ? test : longTest)(`slices of ${name} are moved and added as by the command line`, async () => {
    renderSlices(name, ...options);
    const { page } = await openPage(browser, at(`${name}.html`));
    const told = await comparePictures(page, name, threeViews);
    await page.close();
    return told;
  });
}

run("synth", "film", "--size", "160x120", "--frames", "6", "--samples", "1", "-o", "film");
mkdirSync(at("film-drawn"));
run("rotoscope", "film", "--style", "posterise", "--pixel-format", "yuv444p", "--crf", "8", "-o", "film.mp4");
run("rotoscope", "film", "--style", "posterise", "--output-layout", "left-right", "-o", "film-drawn/frame_%04d.png");
run("pack", "film-drawn/frame_0001.png", "--layout", "left-right", "--to", "views", "-o", "film-drawn");
run("pack", "film-drawn/frame_0001.png", "--layout", "left-right", "--to", "anaglyph", "-o", "film-drawn/anaglyph.png");
const isPaused = (page) => page.evaluate(() => document.querySelector("wheatstone-picture").shadowRoot.querySelector(".film button").textContent === "Play");

const waitUntilSaid = (page, words) =>
  page.waitForFunction((words) => document.querySelector("wheatstone-picture").shadowRoot.querySelector(".said").textContent === words, words, { timeout: 5000 });

await test("a film is its frames, is gone through by keys, has its subtitles, and does not play by itself where motion is not wanted", async () => {
  writeFileSync(at("film.vtt"), `WEBVTT\n\n00:00.000 --> 00:00.100\n<b>Fruit</b>\n\n00:00.200 --> 00:10.000\nThe end\n`);
  run("share", "film.mp4", "--subtitles", "film.vtt", "-o", "film.html");
  const { page, troubles } = await openPage(browser, at("film.html"), { reducedMotion: "reduce" });
  const canvas = page.locator("wheatstone-picture canvas");
  const told = await comparePictures(page, "film-drawn", [
    [{ mode: "parallel" }, "frame_0001.png"],
    [{ mode: "anaglyph" }, "anaglyph.png"],
    [{ mode: "wiggle", view: -0.5 }, "view_000.png"],
    [{ mode: "wiggle", view: 0.5 }, "view_001.png"],
  ]);
  await page.waitForTimeout(200);
  assert.ok(await isPaused(page), "it plays by itself");
  await waitUntilSaid(page, "Fruit");
  await canvas.press("l");
  await page.waitForTimeout(200);
  const end = await comparePictures(page, "film-drawn", [[{ mode: "parallel" }, "frame_0006.png"]]);
  await waitUntilSaid(page, "The end");
  await canvas.press(" ");
  await page.waitForFunction(() => document.querySelector("wheatstone-picture").shadowRoot.querySelector(".film button").textContent === "Pause");
  assert.deepEqual(troubles, []);
  await page.close();
  const moving = await openPage(browser, at("film.html"));
  assert.ok(!(await isPaused(moving.page)), "it does not play");
  await moving.page.close();
  return `${told}, at its end ${end}`;
});

await longTest("a headset shows each eye its view of a film", () =>
  compareInHeadset("film.html", ["film-drawn/view_000.png", "film-drawn/view_001.png"]),
);

await longTest("a film of quilts is its views", async () => {
  run("rotoscope", "film", "--style", "posterise", "--display", "looking-glass-portrait", "--size", "120x160", "--to", "0.05", "--pixel-format", "yuv444p", "--crf", "8", "-o", "quilts");
  run("share", "quilts_qs8x6a0.75.mp4", "-o", "quilts.html");
  execFileSync("ffmpeg", ["-v", "error", "-i", at("quilts_qs8x6a0.75.mp4"), "-frames:v", "1", at("quilts_qs8x6a0.75.png")]);
  run("pack", "quilts_qs8x6a0.75.png", "--to", "views", "-o", "quilts-drawn");
  const { page } = await openPage(browser, at("quilts.html"), { reducedMotion: "reduce" });
  const told = await comparePictures(page, "quilts-drawn", [
    [{ mode: "flat", view: -0.5 }, "view_000.png"],
    [{ mode: "flat", view: 0.5 }, "view_047.png"],
  ]);
  await page.close();
  return told;
});

await test("a film that lies beside a page without a server plays as it is", async () => {
  run("share", "film.mp4", "-o", "beside.html", "--max-size", "20kB");
  const { page } = await openPage(browser, at("beside.html"));
  assert.match(await alarmOf(page), /only where a server sends both/);
  assert.ok(await page.locator("wheatstone-picture video").isVisible(), "the film is not seen");
  await page.close();
});

await longTest("a film that a browser cannot play is told of", async () => {
  run("rotoscope", "film", "--style", "posterise", "--codec", "hevc", "-o", "hevc.mp4");
  run("share", "hevc.mp4", "-o", "hevc.html");
  const { page } = await openPage(browser, at("hevc.html"));
  await expectStill(page, /cannot play the film, whose frames are coded as H.265/);
  await page.close();
});

await longTest("a server delivers a film beside its page", async () => {
  const { address, close } = await serve();
  const { page } = await openPage(browser, `${address}/beside.html`, { reducedMotion: "reduce" });
  const told = await comparePictures(page, "film-drawn", [[{ mode: "parallel" }, "frame_0001.png"]]);
  await page.close();
  close();
  return told;
});

await longTest("another site shows a page in its element, with the controls that it wants", async () => {
  run("share", "impressionist/painting.wst", "-o", "shared.html", "--element", "wheatstone-picture.js");
  writeFileSync(at("site.html"), `<script src="wheatstone-picture.js"></script>
    <wheatstone-picture src="shared.html" flat="right" controlslist="mode"><img src="still/left.png" alt="Fruit"></wheatstone-picture>`);
  const { address, close } = await serve();
  const { page } = await openPage(browser, `${address}/site.html`);
  const told = await comparePictures(page, "impressionist-drawn", [[{ zeroParallax: 0 }, "right.png"]]);
  assert.equal(await page.locator("wheatstone-picture canvas").getAttribute("aria-label"), "Fruit");
  assert.ok(await page.locator("wheatstone-picture select").isVisible());
  assert.ok(!(await page.locator("wheatstone-picture input").isVisible()), "the slider was not asked for");
  await page.close();
  close();
  return told;
});

await longTest("Firefox shows the same strokes and slices, where it is installed", async () => {
  if (!hasFirefox()) return "skipped: firefox-esr or xvfb-run is not installed";
  const page = await browser.newPage();
  const told = [];
  for (const [file, expected] of [["shared.html", "impressionist-drawn/left.png"], ["mass.html", "mass/view_000.png"]]) {
    const found = await psnr(page, await shotInFirefox(folder, file, 160), pngAt(at(expected)));
    assert.ok(found >= leastPsnr, `${file}: ${found} dB`);
    told.push(`${found.toFixed(1)} dB`);
  }
  await page.close();
  return told.join(", ");
});

await test("a page whose data were cut says so, and shows the still picture", async () => {
  const whole = readFileSync(at("impressionist.html"), "utf8");
  for (const [name, part] of [["cut-late", "layer-1"], ["cut-early", "surface-0"]]) {
    writeFileSync(at(`${name}.html`), whole.slice(0, whole.indexOf(`data-part="picture/${part}"`) + 500));
    const { page } = await openPage(browser, at(`${name}.html`));
    await expectStill(page, /incomplete/);
    await page.close();
  }
});

await test("a browser without WebGL, or one that loses it, says so and shows the still picture", async () => {
  const without = await openPage(browser, at("impressionist.html"), {
    before: () => {
      HTMLCanvasElement.prototype.getContext = () => null;
    },
  });
  await expectStill(without.page, /no WebGL/);
  await without.page.close();
  const broken = await openPage(browser, at("impressionist.html"), {
    before: () => {
      WebGL2RenderingContext.prototype.getProgramParameter = () => false;
    },
  });
  await expectStill(broken.page, /cannot be shown/);
  await broken.page.close();
  const { page } = await openPage(browser, at("impressionist.html"));
  await page.evaluate(() => {
    const canvas = document.querySelector("wheatstone-picture").shadowRoot.querySelector("canvas");
    window.lost = canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
    window.lost.loseContext();
  });
  await page.waitForTimeout(100);
  await expectStill(page, /lost/);
  await page.evaluate(() => window.lost.restoreContext());
  await page.waitForFunction(() => document.querySelector("wheatstone-picture").matches("[data-shown]"));
  assert.equal(await alarmOf(page), "");
  await page.close();
});

await test("without JavaScript the still picture is shown, with a sentence", async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(`file://${at("impressionist.html")}`);
  assert.ok(await page.locator("wheatstone-picture img").isVisible());
  assert.match(await page.locator("noscript").innerText(), /JavaScript/);
  await context.close();
});

await browser.close();
if (failures.length > 0) {
  console.log(`${failures.length} failed`);
  process.exit(1);
}
