// RoboHive for JavaScript: simulations of MJCF and URDF models, and environments, in pages and in node.
//
//   import { load, openUrl } from "robohive";
//   const { Simulation } = await load();
//   const simulation = Simulation.own("quadruped");      // or await openUrl("robot.xml")
//   simulation.step(1000);
//   console.log(simulation.time, simulation.qpos, simulation.hash());

import makeEngine from "./engine.js";
import { bytesOf, isArchive } from "./files.js";

/** Most files that are fetched at the same time. */
const AT_ONCE = 16;

let source = () => new URL("engine_bg.wasm", import.meta.url);
let compiled;
let shared;

/** Says where the module comes from: a function that returns bytes, a compiled module or an address, or a promise of one. */
export function provide(from) {
  source = from;
}

/** The engine's classes and functions. All who call this share one instance; the module is compiled once. */
export function load(from) {
  if (from) provide(() => from);
  shared ??= instance();
  shared.catch(() => (shared = undefined));
  return shared;
}

/** An instance of its own, of the module that is compiled once: what goes wrong in it, and what memory it takes, is its own. */
export async function instance() {
  compiled ??= compile();
  compiled.catch(() => (compiled = undefined));
  const engine = makeEngine();
  const { memory } = await engine.init({ module_or_path: await compiled });
  return Object.assign(engine, { memoryBytes: () => memory.buffer.byteLength });
}

async function compile() {
  const from = await source();
  if (from instanceof WebAssembly.Module) return from;
  if (!(from instanceof URL) && typeof from !== "string") return WebAssembly.compile(from);
  const answer = await fetch(from);
  if (!answer.ok) throw new Error(`${from}: ${answer.status} ${answer.statusText}`);
  const streams = answer.headers.get("content-type")?.startsWith("application/wasm");
  return streams ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
}

/** A model that lacks files: `missing` has their paths. */
export class MissingFiles extends Error {
  constructor(message, missing) {
    super(message);
    this.name = "MissingFiles";
    this.missing = missing;
  }
}

/**
 * Opens the model at `path`. `read(path)` returns the bytes of a file, or nothing where there is none, or a promise; it is
 * asked for the model, for what it includes, and for meshes and textures, many at the same time.
 */
export async function openWith(path, read, { engine, files } = {}) {
  engine ??= await load();
  files ??= new engine.Files();
  const asked = new Set(files.paths());
  const ask = async (paths) => {
    const fresh = paths.filter((each) => !asked.has(each));
    fresh.forEach((each) => asked.add(each));
    let found = 0;
    const next = async () => {
      for (let each = fresh.shift(); each !== undefined; each = fresh.shift()) {
        const bytes = await read(each);
        if (!bytes) continue;
        files.add(each, bytes);
        found += 1;
      }
    };
    await Promise.all(Array.from({ length: AT_ONCE }, next));
    return found;
  };
  await ask([path]);
  for (;;) {
    try {
      return engine.Simulation.open(files, path);
    } catch (error) {
      if (error instanceof WebAssembly.RuntimeError) throw error;
      if ((await ask(files.tried)) || (await ask(files.missing))) continue;
      const missing = files.missing;
      const given = missing.filter((each) => files.substitute(each));
      if (given.length) continue;
      throw missing.length ? new MissingFiles(error.message, missing) : error;
    }
  }
}

/** Opens a model from its text, which names no other files. */
export async function openText(text, { engine } = {}) {
  return openWith("model.xml", (path) => (path === "model.xml" ? new TextEncoder().encode(text) : undefined), { engine });
}

/** Opens the model at `path` among files (an array of `{ path, bytes }`), or the one that is nearest to the top. */
export async function openFiles(given, { engine, path, files } = {}) {
  engine ??= await load();
  files ??= new engine.Files();
  for (const { path: name, bytes } of given) isArchive(name, bytes) ? files.addArchive(name, bytes) : files.add(name, bytes);
  const chosen = path ?? files.models()[0];
  if (!chosen) {
    const names = given.map((file) => file.path).slice(0, 5).join(", ");
    throw new Error(`none of ${files.length} files is a model (${names}): a model is MJCF or URDF, .xml or .urdf`);
  }
  return openWith(chosen, () => undefined, { engine, files });
}

/**
 * Opens a model or a zip archive by its address: what it includes, meshes and textures are fetched from beside it.
 * `github:OWNER/NAME/BRANCH/PATH` is a file of a public repository.
 */
export async function openUrl(address, { engine, path, files } = {}) {
  engine ??= await load();
  files ??= new engine.Files();
  const most = engine.Files.mostBytes();
  const url = new URL(addressOf(address), globalThis.document?.baseURI);
  const whole = decodeURIComponent(url.pathname).replace(/^\/+/, "") || "model.xml";
  const first = await bytesOf(await fetch(url), String(address), most);
  if (!first) throw new Error(`${address}: there is no such file`);
  if (isArchive(whole, first)) return openFiles([{ path: whole, bytes: first }], { engine, path, files });
  files.add(whole, first);
  const read = async (name) => {
    if (name.startsWith("..") || name.startsWith("/")) return undefined;
    const beside = new URL(`/${name.split("/").map(encodeURIComponent).join("/")}`, url);
    return bytesOf(await fetch(beside), beside.href, most);
  };
  return openWith(whole, read, { engine, files });
}

/** The address of a file of a public repository. */
function addressOf(address) {
  const inside = /^github:([^/]+\/[^/]+\/[^/]+\/.+)$/.exec(address)?.[1];
  return inside ? `https://raw.githubusercontent.com/${inside}` : address;
}
