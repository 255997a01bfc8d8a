// The site in a browser: every page on a desktop and on a phone, light and dark. Nothing is loaded from other hosts, nothing is
// said on the console, no page is wider than the window, all pictures are there, and models are live.
//   node look.mjs SITE CHROMIUM [SCREENSHOTS]    (in a folder with node_modules/playwright-core)
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdir, readdir, readFile, stat } from "node:fs/promises";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, relative } from "node:path";

const [site, chromiumName, shots] = process.argv.slice(2);
const { chromium } = createRequire(`${process.cwd()}/`)("playwright-core");
const executablePath = execFileSync("which", [chromiumName], { encoding: "utf8" }).trim();
const types = {
  ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm",
  ".svg": "image/svg+xml", ".json": "application/json",
};
const server = createServer(async (request, response) => {
  const path = decodeURI(new URL(request.url, "http://site").pathname).replace(/\/$/, "/index.html");
  try {
    const content = await readFile(site + path);
    response.writeHead(200, { "content-type": types[extname(path)] ?? "application/octet-stream" }).end(content);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const address = `http://127.0.0.1:${server.address().port}/`;

/** Pages of the site that are not rustdoc's or the viewer's own. */
async function pages(folder) {
  const found = [];
  for (const entry of await readdir(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory() && !["api", "live"].includes(relative(site, path))) found.push(...(await pages(path)));
    // The frame of the table of contents is no page.
    else if (entry.name.endsWith(".html") && entry.name !== "toc.html") found.push(relative(site, path));
  }
  return found.sort();
}

/** Pages of which pictures are kept. */
const SHOWN = [
  "index.html", "first_steps.html", "models/own.html", "environments/index.html", "viewer.html", "web.html",
  "reference/mjcf.html", "reference/commands.html", "reference/python_environments.html", "validation/index.html",
];
const isLive = await stat(join(site, "live/engine_bg.wasm")).then(() => true, () => false);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu"] });
const all = await pages(site);
const wrong = [];
for (const [name, viewport] of [["desktop", { width: 1280, height: 800 }], ["phone", { width: 390, height: 844 }]]) {
  for (const colorScheme of ["light", "dark"]) {
    const context = await browser.newContext({ viewport, colorScheme, reducedMotion: "reduce" });
    const page = await context.newPage();
    let here = "";
    page.on("console", (line) => line.type() === "error" && wrong.push(`${here}: ${line.text()}`));
    page.on("pageerror", (error) => wrong.push(`${here}: ${error.message}`));
    page.on("request", (request) => {
      if (!request.url().startsWith(address) && !/^(data|blob):/.test(request.url())) wrong.push(`${here} asks for ${request.url()}`);
    });
    for (here of colorScheme === "light" ? all : all.filter((path) => SHOWN.includes(path))) {
      await page.goto(address + here);
      const { wide, missing } = await page.evaluate(() => ({
        wide: document.scrollingElement.scrollWidth - innerWidth,
        missing: [...document.images].filter((image) => image.complete && !image.naturalWidth).map((image) => image.src),
      }));
      if (wide > 1) wrong.push(`${here} is ${wide} pixels wider than a ${name}`);
      missing.forEach((source) => wrong.push(`${here} lacks ${source}`));
      if (shots && SHOWN.includes(here)) {
        await mkdir(shots, { recursive: true });
        await page.screenshot({ path: `${shots}/${here.replace(".html", "").replaceAll("/", "-")}-${name}-${colorScheme}.png` });
      }
    }
    await context.close();
  }
}

// Live models: the first page starts its own, others when they are asked to.
if (isLive) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  page.on("pageerror", (error) => wrong.push(error.message));
  await page.goto(address);
  await page.waitForSelector("figure.live.open", { timeout: 60000 });
  await page.waitForTimeout(1500);
  const moved = await page.evaluate(() => document.querySelector("robohive-viewer").simulation.time);
  assert.ok(moved > 0, "the model of the first page moves");
  if (shots) await page.screenshot({ path: `${shots}/live.png` });
  await page.goto(`${address}models/own.html`);
  const button = page.locator("figure.live button").nth(1);
  await button.click();
  await page.waitForSelector("figure.live.open", { timeout: 60000 });
  assert.equal(await page.locator("figure.live.open").count(), 1);
}

// Without scripts pictures stand where models would be.
const plain = await browser.newPage({ javaScriptEnabled: false });
await plain.goto(address);
assert.ok(await plain.locator("figure.live img").first().isVisible());
await browser.close();
server.close();
assert.deepEqual(wrong, []);
console.log(`${all.length} pages on a desktop and a phone: nothing from other hosts, nothing wide${isLive ? ", models live" : ""}`);
