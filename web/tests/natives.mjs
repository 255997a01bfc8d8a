// A thread of node.mjs: models and environments beside the hashes and pictures of native builds.
import { readFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";
import { workerData } from "node:worker_threads";
import assert from "node:assert/strict";
import { stepsOf } from "./expected.mjs";

const { folder, references, width, height, mine } = workerData;
const { load } = await import(pathToFileURL(`${folder}/node.js`));
const { Simulation } = await load();
const native = JSON.parse(await readFile(`${references}/hashes.json`, "utf8"));
for (const name of mine) {
  const simulation = name.includes("/") ? Simulation.environment(name, 3n) : Simulation.own(name);
  const began = performance.now();
  const taken = simulation.step(stepsOf(native[name]));
  const seconds = (performance.now() - began) / 1000;
  assert.equal(`${taken} ${simulation.hash()}`, native[name], name);
  const picture = Buffer.from(simulation.draw(width, height));
  assert.ok(picture.equals(await readFile(`${references}/${name.replace("/", "-")}.rgba`)), `${name} looks as native`);
  console.log(`${name}: the native hash and picture after ${taken} steps, ${Math.round(taken / seconds)} steps a second`);
  simulation.free();
}
