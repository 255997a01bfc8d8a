// RoboHive in node: the module is read from beside this file, and models from the disk.

import { readFile } from "node:fs/promises";
import { openFiles, openWith, provide } from "./api.js";
import { isArchive } from "./files.js";

export * from "./api.js";

provide(() => readFile(new URL("./engine_bg.wasm", import.meta.url)));

/** Opens a model or a zip archive on the disk, with all that it names. */
export async function openFile(path, options = {}) {
  const read = async (name) => {
    try {
      return new Uint8Array(await readFile(name));
    } catch (error) {
      if (error.code === "ENOENT" || error.code === "ENOTDIR") return undefined;
      throw error;
    }
  };
  const bytes = await read(path);
  if (!bytes) throw new Error(`${path}: there is no such file`);
  if (isArchive(path, bytes)) return openFiles([{ path, bytes }], options);
  return openWith(path, read, options);
}
