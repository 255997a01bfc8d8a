// Pointers and keys. A mouse does what it does in MuJoCo's viewer. One finger turns the camera, two move it and bring it nearer,
// and a finger that rests selects the body under it and then pulls it.

/** How long a finger rests [ms], and how far it may stray [px]. */
const REST = 500;
const STRAY = 8;
/** What one press of a key moves, in heights of the picture. */
const NUDGE = 0.03;

/** Names of keys where shortcuts have others than browsers. */
const KEYS = {
  Equal: "Equals", BracketLeft: "OpenBracket", BracketRight: "CloseBracket", Backquote: "Backtick",
};
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * Lets a canvas be touched. `now()` is the simulation, or nothing; `changed()` is called when the picture is no longer right,
 * `selected(name)` when a body was.
 */
export function listen(canvas, { now, changed, selected }) {
  const fingers = new Map();
  let resting;
  let held = false;

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [box.width / box.height, (event.clientX - box.left) / box.width, (box.bottom - event.clientY) / box.height];
  };
  const select = (event) => {
    selected(now()?.select(...place(event)));
    changed();
  };
  const release = () => {
    clearTimeout(resting?.timer);
    resting = undefined;
    if (held) now()?.release();
    held = false;
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, event);
    release();
    if (event.ctrlKey) held = now()?.grab(event.button === 0) ?? false;
    if (event.pointerType !== "touch" || fingers.size > 1) return;
    const rest = () => {
      select(event);
      held = now()?.grab(false) ?? false;
      if (held) navigator.vibrate?.(15);
    };
    resting = { event, timer: setTimeout(rest, REST) };
  });

  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    const simulation = now();
    if (!before || !simulation) return;
    if (resting && Math.hypot(event.clientX - resting.event.clientX, event.clientY - resting.event.clientY) > STRAY) {
      clearTimeout(resting.timer);
      resting = undefined;
    }
    const height = canvas.clientHeight;
    const [right, up] = [(event.clientX - before.clientX) / height, (before.clientY - event.clientY) / height];
    if (held) simulation.drag(right, up, event.shiftKey);
    else if (fingers.size === 2) {
      const [other] = [...fingers.values()].filter((finger) => finger.pointerId !== event.pointerId);
      const apart = (finger) => Math.hypot(finger.clientX - other.clientX, finger.clientY - other.clientY);
      simulation.zoom((apart(event) - apart(before)) / height);
      simulation.pan(right / 2, up / 2);
    } else if (event.buttons & 2) simulation.pan(right, up);
    else if (event.buttons & 4) simulation.zoom(up);
    else simulation.orbit(right, up);
    changed();
    fingers.set(event.pointerId, event);
  });

  for (const end of ["pointerup", "pointercancel"])
    canvas.addEventListener(end, (event) => {
      fingers.delete(event.pointerId);
      release();
    });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", select);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    now()?.zoom(-0.02 * Math.sign(event.deltaY));
    changed();
  }, { passive: false });

  canvas.addEventListener("keydown", (event) => {
    const simulation = now();
    if (!simulation || !(moves(simulation, event) || shortcut(simulation, event))) return;
    event.preventDefault();
    changed();
  });
  canvas.addEventListener("keyup", (event) => ["Control", "Shift"].includes(event.key) && release());

  /** Cameras and hands by the keyboard. */
  function moves(simulation, event) {
    const control = event.ctrlKey || event.metaKey;
    const [right, up] = (ARROWS[event.code] ?? []).map((way) => way * NUDGE);
    if (right === undefined) {
      const nearer = { PageUp: 1, PageDown: -1 }[event.code];
      if (nearer && event.shiftKey) simulation.zoom(nearer * NUDGE);
      return Boolean(nearer && event.shiftKey);
    }
    if (control && event.shiftKey) {
      held ||= simulation.grab(false);
      simulation.drag(right, up, false);
    } else if (control) simulation.pan(right, up);
    else if (event.shiftKey) simulation.orbit(right, up);
    else return false;
    return true;
  }

  function shortcut(simulation, event) {
    if (event.altKey || event.metaKey) return false;
    const name = KEYS[event.code] ?? event.code.replace(/^(Key|Digit)/, "");
    return simulation.key((event.ctrlKey ? "Ctrl+" : "") + (event.shiftKey ? "Shift+" : "") + name);
  }
}
