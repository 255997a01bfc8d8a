// RoboHive with its module inside, for bundlers that know no assets.

import { provide } from "./api.js";

export * from "./api.js";

const MODULE = "@MODULE@";

provide(async () => {
  const packed = Uint8Array.from(atob(MODULE), (letter) => letter.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(unpacked).arrayBuffer();
});
