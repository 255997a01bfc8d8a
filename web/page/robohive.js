// RoboHive in a page: `load()` gets the module, whose classes simulate and draw; `<robohive-viewer>` shows one.
//
//   <script type="module" src="robohive.js"></script>
//   <robohive-viewer own="quadruped" running></robohive-viewer>
//
// Attributes: `src` (address of a model or a zip archive), `own` (name of a model of our own), `environment` (an id),
// `seed`, `model` (which model of the archive), `camera` (its name), `running`, `bare` (no bar).

import init, * as engine from "./engine.js";

let module;

/** The engine's classes and functions, once its module is compiled. In node give it the bytes of `engine_bg.wasm`. */
export async function load(bytes) {
  module ??= init(bytes ? { module_or_path: bytes } : undefined);
  await module;
  return engine;
}

const STYLE = `
  :host { display: block; position: relative; min-height: 240px; background: #24272b; color: #e8e8e8;
          font: 13px system-ui, sans-serif; overflow: hidden; }
  canvas { position: absolute; inset: 0; width: 100%; height: 100%; touch-action: none; outline-offset: -2px; }
  .bar { position: absolute; left: 0; right: 0; bottom: 0; display: flex; gap: 6px; align-items: center; padding: 6px;
         background: #000a; flex-wrap: wrap; }
  .bar button, .bar select { font: inherit; color: inherit; background: #444; border: 0; border-radius: 4px;
                             padding: 3px 9px; max-width: 14em; }
  .bar button:focus-visible, .bar select:focus-visible { outline: 2px solid #8bf; }
  .side { position: absolute; top: 0; right: 0; bottom: 38px; width: 240px; overflow: auto; padding: 8px; background: #000a; }
  .side label { display: block; margin-bottom: 4px; overflow-wrap: anywhere; } .side input[type=range] { width: 100%; }
  .message { position: absolute; left: 8px; top: 8px; right: 8px; max-height: 45%; overflow: auto; padding: 8px;
             white-space: pre-wrap; font-family: ui-monospace, monospace; background: #000c; border-left: 3px solid #e66; }
  [hidden] { display: none !important; }`;

const BAR = `
  <canvas tabindex="0" role="img" aria-label="simulation"></canvas>
  <div class="message" role="alert" hidden></div>
  <div class="side" hidden></div>
  <div class="bar">
    <button data-does="run" title="Space">Run</button>
    <button data-does="back" title="Arrow left">Step back</button>
    <button data-does="step" title="Arrow right">Step</button>
    <button data-does="reset" title="Backspace">Reset</button>
    <select data-does="camera" aria-label="camera"></select>
    <select data-does="model" aria-label="model" hidden></select>
    <button data-does="side" aria-expanded="false">Controls</button>
    <span class="status"></span>
  </div>`;

/** Milliseconds of a frame that physics may take, and that a picture may take while things move. */
const PHYSICS = 9;
const PICTURE = 45;
/** Coarsest picture, in parts of the canvas's width, and longest time that is caught up with [s]. */
const COARSEST = 4;
const LONGEST = 0.25;

/** A simulation in a page. `simulation` is the engine's object; `open(files, path)` shows another. */
export class RoboHiveViewer extends (globalThis.HTMLElement ?? Object) {
  static observedAttributes = ["src", "own", "environment", "model", "camera", "running", "seed"];

  #files;
  #cost = 0;
  #drawn = {};
  #last = 0;
  #frame = 0;
  #pending;
  /** The engine's `Simulation`, or nothing yet. */
  simulation;

  connectedCallback() {
    if (!this.shadowRoot) this.#build();
    this.#refresh();
    this.#last = performance.now();
    this.#frame = requestAnimationFrame((now) => this.#show(now));
  }

  disconnectedCallback() {
    cancelAnimationFrame(this.#frame);
    this.#take(undefined);
  }

  attributeChangedCallback(name, before, after) {
    if (!this.isConnected || !this.shadowRoot || before === after) return;
    if (name === "camera") return this.#useCamera();
    if (name === "running") return this.run(after !== null);
    this.#refresh();
  }

  /** Shows the model at `path` among `files` (the engine's `Files`), or the one nearest to the top. */
  async open(files, path) {
    const { Simulation } = await load();
    this.#files = files;
    const models = files.models();
    const chosen = path ?? models[0];
    const list = this.#part("[data-does=model]");
    list.replaceChildren(...models.map((name) => new Option(name, name, false, name === chosen)));
    list.hidden = models.length < 2;
    if (!chosen) throw new Error(`none of ${files.length} files is a model: a model is MJCF or URDF, .xml or .urdf`);
    this.#take(Simulation.open(files, chosen));
  }

  /** Lets time go by, or stops it. */
  run(running = true) {
    if (this.simulation) this.simulation.running = running;
    this.#label();
  }

  /** Says something over the picture, or nothing. */
  say(message) {
    const box = this.#part(".message");
    box.textContent = message ?? "";
    box.hidden = !message;
    if (message) this.dispatchEvent(new CustomEvent("robohive-message", { detail: message, bubbles: true }));
  }

  #part(selector) {
    return this.shadowRoot.querySelector(selector);
  }

  #build() {
    const root = this.attachShadow({ mode: "open" });
    root.innerHTML = `<style>${STYLE}</style>${BAR}`;
    this.#part(".bar").hidden = this.hasAttribute("bare");
    root.addEventListener("click", (event) => this.#does(event.target.dataset?.does));
    this.#part("[data-does=camera]").addEventListener("change", (event) => this.#camera(Number(event.target.value)));
    this.#part("[data-does=model]").addEventListener("change", (event) => this.#try(() => this.open(this.#files, event.target.value)));
    this.#gestures(this.#part("canvas"));
    this.addEventListener("dragover", (event) => event.preventDefault());
    this.addEventListener("drop", (event) => {
      event.preventDefault();
      this.#try(async () => this.open(await dropped(event.dataTransfer)));
    });
  }

  /** Opens what the attributes name. Of several changes at once the last counts. */
  #refresh() {
    clearTimeout(this.#pending);
    this.#pending = setTimeout(() => this.#try(() => this.#named()));
  }

  async #named() {
    const { Simulation, Files } = await load();
    const [src, own, environment] = ["src", "own", "environment"].map((name) => this.getAttribute(name));
    if (environment) return this.#take(Simulation.environment(environment, BigInt(this.getAttribute("seed") ?? 0)));
    if (own) return this.#take(Simulation.own(own));
    if (!src) return;
    const answer = await fetch(src);
    if (!answer.ok) throw new Error(`${src}: ${answer.status} ${answer.statusText}`);
    const files = new Files();
    add(files, src.split("/").pop(), new Uint8Array(await answer.arrayBuffer()));
    await this.open(files, this.getAttribute("model") ?? undefined);
  }

  /** Does something that may fail, and says why it did. */
  async #try(action) {
    try {
      this.say();
      await action();
    } catch (error) {
      this.say(error.message ?? String(error));
    }
  }

  #take(simulation) {
    this.simulation?.free();
    this.simulation = simulation;
    this.#drawn = {};
    if (!simulation) return;
    simulation.running = this.hasAttribute("running");
    const cameras = this.#part("[data-does=camera]");
    cameras.replaceChildren(...["free camera", ...simulation.cameras()].map((name, k) => new Option(name, k - 1)));
    this.#useCamera();
    this.#sliders();
    this.#label();
    if (simulation.warnings) console.info(simulation.warnings);
    this.dispatchEvent(new CustomEvent("robohive-open", { detail: simulation.name, bubbles: true }));
  }

  #useCamera() {
    const name = this.getAttribute("camera");
    const place = this.simulation?.cameras().findIndex((camera) => camera.includes(name ?? "\n")) ?? -1;
    if (place >= 0) this.#camera(place);
  }

  #camera(place) {
    this.#try(() => this.simulation?.useCamera(place));
    this.#part("[data-does=camera]").value = place;
    this.#drawn = {};
  }

  #does(what) {
    const simulation = this.simulation;
    if (!simulation) return;
    if (what === "run") this.run(!simulation.running);
    else if (what === "step") simulation.step(1);
    else if (what === "back") simulation.stepBack();
    else if (what === "reset") simulation.reset();
    else if (what === "side") {
      const side = this.#part(".side");
      side.hidden = !side.hidden;
      this.#part("[data-does=side]").setAttribute("aria-expanded", String(!side.hidden));
    }
    this.#label();
  }

  #label() {
    this.#part("[data-does=run]").textContent = this.simulation?.running ? "Pause" : "Run";
  }

  /** A slider for each control; of an environment, what it observes is not for sliders. */
  #sliders() {
    const { simulation } = this;
    const ranges = simulation.isEnvironment ? [] : simulation.controlRanges();
    const values = simulation.controls;
    const rows = simulation.isEnvironment ? [] : simulation.controlNames().map((name, k) => {
      const [low, high] = [ranges[2 * k], ranges[2 * k + 1]];
      const input = Object.assign(document.createElement("input"), { type: "range", min: low, max: high, step: (high - low) / 1000, value: values[k] });
      input.addEventListener("input", () => this.#try(() => this.simulation.setControl(k, Number(input.value))));
      const label = document.createElement("label");
      label.append(name, input);
      return label;
    });
    const switches = simulation.switches().map((name) => {
      const input = Object.assign(document.createElement("input"), { type: "checkbox", checked: simulation.shows(name) });
      input.addEventListener("change", () => { this.simulation.show(name, input.checked); this.#drawn = {}; });
      const label = document.createElement("label");
      label.append(input, ` ${name}`);
      return label;
    });
    this.#part(".side").replaceChildren(...rows, ...switches);
  }

  #gestures(canvas) {
    let held;
    const fingers = new Map();
    const share = (event) => {
      const box = canvas.getBoundingClientRect();
      return [box.width / box.height, (event.clientX - box.left) / box.width, (box.bottom - event.clientY) / box.height];
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, event);
      held = event.ctrlKey && this.simulation?.grab(event.button === 0);
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before || !this.simulation) return;
      const height = canvas.clientHeight;
      const [right, up] = [(event.clientX - before.clientX) / height, (before.clientY - event.clientY) / height];
      if (fingers.size === 2) {
        const [other] = [...fingers.values()].filter((finger) => finger.pointerId !== event.pointerId);
        const apart = (finger) => Math.hypot(finger.clientX - other.clientX, finger.clientY - other.clientY);
        this.simulation.zoom((apart(event) - apart(before)) / height);
        this.simulation.pan(right / 2, up / 2);
      } else if (held) this.simulation.drag(right, up, event.shiftKey);
      else if (event.buttons & 2) this.simulation.pan(right, up);
      else if (event.buttons & 4) this.simulation.zoom(up);
      else this.simulation.orbit(right, up);
      this.#drawn = {};
      fingers.set(event.pointerId, event);
    });
    const end = (event) => {
      fingers.delete(event.pointerId);
      if (held) this.simulation?.release();
      held = false;
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("dblclick", (event) => {
      const label = this.simulation?.select(...share(event));
      this.dispatchEvent(new CustomEvent("robohive-select", { detail: label, bubbles: true }));
      this.#drawn = {};
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.simulation?.zoom(-0.02 * Math.sign(event.deltaY));
      this.#drawn = {};
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const code = (event.shiftKey ? "Shift+" : "") + event.code.replace(/^Key/, "");
      if (event.ctrlKey || event.metaKey || !this.simulation?.key(code)) return;
      event.preventDefault();
      this.#drawn = {};
      this.#label();
    });
  }

  #show(now) {
    this.#frame = requestAnimationFrame((next) => this.#show(next));
    const { simulation } = this;
    const elapsed = Math.min((now - this.#last) / 1000, LONGEST);
    this.#last = now;
    if (!simulation) return;
    simulation.advance(elapsed, PHYSICS);
    try {
      this.#draw(simulation);
    } catch (error) {
      this.run(false);
      this.say(error.message);
    }
    if (simulation.fault) this.say(simulation.fault);
    const past = simulation.behind ? ` (−${simulation.behind})` : "";
    this.#part(".status").textContent = `${simulation.name}  ${simulation.time.toFixed(3)} s${past}  ${simulation.contacts} contacts`;
  }

  /** A coarse picture while things move and drawing is slow, a fine one when they stand still. */
  #draw(simulation) {
    const canvas = this.#part("canvas");
    const scale = Math.min(devicePixelRatio || 1, 2);
    const whole = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * scale)));
    const parts = Math.min(COARSEST, Math.max(1, Math.ceil(Math.sqrt((this.#cost * whole[0] * whole[1]) / PICTURE))));
    const still = this.#drawn.revision === simulation.revision;
    const size = whole.map((side) => Math.ceil(side / (still ? 1 : parts)));
    if (still && this.#drawn.size === String(size)) return;
    const began = performance.now();
    const bytes = simulation.draw(...size);
    [canvas.width, canvas.height] = size;
    canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(bytes.buffer, bytes.byteOffset, bytes.length), ...size), 0, 0);
    this.#cost = (performance.now() - began) / (size[0] * size[1]);
    this.#drawn = { revision: simulation.revision, size: String(size) };
  }
}

/** Adds a file or an archive. */
function add(files, path, bytes) {
  if (/\.(zip|mjz)$/i.test(path)) files.addArchive("", bytes);
  else files.add(path, bytes);
}

/** All files of what was dropped, folders with what is in them. */
async function dropped(transfer) {
  const { Files } = await load();
  const files = new Files();
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  const walk = async (entry) => {
    if (entry.isFile) {
      const file = await new Promise((done, failed) => entry.file(done, failed));
      add(files, entry.fullPath.replace(/^\//, ""), new Uint8Array(await file.arrayBuffer()));
      return;
    }
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((done, failed) => reader.readEntries(done, failed));
      if (!some.length) return;
      for (const inner of some) await walk(inner);
    }
  };
  for (const entry of entries) await walk(entry);
  return files;
}

globalThis.customElements?.define("robohive-viewer", RoboHiveViewer);
