// What the tests in a browser share: a host on the loopback address, a page, and its complaints.
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname } from "node:path";
import { createRequire } from "node:module";
import { execFileSync } from "node:child_process";
import assert from "node:assert/strict";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".json": "application/json", ".xml": "text/xml" };

/** Serves a folder, and before it `more`: paths to bytes or texts. Counts what is asked for. */
export async function serve(folder, more = new Map()) {
  const asked = [];
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://page").pathname).replace(/\/$/, "/index.html");
    asked.push(path);
    const answer = more.get(path);
    try {
      const content = typeof answer === "function" ? answer(response) : (answer ?? (await readFile(folder + path)));
      response.writeHead(200, { "content-type": TYPES[extname(path)] ?? "application/octet-stream" }).end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return { address: `http://127.0.0.1:${server.address().port}/`, asked, close: () => server.close() };
}

/** Starts a browser. */
export async function start(options = {}) {
  const { chromium } = createRequire(`${process.cwd()}/`)("playwright-core");
  const executablePath = execFileSync("which", ["chromium"], { encoding: "utf8" }).trim();
  return chromium.launch({ executablePath, args: ["--no-sandbox", ...(options.args ?? ["--disable-gpu"])] });
}

/** A page whose complaints end the test, but for those that `expected` names. */
export async function watched(browser, { expected = /$^/, ...options } = {}) {
  const page = await browser.newPage({ viewport: { width: 900, height: 560 }, ...options });
  const complaints = [];
  const known = (text) => expected.test(text) || /willReadFrequently/.test(text);
  page.on("console", (line) => ["error", "warning"].includes(line.type()) && !known(line.text()) && complaints.push(line.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  const finish = async () => {
    assert.deepEqual(complaints, []);
    await page.close();
  };
  /** Runs `action(viewer, argument)` in the page. */
  const inside = (action, argument) =>
    page.evaluate(`(${action})(document.querySelector("robohive-viewer"), ${JSON.stringify(argument) ?? "undefined"})`);
  /** Does something, and tells what the viewer then says: the name of what is open, or the message. */
  const outcome = async (action, argument) => {
    await inside((viewer) => {
      window.outcome = new Promise((done) => {
        viewer.addEventListener("load", (event) => done({ name: event.detail.name }), { once: true });
        viewer.addEventListener("error", (event) => done(event.detail), { once: true });
      });
    });
    await (typeof action === "function" && action.length === 0 ? action() : inside(action, argument));
    return page.evaluate(() => Promise.race([window.outcome, new Promise((done) => setTimeout(done, 60_000, "nothing happened"))]));
  };
  /** What the message says; empty where there is none. */
  const message = () => inside((viewer) => {
    const box = viewer.shadowRoot.querySelector(".message");
    return box.hidden ? "" : box.querySelector("pre").textContent;
  });
  /** Distinct colours of the canvas, once a frame has been drawn. */
  const colours = () => inside((viewer) => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
    const canvas = viewer.shadowRoot.querySelector("canvas");
    const words = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    done(new Set(words).size);
  }))));
  return { page, inside, outcome, message, colours, finish };
}
