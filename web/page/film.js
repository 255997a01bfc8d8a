// A video of a canvas, by the browser's own encoder.

/** Pictures a second. */
const RATE = 30;
/** Formats in the order of preference. */
const FORMATS = [["video/mp4;codecs=avc1.42E01F", "mp4"], ["video/webm;codecs=vp9", "webm"], ["video/webm;codecs=vp8", "webm"], ["video/webm", "webm"]];

/** A film that is being shot. Its size stays, whatever the canvas's becomes. */
export class Film {
  #screen;
  #recorder;
  #parts = [];
  #done;
  /** Ending of the file's name. */
  ending;

  constructor(width, height) {
    const [type, ending] = FORMATS.find(([type]) => globalThis.MediaRecorder?.isTypeSupported(type)) ?? [];
    if (!type) throw new Error("this browser encodes no video: record the states, and render them with robohive");
    this.ending = ending;
    // Encoders want even sides.
    this.#screen = Object.assign(document.createElement("canvas"), { width: width & ~1, height: height & ~1 });
    this.#screen.getContext("2d");
    this.#recorder = new MediaRecorder(this.#screen.captureStream(RATE), { mimeType: type, videoBitsPerSecond: 8e6 });
    this.#recorder.addEventListener("dataavailable", (event) => event.data.size && this.#parts.push(event.data));
    this.#done = new Promise((done) => this.#recorder.addEventListener("stop", () => done(new Blob(this.#parts, { type }))));
    this.#recorder.start(1000);
  }

  /** Takes a picture. */
  show(canvas) {
    this.#screen.getContext("2d").drawImage(canvas, 0, 0, this.#screen.width, this.#screen.height);
  }

  /** Stops the film while nothing is drawn, or goes on. */
  pause(paused) {
    if (paused && this.#recorder.state === "recording") this.#recorder.pause();
    if (!paused && this.#recorder.state === "paused") this.#recorder.resume();
  }

  /** Ends it: the file. */
  end() {
    this.#recorder.stop();
    this.#recorder.stream.getTracks().forEach((track) => track.stop());
    return this.#done;
  }
}
