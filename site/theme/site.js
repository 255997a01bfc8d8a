// Live models: the engine is fetched when somebody asks for it, or, on the first page, once the page is there. Without it (no
// WebAssembly, or a build of the site without the module, which says so in the next line) pictures stay.
const HAS_ENGINE = true;
/** Longest time that opening a model may take [ms]. */
const LIMIT = 60_000;

(() => {
  const figures = [...document.querySelectorAll("figure.live")];
  if (!HAS_ENGINE || !figures.length || typeof WebAssembly !== "object" || location.protocol === "file:") return;
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches || navigator.connection?.saveData;
  const engine = new URL(`${path_to_root}live/robohive.js`, location.href);

  /** Waits until a viewer shows its model. */
  const opened = async (viewer) => {
    for (const began = performance.now(); !viewer.simulation; await new Promise(requestAnimationFrame))
      if (performance.now() - began > LIMIT) throw new Error("the engine did not open it in time");
  };

  const start = async (figure) => {
    const button = figure.querySelector("button");
    const viewer = figure.querySelector("robohive-viewer");
    button.disabled = true;
    button.textContent = "Loading…";
    try {
      await import(engine);
      // Viewers that nobody has started yet fetch nothing: their models are named only now.
      for (const [name, value] of Object.entries(viewer.dataset)) viewer.setAttribute(name, value);
      await opened(viewer);
      figure.classList.add("open");
    } catch (error) {
      button.remove();
      console.info(`no live model: ${error.message}`);
    }
  };

  for (const figure of figures) {
    const viewer = figure.querySelector("robohive-viewer");
    for (const { name, value } of [...viewer.attributes]) {
      viewer.dataset[name] = value;
      viewer.removeAttribute(name);
    }
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: "Run it here" });
    button.addEventListener("click", () => start(figure));
    figure.append(button);
  }
  const isStart = path_to_root === "" && /(^|\/)(index\.html)?$/.test(location.pathname);
  if (isStart && !still) start(figures[0]);
})();
