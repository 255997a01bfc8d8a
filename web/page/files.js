// Files of a person or of a host, refused by their size before they are read.

/** Whether a file is a zip archive, by its name or its first bytes. */
export function isArchive(path, bytes) {
  return /\.(zip|mjz)$/i.test(path) || (bytes[0] === 0x50 && bytes[1] === 0x4b && bytes[2] === 3 && bytes[3] === 4);
}

/** What a file may hold, by its name: a model or an archive with one, recorded states, a policy. */
export const isModel = (path) => /\.(xml|urdf|mjcf|rhm|zip|mjz)$/i.test(path);
export const isTrajectory = (path) => /\.npz$/i.test(path);
export const isPolicy = (path) => /\.(pickle|pkl|safetensors)$/i.test(path);

/** Says that something is too large. */
function refuse(name, bytes, most) {
  const mebibytes = (count) => `${Math.round(count / (1 << 20))} MiB`;
  throw new Error(`${name}: ${mebibytes(bytes)} are more than a page can open, ${mebibytes(most)} for all files together`);
}

/** The bytes of an answer, or nothing where the host has no such file. */
export async function bytesOf(answer, name, most) {
  if (answer.status === 404 || answer.status === 410) return undefined;
  if (!answer.ok) throw new Error(`${name}: ${answer.status} ${answer.statusText}`);
  const declared = Number(answer.headers.get("content-length") ?? 0);
  if (declared > most) refuse(name, declared, most);
  const parts = [];
  let size = 0;
  // A host may say nothing of the length, or something wrong.
  for (const reader = answer.body.getReader(); ; ) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) {
      await reader.cancel();
      refuse(name, size, most);
    }
    parts.push(value);
  }
  const whole = new Uint8Array(size);
  parts.reduce((at, part) => (whole.set(part, at), at + part.length), 0);
  return whole;
}

/** The bytes of a file by its address. */
export async function bytesAt(address, most) {
  const bytes = await bytesOf(await fetch(address), address, most);
  if (!bytes) throw new Error(`${address}: there is no such file`);
  return bytes;
}

/** Where this script lies: not in a call of `URL`, which bundlers would take for the address of a file. */
const HERE = import.meta.url;

/** The bytes of a policy by its address, or of the one that lies beside this page for an environment, `best`; nothing without an address. */
export async function policyAt(address, id, most) {
  if (address !== "best") return address ? bytesAt(address, most) : undefined;
  const shipped = new URL(`policies/${id}.safetensors`, HERE).href;
  const bytes = await bytesOf(await fetch(shipped), shipped, most);
  if (!bytes) throw new Error(`no policy is shipped for ${id}: there is no ${shipped}`);
  return bytes;
}

/** Reads files (`{ path, file }`) unless they are too large together. */
export async function readAll(listed, most) {
  const size = listed.reduce((sum, { file }) => sum + file.size, 0);
  if (size > most) refuse(listed.length === 1 ? listed[0].path : `${listed.length} files`, size, most);
  return Promise.all(listed.map(async ({ path, file }) => ({ path, bytes: new Uint8Array(await file.arrayBuffer()) })));
}

/** Files that were chosen in an `<input type="file">`. */
export function chosen(input) {
  return [...input.files].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

/** Files of what was dropped, folders with all that is in them. */
export async function dropped(transfer) {
  const listed = [];
  // Entries are there only until the event is over.
  const items = [...transfer.items].filter((item) => item.kind === "file");
  const found = items.map((item) => item.webkitGetAsEntry?.() ?? item.getAsFile());
  const walk = async (entry) => {
    if (entry instanceof File) return void listed.push({ path: entry.name, file: entry });
    if (entry.isFile) {
      const file = await new Promise((done, failed) => entry.file(done, failed));
      return void listed.push({ path: entry.fullPath.replace(/^\//, ""), file });
    }
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((done, failed) => reader.readEntries(done, failed));
      if (!some.length) return;
      for (const inner of some) await walk(inner);
    }
  };
  for (const entry of found) if (entry) await walk(entry);
  return listed;
}

/** Gives a person a file to keep. */
export function download(name, bytes, type = "application/octet-stream") {
  const url = URL.createObjectURL(bytes instanceof Blob ? bytes : new Blob([bytes], { type }));
  Object.assign(document.createElement("a"), { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
