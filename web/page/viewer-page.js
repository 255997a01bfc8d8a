// The viewer: the window (viewer.js) on a canvas where the browser has WebGPU or WebGL 2, the element (robohive.js) where it has
// neither. Links say what is open, as on the light page (page.js).

import { MissingFiles, openFiles, openUrl } from "./api.js";
import { bytesAt, chosen, download, dropped, isModel, isPolicy, isTrajectory, policyAt, readAll } from "./files.js";

/** Milliseconds between looks at what the window says. */
const LOOK = 500;

const part = (id) => document.getElementById(id);
const wanted = () => new URLSearchParams(location.hash.slice(1));

/** Says something over the picture, with what can be done about it, or nothing. */
function say(message, action, does) {
  const box = part("message");
  box.hidden = !message;
  box.replaceChildren(message ?? "");
  if (!action) return;
  const button = Object.assign(document.createElement("button"), { textContent: action });
  button.addEventListener("click", does);
  box.append("\n", button);
}

/** Tells those who do not see the picture. */
function tell(text) {
  if (part("status").textContent !== text) part("status").textContent = text;
}

/** Why the browser cannot draw the window, or nothing. */
async function incapable() {
  if (isSecureContext && (await navigator.gpu?.requestAdapter().catch(() => null))) return undefined;
  return document.createElement("canvas").getContext("webgl2") ? undefined : "this browser has neither WebGPU nor WebGL 2";
}

/** The window, and what stands around it. */
class Window {
  /** The module and its `Viewer`. */
  module;
  viewer;
  /** Files of a model that lacks some, and its path. */
  #lacking;
  #lost;

  async start() {
    const { default: makeModule } = await import("./viewer.js");
    this.module = makeModule();
    await this.module.init({ module_or_path: new URL("viewer_bg.wasm", import.meta.url) });
    this.viewer = new this.module.Viewer();
    watchDevices((reason) => this.#lose(reason));
    await this.#draw();
    for (const [id, command] of [["run", "Run or pause"], ["step", "One step forward"]]) {
      part(id).disabled = false;
      part(id).addEventListener("click", () => (this.viewer.perform(command), this.#look()));
    }
    setInterval(() => this.#look(), LOOK);
  }

  /** Starts on a new canvas: one whose context was lost is of no use. */
  async #draw() {
    part("main").querySelector("canvas")?.remove();
    const canvas = Object.assign(document.createElement("canvas"), { tabIndex: 0 });
    canvas.setAttribute("aria-label", "simulation: F1 shows keys and gestures");
    canvas.addEventListener("webglcontextlost", () => this.#lose("the browser took its WebGL context away"));
    part("main").prepend(canvas);
    await this.viewer.start(canvas, download);
    this.#lost = undefined;
    say();
  }

  /** Says that nothing is drawn any more, and how to go on. */
  #lose(reason) {
    if (this.#lost) return;
    this.#lost = reason;
    this.viewer.stop();
    tell("stopped");
    say(`Nothing can be drawn any more: ${reason}. What is open is kept.`, "Draw again", () => this.#draw().catch(fail));
  }

  /** Opens what a link names. */
  follow(names) {
    return this.#try(async () => {
      const [model, environment] = [names.get("model"), names.get("environment")];
      if (environment) {
        const policy = await policyAt(names.get("policy"), environment, this.module.Files.mostBytes());
        this.viewer.openEnvironment(environment, BigInt(names.get("seed") ?? 0), policy);
      } else if (this.module.ownModels().includes(model)) {
        this.viewer.openOwn(model);
      } else {
        await this.#reading(names.get("path") ?? undefined, (from) => openUrl(model, from));
      }
      const replay = names.get("replay");
      if (replay) this.viewer.replay(replay, await bytesAt(replay, this.module.Files.mostBytes()));
      const camera = names.get("camera");
      if (camera && !this.viewer.useCamera(camera)) throw new Error(`no camera's name contains ${camera}`);
      if (names.has("running") && !this.viewer.running) this.viewer.perform("Run or pause");
    });
  }

  /** Opens files (`{ path, bytes }`): recorded states, a policy for the environment, what a model lacks, or something new. */
  open(files) {
    return this.#try(async () => {
      const [first, ...more] = files;
      const alone = first && !more.length;
      if (alone && isTrajectory(first.path)) return this.viewer.replay(first.path, first.bytes);
      const { environment, seed } = this.viewer;
      if (alone && isPolicy(first.path) && environment) return this.viewer.openEnvironment(environment, seed, first.bytes);
      const lacking = this.#lacking;
      if (lacking && !files.some(({ path }) => isModel(path))) await this.#reading(lacking.path, (from) => openFiles(files, { ...from, files: lacking.files }));
      else await this.#reading(undefined, (from) => openFiles(files, from));
    });
  }

  /** Reads a model by what the light page reads by; files of one that lacks some are kept. */
  async #reading(path, read) {
    const { Files } = this.module;
    const files = new Files();
    let held = files;
    // What is read is opened in the window.
    const Simulation = { open: (files, path) => ((held = files), this.viewer.open(files, path)) };
    try {
      await read({ engine: { Files, Simulation }, path, files });
      this.#lacking = undefined;
    } catch (error) {
      this.#lacking = error instanceof MissingFiles ? { files: held, path } : undefined;
      throw error;
    }
  }

  async #try(action) {
    try {
      await action();
      say();
    } catch (error) {
      const missing = error instanceof MissingFiles ? error.missing : [];
      const more = missing.length ? `\n\n${missing.length} missing: drop them here:\n${missing.join("\n")}` : "";
      say((error.message ?? String(error)) + more);
    }
    this.#look();
  }

  /** Repeats in words what the window shows. */
  #look() {
    if (this.#lost) return;
    const { failure } = this.viewer;
    if (failure) return this.#lose(`the viewer failed: ${failure}`);
    const summary = this.viewer.summary();
    tell(summary);
    part("run").textContent = summary.endsWith("running") ? "Pause" : "Run";
  }
}

/** Hears of WebGPU devices that are lost. */
function watchDevices(lost) {
  const request = globalThis.GPUAdapter?.prototype.requestDevice;
  if (!request) return;
  GPUAdapter.prototype.requestDevice = async function (...wanted) {
    const device = await request.apply(this, wanted);
    device.lost.then(({ reason, message }) => reason !== "destroyed" && lost(message || "the GPU was lost"));
    return device;
  };
}

/** The element, which needs neither WebGPU nor WebGL, in place of the window. */
class Plain {
  async start(reason) {
    const { load } = await import("./robohive.js");
    this.module = await load();
    this.viewer = document.createElement("robohive-viewer");
    part("main").querySelector("canvas")?.remove();
    part("main").prepend(this.viewer);
    tell(`plain viewer: ${reason}`);
  }

  follow(names) {
    const model = names.get("model");
    if (model) names.set(this.module.ownModels().includes(model) ? "own" : "src", model);
    for (const name of ["src", "own", "environment", "path", "camera", "seed", "policy", "replay", "running"])
      names.has(name) ? this.viewer.setAttribute(name, names.get(name)) : this.viewer.removeAttribute(name);
  }

  open(files) {
    return this.viewer.give(files);
  }
}

function fail(error) {
  tell("stopped");
  say(error.message ?? String(error));
}

/** Lists, buttons and files that are dropped lead to what is shown. */
function listen(shown) {
  const open = async (listed) => {
    try {
      await shown.open(await readAll(await listed, shown.module.Files.mostBytes()));
    } catch (error) {
      say(error.message);
    }
  };
  // Before the window's own listeners, which know nothing of folders.
  const stop = (event) => (event.preventDefault(), event.stopPropagation());
  addEventListener("dragover", stop, { capture: true });
  addEventListener("drop", (event) => (stop(event), open(dropped(event.dataTransfer))), { capture: true });
  for (const button of document.querySelectorAll("[data-opens]")) {
    const input = part(button.dataset.opens);
    button.addEventListener("click", () => input.click());
    input.addEventListener("change", () => open(chosen(input)).then(() => (input.value = "")));
  }
  for (const [id, name, names] of [["own", "model", shown.module.ownModels()], ["environment", "environment", shown.module.ownEnvironments()]]) {
    part(id).append(...names.map((name) => new Option(name, name)));
    part(id).addEventListener("change", () => {
      if (part(id).value) location.hash = new URLSearchParams({ [name]: part(id).value });
      part(id).selectedIndex = 0;
    });
  }
  addEventListener("hashchange", () => shown.follow(wanted()));
}

/** What shows models here: the window, or the element. */
async function shown() {
  const plain = async (reason) => {
    const element = new Plain();
    await element.start(reason);
    return element;
  };
  const reason = await incapable();
  if (reason) return plain(reason);
  const window = new Window();
  try {
    await window.start();
    return window;
  } catch (error) {
    return plain(error.message ?? String(error));
  }
}

/** Shows the page; `robohive` in its console and for its tests. */
async function main() {
  const page = await shown();
  listen(page);
  if (!location.hash) history.replaceState(null, "", "#model=quadruped");
  await page.follow(wanted());
  globalThis.robohive = page;
}

main().catch(fail);

// What was loaded once is there without a network.
if (isSecureContext && "serviceWorker" in navigator) {
  navigator.serviceWorker.register("offline.js").catch(() => {});
  navigator.serviceWorker.ready.then(({ active }) => active.postMessage("viewer"));
}
