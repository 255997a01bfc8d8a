import type { OpenOptions } from "./api.js";
import type { Simulation } from "./engine.js";

export * from "./api.js";

/** Opens a model or a zip archive on the disk, with all files that it names. */
export function openFile(path: string, options?: OpenOptions & { path?: string }): Promise<Simulation>;
