// Memory while models are opened one after the other, drawn and stepped: in one page, then with the page loaded again each time.
//   node memory.mjs FOLDER REFERENCES STEPS WIDTH HEIGHT [SECONDS]    (in a folder with node_modules/playwright-core)
import assert from "node:assert/strict";
import { serve, start, watched } from "./browser.mjs";

/** How much more than after the first rounds the last one may take. The engine's memory grows once by a tenth, in whichever round frames meet such
 *  that its largest block fits in no gap; a leak of 1.2 percent a round is found. */
const GROWTH = { engine: 1.2, heap: 1.1, nodes: 1.1 };

/** Rounds until the memory has the size that the largest models side by side need, and rounds in all. */
const FIRST = 3;
const ROUNDS = 20;

const [folder, , , , , seconds = "10"] = process.argv.slice(2);
const host = await serve(folder);
const browser = await start();
const { page, inside, outcome, finish } = await watched(browser);
const session = await page.context().newCDPSession(page);
await session.send("Performance.enable");
await session.send("HeapProfiler.enable");

async function load() {
  await page.goto(host.address);
  await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
}

/** Opens own models and an environment: bytes of the engine's memory and of the script's heap, and nodes, afterwards. */
async function round() {
  const names = ["elbow", "pile", "quadruped", "franka_table", "hive/ElbowPose-v0", "humanoid", "drape", "elbow", "pile"];
  for (const name of names) {
    const opened = await outcome((viewer, name) => {
      viewer.removeAttribute(name.includes("/") ? "own" : "environment");
      viewer.setAttribute(name.includes("/") ? "environment" : "own", name);
    }, name);
    assert.equal(opened.message, undefined, name);
    await inside((viewer) => (viewer.simulation.step(50), viewer.simulation.draw(320, 240).length));
  }
  await session.send("HeapProfiler.collectGarbage");
  const { metrics } = await session.send("Performance.getMetrics");
  const value = (name) => metrics.find((metric) => metric.name === name).value;
  return { engine: await inside(async (viewer) => (await viewer.engine()).memoryBytes()), heap: value("JSHeapUsedSize"), nodes: value("Nodes") };
}

/** Rounds until the time is up, each after `before`: the last of the first rounds and the last of all. */
async function rounds(before) {
  const seen = [];
  const end = Date.now() + 500 * Number(seconds);
  while (seen.length < ROUNDS || Date.now() < end) {
    await before();
    seen.push(await round());
  }
  return { first: seen[FIRST - 1], last: seen.at(-1), count: seen.length };
}

function judge(where, { first, last, count }, what) {
  const shown = ({ engine, heap }) => `${(engine / 1e6).toFixed(1)} MB of the engine, ${(heap / 1e6).toFixed(1)} MB of the script`;
  console.log(`${where}: after ${FIRST} rounds ${shown(first)}; after ${count} rounds ${shown(last)}`);
  for (const name of what) assert.ok(last[name] <= GROWTH[name] * first[name] + 1e5, `${where}: ${name}: ${last[name]}, ${first[name]} at first`);
}

await load();
judge("one page", await rounds(async () => {}), ["engine", "heap", "nodes"]);
// A page loaded again has a new engine, whose memory says nothing of the one before it.
judge("a page loaded again each round", await rounds(load), ["heap", "nodes"]);

// And without the element, whose frames come when they like.
await load();
const grown = await inside(async (viewer) => {
  const { Simulation, memoryBytes } = await viewer.engine();
  const names = ["elbow", "pile", "quadruped", "humanoid"];
  const all = () => {
    for (const name of names) {
      const simulation = Simulation.own(name);
      simulation.record();
      simulation.step(20);
      simulation.draw(160, 120);
      simulation.endRecording();
      simulation.save().free();
      simulation.free();
    }
    return memoryBytes();
  };
  const before = all();
  for (let k = 0; k < 8; k++) all();
  return [before, all()];
});
assert.equal(grown[1], grown[0], "the engine's memory, where no frame comes in between");
await finish();
await browser.close();
host.close();
