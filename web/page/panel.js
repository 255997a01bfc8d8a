// The panel beside the picture: controls, what is shown, bodies to select, keys.

const element = (tag, properties, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};
const labelled = (...children) => element("label", {}, ...children);
const folded = (title, open, ...children) => element("details", { open }, element("summary", { textContent: title }), ...children);

/** Fills the panel for a simulation. `changed()` is called when the picture is no longer right, `attempt(action)` does what may fail. */
export function fill(side, simulation, { changed, attempt, Simulation }) {
  side.replaceChildren(
    ...controls(simulation, attempt),
    folded("Speed", false, speed(simulation)),
    folded("Selected body", false, bodies(simulation, changed)),
    folded("Keyframes", false, ...keyframes(simulation, attempt)),
    folded("Shown", false, ...switches(simulation, changed)),
    folded("Keys", false, keys(Simulation)),
  );
}

/** A slider for each control; in an environment actions decide these. */
function controls(simulation, attempt) {
  if (simulation.isEnvironment) return [];
  const ranges = simulation.controlRanges();
  const values = simulation.controls;
  const rows = simulation.controlNames().map((name, k) => {
    const [min, max] = [ranges[2 * k], ranges[2 * k + 1]];
    const input = element("input", { type: "range", min, max, step: (max - min) / 1000, value: values[k] });
    input.addEventListener("input", () => attempt(() => simulation.setControl(k, Number(input.value))));
    return labelled(name, input);
  });
  const zero = element("button", { textContent: "All to zero" });
  zero.addEventListener("click", () => attempt(() => {
    simulation.write("ctrl", new Float64Array(values.length));
    rows.forEach((row) => (row.querySelector("input").value = 0));
  }));
  return rows.length ? [zero, ...rows] : [];
}

function speed(simulation) {
  const text = () => `${simulation.speed} % of real time`;
  const shown = element("span", { textContent: text() });
  const button = (name, key) => {
    const made = element("button", { textContent: name });
    made.addEventListener("click", () => (simulation.key(key), (shown.textContent = text())));
    return made;
  };
  return element("div", {}, button("Slower", "Minus"), " ", button("Faster", "Equals"), " ", shown);
}

function bodies(simulation, changed) {
  const names = simulation.names("body").map((name, k) => new Option(k ? name || `body ${k}` : "none", k));
  const list = element("select", { ariaLabel: "selected body" }, ...names);
  list.dataset.does = "body";
  list.addEventListener("change", () => (simulation.selectBody(Number(list.value)), changed()));
  return list;
}

function keyframes(simulation, attempt) {
  const button = (name, key) => {
    const made = element("button", { textContent: name });
    made.addEventListener("click", () => attempt(() => simulation.resetToKey(key)));
    return made;
  };
  if (simulation.isEnvironment) return ["its task says how episodes begin"];
  return [button("Reference", -1), ...simulation.names("key").map((name, k) => button(name || `key ${k}`, k))];
}

function switches(simulation, changed) {
  return simulation.switches().map((name) => {
    const input = element("input", { type: "checkbox", checked: simulation.shows(name) });
    input.addEventListener("change", () => (simulation.show(name, input.checked), changed()));
    return labelled(input, ` ${name}`);
  });
}

/** Keys that move the camera and the selected body, beside those of MuJoCo's viewer. */
const MOVES = [
  ["Shift+arrows", "Turn the free camera"],
  ["Ctrl+arrows", "Move it"],
  ["Shift+PageUp, PageDown", "Bring it nearer, or away"],
  ["Ctrl+Shift+arrows", "Pull the selected body"],
];

function keys(Simulation) {
  const words = Simulation.shortcuts();
  const own = words.flatMap((key, k) => (k % 2 ? [] : [[key, words[k + 1]]]));
  return element("dl", {}, ...[...MOVES, ...own].flatMap(([key, name]) => [element("dt", { textContent: key }), element("dd", { textContent: name })]));
}
