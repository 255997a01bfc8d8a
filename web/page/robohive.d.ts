import type { Files, Simulation } from "./engine.js";
import type * as engine from "./engine.js";

/** The engine's classes and functions, once its module is compiled. In node give it the bytes of `engine_bg.wasm`. */
export function load(bytes?: BufferSource | WebAssembly.Module): Promise<typeof engine>;

/** `<robohive-viewer>`: a simulation in a page. */
export class RoboHiveViewer extends HTMLElement {
  /** What is shown, or nothing yet. */
  simulation?: Simulation;
  /** Shows the model at `path` among `files`, or the one nearest to the top. */
  open(files: Files, path?: string): Promise<void>;
  /** Lets time go by, or stops it. */
  run(running?: boolean): void;
  /** Says something over the picture, or nothing. */
  say(message?: string): void;
}

export type { Files, Simulation };
