// Model files that come without a package: which files they name, and where those have to lie to be found.

const MODEL = /\.(urdf|xacro|sdf)$/i;
const FIND = String.raw`(?:file:\/\/)?\$\(find\s+[\w.-]+\)`;
const ENDINGS = "stl|dae|obj|glb|gltf|png|jpe?g|xacro";
const NAMED = new RegExp(`(?:filename\\s*=\\s*["']|<uri>\\s*)((?:${FIND})?[^"'<>\\s]+\\.(?:${ENDINGS}))\\s*(?:["']|</uri>)`, "gi");
const IN_PACKAGE = /^(?:(?:package|model):\/\/|(?:file:\/\/)?\$\(find\s+)([\w.-]+)\)?\/(.+)$/;
const LARGEST = 20e6; // of a model file that is read here

const nameOf = (path) => path.split("/").pop();
const endingOf = (name) => name.split(".").pop().toLowerCase();

// Returns the addresses of meshes, textures and included files in model files, each once.
async function named(files) {
  const models = files.filter(({ file }) => MODEL.test(file.name) && file.size < LARGEST);
  const texts = await Promise.all(models.map(({ file }) => file.text()));
  return [...new Set(texts.flatMap((text) => [...text.matchAll(NAMED)].map((match) => match[1])))];
}

// Returns the path of an address seen from a model in `<folder>/urdf`; "" for one that leads elsewhere.
function placeOf(address, folder) {
  const [, holder, rest] = IN_PACKAGE.exec(address) ?? [];
  if (holder) return `${holder}/${rest}`;
  if (/[$:]|^\//.test(address)) return "";
  const parts = [folder, "urdf"];
  for (const part of address.split("/")) {
    if (part === "..") parts.pop();
    else if (part !== ".") parts.push(part);
  }
  return parts.length > 1 ? parts.join("/") : "";
}

// Returns files that were given one by one with the paths of a package, and the names of those that are missing. Names
// that xacro computes are not known here, but the folder of such files is.
export async function laidOut(files) {
  const addresses = await named(files);
  const holder = addresses.map((address) => IN_PACKAGE.exec(address)?.[1]).find(Boolean);
  const model = files.find(({ file }) => MODEL.test(file.name));
  const folder = holder ?? (model ? model.file.name.replace(/(\.urdf|\.sdf)?\.\w+$/i, "") : "files");
  const places = new Map(addresses.map((address) => [nameOf(address), placeOf(address, folder)]));
  const computed = [...places].filter(([name]) => name.includes("$"));
  const given = new Set(files.map(({ file }) => file.name));
  const missing = [...places].filter(([name, place]) => place && !name.includes("$") && !given.has(name));
  const laid = files.map(({ file }) => {
    const [, like = ""] = computed.find(([name]) => endingOf(name) === endingOf(file.name)) ?? [];
    const beside = MODEL.test(file.name) ? `${folder}/urdf` : like.replace(/\/[^/]*$/, "") || folder;
    return { path: places.get(file.name) || `${beside}/${file.name}`, file };
  });
  return { files: laid, missing: missing.map(([name]) => name) };
}
