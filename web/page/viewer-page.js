// The page of the viewer: the window (viewer.js) on a canvas where the browser has WebGPU or WebGL 2, the plain element
// (robohive.js) where it has neither. Files are opened here and never leave the page.
//
//   viewer.html#own=pile   #environment=hive/FrankaReach-v0&seed=3   #src=robot.zip&model=scene.xml   &camera=front   &running

/** Most bytes of all files that are opened together. */
const MOST_BYTES = 2 ** 30;
/** Milliseconds between looks at what the window says. */
const LOOK = 500;

const part = (id) => document.getElementById(id);
const wanted = () => new URLSearchParams(location.hash.slice(1));

/** Says something over the picture, with what can be done about it, or nothing. */
function say(message, action, does) {
  const box = part("message");
  if (box.dataset.text === (message ?? "")) return;
  box.dataset.text = message ?? "";
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

/** What the browser draws with. */
async function graphics() {
  if (isSecureContext && (await navigator.gpu?.requestAdapter().catch(() => null))) return "WebGPU";
  return document.createElement("canvas").getContext("webgl2") ? "WebGL 2" : undefined;
}

/** Path and `File` of everything that was dropped, folders with what is in them. Entries are taken before anything waits. */
async function dropped(transfer) {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  const found = entries.length ? [] : [...transfer.files].map((file) => [file.name, file]);
  const walk = async (entry) => {
    if (entry.isFile) {
      const file = await new Promise((done, failed) => entry.file(done, failed));
      return found.push([entry.fullPath.replace(/^\//, ""), file]);
    }
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((done, failed) => reader.readEntries(done, failed));
      if (!some.length) return;
      for (const inner of some) await walk(inner);
    }
  };
  for (const entry of entries) await walk(entry);
  return found;
}

/** The window, and what stands around it. */
class Page {
  /** The module, the `Viewer` of it, and the files that were opened last, to which missing ones are added. */
  module;
  viewer;
  #files;
  #incomplete = false;
  #lost;

  async start() {
    const { default: init, ...module } = await import("./viewer.js");
    await init();
    this.module = module;
    const list = (id, names) => part(id).append(...names.map((name) => new Option(name, name)));
    list("own", module.ownModels());
    list("environments", module.ownEnvironments());
    this.viewer = new module.Viewer();
    watchDevices((reason) => this.lose(reason));
    await this.#draw();
    for (const id of ["run", "step"]) part(id).disabled = false;
    part("run").addEventListener("click", () => this.viewer.perform("Run or pause"));
    part("step").addEventListener("click", () => this.viewer.perform("One step forward"));
    addEventListener("hashchange", () => this.link());
    setInterval(() => this.#look(), LOOK);
  }

  /** Starts on a new canvas: one whose context was lost is of no use. */
  async #draw() {
    part("main").querySelector("canvas")?.remove();
    const canvas = Object.assign(document.createElement("canvas"), { tabIndex: 0 });
    canvas.setAttribute("aria-label", "simulation: F1 shows keys and gestures");
    canvas.addEventListener("webglcontextlost", () => this.lose("the browser took its WebGL context away"));
    part("main").prepend(canvas);
    await this.viewer.start(canvas, save);
    this.#lost = undefined;
    say();
  }

  /** Says that nothing is drawn any more, and how to go on. */
  lose(reason) {
    if (this.#lost) return;
    this.#lost = reason;
    this.viewer.stop();
    tell("Stopped");
    say(`Nothing can be drawn any more: ${reason}. What is open is kept.`, "Draw again", () => this.#draw().catch(fail));
  }

  /** Opens what the address names. */
  async link() {
    const names = wanted();
    await this.#try(async () => {
      const src = names.get("src");
      if (src) {
        const answer = await fetch(src);
        if (!answer.ok) throw new Error(`${src}: ${answer.status} ${answer.statusText}`);
        const files = new this.module.Files();
        files.add(src.split("/").pop(), new Uint8Array(await answer.arrayBuffer()));
        this.viewer.open(files, names.get("model") ?? undefined);
      } else {
        this.viewer.openOwn(names.get("environment") ?? names.get("own") ?? "quadruped");
        if (names.has("environment")) this.viewer.begin(BigInt(names.get("seed") ?? 0));
      }
      if (names.has("camera")) this.viewer.useCamera(names.get("camera"));
      if (names.has("running") && !this.viewer.running) this.viewer.perform("Run or pause");
    });
  }

  /** Opens files that were dropped or chosen; what was missing before is added to what is there. */
  async open(found) {
    await this.#try(async () => {
      const bytes = found.reduce((sum, [, file]) => sum + file.size, 0);
      if (bytes > MOST_BYTES) throw new Error(`these files have ${(bytes / 2 ** 20).toFixed(0)} MiB, more than the ${MOST_BYTES >> 20} that can be opened`);
      if (!this.#incomplete || found.some(([path]) => /\.(zip|mjz|xml|mjcf|urdf)$/i.test(path))) this.#files = new this.module.Files();
      for (const [path, file] of found) this.#files.add(path, new Uint8Array(await file.arrayBuffer()));
      this.#incomplete = true;
      this.viewer.open(this.#files);
      this.#incomplete = false;
    });
  }

  async #try(action) {
    try {
      await action();
      say();
    } catch (error) {
      say(error.message ?? String(error));
    }
    this.#look();
  }

  /** Repeats in words what the window shows. */
  #look() {
    if (this.#lost) return;
    const { failure } = this.viewer;
    if (failure) return this.lose(`the viewer failed: ${failure}`);
    tell(this.viewer.summary());
    part("run").textContent = this.viewer.summary().endsWith("running") ? "Pause" : "Run";
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

/** Offers a file as a download. */
function save(name, bytes) {
  const address = URL.createObjectURL(new Blob([bytes]));
  Object.assign(document.createElement("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

function fail(error) {
  tell("Stopped");
  say(error.message ?? String(error));
}

/** The element that needs neither WebGPU nor WebGL, in place of the window. */
async function plain(reason) {
  const { load } = await import("./robohive.js");
  const viewer = document.createElement("robohive-viewer");
  part("main").prepend(viewer);
  const link = () => {
    const names = wanted();
    if (!["own", "environment", "src"].some((name) => names.has(name))) names.set("own", "quadruped");
    for (const name of ["src", "own", "environment", "model", "camera", "seed", "running"])
      names.has(name) ? viewer.setAttribute(name, names.get(name)) : viewer.removeAttribute(name);
  };
  addEventListener("hashchange", link);
  link();
  const engine = await load();
  part("own").append(...engine.ownModels().map((name) => new Option(name, name)));
  part("environments").append(...engine.ownEnvironments().map((name) => new Option(name, name)));
  tell(`Plain viewer: ${reason}`);
  return {
    viewer,
    open: async (found) => {
      const files = new engine.Files();
      try {
        for (const [path, file] of found) {
          const bytes = new Uint8Array(await file.arrayBuffer());
          if (/\.(zip|mjz)$/i.test(path)) files.addArchive("", bytes);
          else files.add(path, bytes);
        }
        viewer.say();
        await viewer.open(files);
      } catch (error) {
        viewer.say(error.message);
      }
    },
  };
}

/** Files go to whatever shows them. */
function listen(page) {
  const stop = (event) => (event.preventDefault(), event.stopPropagation());
  // Before the window's own listeners, which know nothing of folders.
  addEventListener("dragover", stop, { capture: true });
  addEventListener("drop", (event) => {
    stop(event);
    dropped(event.dataTransfer).then((found) => page.open(found), fail);
  }, { capture: true });
  for (const id of ["files", "folder"])
    part(id).addEventListener("change", (event) => {
      const found = [...event.target.files].map((file) => [file.webkitRelativePath || file.name, file]);
      page.open(found);
      event.target.value = "";
    });
  for (const [id, name] of [["own", "own"], ["environments", "environment"]])
    part(id).addEventListener("change", (event) => {
      if (event.target.value) location.hash = new URLSearchParams({ [name]: event.target.value });
      event.target.selectedIndex = 0;
    });
}

/** Shows the page; `robohive` in its console and for its tests. */
async function main() {
  const draws = await graphics();
  if (!draws) {
    globalThis.robohive = await plain("the browser has neither WebGPU nor WebGL 2");
    return listen(globalThis.robohive);
  }
  const page = new Page();
  try {
    await page.start();
  } catch (error) {
    part("main").querySelector("canvas")?.remove();
    globalThis.robohive = await plain(error.message ?? String(error));
    return listen(globalThis.robohive);
  }
  listen(page);
  await page.link();
  globalThis.robohive = page;
}

main().catch(fail);
