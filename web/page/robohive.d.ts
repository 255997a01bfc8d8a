import type { Engine, Simulation } from "./api.js";

export * from "./api.js";

/** What `<robohive-viewer>` tells by events. */
export interface RoboHiveViewerEventMap {
  /** Something is shown. */
  load: CustomEvent<{ name: string }>;
  /** Something could not be opened, or a step failed; files that a model lacks. */
  error: CustomEvent<{ message: string; missing: string[] }>;
  /** Steps were taken before a picture. */
  step: CustomEvent<{ time: number; steps: number }>;
  /** A body was selected, or none. */
  pick: CustomEvent<{ body?: string }>;
  /** A recording has ended; it is downloaded unless the default is prevented. */
  record: CustomEvent<{ name: string; bytes: Uint8Array | Blob }>;
}

/** `<robohive-viewer>`: a simulation in a page. Its attributes stand at the head of `robohive.js`. */
export class RoboHiveViewer extends HTMLElement {
  /** What is shown, or nothing yet. It belongs to the element, which frees it when it shows something else. */
  readonly simulation?: Simulation;
  /** Whether time stands still. */
  readonly paused: boolean;
  /** The engine's classes and functions, in an instance of this element alone. */
  engine(): Promise<Engine>;
  /** Shows the model at `path` among files and archives, or the one nearest to the top. */
  openFiles(files: { path: string; bytes: Uint8Array }[], path?: string): Promise<void>;
  /** Takes files as if they were dropped: a model, what it lacks, recorded states, or a policy. */
  give(files: { path: string; bytes: Uint8Array }[]): Promise<void>;
  /** Shows a model or an archive by its address. */
  openUrl(address: string | URL, path?: string): Promise<void>;
  /** Lets time go by, or stops it. */
  run(running?: boolean): void;
  /** Begins to record every step. */
  record(): void;
  /** Ends the recording and offers it as a file. */
  endRecording(): void;
  /** Says something over the picture, or nothing; with files that are missing, how to add them. */
  say(message?: string, missing?: string[]): void;

  addEventListener<K extends keyof RoboHiveViewerEventMap>(
    type: K,
    listener: (this: RoboHiveViewer, event: RoboHiveViewerEventMap[K]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
}

declare global {
  interface HTMLElementTagNameMap {
    "robohive-viewer": RoboHiveViewer;
  }
}
