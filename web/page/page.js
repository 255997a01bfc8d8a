// The page around one viewer: what to open, and links that say what is open.
//
//   #model=quadruped&camera=track&running      a model of our own, or the address of one
//   #environment=hive/FrankaReach-v0&seed=3    an environment
//   #model=robots.zip&path=arm/scene.xml       a model of an archive

import { load } from "./robohive.js";
import { chosen, readAll } from "./files.js";

const viewer = document.getElementById("viewer");
const { Files, ownModels, ownEnvironments } = await load();
const lists = { own: ownModels(), environment: ownEnvironments() };
for (const [id, names] of Object.entries(lists)) {
  const list = document.getElementById(id);
  list.append(...names.map((name) => new Option(name, name)));
  list.addEventListener("change", () => {
    if (list.value) location.hash = new URLSearchParams({ [id === "own" ? "model" : id]: list.value });
  });
}

/** Shows what the link names. */
function follow() {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const model = wanted.get("model");
  if (model) wanted.set(lists.own.includes(model) ? "own" : "src", model);
  for (const name of ["src", "own", "environment", "path", "camera", "seed", "policy", "replay", "running", "controls"])
    wanted.has(name) ? viewer.setAttribute(name, wanted.get(name)) : viewer.removeAttribute(name);
  for (const id of Object.keys(lists)) document.getElementById(id).value = wanted.get(id) ?? "";
}
addEventListener("hashchange", follow);

for (const button of document.querySelectorAll("[data-opens]")) {
  const input = document.getElementById(button.dataset.opens);
  button.addEventListener("click", () => input.click());
  input.addEventListener("change", async () => {
    try {
      const files = await readAll(chosen(input), Files.mostBytes());
      input.value = "";
      await viewer.give(files);
    } catch (error) {
      viewer.say(error.message);
    }
  });
}

if (!location.hash) history.replaceState(null, "", "#model=quadruped");
follow();

// What was loaded once is there without a network.
if (isSecureContext && "serviceWorker" in navigator) navigator.serviceWorker.register("offline.js").catch(() => {});
