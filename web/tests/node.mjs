// The module in node: hashes and pictures of own models and environments after steps, the interface, bad input.
//   node node.mjs FOLDER REFERENCES STEPS WIDTH HEIGHT
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { availableParallelism, tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Worker } from "node:worker_threads";
import { brotliCompressSync, constants } from "node:zlib";
import assert from "node:assert/strict";
import { boxMesh, zip } from "./zip.mjs";

/** Most bytes of the module as a host that compresses sends it. */
const MOST = 4e6;

const [folder, references, , ...sides] = process.argv.slice(2);
const [width, height] = sides.map(Number);
const module = await readFile(`${folder}/engine_bg.wasm`);
const packed = brotliCompressSync(module, { params: { [constants.BROTLI_PARAM_QUALITY]: 9, [constants.BROTLI_PARAM_SIZE_HINT]: module.length } });
console.log(`the module has ${(module.length / 1e6).toFixed(2)} MB, ${(packed.length / 1e6).toFixed(2)} MB by brotli`);
assert.ok(packed.length < MOST, `more than ${MOST / 1e6} MB by brotli`);

const { instance, load, MissingFiles, openFile, openFiles, openText, openWith } = await import(pathToFileURL(`${folder}/node.js`));
const { Files, Simulation, ownModels, ownEnvironments } = await load();

const native = JSON.parse(await readFile(`${references}/hashes.json`, "utf8"));
const [names, known] = [Object.keys(native), new Set([...ownModels(), ...ownEnvironments()])];
assert.ok(names.every((name) => known.has(name)) && ownModels().every((name) => name in native));
const count = availableParallelism();
await Promise.all(Array.from({ length: count }, (_, k) => {
  const mine = names.filter((_, place) => place % count === k);
  const worker = new Worker(new URL("natives.mjs", import.meta.url), { workerData: { folder, references, width, height, mine } });
  return new Promise((done, failed) => worker.on("error", failed).on("exit", done));
}));

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
assert.throws(() => new Files().addArchive("broken.zip", bytes("PK\u0003\u0004 and no more")), /broken\.zip: a damaged zip/);

// Elements and arrays by name, states saved and restored to the last bit.
const humanoid = Simulation.own("humanoid");
assert.equal(humanoid.names("joint").length, humanoid.array("jnt_type").values.length);
const [body] = humanoid.names("body").slice(1);
assert.equal(humanoid.id("body", body), 1);
assert.deepEqual([...humanoid.array("xpos").shape], [humanoid.names("body").length, 3]);
assert.throws(() => humanoid.array("xposs"), /did you mean "xpos"/);
assert.throws(() => humanoid.id("body", `${body}x`), new RegExp(body));
assert.throws(() => humanoid.names("bodies"), /body, joint/);
humanoid.step(200);
const [saved, archive] = [humanoid.save(), humanoid.stateBytes()];
humanoid.step(100);
const there = humanoid.hash();
humanoid.step(50);
humanoid.restore(saved);
humanoid.step(100);
assert.equal(humanoid.hash(), there, "the steps after a saved state are those that followed it");
humanoid.restoreBytes(archive);
humanoid.step(100);
assert.equal(humanoid.hash(), there, "after one in an archive too");
humanoid.stepBack();
humanoid.running = true;
assert.ok(humanoid.advance(0.05, 1000) > 0);
assert.throws(() => two.restore(saved), /another model|not taken of this model/);
assert.throws(() => two.restoreBytes(archive), /qpos|another number/);
assert.throws(() => two.restoreBytes(bytes("no archive")), Error);
assert.throws(() => two.write("qpos", [NaN]), /no number/);
assert.throws(() => two.write("qpos", [1, 2]), /another length/);
assert.throws(() => two.write("xpos", [1]), /cannot be written/);
two.write("qpos", [0.5]);
assert.equal(two.qpos[0], 0.5);
assert.throws(() => two.resetToKey(0), /0 keyframes/);
assert.throws(() => two.sensor("nothing"), /no sensor/);
assert.throws(() => env.save(), /environment/);

// Depth and segmentation.
const depth = humanoid.drawDepth(32, 24);
assert.ok(depth.length === 32 * 24 && depth.every((distance) => distance > 0));
assert.ok(new Set(humanoid.drawSegmentation(32, 24)).size > 2);

// Recordings: one row a step, wherever steps are taken.
const falling = Simulation.own("pile");
falling.record();
falling.step(10);
falling.running = true;
const advanced = falling.advance(0.1, 10_000);
assert.equal(falling.recorded, 10 + advanced);
const rows = 10 + advanced;
const kept = falling.qpos;
assert.throws(() => falling.replay("states.npz", bytes("PK")), /end the recording first/);
const recorded = falling.endRecording();
assert.throws(() => falling.endRecording(), /nothing is recorded/);
env.record();
env.resetTo(1n);
env.act(new Float64Array(bounds.length / 2));
assert.equal(env.recorded, 1);
assert.ok(rows > 10);

// Recorded states are shown again, a second recording beside the first.
const again = Simulation.own("pile");
again.replay("states.npz", recorded);
assert.deepEqual([again.states, again.state, again.difference], [rows, 0, undefined]);
again.seek(rows - 2);
assert.equal(again.step(1), 1);
assert.equal(again.state, rows - 1);
const last = again.qpos;
again.endReplay();
assert.equal(again.states, 0);
assert.equal(again.step(1), 1);
assert.ok(again.qpos.every((value, k) => Math.abs(value - kept[k]) < 1e-9), "it goes on from the last recorded state");
assert.ok(last.some((value, k) => value !== kept[k]));
const other = Simulation.own("pile");
const lifted = other.qpos;
lifted[2] += 0.25;
other.write("qpos", lifted);
other.record();
other.step(rows);
again.replay("first.npz", recorded);
again.replay("second.npz", other.endRecording());
again.seek(0);
assert.ok(Math.abs(again.difference - 0.25) < 1e-12, `${again.difference}`);
assert.throws(() => Simulation.own("elbow").replay("states.npz", recorded), /states\.npz[^]*another model|states\.npz/);
assert.throws(() => again.replay("broken.npz", bytes("PK\u0003\u0004 and no more")), /broken\.npz/);

// Files from the disk, from a function, without their folders, and in archives.
const place = await mkdtemp(join(tmpdir(), "robohive-"));
const scene = `<mujoco><compiler meshdir="meshes"/><asset><mesh file="box.stl"/></asset><include file="parts/arm.xml"/></mujoco>`;
const part = `<mujoco><worldbody><light pos="0 0 3"/><body><freejoint/><geom type="mesh" mesh="box"/></body></worldbody></mujoco>`;
await writeFile(join(place, "alone.xml"), part.replace(/<geom.*?>/, `<geom size=".1"/>`));
assert.equal((await openFile(join(place, "alone.xml"))).names("body").length, 2);
await writeFile(join(place, "scene.zip"), zip([["a/scene.xml", scene], ["a/parts/arm.xml", part], ["a/meshes/box.stl", boxMesh(0.1, 0.2, 0.3)]]));
const zipped = await openFile(join(place, "scene.zip"));
assert.equal(zipped.array("mesh_vertnum").values[0], 8);
const asked = [];
const provided = { "scene.xml": scene, "parts/arm.xml": part, "meshes/box.stl": boxMesh(0.1, 0.2, 0.3) };
const read = (path) => (asked.push(path), provided[path] && (typeof provided[path] === "string" ? bytes(provided[path]) : provided[path]));
const read_from = await openWith("scene.xml", read);
read_from.step(10);
zipped.step(10);
assert.equal(read_from.hash(), zipped.hash());
assert.deepEqual(asked.sort(), ["meshes/box.stl", "parts/arm.xml", "scene.xml"]);
const flat = [["scene.xml", scene], ["arm.xml", part], ["box.stl", boxMesh(0.1, 0.2, 0.3)]];
const gathered = await openFiles(flat.map(([path, content]) => ({ path, bytes: typeof content === "string" ? bytes(content) : content })));
gathered.step(10);
assert.equal(gathered.hash(), zipped.hash(), "files without their folders are found by their names");
const two_missing = scene.replace(`<mesh file="box.stl"/>`, `<mesh file="box.stl"/><mesh file="arm.obj"/>`);
const lacking = openWith("scene.xml", (path) => ({ "scene.xml": bytes(two_missing), "parts/arm.xml": bytes(part) })[path]);
await assert.rejects(lacking, (error) => error instanceof MissingFiles && error.missing.join() === "meshes/arm.obj,meshes/box.stl" && /arm\.obj/.test(error.message));
await assert.rejects(openFile(join(place, "nothing.xml")), /there is no such file/);
await assert.rejects(openText("<mujoco><worldbody><geom/></worldbody>"), /model\.xml:1/);
await rm(place, { recursive: true });

// Hostile archives.
const refused = (archive, why) => assert.throws(() => new Files().addArchive("a.zip", archive), why);
refused(zip([["../evil.xml", "<mujoco/>"]]), /leads out/);
refused(zip([["/etc/../../x.xml", "<mujoco/>"]]), /leads out/);
refused(zip([["bomb.stl", Buffer.alloc(100 << 20)]]), /honest archive/);
refused(zip([]), /holds no file/);
const truncated = zip([["a.xml", "<mujoco/>"]]);
truncated[45] ^= 0xff;
refused(truncated, /damaged/);
assert.equal(new Files().addArchive("names.zip", zip([[Buffer.from([0xff, 0xfe, 0x2e, 0x78]), "x"], ["<img src=x onerror=alert(1)>.xml", "<mujoco/>"]])), 2);

// Instances are apart, of one compiled module.
const apart = await instance();
assert.notEqual(apart.Simulation, Simulation);
assert.equal(apart.Simulation.own("elbow").step(10), 10);
assert.throws(() => Simulation.open(new apart.Files(), "x.xml"), /expected instance of Files/);
assert.ok(apart.memoryBytes() > 1 << 20);
console.log("files, archives, controls, states, recordings, pictures, environments and refusals are as they should be");
