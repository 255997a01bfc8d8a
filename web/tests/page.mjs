// The page in a browser: every model and environment of our own beside the native build, keys, sliders, cameras, pulls, recordings,
// links, and frames a second.
//   node page.mjs FOLDER REFERENCES STEPS WIDTH HEIGHT [SCREENSHOTS]    (in a folder with node_modules/playwright-core)
import { mkdir, readFile, writeFile } from "node:fs/promises";
import assert from "node:assert/strict";
import { serve, start, watched } from "./browser.mjs";
import { stepsOf } from "./expected.mjs";

const [folder, references, , width, height, shots] = process.argv.slice(2);
const host = await serve(folder);
const browser = await start();
const { page, inside, outcome, message, colours, finish } = await watched(browser, { expected: /404/ });
let times = 0;
/** Follows a link, which differs from the last one. */
const opened = (hash) => outcome((viewer, hash) => (location.hash = hash), `${hash}&times=${times++}`);
const shoot = async (name) => shots && (await mkdir(shots, { recursive: true }), writeFile(`${shots}/${name}.png`, await page.screenshot()));
const part = (selector) => page.locator("robohive-viewer").locator(selector);

const began = Date.now();
await page.goto(host.address);
await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
await colours();
console.log(`first picture after ${Date.now() - began} ms`);

// Every model and environment of our own: a picture, the native hash, and the native picture to the last bit.
const native = JSON.parse(await readFile(`${references}/hashes.json`, "utf8"));
for (const [name, expected] of Object.entries(native)) {
  const { message: trouble } = await opened(name.includes("/") ? `environment=${name}&seed=3` : `model=${name}`);
  assert.equal(trouble, undefined, name);
  assert.ok((await colours()) > 20, `${name} is drawn`);
  const [found, picture] = await inside((viewer, [steps, width, height]) => {
    const { simulation } = viewer;
    const taken = simulation.step(steps);
    const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    [canvas.canvas.width, canvas.canvas.height] = [width, height];
    canvas.putImageData(new ImageData(new Uint8ClampedArray(simulation.draw(width, height)), width, height), 0, 0);
    const { data } = canvas.getImageData(0, 0, width, height);
    let text = "";
    for (let k = 0; k < data.length; k += 8192) text += String.fromCharCode(...data.subarray(k, k + 8192));
    return [`${taken} ${simulation.hash()}`, btoa(text)];
  }, [stepsOf(expected), Number(width), Number(height)]);
  assert.equal(found, expected, name);
  const seen = await readFile(`${references}/${name.replace("/", "-")}.rgba`);
  assert.ok(Buffer.from(picture, "base64").equals(seen), `${name} looks as native`);
  await shoot(name.replace("/", "-"));
}
console.log(`${Object.keys(native).length} models and environments: native hashes and pictures`);

// The keyboard alone: from the picture to the bar and back, running, stepping back, cameras, a body that is selected and pulled.
await opened("model=franka_table");
await part("canvas").focus();
await page.keyboard.press("Space");
await page.waitForFunction(() => document.querySelector("robohive-viewer").simulation.time > 0.05);
assert.equal(await part("[data-does=run]").textContent(), "Pause");
await page.keyboard.press("Space");
const state = (get) => inside(get);
const before = await state((viewer) => viewer.simulation.time);
await page.keyboard.press("ArrowLeft");
assert.ok((await state((viewer) => viewer.simulation.time)) < before, "a state of the past is shown");
await page.keyboard.press("BracketRight");
assert.equal(await state((viewer) => viewer.simulation.camera), 0);
await page.waitForFunction(() => document.querySelector("robohive-viewer").shadowRoot.querySelector("[data-does=camera]").value === "0");
await page.keyboard.press("Escape");
const picture = () => inside((viewer) => [...viewer.simulation.draw(64, 48)].join());
const from = await picture();
await page.keyboard.press("Shift+ArrowRight");
const turned = await picture();
await page.keyboard.press("Control+ArrowUp");
const moved = await picture();
await page.keyboard.press("Shift+PageUp");
assert.equal(new Set([from, turned, moved, await picture()]).size, 4, "the camera turns, moves and comes nearer");
const focused = () => inside((viewer) => viewer.shadowRoot.activeElement?.dataset.does);
await page.keyboard.press("Tab");
assert.equal(await focused(), "run");
while ((await focused()) !== "side") await page.keyboard.press("Tab");
await page.keyboard.press("Enter");
await part(".side input[type=range]").first().press("End");
const highest = await inside((viewer) => [viewer.simulation.controls[0], viewer.simulation.controlRanges()[1]]);
assert.ok(Math.abs(highest[0] - highest[1]) < 0.01, `the slider is at its end: ${highest}`);
await part("[data-does=side]").click();
await part("[data-does=camera]").selectOption({ index: 1 });
assert.equal(await state((viewer) => viewer.simulation.camera), 0);
assert.ok((await colours()) > 20);
await opened("model=pile");
await inside((viewer) => viewer.simulation.selectBody(viewer.simulation.names("body").length - 1));
await part("canvas").focus();
const height_of = () => inside((viewer) => viewer.simulation.array("xpos").values.at(-1));
const resting = await height_of();
for (let k = 0; k < 12; k++) await page.keyboard.press("Control+Shift+ArrowUp", { delay: 0 });
await page.keyboard.down("Control");
await page.keyboard.down("Shift");
for (let k = 0; k < 12; k++) await page.keyboard.press("ArrowUp");
await page.waitForTimeout(200);
assert.ok((await height_of()) > resting + 0.01, "the selected body is lifted while time stands still");
await page.keyboard.up("Shift");
await page.keyboard.up("Control");

// A body is selected by a double click, pulled and released.
await opened("model=pile");
await inside((viewer) => viewer.simulation.step(500));
const box = await part("canvas").boundingBox();
let label;
for (let k = 0; k < 40 && !label; k++) {
  const at = [box.x + box.width / 2 + (k % 8) * 20 - 80, box.y + box.height / 2 + Math.floor(k / 8) * 30 - 60];
  const told = inside((viewer) => new Promise((done) => viewer.addEventListener("pick", (event) => done(event.detail.body ?? null), { once: true }) || setTimeout(done, 2000, null)));
  await page.mouse.dblclick(...at);
  if ((label = await told)) {
    await page.keyboard.press("Space");
    const highest = () => inside((viewer) => [...viewer.simulation.qpos].filter((_, i) => i % 7 === 2).reduce((a, b) => Math.max(a, b)));
    const low = await highest();
    await page.keyboard.down("Control");
    await page.mouse.move(...at);
    await page.mouse.down({ button: "right" });
    await page.mouse.move(at[0], at[1] - 250, { steps: 5 });
    await page.waitForFunction((low) => {
      const { qpos } = document.querySelector("robohive-viewer").simulation;
      return qpos.filter((_, i) => i % 7 === 2).some((z) => z > low + 0.02);
    }, low);
    await shoot("pulled");
    await page.mouse.up({ button: "right" });
    await page.keyboard.up("Control");
  }
}
assert.ok(label, "some body is near the middle");

// States and a video are recorded and kept as files.
await opened("model=elbow&running");
const kept = page.waitForEvent("download");
await part("[data-does=record]").click();
await page.waitForFunction(() => document.querySelector("robohive-viewer").simulation.recorded > 50);
await part("[data-does=record]").click();
const archive = await kept;
assert.match(archive.suggestedFilename(), /elbow.*\.states\.npz$/);

// What was recorded is shown again, with a slider.
await page.locator("#files").setInputFiles({ name: "states.npz", mimeType: "application/zip", buffer: await readFile(await archive.path()) });
await page.waitForFunction(() => document.querySelector("robohive-viewer").simulation.states > 50);
await part("[data-does=seek]").press("End");
assert.ok(await state(({ simulation }) => simulation.state === simulation.states - 1 && simulation.time > 0.05));
assert.equal(await message(), "");
await opened("model=pile");
await part("[data-does=seek]").waitFor({ state: "hidden" });
await opened("model=elbow&running");
const filmed = page.waitForEvent("download");
await part("[data-does=film]").click();
await page.waitForTimeout(1500);
await part("[data-does=film]").click();
const film = await filmed;
assert.match(film.suggestedFilename(), /elbow.*\.film\.(webm|mp4)$/);
const shown = await inside(async (viewer, bytes) => {
  const video = document.createElement("video");
  video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0))]));
  await new Promise((done, failed) => { video.onloadeddata = done; video.onerror = () => failed(new Error("no video")); });
  return [video.videoWidth, video.videoHeight];
}, (await readFile(await film.path())).toString("base64"));
assert.ok(shown[0] > 800 && shown[1] > 400, `a video of ${shown}`);

// Links to cameras, and to what does not exist.
await opened("model=quadruped&camera=track");
assert.equal(await state((viewer) => viewer.simulation.cameras()[viewer.simulation.camera]), "track");
assert.match((await opened("model=nothing.xml")).message, /no such file/);
assert.match((await opened("environment=hive/Nothing")).message, /hive/);
await shoot("nothing");
assert.match(await message(), /hive/);

// Frames a second while things move, at 640 x 360.
for (const name of ["franka_table", "elbow", "quadruped"]) {
  await opened(`model=${name}&running`);
  await inside((viewer) => Object.assign(viewer.style, { width: "640px", height: "360px" }));
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
await finish();
await browser.close();
host.close();
console.log("keys, sliders, cameras, pulls, recordings and links are as they should be");
