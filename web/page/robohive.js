// `<robohive-viewer>`: a simulation in a page.
//
//   <script type="module" src="robohive.js"></script>
//   <robohive-viewer own="quadruped" running></robohive-viewer>
//
// | attribute | what it says |
// |---|---|
// | `src` | address of a model or a zip archive, or `github:OWNER/NAME/BRANCH/PATH` |
// | `path` | which model of the archive |
// | `own` | name of a model of our own |
// | `environment`, `seed`, `policy` | an id, the seed of its first episode, the address of a policy, or `best` for the one that is shipped |
// | `replay` | address of recorded states (`.npz`) that are shown instead of a simulation |
// | `camera` | name of a camera |
// | `running`, `paused` | whether time goes by: `paused` wins |
// | `controls` | shows the panel of controls |
// | `bare` | shows no bar |
// | `loading` | `eager`: opened before it is seen |
//
// Events: `load` (`detail.name`), `error` (`detail.message`, `detail.missing`), `step` (`detail.time`, `detail.steps`), `pick`
// (`detail.body`), `record` (`detail.name`, `detail.bytes`; prevent the default to keep the file from being downloaded).

import { instance, MissingFiles, openFiles, openUrl } from "./api.js";
import { bytesAt, chosen, download, dropped, isModel, isPolicy, isTrajectory, policyAt, readAll } from "./files.js";
import { Film } from "./film.js";
import { listen } from "./gestures.js";
import { build } from "./look.js";
import { fill } from "./panel.js";

export * from "./api.js";

/** Milliseconds of a frame that physics may take, and that a picture may take while things move. */
const PHYSICS = 9;
const PICTURE = 45;
/** Coarsest picture, in parts of the canvas's width, and longest time that is caught up with [s]. */
const COARSEST = 4;
const LONGEST = 0.25;
/** Bytes of memory that a failed load may leave behind. */
const LEFT = 256 << 20;

/** A simulation in a page. */
export class RoboHiveViewer extends (globalThis.HTMLElement ?? Object) {
  static observedAttributes = ["src", "path", "own", "environment", "seed", "policy", "replay", "camera", "running", "paused", "controls", "bare"];

  /** The engine's `Simulation`, or nothing yet. */
  simulation;
  #engine;
  #observer;
  #visible = false;
  #stale = true;
  /** Counts what is opened: the last one wins. */
  #turn = 0;
  #pending;
  /** What is open and lacks files: how to open it again with more. */
  #again;
  /** The fault that was told. */
  #told;
  #film;
  #hidden = 0;
  #cost = 0;
  #drawn = {};
  #last = 0;
  #frame = 0;
  #watch = () => this.#hide();

  connectedCallback() {
    if (!this.shadowRoot) this.#build();
    this.#observer = new IntersectionObserver((seen) => this.#see(seen.at(-1).isIntersecting));
    this.#observer.observe(this);
    document.addEventListener("visibilitychange", this.#watch);
    this.#stale = true;
    if (this.getAttribute("loading") === "eager") this.#refresh();
  }

  disconnectedCallback() {
    this.#observer.disconnect();
    document.removeEventListener("visibilitychange", this.#watch);
    clearTimeout(this.#pending);
    this.#see(false);
    this.#turn += 1;
    this.#take(undefined);
    this.#engine = undefined;
  }

  attributeChangedCallback(name, before, after) {
    if (!this.isConnected || !this.shadowRoot || before === after) return;
    if (name === "camera") this.#useCamera();
    else if (name === "running" || name === "paused") this.run(this.#wantsToRun);
    else if (name === "controls") this.#unfold(after !== null);
    else if (name === "bare") this.#part(".bar").hidden = after !== null;
    else {
      this.#stale = true;
      if (this.#visible) this.#refresh();
    }
  }

  /** The engine's classes and functions, in an instance of this element alone. */
  async engine() {
    this.#engine ??= instance();
    this.#engine.catch(() => (this.#engine = undefined));
    return this.#engine;
  }

  /** Shows the model at `path` among files (`{ path, bytes }`) and archives, or the one nearest to the top. */
  openFiles(files, path) {
    return this.#open((engine) => this.#among(engine, files, path));
  }

  /** Takes files (`{ path, bytes }`) as if they were dropped: a model, what it lacks, recorded states, or a policy. */
  give(files) {
    return this.#open((engine) => this.#sort(engine, files));
  }

  /** Shows a model or an archive by its address. */
  openUrl(address, path) {
    return this.#open(async (engine) => {
      const files = new engine.Files();
      this.#again = (more, chosen) => this.#within(files, more, chosen ?? path);
      const simulation = await openUrl(address, { engine, path, files });
      this.#models(files, path);
      return simulation;
    });
  }

  /** Lets time go by, or stops it. */
  run(running = true) {
    if (this.simulation) this.simulation.running = running;
    this.#label();
  }

  /** Whether time stands still. */
  get paused() {
    return !this.simulation?.running;
  }

  /** Begins to record every step; `endRecording` gives the archive. */
  record() {
    this.simulation?.record();
    this.#label();
  }

  /** Ends the recording and offers it as a file. */
  endRecording() {
    if (this.simulation?.recordingFull) this.say("The recording was full: the last steps are not in it.");
    this.#offer("states.npz", this.simulation.endRecording());
  }

  /** Says something over the picture, or nothing. */
  say(message, missing = []) {
    const box = this.#part(".message");
    box.querySelector("pre").textContent = message ?? "";
    box.querySelector(".supply").hidden = !missing.length;
    box.hidden = !message;
  }

  get #wantsToRun() {
    return this.hasAttribute("running") && !this.hasAttribute("paused");
  }

  #part(selector) {
    return this.shadowRoot.querySelector(selector);
  }

  #tell(type, detail, options = {}) {
    return this.dispatchEvent(new CustomEvent(type, { detail, ...options }));
  }

  #build() {
    const root = this.attachShadow({ mode: "open" });
    build(root);
    this.#part(".bar").hidden = this.hasAttribute("bare");
    root.addEventListener("click", (event) => this.#does(event.target.dataset?.does));
    this.#part("[data-does=seek]").addEventListener("input", (event) => this.simulation?.seek(Number(event.target.value)));
    this.#part("[data-does=camera]").addEventListener("change", (event) => this.#camera(Number(event.target.value)));
    const models = this.#part("[data-does=path]");
    models.addEventListener("change", () => this.#open(() => this.#again([], models.value)));
    const input = this.#part("input[type=file]");
    input.addEventListener("change", () => this.#given(chosen(input)));
    const canvas = this.#part("canvas");
    listen(canvas, {
      now: () => this.simulation,
      changed: () => this.#changed(),
      selected: (body) => this.#selected(body),
    });
    canvas.addEventListener("contextlost", () => this.say("The browser has taken the picture's memory away, and will give it back."));
    canvas.addEventListener("contextrestored", () => (this.say(), this.#changed()));
    this.addEventListener("dragover", (event) => event.preventDefault());
    this.addEventListener("drop", (event) => {
      event.preventDefault();
      const listed = dropped(event.dataTransfer);
      // It is waited for later, where its failure is told.
      listed.catch(() => {});
      this.#given(listed);
    });
  }

  /** The element has come into sight, or gone out of it. */
  #see(visible) {
    if (visible === this.#visible) return;
    this.#visible = visible;
    if (visible && this.#stale) this.#refresh();
    if (visible) {
      this.#last = performance.now();
      this.#frame = requestAnimationFrame((now) => this.#show(now));
    } else if (!this.#isRecording) {
      cancelAnimationFrame(this.#frame);
    }
  }

  get #isRecording() {
    return Boolean(this.#film || this.simulation?.recording);
  }

  /** The tab is hidden or shown: browsers draw nothing in hidden ones, so a recording stands still, and says so. */
  #hide() {
    this.#film?.pause(document.hidden);
    if (document.hidden) this.#hidden = performance.now();
    else if (this.#isRecording && this.simulation?.running) {
      const seconds = ((performance.now() - this.#hidden) / 1000).toFixed(0);
      this.say(`The simulation and its recording stood still for ${seconds} s, while the tab was hidden; no step is missing.`);
    }
    this.#last = performance.now();
  }

  /** Opens what the attributes name. Of several changes at once the last counts. */
  #refresh() {
    clearTimeout(this.#pending);
    this.#stale = false;
    this.#pending = setTimeout(() => this.#named());
  }

  #named() {
    const [src, own, environment, path] = ["src", "own", "environment", "path"].map((name) => this.getAttribute(name));
    if (environment) return this.#open((engine) => this.#environment(engine, environment));
    if (own) return this.#open((engine) => engine.Simulation.own(own));
    if (src) return this.openUrl(src, path ?? undefined);
  }

  async #environment(engine, id) {
    return this.#play(engine, id, await policyAt(this.getAttribute("policy"), id, engine.Files.mostBytes()));
  }

  #play(engine, id, policy) {
    return engine.Simulation.environment(id, BigInt(this.getAttribute("seed") ?? 0), policy);
  }

  /** Opens a model among files, and remembers how to go on where some are missing. */
  async #among(engine, given, path) {
    const files = new engine.Files();
    this.#again = (more, chosen) => this.#within(files, more, chosen ?? path);
    const simulation = await openFiles(given, { engine, path, files });
    this.#models(files, path);
    return simulation;
  }

  async #within(files, more, path) {
    const simulation = await openFiles(more, { engine: await this.engine(), path, files });
    this.#models(files, path);
    return simulation;
  }

  /** Lists the models among files. */
  #models(files, path) {
    const models = files.models();
    const list = this.#part("[data-does=path]");
    list.replaceChildren(...models.map((name) => new Option(name, name, false, name === (path ?? models[0]))));
    list.hidden = models.length < 2;
  }

  /** Takes what a person gave. */
  #given(listed) {
    return this.#open(async (engine) => this.#sort(engine, await readAll(await listed, engine.Files.mostBytes())));
  }

  /** Files by what they are: recorded states, a policy for the environment that is shown, what a model lacks, or something new. */
  #sort(engine, files) {
    const [first, ...more] = files;
    const alone = this.simulation && first && !more.length;
    if (alone && isTrajectory(first.path)) return this.#replay(first);
    const environment = this.simulation?.isEnvironment && this.simulation.name;
    if (environment && alone && isPolicy(first.path)) return this.#play(engine, environment, first.bytes);
    const lacking = !this.#part(".supply").hidden && this.#again;
    return lacking && !files.some(({ path }) => isModel(path)) ? lacking(files) : this.#among(engine, files);
  }

  #replay({ path, bytes }) {
    this.simulation.replay(path, bytes);
    this.say();
    this.#replays();
  }

  /** Shows what `make(engine)` opens, or why it cannot be opened. */
  async #open(make) {
    const turn = ++this.#turn;
    this.setAttribute("aria-busy", "true");
    this.#part(".status").textContent = "loading…";
    try {
      // Compiling a model blocks the page: what says so is painted first.
      await new Promise((done) => setTimeout(done, 20));
      const simulation = await make(await this.engine());
      if (turn !== this.#turn || !simulation) return simulation?.free();
      this.say();
      await this.#take(simulation);
      this.#tell("load", { name: simulation.name });
    } catch (error) {
      if (turn === this.#turn) await this.#fail(error);
    } finally {
      if (turn === this.#turn) this.removeAttribute("aria-busy");
    }
  }

  /** Says what went wrong. An instance that has broken, or that a failed load has swollen, is given up: another opens what comes next. */
  async #fail(error) {
    const missing = error instanceof MissingFiles ? error.missing : [];
    const broken = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
    const engine = await this.#engine?.catch(() => undefined);
    if (broken || (engine?.memoryBytes() > LEFT && !missing.length)) this.#engine = this.#again = undefined;
    if (broken) {
      this.simulation = undefined;
      this.#changed();
    }
    const what = broken ? `The engine has stopped, most likely for lack of memory: ${error.message}` : (error.message ?? String(error));
    const more = missing.length ? `\n\n${missing.length} missing: drop them here, or add them:\n${missing.join("\n")}` : "";
    this.say(what + more, missing);
    this.#part(".status").textContent = this.simulation?.name ?? "";
    this.#tell("error", { message: what, missing });
  }

  /** Does something that may fail, and says why it did. */
  #attempt(action) {
    try {
      action();
    } catch (error) {
      this.#fail(error);
    }
  }

  async #take(simulation) {
    if (this.#film) this.#endFilm();
    this.simulation?.free();
    this.simulation = simulation;
    this.#told = undefined;
    this.#changed();
    if (!simulation) return;
    const cameras = this.#part("[data-does=camera]");
    cameras.replaceChildren(...["free camera", ...simulation.cameras()].map((name, k) => new Option(name, k - 1)));
    this.#useCamera();
    await this.#replayNamed(simulation);
    this.#replays();
    const { Simulation } = await this.engine();
    if (simulation !== this.simulation) return;
    fill(this.#part(".side"), simulation, {
      changed: () => this.#changed(),
      attempt: (action) => this.#attempt(action),
      Simulation,
    });
    this.#unfold(this.hasAttribute("controls"));
    this.run(this.#wantsToRun);
    if (simulation.warnings) console.info(simulation.warnings);
  }

  /** Shows the states that the attribute names. */
  async #replayNamed(simulation) {
    const address = this.getAttribute("replay");
    if (!address) return;
    const { Files } = await this.engine();
    const bytes = await bytesAt(address, Files.mostBytes());
    if (simulation === this.simulation) simulation.replay(address, bytes);
  }

  /** The slider through recorded states, where there are some. */
  #replays() {
    const slider = this.#part("[data-does=seek]");
    const { states = 0 } = this.simulation ?? {};
    slider.hidden = !states;
    slider.max = Math.max(states - 1, 0);
    this.#part("[data-does=record]").hidden = states > 0;
    this.#changed();
  }

  #useCamera() {
    const place = this.simulation?.cameras().indexOf(this.getAttribute("camera")) ?? -1;
    if (place >= 0) this.#camera(place);
  }

  #camera(place) {
    this.#attempt(() => this.simulation?.useCamera(place));
    this.#changed();
  }

  #changed() {
    this.#drawn = {};
  }

  #selected(body) {
    this.#part("[role=status]").textContent = body ? `${body} is selected` : "nothing is selected";
    this.#tell("pick", { body });
  }

  #does(what) {
    const { simulation } = this;
    if (what === "dismiss") this.say();
    else if (what === "supply") this.#part("input[type=file]").click();
    if (!simulation) return;
    if (what === "run") this.run(!simulation.running);
    else if (what === "step") simulation.step(1);
    else if (what === "back") simulation.stepBack();
    else if (what === "reset") simulation.reset();
    else if (what === "side") this.#unfold(this.#part(".side").hidden);
    else if (what === "record") simulation.recording ? this.endRecording() : this.record();
    else if (what === "film") this.#attempt(() => (this.#film ? this.#endFilm() : this.#beginFilm()));
    this.#label();
  }

  #beginFilm() {
    const { clientWidth, clientHeight } = this;
    this.#film = new Film(clientWidth, clientHeight);
  }

  async #endFilm() {
    const film = this.#film;
    this.#film = undefined;
    const { name } = this.simulation;
    this.#label();
    this.#offer(`film.${film.ending}`, await film.end(), name);
  }

  /** Offers a file, unless who listens keeps it. */
  #offer(ending, bytes, name = this.simulation.name) {
    const file = `${name.replace(/[^\w.-]+/g, "_") || "simulation"}.${ending}`;
    if (this.#tell("record", { name: file, bytes }, { cancelable: true })) download(file, bytes);
    this.#label();
  }

  #unfold(open) {
    this.#part(".side").hidden = !open;
    this.#part("[data-does=side]").setAttribute("aria-expanded", String(open));
  }

  #label() {
    const running = this.simulation?.running ?? false;
    this.#part("[data-does=run]").textContent = running ? "Pause" : "Run";
    this.#part("[data-does=record]").setAttribute("aria-pressed", String(this.simulation?.recording ?? false));
    this.#part("[data-does=film]").setAttribute("aria-pressed", String(Boolean(this.#film)));
  }

  #show(now) {
    if (!this.#visible && !this.#isRecording) return;
    this.#frame = requestAnimationFrame((next) => this.#show(next));
    const { simulation } = this;
    const elapsed = Math.min(Math.max(now - this.#last, 0) / 1000, LONGEST);
    this.#last = now;
    if (!simulation) return;
    try {
      const steps = simulation.advance(elapsed, PHYSICS);
      this.#draw(simulation);
      if (steps) this.#tell("step", { time: simulation.time, steps });
      if (simulation.fault !== this.#told) this.#fault(simulation.fault);
      this.#status(simulation);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) this.run(false);
      this.#fail(error);
    }
  }

  /** Says once why the simulation has stopped. */
  #fault(fault) {
    this.#told = fault;
    if (!fault) return;
    this.say(`The simulation has stopped: ${fault}`);
    this.#label();
    this.#tell("error", { message: fault, missing: [] });
  }

  #status(simulation) {
    const past = simulation.behind ? ` (−${simulation.behind})` : "";
    const speed = simulation.running && simulation.reachedSpeed ? `  ${simulation.reachedSpeed.toFixed(0)} %` : "";
    const { states, state, difference } = simulation;
    const slider = this.#part("[data-does=seek]");
    if (slider.hidden === states > 0) this.#replays();
    if (states && Number(slider.value) !== state) slider.value = state;
    const beside = difference === undefined ? "" : `  ${difference.toExponential(1)} beside`;
    const kept = simulation.recording ? `  ${simulation.recorded} states recorded` : "";
    const text = `${simulation.name}  ${simulation.time.toFixed(3)} s${past}${speed}  ${simulation.contacts} contacts${kept}${beside}`;
    this.#part(".status").textContent = text;
    if (this.#part("[data-does=run]").textContent !== (simulation.running ? "Pause" : "Run")) this.#label();
    const cameras = this.#part("[data-does=camera]");
    if (Number(cameras.value) !== simulation.camera) cameras.value = simulation.camera;
  }

  /** A coarse picture while things move and drawing is slow, a fine one when they stand still. */
  #draw(simulation) {
    const canvas = this.#part("canvas");
    const scale = Math.min(devicePixelRatio || 1, 2);
    const whole = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * scale)));
    const parts = Math.min(COARSEST, Math.max(1, Math.ceil(Math.sqrt((this.#cost * whole[0] * whole[1]) / PICTURE))));
    const still = this.#drawn.revision === simulation.revision;
    const size = whole.map((side) => Math.ceil(side / (still ? 1 : parts)));
    if (!still || this.#drawn.size !== String(size)) {
      const began = performance.now();
      const bytes = simulation.draw(...size);
      [canvas.width, canvas.height] = size;
      const pixels = new Uint8ClampedArray(bytes.buffer, bytes.byteOffset, bytes.length);
      canvas.getContext("2d").putImageData(new ImageData(pixels, ...size), 0, 0);
      this.#cost = (performance.now() - began) / (size[0] * size[1]);
      this.#drawn = { revision: simulation.revision, size: String(size) };
    }
    this.#film?.show(canvas);
  }
}

globalThis.customElements?.define("robohive-viewer", RoboHiveViewer);
