// Compares the hashes that the WebAssembly module computes with the recorded ones: node run.mjs MODULE.wasm

import { readFileSync } from "node:fs";

const recorded = readFileSync(new URL("digests.txt", import.meta.url), "utf8").trim().split("\n");
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), {});
const { count, hash } = instance.exports;
if (count() !== recorded.length) throw new Error(`${count()} hashes, ${recorded.length} recorded hashes`);
recorded.forEach((row, number) => {
  const [name, expected] = row.split(" ");
  const found = BigInt.asUintN(64, hash(number)).toString(16).padStart(16, "0");
  console.log(name.padEnd(28), found, found === expected ? "as recorded" : "DIFFERS");
  if (found !== expected) process.exitCode = 1;
});
