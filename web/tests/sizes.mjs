// What pages load, and that the viewer stays within four megabytes as a host that compresses sends it.
//   node sizes.mjs FOLDER
import { readFile } from "node:fs/promises";
import { brotliCompressSync, constants } from "node:zlib";
import assert from "node:assert/strict";

const MOST = 4e6;
const [folder] = process.argv.slice(2);
const PAGES = {
  engine: ["engine_bg.wasm", "engine.js", "robohive.js"],
  viewer: ["viewer.html", "viewer-page.js", "viewer_bg.wasm", "viewer.js"],
};

for (const [page, names] of Object.entries(PAGES)) {
  const files = await Promise.all(names.map((name) => readFile(`${folder}/${name}`)));
  const packed = files.map((bytes) => brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } }).length);
  const sum = (sizes) => sizes.reduce((a, b) => a + b, 0);
  const [raw, brotli] = [sum(files.map((bytes) => bytes.length)), sum(packed)];
  console.log(`${page}: ${(raw / 1e6).toFixed(2)} MB, ${(brotli / 1e6).toFixed(2)} MB by brotli`);
  assert.ok(brotli <= MOST, `${page} is larger than ${MOST / 1e6} MB by brotli`);
}
