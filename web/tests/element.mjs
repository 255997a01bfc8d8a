// The element: models fetched with all that they name, several on a page, in and out of sight, fingers, hidden tabs, lost memory,
// broken instances, without a network.
//   node element.mjs FOLDER REFERENCES STEPS WIDTH HEIGHT    (in a folder with node_modules/playwright-core)
import assert from "node:assert/strict";
import { serve, start, watched } from "./browser.mjs";
import { boxMesh, TETRAHEDRON, zip } from "./zip.mjs";

const [folder] = process.argv.slice(2);
const meshes = Array.from({ length: 12 }, (_, k) => `<mesh name="m${k}" file="../meshes/m${k}.stl"/>`).join("");
const geoms = Array.from({ length: 12 }, (_, k) => `<geom type="mesh" mesh="m${k}" pos="0 0 ${k}"/>`).join("");
const robot = `<mujoco model="fetched"><include file="parts/assets.xml"/><worldbody><light pos="0 0 3"/><body><freejoint/>${geoms}</body></worldbody></mujoco>`;
const assets = `<mujoco><asset>${meshes}<mesh name="t" file="tetra.obj"/></asset></mujoco>`;
const page_of = (body) => `<!doctype html><link rel="icon" href="data:,"><style>robohive-viewer { height: 300px }</style><script type="module" src="/robohive.js"></script>${body}`;
const more = new Map([
  ["/robots/scenes/robot.xml", robot],
  ["/robots/scenes/parts/assets.xml", assets],
  ["/robots/scenes/parts/tetra.obj", TETRAHEDRON],
  ...Array.from({ length: 12 }, (_, k) => [`/robots/meshes/m${k}.stl`, boxMesh(0.1, 0.1, 0.1 + k / 100)]),
  ["/lacking/robot.xml", robot],
  ["/lacking/parts/assets.xml", assets],
  ["/robot.zip", zip([["a.xml", "<mujoco model='a'/>"], ["b.xml", "<mujoco model='b'><worldbody><geom size='1'/></worldbody></mujoco>"]])],
  ["/endless.xml", (response) => (response.setHeader("content-length", 2e9), "<mujoco/>")],
  ["/fetched.html", page_of(`<robohive-viewer src="robots/scenes/robot.xml"></robohive-viewer>`)],
  ["/several.html", page_of([1, 2, 3].map((k) => `<robohive-viewer id="v${k}" own="elbow" running bare></robohive-viewer><div style="height: 900px"></div>`).join(""))],
]);
const host = await serve(folder, more);
const browser = await start();

// Fetched: include, meshes, at the same time, each once; then what is missing, archives, what is too large.
{
  const { page, inside, outcome, message, finish } = await watched(browser, { expected: /404|ERR_UNSAFE_PORT/ });
  await page.goto(`${host.address}fetched.html`);
  await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
  const shapes = await inside((viewer) => [viewer.simulation.name, viewer.simulation.array("nmesh").values[0]]);
  assert.deepEqual(shapes, ["fetched", 13]);
  const fetched = host.asked.filter((path) => path.startsWith("/robots/"));
  assert.equal(new Set(fetched).size, fetched.length, `each file once: ${fetched}`);
  const open = (address, path) => outcome((viewer, [address, path]) => viewer.openUrl(address, path), [address, path]);
  const lacking = await open("/lacking/robot.xml");
  assert.equal(lacking.missing.length, 13);
  assert.match(await message(), /13 missing[\s\S]*meshes\/m0\.stl[\s\S]*meshes\/m9\.stl/);
  assert.deepEqual(await open("/robot.zip"), { name: "a" });
  assert.equal(await page.locator("[data-does=path]").evaluate((list) => list.options.length), 2);
  await outcome(() => page.locator("[data-does=path]").selectOption("b.xml"));
  assert.equal(await inside((viewer) => viewer.simulation.name), "b");
  assert.deepEqual(await open("/robot.zip", "b.xml"), { name: "b" });
  assert.match((await open("/endless.xml")).message, /1907 MiB are more than a page can open/);
  assert.match((await open("http://127.0.0.1:9/robot.xml")).message, /fetch/i);
  assert.match((await outcome((viewer) => viewer.setAttribute("environment", "hive/Nothing"))).message, /Nothing/);
  assert.match((await outcome((viewer) => { viewer.setAttribute("environment", "hive/ElbowPose-v0"); viewer.setAttribute("policy", "none.pickle"); })).message, /no such file/);
  assert.match((await outcome((viewer) => viewer.setAttribute("policy", "best"))).message, /no policy is shipped for hive.ElbowPose-v0/);
  assert.deepEqual(await outcome((viewer) => viewer.setAttribute("environment", "hive/FrankaReach-v0")), { name: "hive/FrankaReach-v0" });
  const steps = await inside(({ simulation }) => {
    let steps = 0;
    while (!simulation.solved() && steps < 45) steps += simulation.step(1);
    return steps;
  });
  assert.ok(steps > 5 && steps < 45, `the policy that is shipped reaches its target after ${steps} steps`);
  await page.evaluate(() => (document.querySelector("robohive-viewer").src = 1));
  await finish();
}

// Several on a page: one compiled module, each opened when it is seen, and at rest when it is not.
{
  const { page, finish } = await watched(browser);
  await page.addInitScript(() => {
    window.compiled = 0;
    const { compileStreaming } = WebAssembly;
    WebAssembly.compileStreaming = (...given) => ((window.compiled += 1), compileStreaming.apply(WebAssembly, given));
  });
  await page.goto(`${host.address}several.html`);
  await page.waitForFunction(() => document.getElementById("v1")?.simulation?.time > 0.05);
  assert.equal(await page.evaluate(() => Boolean(document.getElementById("v3").simulation)), false, "what is out of sight is not opened");
  await page.evaluate(() => document.getElementById("v3").scrollIntoView());
  await page.waitForFunction(() => document.getElementById("v3").simulation?.time > 0.05);
  const time = () => page.evaluate(() => document.getElementById("v1").simulation.time);
  const rested = await time();
  await page.waitForTimeout(300);
  assert.equal(await time(), rested, "what is out of sight stands still");
  assert.equal(await page.evaluate(() => window.compiled), 1);
  const engines = await page.evaluate(async () => (await document.getElementById("v1").engine()) === (await document.getElementById("v3").engine()));
  assert.equal(engines, false, "each has an instance of its own");
  // Removed and put back; attributes.
  await page.evaluate(() => {
    const viewer = document.getElementById("v3");
    const { parentNode } = viewer;
    viewer.remove();
    parentNode.prepend(viewer);
    viewer.setAttribute("controls", "");
    scrollTo(0, 0);
  });
  await page.waitForFunction(() => document.getElementById("v3").simulation?.time > 0.05);
  assert.equal(await page.evaluate(() => document.getElementById("v3").shadowRoot.querySelector(".side").hidden), false);
  await page.evaluate(() => document.getElementById("v3").setAttribute("paused", ""));
  assert.equal(await page.evaluate(() => document.getElementById("v3").paused), true);
  await finish();
}

// Fingers, by the browser's own events of touch: one turns, two move and come nearer, one that rests selects and pulls.
{
  const context = await browser.newContext({ hasTouch: true, viewport: { width: 600, height: 500 } });
  const { page, inside, finish } = await watched(context);
  await page.goto(`${host.address}#model=pile`);
  await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
  const session = await context.newCDPSession(page);
  const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const eye = () => inside((viewer) => [...viewer.simulation.draw(48, 36)].join());
  const pictures = [await eye()];
  await touch("touchStart", [300, 300]);
  await touch("touchMove", [360, 320]);
  await touch("touchEnd");
  pictures.push(await eye());
  await touch("touchStart", [250, 300], [350, 300]);
  await touch("touchMove", [200, 300], [400, 300]);
  await touch("touchEnd");
  pictures.push(await eye());
  assert.equal(new Set(pictures).size, 3, "one finger turns, two come nearer");
  await page.reload();
  await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
  await inside((viewer) => viewer.addEventListener("pick", (event) => (window.picked = event.detail.body)));
  const box = await page.locator("robohive-viewer canvas").boundingBox();
  let held = false;
  for (let k = 0; k < 12 && !held; k++) {
    const at = [box.x + box.width / 2 + (k % 4) * 25 - 40, box.y + box.height / 2 + Math.floor(k / 4) * 30];
    await touch("touchStart", at);
    await page.waitForTimeout(700);
    held = Boolean(await inside((viewer) => window.picked && viewer.simulation.selected));
    if (held) {
      const before = await inside((viewer) => viewer.simulation.qpos.join());
      await touch("touchMove", [at[0] + 5, at[1] - 60]);
      await page.waitForFunction((before) => document.querySelector("robohive-viewer").simulation.qpos.join() !== before, before);
    }
    await touch("touchEnd");
  }
  assert.ok(held, "a finger that rests selects and moves a body");
  await finish();
  await context.close();
}

// A recording in a tab that is hidden; the picture's memory taken away and given back; an instance that breaks; a large one left behind.
{
  const { page, inside, outcome, message, colours, finish } = await watched(browser);
  await page.goto(`${host.address}#model=elbow&running`);
  await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation?.running);
  await inside((viewer) => viewer.record());
  const hide = (hidden) => page.evaluate((hidden) => {
    Object.defineProperty(document, "hidden", { value: hidden, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
  }, hidden);
  await hide(true);
  await page.waitForTimeout(200);
  await hide(false);
  assert.match(await message(), /stood still for 0 s[\s\S]*no step is missing/);
  assert.equal(await inside((viewer) => viewer.simulation.recording), true);
  const context = (type) => inside((viewer, type) => viewer.shadowRoot.querySelector("canvas").dispatchEvent(new Event(type)), type);
  await context("contextlost");
  assert.match(await message(), /will give it back/);
  await context("contextrestored");
  assert.equal(await message(), "");
  assert.ok((await colours()) > 20);
  const broken = await outcome(async (viewer) => {
    const { Simulation } = await viewer.engine();
    const { draw } = Simulation.prototype;
    Simulation.prototype.draw = () => { throw new WebAssembly.RuntimeError("unreachable"); };
    viewer.simulation.step(1);
    setTimeout(() => (Simulation.prototype.draw = draw), 500);
  });
  assert.match(broken.message, /The engine has stopped/);
  assert.equal((await outcome((viewer) => viewer.setAttribute("own", "pile"))).message, undefined);
  assert.ok((await colours()) > 20, "another instance goes on");
  const memory = () => inside(async (viewer) => (await viewer.engine()).memoryBytes());
  const small = await memory();
  const text = `<mujoco><worldbody>${`<replicate count="100000" offset="0 0 1"><site/></replicate>`.repeat(9)}<geom size="-1"/></worldbody></mujoco>`;
  const huge = await outcome((viewer, text) => {
    viewer.removeAttribute("own");
    return viewer.openFiles([{ path: "huge.xml", bytes: new TextEncoder().encode(text) }]);
  }, text);
  assert.ok(huge.message, "a huge model that cannot be compiled");
  assert.ok((await memory()) < small + 16e6, "its memory is given up");
  assert.ok(await inside((viewer) => viewer.simulation.step(1)), "what was shown goes on");
  assert.match((await outcome((viewer) => viewer.setAttribute("own", "elbow"))).name, /elbow/);
  await finish();
}

// Without a network, after the first load.
{
  const { page, finish, colours } = await watched(browser);
  await page.goto(`${host.address}#model=quadruped`);
  await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
  await page.evaluate(() => navigator.serviceWorker.ready);
  const names = await page.evaluate(() => caches.keys());
  assert.equal(names.length, 1);
  assert.match(names[0], /^robohive-[0-9a-f]{16}$/);
  host.close();
  await page.context().setOffline(true);
  await page.goto(`${host.address}?again#model=pile`);
  await page.waitForFunction(() => document.querySelector("robohive-viewer")?.simulation);
  assert.ok((await colours()) > 20);
  await finish();
}
await browser.close();
console.log("files fetched, several viewers, fingers, hidden tabs, lost memory and no network are as they should be");
