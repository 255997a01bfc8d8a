// The module in node: hashes of own models and environments after steps, the example of the package, and bad input.
//   node node.mjs FOLDER HASHES.json STEPS
import { readFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";
import assert from "node:assert/strict";

const [folder, hashes, steps] = process.argv.slice(2);
const { load } = await import(pathToFileURL(`${folder}/robohive.js`));
const { Files, Simulation, ownModels, ownEnvironments } = await load(await readFile(`${folder}/engine_bg.wasm`));

const native = JSON.parse(await readFile(hashes, "utf8"));
const names = [...ownModels(), ...ownEnvironments()];
assert.equal(names.length, Object.keys(native).length);
for (const name of names) {
  const simulation = name.includes("/") ? Simulation.environment(name, 3n) : Simulation.own(name);
  const began = performance.now();
  const taken = simulation.step(Number(steps));
  const seconds = (performance.now() - began) / 1000;
  assert.equal(`${taken} ${simulation.hash()}`, native[name], name);
  console.log(`${name}: the native hash after ${taken} steps, ${Math.round(taken / seconds)} steps a second`);
  simulation.free();
}

// A model in two files, and what is missing without the second.
const files = new Files();
const bytes = (text) => new TextEncoder().encode(text);
files.add("robot/robot.xml", bytes(`<mujoco model="two"><include file="arm.xml"/><worldbody><light pos="0 0 3"/></worldbody></mujoco>`));
assert.throws(() => Simulation.open(files, "robot/robot.xml"), /arm\.xml/);
files.add("robot/arm.xml", bytes(`<mujoco><worldbody><body><joint name="hinge" axis="0 1 0"/><geom size=".05" fromto="0 0 0 .4 0 0" type="capsule"/></body></worldbody>
  <actuator><motor name="motor" joint="hinge" ctrlrange="-3 2"/></actuator><sensor><jointpos joint="hinge"/></sensor></mujoco>`));
assert.deepEqual(files.models(), ["robot/arm.xml", "robot/robot.xml"]);
const two = Simulation.open(files, "robot/robot.xml");
assert.deepEqual([two.name, [...two.controlRanges()], two.sensors.length], ["two", [-3, 2], 1]);
two.setControl(0, 2);
two.step(100);
assert.ok(Math.abs(two.qpos[0]) > 0.01 && Math.abs(two.time - 0.2) < 1e-9);
assert.throws(() => two.setControl(1, 0), /1 controls/);
assert.throws(() => two.act(new Float64Array(1)), /not an environment/);
const picture = two.draw(64, 48);
assert.equal(picture.length, 64 * 48 * 4);
assert.ok(new Set(picture).size > 20, "something is seen");
assert.throws(() => two.draw(0, 5), /8192/);
two.stepBack();
assert.equal(two.behind, 1);

// An environment by hand, and what is refused.
const env = Simulation.environment("hive/FrankaReach-v0", 5n);
const first = env.resetTo(5n);
const bounds = env.actionBounds();
const step = env.act(new Float64Array(bounds.length / 2));
assert.ok(Number.isFinite(step.reward) && !step.terminated && first.length === env.observation().length);
assert.throws(() => env.act(new Float64Array(1)), /finite numbers/);
assert.throws(() => Simulation.environment("hive/FrankaReech-v0", 0n), /FrankaReach/);
assert.throws(() => Simulation.own("nothing"), /quadruped/);
assert.throws(() => new Files().addArchive("broken.zip", bytes("PK\u0003\u0004 and no more")), /damaged zip/);
console.log("files, controls, pictures, environments and refusals are as they should be");
