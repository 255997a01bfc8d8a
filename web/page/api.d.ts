import type * as bindings from "./engine.js";
import type { Files, Simulation, State, Step, NamedArray } from "./engine.js";

export type { Files, Simulation, State, Step, NamedArray };

/** The engine's classes and functions. */
export interface Engine extends Pick<typeof bindings, "Files" | "Simulation" | "State" | "Step" | "NamedArray" | "ownModels" | "ownEnvironments"> {
  /** Bytes of the memory that this instance holds. It never shrinks; an instance that nothing refers to is freed. */
  memoryBytes(): number;
}

/** Where the module comes from: bytes, a compiled module, or an address. */
export type Source = BufferSource | WebAssembly.Module | URL | string;

/** Which instance opens a model, and which files it has already. */
export interface OpenOptions {
  /** The shared one otherwise. */
  engine?: Engine;
  /** Files of the same instance. */
  files?: Files;
}

/** The engine's classes and functions. All who call this share one instance; the module is compiled once. */
export function load(from?: Source): Promise<Engine>;
/** An instance of its own: what goes wrong in it, and what memory it takes, is its own. */
export function instance(): Promise<Engine>;
/** Says where the module comes from, where it does not stand beside the script. */
export function provide(from: () => Source | Promise<Source>): void;

/** Opens the model at `path`, asking `read` for its bytes and for those of all files that it names. */
export function openWith(
  path: string,
  read: (path: string) => Uint8Array | undefined | Promise<Uint8Array | undefined>,
  options?: OpenOptions,
): Promise<Simulation>;
/** Opens a model from its text, which names no other files. */
export function openText(text: string, options?: Pick<OpenOptions, "engine">): Promise<Simulation>;
/** Opens the model at `path` among files and zip archives, or the one that is nearest to the top. */
export function openFiles(files: { path: string; bytes: Uint8Array }[], options?: OpenOptions & { path?: string }): Promise<Simulation>;
/** Opens a model or a zip archive by its address, or by `github:OWNER/NAME/BRANCH/PATH`, with all files that it names. */
export function openUrl(address: string | URL, options?: OpenOptions & { path?: string }): Promise<Simulation>;

/** A model that lacks files. */
export class MissingFiles extends Error {
  /** Their paths. */
  readonly missing: string[];
}
