// Runs the built bundle as VS Code's extension host does, with an editor in place of VS Code.
const Module = require("node:module");
const path = require("node:path");

const manifest = require("../package.json");

const BUNDLE = path.join(__dirname, "..", manifest.main);
/** Nothing healthy comes near this limit. */
const LIMIT = 60_000;

/** Activate the extension in an editor, and return what ends it. */
async function activate(editor) {
  const load = Module._load;
  Module._load = (name, ...rest) => (name === "vscode" ? editor.module : load(name, ...rest));
  delete require.cache[BUNDLE];
  let extension;
  try {
    extension = require(BUNDLE);
  } finally {
    Module._load = load;
  }
  const subscriptions = [];
  await extension.activate({ subscriptions, extension: { packageJSON: manifest } });
  return async () => {
    await extension.deactivate();
    subscriptions.forEach((each) => each.dispose());
  };
}

/** Wait until something is there, and return it. */
async function until(what, find) {
  for (const end = Date.now() + LIMIT; Date.now() < end; await new Promise((resolve) => setTimeout(resolve, 20))) {
    const found = await find();
    if (found) {
      return found;
    }
  }
  throw new Error(`not seen: ${what}`);
}

/** Wait until a process has ended. */
function ended(pid) {
  return until(`the end of process ${pid}`, () => {
    try {
      return !process.kill(pid, 0);
    } catch {
      return true;
    }
  });
}

module.exports = { activate, ended, until };
