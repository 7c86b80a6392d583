// What the user gives: one archive or model file as it is, or folders that are to be packed.

import { laidOut } from "./parts.js";

const PART = /\.(stl|dae|obj|glb|gltf|mtl|png|jpe?g)$/i;
const SKIPPED = new Set([".git", ".hg", ".svn", "__pycache__"]); // as `submit` leaves them out

// What cannot be sent, in words for the user.
export class Refusal extends Error {}

// Files that cannot be sent yet: a model that is given as well makes them a package.
export class Incomplete extends Refusal {}

// Returns the files of a drop with their paths, or a promise of them. The browser forgets the entries after the event,
// so they are taken before anything is waited for.
export function dropped(transfer, most) {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  const files = [...transfer.files].map((file) => ({ path: file.name, file }));
  return entries.length > 0 ? entriesOf(entries, most) : files;
}

async function entriesOf(entries, most) {
  const found = [];
  const waiting = [...entries];
  while (waiting.length > 0) {
    const entry = waiting.pop();
    if (SKIPPED.has(entry.name)) continue;
    if (entry.isDirectory) {
      waiting.push(...(await children(entry)));
    } else {
      const file = await new Promise((resolve, reject) => entry.file(resolve, reject));
      found.push({ path: entry.fullPath.replace(/^\//, ""), file });
    }
    refuseMany(found.length, most);
  }
  return found;
}

// A reader gives some entries at a time, and none when it is through.
async function children(folder) {
  const reader = folder.createReader();
  const all = [];
  for (;;) {
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return all;
    all.push(...some);
  }
}

// Returns the files of an input for folders with their paths.
export function ofFolder(list, most) {
  const found = [...list]
    .map((file) => ({ path: file.webkitRelativePath, file }))
    .filter(({ path }) => !path.split("/").some((part) => SKIPPED.has(part)));
  refuseMany(found.length, most);
  return found;
}

function refuseMany(number, most) {
  if (number > most) {
    throw new Refusal(`There are more than ${most} files. Choose the package's own folder.`);
  }
}

// Returns what is to be sent: {name, bytes, files, file, missing}; `file` is null for what is to be packed, and
// `missing` names the files that a model without its package needs.
export async function chosen(files, limits) {
  if (files.length === 0) {
    throw new Refusal("The folder contains no files. Choose a package folder with a model.");
  }
  const bytes = files.reduce((sum, { file }) => sum + file.size, 0);
  const loose = files.filter(({ path }) => !path.includes("/"));
  if (loose.length > 0 && loose.length < files.length) {
    throw new Refusal("Files and folders were dropped together. Drop one folder, an archive, or files alone.");
  }
  const { files: laid, missing } = loose.length > 0 ? await laidOut(files) : { files, missing: [] };
  if (files.length === 1 && loose.length === 1 && !PART.test(files[0].path)) {
    refuseFile(files[0].file, limits);
    return { name: files[0].file.name, bytes, files, file: files[0].file, missing };
  }
  refuseMissingModel(loose);
  refuseBytes(bytes, Math.min(limits.bytes, limits.unpacked));
  return { name: `${nameOf(laid)}.zip`, bytes, files: laid, file: null, missing };
}

function refuseMissingModel(loose) {
  const archive = loose.find(({ path }) => /\.(zip|tgz|gz)$/i.test(path));
  if (archive) throw new Refusal(`${archive.path} is an archive: send it alone.`);
  if (loose.length > 0 && !loose.some(({ path }) => /\.(urdf|xacro|sdf|world)$/i.test(path))) {
    const [what, them] = loose.length > 1 ? ["None of these files is", "them"] : [`${loose[0].path} is not`, "it"];
    throw new Incomplete(`${what} a model. Add the .urdf, .xacro or .sdf file that uses ${them}.`);
  }
}

function nameOf(files) {
  const tops = new Set(files.map(({ path }) => path.split("/")[0]));
  return tops.size === 1 ? [...tops][0] : "packages";
}

function refuseFile(file, limits) {
  const name = file.name.toLowerCase();
  if (!limits.endings.some((ending) => name.endsWith(ending))) {
    throw new Refusal(`“${file.name}” does not end in ${limits.endings.join(", ")}. Choose an archive or a model file.`);
  }
  refuseBytes(file.size, limits.bytes);
}

function refuseBytes(bytes, most) {
  if (bytes > most) {
    throw new Refusal(`It has ${megabytes(bytes)}, but at most ${megabytes(most)} can be sent. Remove files that are not part of the package.`);
  }
}

export function megabytes(bytes) {
  if (bytes < 1e5) return `${Math.ceil(bytes / 1e3)} kB`;
  return `${(bytes / 1e6).toLocaleString("en", { maximumFractionDigits: bytes < 1e7 ? 1 : 0 })} MB`;
}
