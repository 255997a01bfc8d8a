// Twenty-eight things that people drop on a page, by real events of dragging: models alone, in folders and in archives, with meshes,
// and what is broken, too large or hostile. Each ends in a picture or in a message.
//   node drops.mjs FOLDER REFERENCES STEPS WIDTH HEIGHT    (in a folder with node_modules/playwright-core)
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { serve, start, watched } from "./browser.mjs";
import { boxMesh, picture, TETRAHEDRON, zip } from "./zip.mjs";

const [folder] = process.argv.slice(2);
const own = (path) => readFile(fileURLToPath(new URL(`../../assets/${path}`, import.meta.url)));
const scene = (assets, body) => `<mujoco><asset>${assets}</asset><worldbody><light pos="0 0 3"/><geom type="plane" size="2 2 .1"/><body pos="0 0 1"><freejoint/>${body}</body></worldbody></mujoco>`;
const meshed = (file, more = "") => scene(`<mesh name="m" file="${file}"/>${more}`, `<geom type="mesh" mesh="m" mass="1"/>`);
const included = `<mujoco><include file="parts/body.xml"/><worldbody><light pos="0 0 3"/></worldbody></mujoco>`;
const part = `<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom size=".3"/></body></worldbody></mujoco>`;
const urdf = `<robot name="box"><link name="base"><visual><geometry><mesh filename="package://box/meshes/box.stl"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>`;
const png = picture(4, 4, [200, 40, 40]);
const textured = scene(`<texture name="t" type="2d" file="skin.png"/><material name="m" texture="t"/>`, `<geom type="box" size=".3 .3 .3" material="m"/>`);
const diverging = `<mujoco><option timestep=".01" gravity="0 0 -1e11"/><worldbody><light pos="0 0 3"/><body><freejoint/><geom size=".1"/></body></worldbody></mujoco>`;

/** What is dropped, and what comes of it: the number of bodies, or a message. */
const DROPS = [
  ["an arm", [["franka_table.xml", await own("franka/franka_table.xml")]], 16],
  ["an elbow", [["elbow.xml", await own("elbow/elbow.xml")]], 3],
  ["a quadruped", [["quadruped.xml", await own("quadruped/quadruped.xml")]], 10],
  ["a humanoid", [["humanoid.xml", await own("humanoid/humanoid.xml")]], 10],
  ["a pile", [["pile.xml", await own("pile/pile.xml")]], 10],
  ["a folder with an include", [["yard/yard.xml", await own("yard/yard.xml")], ["yard/parts/crane.xml", await own("yard/parts/crane.xml")]], 3],
  ["a folder with a mesh", [["robot/robot.xml", meshed("meshes/tetra.obj")], ["robot/meshes/tetra.obj", TETRAHEDRON]], 2],
  ["a folder in a folder", [["a/b/c/robot.xml", meshed("../../shared/box.stl")], ["a/shared/box.stl", boxMesh(0.2, 0.3, 0.4)]], 2],
  ["files without their folders", [["robot.xml", meshed("deep/meshes/box.stl")], ["box.stl", boxMesh(0.2, 0.3, 0.4)]], 2],
  ["a texture", [["t.xml", textured], ["skin.png", png]], 2],
  ["an archive with a mesh", [["robot.zip", zip([["r/robot.xml", meshed("m/box.stl")], ["r/m/box.stl", boxMesh(0.2, 0.3, 0.4)]])]], 2],
  ["an archive of MuJoCo", [["robot.mjz", zip([["robot.xml", included], ["parts/body.xml", part]])]], 2],
  ["an archive named otherwise", [["download", zip([["robot.xml", included], ["parts/body.xml", part]])]], 2],
  ["an archive with a URDF", [["box.zip", zip([["box/urdf/box.urdf", urdf], ["box/meshes/box.stl", boxMesh(0.5, 0.5, 0.5)]])]], 1],
  ["a hostile name", [["<img src=x onerror=document.title='taken'>.xml", part]], 2],
  ["a model that diverges", [["wild.xml", diverging]], 2],
  ["two meshes that are missing", [["robot.xml", meshed("a.stl", `<mesh file="b.obj"/>`)]], /2 missing[\s\S]*a\.stl[\s\S]*b\.obj/],
  ["an include that is missing", [["scene.xml", included]], /parts\/body\.xml/],
  ["a misspelt attribute", [["bad.xml", "<mujoco>\n  <worldbody><geom sise='1'/></worldbody></mujoco>"]], /bad\.xml:2:\d+[\s\S]*sise/],
  ["no end", [["cut.xml", "<mujoco><worldbody>"]], /cut\.xml:1/],
  ["no text", [["bytes.xml", Buffer.from([0xff, 0xfe, 0x80, 0x3c, 0x00, 0xd8])]], /bytes\.xml/],
  ["another encoding", [["latin.xml", Buffer.from("<mujoco model='\xe9'/>", "latin1")]], /UTF-8/],
  ["nothing", [["empty.xml", ""]], /empty\.xml/],
  ["no model", [["notes.txt", "a letter"], ["picture.png", png]], /none of 2 files is a model/],
  ["half an archive", [["half.zip", "PK\u0003\u0004 and no more"]], /half\.zip: a damaged zip archive/],
  ["an archive that leads out", [["out.zip", zip([["../../evil.xml", part]])]], /leads out of the archive/],
  ["a bomb", [["bomb.zip", zip([["bomb.xml", Buffer.alloc(64 << 20, 32)]])]], /honest archive/],
  ["a broken mesh", [["robot.xml", meshed("box.stl")], ["box.stl", boxMesh(0.2, 0.3, 0.4).subarray(0, 200)]], /box\.stl/],
  ["what asks for too much", [["big.xml", `<mujoco><size nuserdata="999999999"/></mujoco>`]], /nuserdata/],
];

const host = await serve(folder);
const browser = await start();
const { page, inside, outcome, message, colours, finish } = await watched(browser);
await page.goto(`${host.address}#model=elbow`);
await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);

/** Drops files by an event of dragging, as a browser makes it. */
const drop = (files) => outcome(async (viewer, files) => {
  const transfer = new DataTransfer();
  for (const [path, content] of files) {
    const bytes = Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0));
    const file = new File([bytes], path.split("/").pop());
    transfer.items.add(file);
  }
  // A script cannot put folders into a transfer: the entries that the browser gives for these are made up.
  const roots = new Map();
  const entry = (path, index) => ({ isFile: true, fullPath: `/${path}`, file: (done) => done(transfer.files[index]) });
  files.forEach(([path], index) => {
    const names = path.split("/");
    let level = roots;
    for (const name of names.slice(0, -1)) {
      if (!level.has(name)) level.set(name, new Map());
      level = level.get(name);
    }
    level.set(names.at(-1), entry(path, index));
  });
  const made = (inner) => {
    if (inner.isFile) return inner;
    const left = [...inner.values()].map(made);
    return { isFile: false, createReader: () => ({ readEntries: (done) => done(left.splice(0, 1)) }) };
  };
  const tops = [...roots.values()].map(made);
  if (files.some(([path]) => path.includes("/")))
    Object.defineProperty(transfer, "items", { value: tops.map((top) => ({ kind: "file", webkitGetAsEntry: () => top })) });
  const canvas = viewer.shadowRoot.querySelector("canvas");
  for (const type of ["dragover", "drop"]) canvas.dispatchEvent(new DragEvent(type, { dataTransfer: transfer, bubbles: true, composed: true, cancelable: true }));
}, files.map(([path, content]) => [path, Buffer.from(content).toString("base64")]));

for (const [what, files, expected] of DROPS) {
  const { message: trouble } = await drop(files);
  if (expected instanceof RegExp) {
    assert.match(await message(), expected, what);
    assert.ok(trouble, what);
    continue;
  }
  assert.equal(trouble, undefined, what);
  assert.equal(await message(), "", what);
  assert.ok((await colours()) > 2, `${what} is drawn`);
  const bodies = await inside((viewer) => viewer.simulation.names("body").length);
  assert.ok(bodies >= expected, `${what} has ${bodies} bodies`);
  // What stops it would be told while the next thing is opened.
  if (!what.includes("diverges")) assert.equal(await inside((viewer) => viewer.simulation.step(5)), 5, what);
}
assert.notEqual(await page.title(), "taken");

// A model that diverges says so, and the page goes on.
await drop([["wild.xml", diverging]]);
await inside((viewer) => viewer.run());
await page.waitForFunction(() => !document.querySelector("robohive-viewer").shadowRoot.querySelector(".message").hidden);
assert.match(await message(), /The simulation has stopped/);
assert.equal(await inside((viewer) => viewer.paused), true);
await page.locator("[data-does=dismiss]").click();
await colours();
assert.equal(await message(), "", "what was dismissed is not said again");

// What is missing can be dropped in, and a step later the model is there.
await drop([["robot.xml", meshed("a.stl", `<mesh file="more/b.obj"/>`)]]);
assert.match(await message(), /2 missing/);
assert.match((await drop([["a.stl", boxMesh(0.1, 0.2, 0.3)]])).message, /b\.obj/);
assert.match(await message(), /1 missing/);
assert.equal((await drop([["b.obj", TETRAHEDRON]])).message, undefined);
assert.equal(await message(), "");
// Or chosen.
await drop([["robot.xml", meshed("meshes/a.stl")]]);
const chooser = page.waitForEvent("filechooser");
await page.getByRole("button", { name: "Add the missing files…" }).click();
await (await chooser).setFiles({ name: "a.stl", mimeType: "model/stl", buffer: boxMesh(0.1, 0.2, 0.3) });
await page.waitForFunction(() => document.querySelector("robohive-viewer").shadowRoot.querySelector(".message").hidden);
assert.equal(await inside((viewer) => viewer.simulation.array("nmesh").values[0]), 1);

// Files that are too large are refused by their size: nothing of them is read.
const refused = await outcome(async (viewer) => {
  const file = new File([], "huge.xml");
  Object.defineProperty(file, "size", { value: 1e9 });
  file.arrayBuffer = () => { throw new Error("it was read"); };
  const transfer = new DataTransfer();
  Object.defineProperty(transfer, "items", { value: [{ kind: "file", webkitGetAsEntry: () => null, getAsFile: () => file }] });
  viewer.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
});
assert.match(refused.message, /huge\.xml: 954 MiB are more than a page can open, 512 MiB/);

// A policy that is none, for an environment.
await outcome((viewer) => (location.hash = "environment=hive/ElbowPose-v0"));
assert.match((await drop([["policy.pickle", "no pickle"]])).message, /.+/);
assert.ok(await inside((viewer) => viewer.simulation.isEnvironment), "the environment goes on");

await finish();
await browser.close();
host.close();
console.log(`${DROPS.length} things dropped: each was drawn or refused with a message`);
