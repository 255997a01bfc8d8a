// What the element looks like: styles, and the parts of its shadow tree.

const STYLE = `
  :host { display: block; position: relative; min-height: 240px; background: #24272b; color: #e8e8e8;
          font: 13px system-ui, sans-serif; overflow: hidden; }
  canvas { position: absolute; inset: 0; width: 100%; height: 100%; touch-action: none; outline-offset: -2px; }
  .bar { position: absolute; left: 0; right: 0; bottom: 0; display: flex; gap: 6px; align-items: center; padding: 6px;
         background: #000a; flex-wrap: wrap; }
  button, select { font: inherit; color: inherit; background: #444; border: 0; border-radius: 4px; padding: 3px 9px;
                   max-width: 14em; }
  button:focus-visible, select:focus-visible, input:focus-visible, summary:focus-visible { outline: 2px solid #8bf; }
  button[aria-pressed=true] { background: #a33; }
  .side { position: absolute; top: 0; right: 0; bottom: 38px; width: min(240px, 70%); overflow: auto; padding: 8px;
          box-sizing: border-box; background: #000a; }
  .side label { display: block; margin-bottom: 4px; overflow-wrap: anywhere; }
  .side input[type=range], .side select { width: 100%; max-width: none; }
  .side dl { display: grid; grid-template-columns: auto 1fr; gap: 2px 8px; } .side dd { margin: 0; }
  .message { position: absolute; left: 8px; top: 8px; right: 8px; max-height: 60%; overflow: auto; padding: 8px;
             background: #000d; border-left: 3px solid #e66; }
  .message pre { margin: 0 0 6px; white-space: pre-wrap; font-family: ui-monospace, monospace; overflow-wrap: anywhere; }
  .hidden-text { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
  input[type=file] { position: absolute; width: 1px; height: 1px; opacity: 0; }
  [hidden] { display: none !important; }`;

const PARTS = `
  <canvas tabindex="0" role="application" aria-label="simulation"></canvas>
  <div class="message" role="alert" hidden>
    <pre></pre>
    <span class="supply" hidden><button data-does="supply">Add the missing files…</button><input type="file" multiple tabindex="-1" aria-label="missing files"></span>
    <button data-does="dismiss">Dismiss</button>
  </div>
  <div class="side" role="region" aria-label="controls" tabindex="-1" hidden></div>
  <div class="bar" role="toolbar" aria-label="simulation">
    <button data-does="run" title="Space">Run</button>
    <button data-does="back" title="Arrow left">Step back</button>
    <button data-does="step" title="Arrow right">Step</button>
    <button data-does="reset" title="Backspace">Reset</button>
    <input type="range" data-does="seek" aria-label="recorded state" min="0" step="1" value="0" hidden>
    <select data-does="camera" aria-label="camera"></select>
    <select data-does="path" aria-label="model" hidden></select>
    <button data-does="record" aria-pressed="false" title="every step, as a numpy archive">Record</button>
    <button data-does="film" aria-pressed="false" title="the picture, as a video">Film</button>
    <button data-does="side" aria-expanded="false">Controls</button>
    <span class="status"></span>
  </div>
  <span class="hidden-text" role="status" aria-live="polite"></span>`;

/** Fills a shadow root. */
export function build(root) {
  root.innerHTML = `<style>${STYLE}</style>${PARTS}`;
}
