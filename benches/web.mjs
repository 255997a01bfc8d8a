// Steps a second of the page's module beside native code on one thread, where that is built, and beside MuJoCo's package of npm, in
// node and in Chromium, all in turns; and frames a second of the CPU rasteriser.
//   cargo xtask web; cargo build --release -p robohive-mjcf --example steps
//   npm install --prefix target/web-tools playwright-core@1.65 @mujoco/mujoco@3.12
//   node benches/web.mjs [--rounds N] [--write FILE]        (at the top of the repository)
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { readFile, writeFile } from "node:fs/promises";
import { cpus, loadavg } from "node:os";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";
import { serve, start } from "../web/tests/browser.mjs";
import { sides } from "./web_sides.mjs";

const MODELS = { franka_table: "franka", elbow: "elbow", quadruped: "quadruped", humanoid: "humanoid", pile: "pile" };
/** Rounds that are not counted, in which engines compile what is hot. */
const WARM = 6;
/** Seconds that a round should take of each. */
const ROUND = 0.15;

const option = (name, otherwise) => (process.argv.includes(name) ? process.argv[process.argv.indexOf(name) + 1] : otherwise);
const rounds = Number(option("--rounds", "20"));
const file = option("--write");
const tools = `${process.cwd()}/target/web-tools`;
const folder = `${process.cwd()}/target/web`;
const peer = `${tools}/node_modules/@mujoco/mujoco`;
const path_of = (name) => `assets/${MODELS[name]}/${name}.xml`;

/** The native program. */
const NATIVE = "target/release/examples/steps";
const native_too = existsSync(NATIVE);

/** `seconds(model, steps)` of the native program. */
function native() {
  const child = spawn(NATIVE, { stdio: ["pipe", "pipe", "inherit"] });
  const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  const seconds = async (name, steps) => {
    child.stdin.write(`${path_of(name)} ${steps}\n`);
    return Number((await lines.next()).value);
  };
  return { seconds, end: () => child.stdin.end() };
}

const texts = Object.fromEntries(await Promise.all(Object.keys(MODELS).map(async (name) => [name, await readFile(path_of(name), "utf8")])));
const { default: loadMujoco } = await import(pathToFileURL(`${peer}/mujoco.js`));
const inNode = await sides(await import(pathToFileURL(`${folder}/node.js`)), loadMujoco, texts);
process.chdir(tools);
const host = await serve(folder, new Map([
  ["/mujoco.js", await readFile(`${peer}/mujoco.js`)],
  ["/mujoco.wasm", await readFile(`${peer}/mujoco.wasm`)],
  ["/sides.js", await readFile(new URL("web_sides.mjs", import.meta.url))],
  ["/bench.html", "<!doctype html>"],
]));
const browser = await start();
process.chdir(`${tools}/../..`);
const page = await browser.newPage();
await page.goto(`${host.address}bench.html`);
await page.evaluate(async (texts) => {
  const [robohive, mujoco, { sides }] = await Promise.all([import("/api.js"), import("/mujoco.js"), import("/sides.js")]);
  window.sides = await sides(robohive, mujoco.default, texts);
}, texts);
const inPage = (side) => (name, steps) => page.evaluate(([side, name, steps]) => window.sides[side](name, steps), [side, name, steps]);
const ours = native_too ? native() : undefined;

const COLUMNS = {
  ...(ours && { native: ours.seconds }),
  "node": inNode.robohive,
  "MuJoCo in node": inNode.mujoco,
  "Chromium": inPage("robohive"),
  "MuJoCo in Chromium": inPage("mujoco"),
};
const median = (list) => list.toSorted((a, b) => a - b)[Math.floor(list.length / 2)];
const before = loadavg()[0];
const rows = [];
for (const name of Object.keys(MODELS)) {
  // As many steps as fill a round, found in node.
  for (const side of Object.values(COLUMNS)) await side(name, 2000);
  const steps = Math.max(50, Math.round((ROUND * 500) / (await inNode.robohive(name, 500))));
  for (const [column, side] of Object.entries(COLUMNS)) if (column !== "node") await side(name, 500);
  const rates = Object.fromEntries(Object.keys(COLUMNS).map((column) => [column, []]));
  for (let round = 0; round < WARM + rounds; round++)
    for (const [column, seconds] of Object.entries(COLUMNS)) {
      const rate = steps / (await seconds(name, steps));
      if (round >= WARM) rates[column].push(rate);
    }
  // Rounds are compared with the native one beside them: other work of the machine slows all of them.
  const shares = (of, to) => median(rates[of].map((rate, k) => rate / rates[to][k]));
  const row = {
    name,
    rates: Object.fromEntries(Object.entries(rates).map(([column, list]) => [column, median(list)])),
    ...(ours && { node: shares("node", "native"), page: shares("Chromium", "native") }),
    nodePeer: shares("node", "MuJoCo in node"),
    pagePeer: shares("Chromium", "MuJoCo in Chromium"),
  };
  await inPage("frames")(name, 10);
  row.frames = 40 / (await inPage("frames")(name, 40));
  rows.push(row);
  console.log(name, JSON.stringify(row));
}
const mean = (key) => Math.exp(rows.reduce((sum, row) => sum + Math.log(row[key]), 0) / rows.length);
const version = await browser.version();
ours?.end();
await browser.close();
host.close();

const number = (value) => Math.round(value).toString();
const peerVersion = JSON.parse(await readFile(`${peer}/package.json`, "utf8")).version;
const rates = [...(ours ? ["native"] : []), "node", "Chromium", "MuJoCo in node", "MuJoCo in Chromium"];
const ratios = { ...(ours && { node: "node / native", page: "Chromium / native" }), nodePeer: "beside MuJoCo in node", pagePeer: "in Chromium" };
const line = (cells) => `| ${cells.join(" | ")} |`;
const titles = ["model", ...rates, ...Object.values(ratios), "frames/s"];
const table = [
  line(titles),
  line(titles.map(() => "---")),
  ...rows.map((row) => line([
    row.name,
    ...rates.map((column) => number(row.rates[column])),
    ...Object.keys(ratios).map((key) => row[key].toFixed(2)),
    number(row.frames),
  ])),
  ``,
  `Geometric means: ${Object.entries(ratios).map(([key, title]) => `${title} ${mean(key).toFixed(2)}`).join(", ")}.`,
  ``,
  `node ${process.versions.node}, Chromium ${version}, @mujoco/mujoco ${peerVersion}, ${cpus().length} cores, load ${before.toFixed(0)} to ${loadavg()[0].toFixed(0)}, ${rounds} rounds.`,
].join("\n");
console.log(table);
if (file) {
  const text = await readFile(file, "utf8");
  const [head, rest] = text.split("<!-- web begin -->");
  const [, tail] = rest.split("<!-- web end -->");
  await writeFile(file, `${head}<!-- web begin -->\n${table}\n<!-- web end -->${tail}`);
}
