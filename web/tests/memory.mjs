// Memory while models are opened one after the other, drawn and stepped, and the page is loaded again now and then.
//   node memory.mjs FOLDER REFERENCES STEPS WIDTH HEIGHT [SECONDS]    (in a folder with node_modules/playwright-core)
import assert from "node:assert/strict";
import { serve, start, watched } from "./browser.mjs";

/** How much more than after the first round a later round may take. */
const GROWTH = 1.15;

const [folder, , , , , seconds = "10"] = process.argv.slice(2);
const host = await serve(folder);
const browser = await start();
const { page, inside, outcome, finish } = await watched(browser);
const session = await page.context().newCDPSession(page);
await session.send("Performance.enable");
await session.send("HeapProfiler.enable");

/** Opens every own model and two environments: bytes of the engine's memory and of the script's heap afterwards. */
async function round() {
  await page.goto(host.address);
  await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
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

const first = await round();
const end = Date.now() + 1000 * Number(seconds);
let [last, rounds] = [first, 1];
do {
  last = await round();
  rounds += 1;
} while (Date.now() < end);
const shown = ({ engine, heap }) => `${(engine / 1e6).toFixed(1)} MB of the engine, ${(heap / 1e6).toFixed(1)} MB of the script`;
console.log(`after 1 round ${shown(first)}; after ${rounds} rounds in ${seconds} s ${shown(last)}`);
for (const what of ["engine", "heap", "nodes"]) assert.ok(last[what] <= GROWTH * first[what] + 1e5, `${what}: ${last[what]}, ${first[what]} at first`);

// In one page and one instance too.
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
assert.ok(grown[1] <= GROWTH * grown[0], `the engine's memory: ${grown}`);
await finish();
await browser.close();
host.close();
