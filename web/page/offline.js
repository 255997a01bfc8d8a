// Keeps the page for when there is no network: the newest files while there is one, those of this version otherwise.

const VERSION = "@VERSION@";
const FILES = ["./", /* @FILES@ */];
/** What the viewer needs beside: kept once it has been opened. */
const VIEWER = [/* @VIEWER@ */];

const keep = async (files, cache) => (await caches.open(VERSION)).addAll(files.map((file) => new Request(file, { cache })));

/** Keeps those that are not kept yet: the module of the viewer is large. */
async function keepMissing(files) {
  const kept = await caches.open(VERSION);
  const found = await Promise.all(files.map((file) => kept.match(file)));
  await kept.addAll(files.filter((_, k) => !found[k]));
}

addEventListener("install", (event) => event.waitUntil(keep(FILES, "no-cache")));

addEventListener("message", (event) => {
  if (event.data === "viewer") event.waitUntil(keepMissing(VIEWER));
});

addEventListener("activate", (event) => {
  const clear = async () => {
    for (const name of await caches.keys()) if (name.startsWith("robohive-") && name !== VERSION) await caches.delete(name);
    await clients.claim();
  };
  event.waitUntil(clear());
});

addEventListener("fetch", (event) => {
  const { request } = event;
  const here = new URL("./", location.href).href;
  if (request.method !== "GET" || !request.url.startsWith(here)) return;
  const answer = async () => {
    const kept = await caches.open(VERSION);
    try {
      return await fetch(request);
    } catch (error) {
      const found = await kept.match(request, { ignoreSearch: true });
      if (found) return found;
      throw error;
    }
  };
  event.respondWith(answer());
});
