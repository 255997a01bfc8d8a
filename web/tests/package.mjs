// The folder as a package of npm: packed, installed, checked for types; the examples of its README in node and through a bundler.
//   node package.mjs FOLDER    (in a folder with node_modules that has typescript and vite)
import { mkdir, readFile, readdir, rm, symlink, writeFile } from "node:fs/promises";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import assert from "node:assert/strict";
import { serve, start, watched } from "./browser.mjs";

const [folder] = process.argv.slice(2);
const place = join(process.cwd(), "package-test");
const run = (program, ...words) => execFileSync(program, words, { cwd: place, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });
await rm(place, { recursive: true, force: true });
await mkdir(join(place, "node_modules"), { recursive: true });
await symlink(join(process.cwd(), "node_modules", "vite"), join(place, "node_modules", "vite"));

// Packed as it would be published, and unpacked where a program has it.
const [packed] = JSON.parse(run("npm", "pack", "--json", folder));
const names = packed.files.map((file) => file.path);
for (const needed of ["LICENSE", "THIRD_PARTY.txt", "README.md", "api.d.ts", "engine_bg.wasm", "robohive.js", "inline.js"])
  assert.ok(names.includes(needed), `the package has ${needed}`);
assert.ok(!names.some((name) => /\.html$|page|offline/.test(name)), names.join(", "));
run("tar", "-xzf", packed.filename);
run("mv", "package", join("node_modules", "robohive"));
console.log(`the package has ${names.length} files, ${(packed.size / 1e6).toFixed(2)} MB packed`);
const notices = await readFile(join(place, "node_modules/robohive/THIRD_PARTY.txt"), "utf8");
for (const work of ["libm", "wasm-bindgen", "zip"]) assert.match(notices, new RegExp(`^${work} v[^\\n]*(MIT|Apache)`, "m"));

// The examples of the README, as they stand.
const readme = await readFile(join(folder, "README.md"), "utf8");
const [node, config] = [...readme.matchAll(/```js\n([\s\S]*?)```/g)].map(([, code]) => code);
const [html] = [...readme.matchAll(/```html\n([\s\S]*?)```/g)].map(([, code]) => code);
await writeFile(join(place, "package.json"), `{ "type": "module", "private": true }`);
await writeFile(join(place, "example.js"), node);
const printed = run("node", "example.js").trim().split("\n");
assert.match(printed[0], /^1(\.0{9}\d*)? Float64Array\(1\) \[ -?\d+\.\d+ \] [0-9a-f]{16}$/);
assert.match(printed[1], /^\d+ -?\d+(\.\d+)? (true|false)$/);

// Types of the examples and of what else a program does; what is wrong is found.
const more = `
import { openFile, openUrl, provide, type Simulation } from "robohive";
import { RoboHiveViewer } from "robohive/element";
import { load as inline } from "robohive/inline";
provide(() => "https://example.org/engine_bg.wasm");
async function all(simulation: Simulation): Promise<Float64Array> {
  simulation.restore(simulation.save());
  const shape: Uint32Array = simulation.array("xpos").shape;
  const viewer: RoboHiveViewer = document.createElement("robohive-viewer");
  viewer.addEventListener("error", (event) => console.log(event.detail.missing.length, shape));
  await viewer.openFiles([{ path: "a.xml", bytes: new Uint8Array() }]);
  (await inline()).ownModels().map((name) => name.length);
  return (await openUrl("github:a/b/c/d.xml")).qpos ?? (await openFile("a.xml")).qpos;
}
export { all };
`;
const options = { strict: true, noEmit: true, target: "es2022", module: "esnext", moduleResolution: "bundler", lib: ["es2022", "dom"], types: [], customConditions: ["node"], skipLibCheck: false };
const check = async (text) => {
  await writeFile(join(place, "types.ts"), text);
  await writeFile(join(place, "tsconfig.json"), JSON.stringify({ compilerOptions: options, files: ["types.ts"] }));
  return run("node", join(process.cwd(), "node_modules/typescript/bin/tsc"), "-p", ".");
};
assert.equal(await check(node), "");
assert.equal(await check(more), "");
await assert.rejects(check(more.replace("openFiles([{ path", "openFiles([{ paht").replace("2>", "")), "a misspelt name is an error");

// Through a bundler, into a browser.
const page = `<!doctype html><link rel="icon" href="data:,"><body>${html}</body>`;
await writeFile(join(place, "index.html"), page);
await writeFile(join(place, "vite.config.js"), config);
run("node", join(process.cwd(), "node_modules/vite/bin/vite.js"), "build", "--logLevel", "error");
assert.ok((await readdir(join(place, "dist/assets"))).some((name) => name.endsWith(".wasm")));
const inlined = `import { load } from "robohive/inline"; const { Simulation } = await load(); document.title = Simulation.own("elbow").name;`;
await mkdir(join(place, "inline"));
await writeFile(join(place, "inline/index.html"), `<!doctype html><link rel="icon" href="data:,"><script type="module">${inlined}</script>`);
run("node", join(process.cwd(), "node_modules/vite/bin/vite.js"), "build", "inline", "--outDir", "../dist-inline", "--logLevel", "error", "--assetsInlineLimit", "0", "--target", "esnext");
const browser = await start();
for (const [made, done] of [["dist", () => Number.parseFloat(document.title) > 0.1], ["dist-inline", () => document.title === "elbow"]]) {
  const host = await serve(join(place, made));
  const { page: shown, finish } = await watched(browser);
  await shown.goto(host.address);
  await shown.waitForFunction(done);
  await finish();
  host.close();
}
await browser.close();
await rm(place, { recursive: true });
console.log("the package installs, its types hold, and its examples run in node and through a bundler");
