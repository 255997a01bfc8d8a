// The viewer in a browser: with WebGPU, with WebGL 2 alone, with neither. Pictures are compared with those of the CPU, states with
// native ones, and nothing may be complained about.
//   node viewer.mjs FOLDER REFERENCES STEPS WIDTH HEIGHT [SCREENSHOTS]    (in a folder with node_modules/playwright-core)
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { brotliCompressSync, constants } from "node:zlib";
import assert from "node:assert/strict";
import { serve, start } from "./browser.mjs";
import { stepsOf } from "./expected.mjs";

const [folder, references, , , , shots] = process.argv.slice(2);
const host = await serve(folder);
const native = JSON.parse(await readFile(`${references}/hashes.json`, "utf8"));
const models = Object.keys(native).filter((name) => !name.includes("/"));

/** Most bytes of what the viewer loads, as a host that compresses sends it. */
const MOST = 4e6;
const loaded = await Promise.all(["viewer.html", "viewer-page.js", "api.js", "files.js", "viewer_bg.wasm", "viewer.js"].map((name) => readFile(`${folder}/${name}`)));
const packed = loaded.map((bytes) => brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } }).length);
const bytes = packed.reduce((a, b) => a + b, 0);
console.log(`the viewer has ${(bytes / 1e6).toFixed(2)} MB by brotli`);
assert.ok(bytes <= MOST, `more than ${MOST / 1e6} MB by brotli`);

/**
 * What `validation/pictures.toml` asks of pictures beside each other, of the quadruped's steep shadows, and of skies by WebGPU
 * on SwiftShader, which gives one slice of the sky's cylinder a single direction (Mesa's driver does not) [dB].
 */
const bar = (name, way) => (name === "quadruped" || (way === "webgpu" && SKIES.includes(name)) ? 35 : 40);
const SKIES = ["franka_table", "kitchen", "reach"];
/** Columns and rows at the left top where the window writes that time stands still. */
const LABEL = [130, 36];
/** The model whose warnings stand over the lower half of its picture. */
const WARNED = "yard";
/** Longest wait for something to be drawn: software drivers take a second for a picture [ms]. */
const PATIENCE = 60_000;

const VULKAN = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-angle=swiftshader", "--use-vulkan=swiftshader"];
const WAYS = {
  webgpu: [...VULKAN, "--enable-unsafe-swiftshader"],
  webgl2: ["--enable-unsafe-swiftshader"],
  neither: ["--disable-gpu", "--disable-3d-apis"],
};

/** A page that is drawn in one of these ways, and what it has complained about. */
async function open(way) {
  const browser = await start({ args: WAYS[way] });
  const page = await browser.newPage({ viewport: { width: 1000, height: 520 } });
  const complaints = [];
  page.on("console", (line) => line.type() === "error" && complaints.push(line.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  const began = Date.now();
  await page.goto(`${host.address}viewer.html#model=quadruped`);
  await page.waitForFunction(() => globalThis.robohive, null, { timeout: PATIENCE });
  console.log(`${way}: opened after ${Date.now() - began} ms`);
  return { browser, page, complaints };
}

const shoot = async (page, name) => shots && (await mkdir(shots, { recursive: true }), writeFile(`${shots}/${name}.png`, await page.screenshot()));

/** Peak signal-to-noise ratio of what the page shows beside the picture by the CPU [dB]. */
async function likeness(page, name) {
  const [left, top, width, height] = await page.evaluate(() => {
    const box = document.querySelector("canvas").getBoundingClientRect();
    const [x, y, width, height] = robohive.viewer.area();
    return [box.left + x, box.top + y, width, height].map(Math.round);
  });
  const png = await page.screenshot({ clip: { x: left, y: top, width, height } });
  return page.evaluate(async ([png, width, height, label, free]) => {
    const bytes = Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const context = new OffscreenCanvas(width, height).getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const shown = context.getImageData(0, 0, width, height).data;
    const expected = robohive.viewer.picture(width, height);
    let [sum, count] = [0, 0];
    for (let at = 0; at < expected.length; at++) {
      const [column, row] = [(at >> 2) % width, Math.floor((at >> 2) / width)];
      if ((column < label[0] && row < label[1]) || row > free * height) continue;
      sum += (shown[at] - expected[at]) ** 2;
      count += 1;
    }
    return 10 * Math.log10((255 * 255 * count) / Math.max(sum, 1));
  }, [png.toString("base64"), width, height, LABEL, name === WARNED ? 0.5 : 1]);
}

/** Waits until the page shows what the CPU draws. */
async function drawn(page, name, way) {
  const end = Date.now() + PATIENCE;
  let best = 0;
  while (best < bar(name, way) && Date.now() < end) best = Math.max(best, await likeness(page, name));
  assert.ok(best >= bar(name, way), `${name}: the page shows what the CPU draws only within ${best.toFixed(1)} dB`);
  return best;
}

const go = (page, hash) => page.evaluate((hash) => robohive.follow(new URLSearchParams(hash)), hash);
const message = (page) => page.locator("#message").textContent();
const file = (name, text) => ({ name, mimeType: "text/xml", buffer: Buffer.from(text) });
const chosen = async (page, said, ...files) => {
  await page.locator("#files").setInputFiles(files);
  await page.waitForFunction((said) => new RegExp(said).test(document.getElementById("message").textContent), said, { timeout: PATIENCE });
};

/** Every model by the GPU or the CPU, its state, commands, files, and a lost context. */
async function window(way) {
  const { browser, page, complaints } = await open(way);
  if (way === "webgpu") await page.evaluate(() => robohive.viewer.useGpu(true));
  const likenesses = {};
  for (const name of models) {
    await go(page, `model=${name}`);
    likenesses[name] = (await drawn(page, name, way)).toFixed(1);
    await shoot(page, `${way}-${name}`);
  }
  console.log(`${way}: drawn by ${(await page.evaluate(() => robohive.viewer.drawnBy())).join("; ")}: ${JSON.stringify(likenesses)} dB`);
  if (way === "webgpu") assert.notEqual((await page.evaluate(() => robohive.viewer.drawnBy()))[0], "CPU");

  for (const [name, expected] of Object.entries(native)) {
    await go(page, name.includes("/") ? `environment=${name}&seed=3` : `model=${name}`);
    const found = await page.evaluate((steps) => `${robohive.viewer.step(steps)} ${robohive.viewer.hash()}`, stepsOf(expected));
    assert.equal(found, expected, name);
  }
  console.log(`${way}: ${Object.keys(native).length} models and environments have the native hashes`);

  await go(page, "model=pile");
  const unknown = await page.evaluate(() => robohive.module.commands().filter((name) => !robohive.viewer.perform(name)));
  assert.deepEqual(unknown, []);
  await go(page, "model=pile&running");
  await page.waitForFunction(() => robohive.viewer.time > 0.05, null, { timeout: PATIENCE });
  await page.locator("#run").click();
  await page.waitForFunction(() => !robohive.viewer.running);
  await page.waitForFunction(() => /pile, paused at/.test(document.getElementById("status").textContent));
  await drawn(page, "pile");

  await replays(page);
  await policies(page);
  await files(page);
  await lost(page, way);
  assert.deepEqual(complaints, []);
  await browser.close();
}

/** Recorded states in place of a simulation, as the light page records them. */
async function replays(page) {
  const recorded = await page.evaluate(async () => {
    const { load } = await import("./api.js");
    const simulation = (await load()).Simulation.own("pile");
    simulation.record();
    simulation.step(40);
    return [...simulation.endRecording()];
  });
  await go(page, "model=pile");
  await page.locator("#files").setInputFiles({ name: "states.npz", mimeType: "application/zip", buffer: Buffer.from(recorded) });
  await page.waitForFunction(() => robohive.viewer.perform("One step forward") && robohive.viewer.time > 0.07, null, { timeout: PATIENCE });
  assert.equal(await page.evaluate(() => (robohive.viewer.step(100), robohive.viewer.time)), await page.evaluate(() => robohive.viewer.time), "it ends at the last state");
  assert.equal(await message(page), "");
  await drawn(page, "pile");
}

/** A policy is for the environment that is open; one that is none is refused. */
async function policies(page) {
  await go(page, "environment=hive/ElbowPose-v0&seed=3");
  assert.deepEqual(await page.evaluate(() => [robohive.viewer.environment, String(robohive.viewer.seed)]), ["hive/ElbowPose-v0", "3"]);
  await chosen(page, "pickle|policy", file("policy.pickle", "no pickle"));
  assert.match(await page.evaluate(() => robohive.viewer.summary()), /ElbowPose/, "what was open stays");
  await go(page, "model=pile");
  assert.equal(await page.evaluate(() => robohive.viewer.environment), undefined);
}

/** A model in parts: what is missing is listed, and added. What is broken is said. */
async function files(page) {
  const body = `<body><joint axis="0 1 0"/><geom mesh="link" type="mesh"/></body>`;
  const arm = `<mujoco model="arm"><compiler meshdir="meshes"/><asset><mesh file="link.obj"/></asset><worldbody><light pos="0 0 3"/>${body}</worldbody></mujoco>`;
  const mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  await chosen(page, "1 missing[^]*meshes/link\\.obj", file("arm.xml", arm));
  await chosen(page, "^$", file("link.obj", mesh));
  assert.match(await page.evaluate(() => robohive.viewer.summary()), /^arm\.xml/);
  await drawn(page, "arm");
  await chosen(page, "bad\\.xml:2:\\d+.*sise", file("bad.xml", "<mujoco>\n  <worldbody><geom sise='1'/></worldbody></mujoco>"));
  assert.match(await page.evaluate(() => robohive.viewer.summary()), /^arm\.xml/, "what was open stays");
  await chosen(page, "damaged zip", file("broken.zip", "PK\u0003\u0004 and no more"));
  await chosen(page, "none of 1 files is a model", file("notes.txt", "no model"));
  const drop = ([name, text]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], name));
    document.querySelector("canvas").dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
  };
  await page.evaluate(drop, ["dropped.xml", "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>"]);
  await page.waitForFunction(() => /^dropped\.xml/.test(robohive.viewer.summary()), null, { timeout: PATIENCE });
  assert.equal(await message(page), "");
}

/** A context that the browser takes away: a message, and what was open is drawn again. */
async function lost(page, way) {
  if (way !== "webgl2") return;
  await page.evaluate(() => robohive.viewer.perform("One step forward"));
  const before = await page.evaluate(() => robohive.viewer.hash());
  await page.evaluate(() => document.querySelector("canvas").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext());
  await page.waitForFunction(() => /Nothing can be drawn any more/.test(document.getElementById("message").textContent));
  await page.locator("#message button").click();
  await page.waitForFunction(() => document.getElementById("message").hidden, null, { timeout: PATIENCE });
  assert.equal(await page.evaluate(() => robohive.viewer.hash()), before);
  await drawn(page, "dropped");
}

/** The element in place of the window. */
async function plain() {
  const { browser, page, complaints } = await open("neither");
  assert.match(await page.locator("#status").textContent(), /plain viewer: this browser has neither/);
  await page.waitForFunction(() => robohive.viewer.simulation);
  const colours = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
    const canvas = robohive.viewer.shadowRoot.querySelector("canvas");
    done(new Set(new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size);
  }))));
  assert.ok(colours > 20, `${colours} colours`);
  const found = await page.evaluate((steps) => `${robohive.viewer.simulation.step(steps)} ${robohive.viewer.simulation.hash()}`, stepsOf(native.quadruped));
  assert.equal(found, native.quadruped);
  await shoot(page, "neither-quadruped");
  assert.deepEqual(complaints.filter((text) => !/willReadFrequently/.test(text)), []);
  await browser.close();
  console.log("neither: the plain element draws");
}

/** What was loaded once is there without a network. */
async function offline() {
  const { browser, page } = await open("webgl2");
  const kept = async () => {
    for (const name of await caches.keys()) if (await (await caches.open(name)).match("viewer_bg.wasm")) return true;
    return false;
  };
  await page.waitForFunction(kept, null, { timeout: PATIENCE });
  await page.context().setOffline(true);
  await page.reload();
  await page.waitForFunction(() => globalThis.robohive, null, { timeout: PATIENCE });
  assert.match(await page.evaluate(() => robohive.viewer.summary()), /^quadruped/);
  await browser.close();
  console.log("offline: the window opens");
}

await window("webgl2");
await window("webgpu");
await plain();
await offline();
host.close();
