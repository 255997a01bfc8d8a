// The page in a browser: opens models, drops files, runs, drags, moves sliders, switches cameras, and looks at pixels.
//   node page.mjs FOLDER HASHES.json STEPS CHROMIUM [SCREENSHOTS]    (in a folder with node_modules/playwright-core)
import { createServer } from "node:http";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { extname } from "node:path";
import { createRequire } from "node:module";
import { execFileSync } from "node:child_process";
import assert from "node:assert/strict";

const [folder, hashes, steps, chromiumName, shots] = process.argv.slice(2);
const { chromium } = createRequire(`${process.cwd()}/`)("playwright-core");
const executablePath = execFileSync("which", [chromiumName], { encoding: "utf8" }).trim();
const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".json": "application/json" };
const server = createServer(async (request, response) => {
  const path = new URL(request.url, "http://page").pathname.replace(/\/$/, "/index.html");
  try {
    const content = await readFile(folder + path);
    response.writeHead(200, { "content-type": types[extname(path)] ?? "application/octet-stream" }).end(content);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const address = `http://127.0.0.1:${server.address().port}/`;

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu"] });
const page = await browser.newPage({ viewport: { width: 900, height: 560 } });
const complaints = [];
page.on("console", (line) => ["error", "warning"].includes(line.type()) && complaints.push(line.text()));
page.on("pageerror", (error) => complaints.push(error.message));

/** Runs `action(viewer, argument)` in the page. */
const inside = (action, argument) =>
  page.evaluate(`(${action})(document.querySelector("robohive-viewer"), ${JSON.stringify(argument) ?? "undefined"})`);
const opened = (hash) => inside((viewer, hash) => new Promise((done) => {
  viewer.addEventListener("robohive-open", (event) => done(event.detail), { once: true });
  viewer.addEventListener("robohive-message", (event) => done(event.detail), { once: true });
  location.hash = hash;
}), hash);
/** Distinct colours of the canvas, once a frame has been drawn. */
const colours = () => inside((viewer) => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
  const canvas = viewer.shadowRoot.querySelector("canvas");
  const words = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
  done(new Set(words).size);
}))));
const shoot = async (name) => shots && (await mkdir(shots, { recursive: true }), writeFile(`${shots}/${name}.png`, await page.screenshot()));

const began = Date.now();
await page.goto(address);
await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
console.log(`first model after ${Date.now() - began} ms`);

// Every model and environment of our own: a picture, and the native hash.
const native = JSON.parse(await readFile(hashes, "utf8"));
for (const [name, expected] of Object.entries(native)) {
  await opened(name.includes("/") ? `environment=${name}&seed=3` : `own=${name}`);
  assert.ok((await colours()) > 20, `${name} is drawn`);
  const found = await inside((viewer, steps) => `${viewer.simulation.step(steps)} ${viewer.simulation.hash()}`, Number(steps));
  assert.equal(found, expected, name);
  await shoot(name.replace("/", "-"));
}
console.log(`${Object.keys(native).length} models and environments: drawn, and the native hashes after ${steps} steps`);

// Run and pause by the keyboard, orbit by a drag, cameras and sliders.
await opened("own=franka_table");
await page.locator("robohive-viewer canvas").focus();
await page.keyboard.press("Space");
await page.waitForTimeout(400);
assert.ok(await inside((viewer) => viewer.simulation.running && viewer.simulation.time > 0));
await page.keyboard.press("Space");
const before = await inside((viewer) => viewer.simulation.time);
await page.keyboard.press("ArrowLeft");
assert.ok((await inside((viewer) => viewer.simulation.time)) < before, "a state of the past is shown");
await page.locator("[data-does=side]").click();
await page.locator(".side input[type=range]").first().press("End");
const highest = await inside((viewer) => [viewer.simulation.controls[0], viewer.simulation.controlRanges()[1]]);
assert.ok(Math.abs(highest[0] - highest[1]) < 0.01, `the slider is at its end: ${highest}`);
await page.locator("[data-does=side]").click();
await page.locator("[data-does=camera]").selectOption({ index: 1 });
assert.ok((await colours()) > 20);

// A body is selected, pulled and released.
await opened("own=pile");
const box = await page.locator("robohive-viewer canvas").boundingBox();
let label;
for (let k = 0; k < 40 && !label; k++) {
  const at = [box.x + box.width / 2 + (k % 8) * 20 - 80, box.y + box.height / 2 + Math.floor(k / 8) * 30 - 60];
  const told = inside((viewer) => new Promise((done) => viewer.addEventListener("robohive-select", (event) => done(event.detail ?? null), { once: true }) || setTimeout(done, 2000, null)));
  await page.mouse.dblclick(...at);
  if ((label = await told)) {
    await page.keyboard.press("Space");
    const height = () => inside((viewer) => [...viewer.simulation.qpos].filter((_, i) => i % 7 === 2).reduce((a, b) => Math.max(a, b)));
    const low = await height();
    await page.keyboard.down("Control");
    await page.mouse.move(...at);
    await page.mouse.down({ button: "right" });
    await page.mouse.move(at[0], at[1] - 250, { steps: 5 });
    await page.waitForTimeout(700);
    assert.ok((await height()) > low + 0.02, `${label} was pulled up`);
    await shoot("pulled");
    await page.mouse.up({ button: "right" });
    await page.keyboard.up("Control");
  }
}
assert.ok(label, "some body is near the middle");

// Files: a model in parts, what is missing without one, and what is broken.
const file = (name, text) => ({ name, mimeType: "text/xml", buffer: Buffer.from(text) });
const message = () => inside((viewer) => viewer.shadowRoot.querySelector(".message").textContent);
const chosen = async (...files) => (await page.locator("#files").setInputFiles(files), page.waitForTimeout(300));
const arm = `<mujoco><worldbody><light pos="0 0 3"/><body><joint axis="0 1 0"/><geom mesh="link" type="mesh"/></body></worldbody></mujoco>`;
const parts = file("arm.xml", arm.replace("<worldbody>", `<asset><mesh file="link.obj"/></asset><worldbody>`));
await chosen(parts);
assert.match(await message(), /link\.obj/);
const mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
await chosen(parts, file("link.obj", mesh));
assert.equal(await message(), "");
assert.ok((await colours()) > 3, "the flat faces of the mesh are seen");
await chosen(file("bad.xml", "<mujoco>\n  <worldbody><geom sise='1'/></worldbody></mujoco>"));
assert.match(await message(), /bad\.xml:2:\d+.*sise/);
await shoot("bad");
await chosen(file("broken.zip", "PK\u0003\u0004 and no more"));
assert.match(await message(), /damaged zip/);
await chosen(file("notes.txt", "no model"));
assert.match(await message(), /none of 1 files is a model/);
assert.match(await opened("own=nothing"), /quadruped/);

// Frames a second while things move, at 640 x 360.
await page.setViewportSize({ width: 640, height: 400 });
for (const name of ["franka_table", "elbow", "quadruped"]) {
  await opened(`own=${name}&running`);
  const frames = await inside((viewer) => new Promise((done) => {
    let count = 0;
    const start = performance.now();
    const frame = () => {
      count += 1;
      if (performance.now() - start > 2000) done((count * 1000) / (performance.now() - start));
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }));
  console.log(`${name}: ${frames.toFixed(0)} frames a second while it moves`);
}
assert.deepEqual(complaints.filter((text) => !/404|willReadFrequently/.test(text)), []);
console.log("keys, drags, sliders, cameras, pulls, files and messages are as they should be");
await browser.close();
server.close();
