// screenshot.mjs PAGE PICTURE.png: what a page looks like in a browser.

import { openPage, startBrowser } from "./browser.mjs";

const [file, picture] = process.argv.slice(2);
const browser = await startBrowser();
const { page } = await openPage(browser, file);
await page.setViewportSize({ width: 900, height: 790 });
await page.waitForTimeout(3000);
await page.screenshot({ path: picture });
await browser.close();
