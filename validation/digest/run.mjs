// Compares the hashes that the WebAssembly module computes with the recorded ones, but for those whose names begin with LEFT_OUT:
// node run.mjs MODULE.wasm [LEFT_OUT]

import { readFileSync } from "node:fs";

const table = readFileSync(new URL("digests.txt", import.meta.url), "utf8").trim().split("\n");
const leftOut = process.argv[3];
const recorded = table.filter((row) => leftOut === undefined || !row.startsWith(leftOut));
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), {});
const { count, hash } = instance.exports;
if (count() !== recorded.length) throw new Error(`${count()} hashes, ${recorded.length} recorded hashes`);
recorded.forEach((row, number) => {
  const [name, expected] = row.split(" ");
  const found = BigInt.asUintN(64, hash(number)).toString(16).padStart(16, "0");
  console.log(name.padEnd(28), found, found === expected ? "as recorded" : "DIFFERS");
  if (found !== expected) process.exitCode = 1;
});
