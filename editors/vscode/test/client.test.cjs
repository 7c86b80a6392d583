// What the client does: which program it starts, what it tells the server, what it tells the user.
const assert = require("node:assert/strict");
const fs = require("node:fs");
const { tmpdir } = require("node:os");
const path = require("node:path");
const { afterEach, beforeEach, test } = require("node:test");
const { URI } = require("vscode-uri");

const { Editor } = require("./editor.cjs");
const { activate, ended, until } = require("./host.cjs");

const SDF = "<sdf version='1.9'/>\n";
const SERVES = `case "$2" in --help) echo "usage: subt-check server [-h]" ;; *) exec "${process.execPath}" "${path.join(__dirname, "recorder.cjs")}" ;; esac`;
const OLD = 'echo "usage: subt-check check [-h]"';
const ENDS = 'case "$2" in --help) echo "usage: subt-check server [-h]" ;; *) echo "pygls is missing" >&2; exit 2 ;; esac';
const PATH = process.env.PATH;

let folder;
let workspace;
let outside;
let end;

beforeEach(() => {
  folder = fs.realpathSync(fs.mkdtempSync(path.join(tmpdir(), "subt-check-")));
  [workspace, outside] = ["workspace", "outside"].map((name) => path.join(folder, name));
  fs.mkdirSync(outside);
  write(path.join(workspace, "model.sdf"), SDF);
  process.env.PATH = `${outside}${path.delimiter}/bin${path.delimiter}/usr/bin`;
  process.env.RECORD = path.join(folder, "record");
  end = async () => {};
});

afterEach(async () => {
  await end();
  process.env.PATH = PATH;
  await Promise.all(received("initialize").map(({ pid }) => ended(pid))); // until then they write
  fs.rmSync(folder, { recursive: true });
});

function write(file, text) {
  fs.mkdirSync(path.dirname(file), { recursive: true });
  fs.writeFileSync(file, text);
}

/** Put a program `subt-check` into a folder; it leaves a mark when it is run. */
function program(place, does = SERVES) {
  const file = path.join(place, "subt-check");
  write(file, `#!/bin/sh\ntouch "$0.was-run"\n${does}\n`);
  fs.chmodSync(file, 0o755);
  return file;
}

function wasRun(file) {
  return fs.existsSync(`${file}.was-run`);
}

async function start(more = {}) {
  const editor = new Editor({ folders: [workspace], ...more });
  end = await activate(editor);
  return editor;
}

function received(method) {
  const text = fs.existsSync(process.env.RECORD) ? fs.readFileSync(process.env.RECORD, "utf8") : "";
  const lines = text.split("\n").slice(0, -1); // the last one may be under way
  return lines.map((line) => JSON.parse(line)).filter((message) => message.method === method);
}

/** Return the program that was started as the server. */
function started(editor) {
  return editor.log.findLast((line) => line.startsWith("info: Starting "))?.match(/Starting (.*) server/)[1];
}

test("the environment of the workspace comes before PATH", async () => {
  const inside = program(path.join(workspace, ".venv/bin"));
  const onPath = program(outside);
  assert.equal(started(await start()), inside);
  assert.equal(received("initialize").length, 1);
  assert.ok(!wasRun(onPath));
});

test("the interpreter of the Python extension comes before PATH", async () => {
  const interpreter = path.join(folder, "selected/bin/python");
  const selected = program(path.dirname(interpreter));
  program(outside);
  const environments = {
    getActiveEnvironmentPath: () => ({ path: interpreter }),
    resolveEnvironment: async () => ({ executable: { uri: URI.file(interpreter) } }),
  };
  assert.equal(started(await start({ extensions: { "ms-python.python": { environments } } })), selected);
});

test("a Python extension that fails is passed over", async () => {
  const onPath = program(outside);
  const environments = { getActiveEnvironmentPath: () => { throw new Error("of others"); } };
  assert.equal(started(await start({ extensions: { "ms-python.python": { environments } } })), onPath);
});

test("the setting comes before all others", async () => {
  const named = program(path.join(workspace, "tools"));
  const inside = program(path.join(workspace, ".venv/bin"));
  const settings = { "subt-check.path": "${workspaceFolder}/tools/subt-check" };
  assert.equal(started(await start({ settings })), named);
  assert.ok(!wasRun(inside));
});

test("a version without the command is passed over", async () => {
  program(path.join(workspace, "venv/bin"), OLD);
  const onPath = program(outside);
  const editor = await start();
  assert.equal(started(editor), onPath);
  assert.match(editor.log.join("\n"), /venv\/bin\/subt-check has no command `server`/);
});

test("without a program, one message says what to do", async () => {
  const editor = await start();
  assert.equal(editor.messages.length, 1);
  assert.match(editor.messages[0].message, /not on PATH\. .* pip install 'subt-check\[editor\]'$/);
  assert.deepEqual(editor.messages[0].choices, ["How to install", "Open settings", "Show output"]);
});

test("its buttons open the page and the settings", async () => {
  const editor = new Editor({ folders: [workspace] });
  editor.choose = (_, [install]) => install;
  end = await activate(editor);
  editor.choose = (_, [, settings]) => settings;
  await editor.module.commands.executeCommand("subt-check.restart");
  const page = require("../package.json").homepage;
  await until("both", () => editor.opened.length === 2);
  assert.deepEqual(editor.opened, [page, "workbench.action.openSettings subt-check.path"]);
});

test("a setting that names no program is named", async () => {
  const editor = await start({ settings: { "subt-check.path": "nowhere/subt-check" } });
  assert.match(editor.messages[0].message, /workspace\/nowhere\/subt-check is not a program\. The setting subt-check\.path/);
});

test("a server that ends at once is one message, and is not started again", async () => {
  program(outside, ENDS);
  const editor = await start();
  assert.equal(editor.messages.length, 1);
  assert.match(editor.messages[0].message, /outside\/subt-check started no server; the output says why\. .*pip install 'subt-check\[editor\]'$/);
  await until("the reason in the log", () => editor.log.some((line) => line.includes("pygls is missing")));
  assert.equal(editor.log.filter((line) => line.includes("pygls is missing")).length, 1);
});

test("no program from within a workspace that is not trusted is run", async () => {
  const inside = [".venv/bin", "venv/bin", "bin"].map((place) => program(path.join(workspace, place)));
  process.env.PATH = `${path.join(workspace, "bin")}${path.delimiter}bin${path.delimiter}${process.env.PATH}`;
  const onPath = program(outside);
  const editor = await start({ trusted: false });
  assert.equal(started(editor), onPath);
  assert.equal(received("initialize")[0].cwd, outside);
  assert.deepEqual(inside.filter(wasRun), []);
});

test("no link leads out of that", async () => {
  const inside = program(path.join(workspace, "hidden"));
  fs.symlinkSync(inside, path.join(outside, "subt-check"));
  const editor = await start({ trusted: false, settings: { "subt-check.path": path.join(outside, "subt-check") } });
  assert.match(editor.messages[0].message, /is not run, because it is in a workspace that is not trusted/);
  assert.ok(!wasRun(inside));
});

test("trust starts the program of the workspace", async () => {
  const inside = program(path.join(workspace, ".venv/bin"));
  const editor = await start({ trusted: false });
  assert.ok(!wasRun(inside));
  editor.trusted = true;
  editor.fire("onDidGrantWorkspaceTrust");
  await until("the server", () => received("initialize").length === 1);
});

test("the server is told the settings, at the start and when they change", async () => {
  program(outside);
  const editor = await start({ settings: { "subt-check.trial": "save" } });
  assert.deepEqual(received("initialize")[0].params.initializationOptions, { trial: "save", debounce: 20, verdict: true });
  editor.set("subt-check.debounce", 250);
  const sent = () => received("workspace/didChangeConfiguration").at(-1)?.params.settings["subt-check"];
  await until("the change", () => sent()?.debounce === 250);
  assert.equal(sent().trial, "save");
  assert.equal(received("initialize").length, 1);
});

test("other arguments start the server anew, in order", async () => {
  program(outside, `echo "$@" >> "${folder}/arguments"\n${SERVES}`);
  const editor = await start();
  editor.set("subt-check.args", ["--verbose"]);
  await until("the second server", () => received("initialize").length === 2);
  assert.equal(received("exit").length, 1);
  assert.match(fs.readFileSync(`${folder}/arguments`, "utf8"), /^server --verbose$/m);
  assert.deepEqual(editor.messages, []);
});

test("the server sees the files of robot packages, and no others", async () => {
  program(outside);
  const editor = await start();
  const names = ["model.sdf", "a.launch", "spawner.rb", "CMakeLists.txt", "specifications.md", "subt-check.toml"];
  [...names, "main.c"].forEach((name) => editor.open(path.join(workspace, name), "plaintext", "text"));
  editor.open(path.join(workspace, "b.yaml"), "yaml", "a: 1");
  const uris = () => received("textDocument/didOpen").map(({ params }) => path.basename(params.textDocument.uri));
  await until("the last file", () => uris().includes("b.yaml"));
  assert.deepEqual(uris(), [...names, "b.yaml"]);
});

/** Open a file on which the server gives a verdict. */
function judged(editor, name, verdict) {
  const file = path.join(workspace, name);
  return editor.open(file, "xml", `${SDF}<!-- ${JSON.stringify(verdict)} -->`);
}

const BAD = { verdict: "not_ready", package: "[rover](x)", text: "Not ready: 3 errors", sentence: "Not ready: why", errors: 3, warnings: 1 };
const GOOD = { verdict: "ready", package: "scout", text: "Ready", sentence: "Ready: nothing to fix", errors: 0, warnings: 0 };

test("the status bar has the verdict on the package of the file that is shown", async () => {
  program(outside);
  const editor = await start();
  const [item] = editor.items;
  const bad = judged(editor, "model.sdf", BAD);
  await until("the verdict", () => item.isVisible);
  assert.equal(item.text, "$(error) Not ready: 3 errors");
  assert.equal(item.backgroundColor.id, "statusBarItem.errorBackground");
  assert.equal(item.command, "workbench.actions.view.problems");
  assert.ok(editor.context["subt-check.hasVerdict"]);
  const good = judged(editor, "good.sdf", GOOD);
  assert.ok(!item.isVisible);
  await until("the other verdict", () => item.isVisible);
  assert.deepEqual([item.text, item.backgroundColor], ["$(pass) Ready", undefined]);
  judged(editor, "package.xml", { ...GOOD, text: "Ready: 2 warnings", warnings: 2 });
  await until("the third verdict", () => item.isVisible && item.text === "$(warning) Ready: 2 warnings");
  assert.equal(item.backgroundColor.id, "statusBarItem.warningBackground");
  editor.show(bad);
  assert.equal(item.text, "$(error) Not ready: 3 errors");
  editor.show(undefined);
  assert.ok(!item.isVisible);
  editor.show(good);
  assert.equal(item.text, "$(pass) Ready");
});

test("a robot that is not decided about is a warning", async () => {
  program(outside);
  const editor = await start();
  const [item] = editor.items;
  judged(editor, "model.sdf", { verdict: "incomplete", text: "Incomplete", sentence: "no robot was read", errors: 0, warnings: 0 });
  await until("the verdict", () => item.isVisible);
  assert.equal(item.text, "$(warning) Incomplete");
});

test("its tooltip has the sentence and leads to the report, and names are no links", async () => {
  program(outside);
  const editor = await start();
  const [item] = editor.items;
  judged(editor, "model.sdf", BAD);
  await until("the verdict", () => item.isVisible);
  assert.match(item.tooltip.value, /Not ready: why[^]*\[Open the report\]\(command:subt-check\.show3d\)/);
  assert.ok(!item.tooltip.value.includes("[rover]"));
  assert.deepEqual(item.tooltip.isTrusted.enabledCommands, ["subt-check.show3d", "subt-check.check"]);
});

test("outside of packages, and when the server has ended, there is no verdict", async () => {
  program(outside);
  const editor = await start();
  const [item] = editor.items;
  judged(editor, "model.sdf", BAD);
  await until("the verdict", () => item.isVisible);
  assert.ok(editor.context["subt-check.isRunning"]);
  judged(editor, "pom.xml", { verdict: "none" });
  assert.ok(!item.isVisible);
  editor.show(editor.documents[0]);
  assert.ok(item.isVisible);
  fs.rmSync(path.join(outside, "subt-check"));
  await editor.module.commands.executeCommand("subt-check.restart");
  assert.ok(!item.isVisible);
  assert.ok(!editor.context["subt-check.isRunning"]);
});

test("typing is sent as what changed", async () => {
  program(outside);
  const editor = await start();
  const document = editor.open(path.join(workspace, "model.sdf"), "xml", SDF);
  const { Range } = editor.module;
  editor.replace(document, new Range(0, 14, 0, 17), "1.11");
  const [{ params }] = await until("the change", () => {
    const changes = received("textDocument/didChange");
    return changes.length > 0 && changes;
  });
  assert.equal(params.contentChanges[0].text, "1.11");
  assert.deepEqual(params.contentChanges[0].range.start, { line: 0, character: 14 });
});

test("commands of the palette reach the server with the file that is shown", async () => {
  program(outside);
  const editor = await start();
  const { uri } = editor.open(path.join(workspace, "model.sdf"), "xml", SDF);
  await editor.module.commands.executeCommand("subt-check.drive");
  const [{ params }] = received("workspace/executeCommand");
  assert.equal(params.command, "subt-check.server.drive");
  assert.deepEqual(params.arguments, [uri.toString()]);
  assert.ok(editor.log.includes("appendLine: It drove 3.2 m."));
});

test("the report is opened once, outside the editor", async () => {
  program(outside);
  const editor = await start();
  editor.open(path.join(workspace, "model.sdf"), "xml", SDF);
  await editor.module.commands.executeCommand("subt-check.show3d");
  assert.deepEqual(editor.opened, ["file:///tmp/report.html"]);
});

test("a long command shows its progress and can be cancelled", async () => {
  program(outside);
  const editor = await start();
  editor.open(path.join(workspace, "model.sdf"), "xml", SDF);
  const done = editor.module.commands.executeCommand("subt-check.check");
  const shown = await until("progress", () => editor.progress.find(({ reports }) => reports.includes("weights")));
  assert.ok(shown.cancellable);
  shown.cancel();
  await done;
  await until("the end", () => received("$/cancelled").length === 1);
  assert.deepEqual(editor.messages, []);
});

test("without a file, a command says what it needs", async () => {
  program(outside);
  const editor = await start();
  await editor.module.commands.executeCommand("subt-check.check");
  assert.match(editor.messages[0].message, /open a file of a robot package first/);
});

test("XML of other trades starts nothing, until a robot is opened", async () => {
  fs.rmSync(path.join(workspace, "model.sdf"));
  const onPath = program(outside);
  const editor = await start();
  editor.open(path.join(workspace, "pom.xml"), "xml", "<project/>");
  assert.ok(!wasRun(onPath));
  editor.open(path.join(folder, "single.urdf"), "xml", "<robot name='r'/>");
  await until("the file", () => received("textDocument/didOpen").some(({ params }) => params.textDocument.uri.endsWith("single.urdf")));
});

test("the server ends with the editor", async () => {
  program(outside);
  await start();
  const [{ pid }] = received("initialize");
  await end();
  end = async () => {};
  assert.equal(received("shutdown").length, 1);
  await ended(pid);
});

test("the output can be shown", async () => {
  const editor = await start();
  await editor.module.commands.executeCommand("subt-check.showOutput");
  assert.ok(editor.outputIsShown);
});

test("all commands of the manifest are there", async () => {
  program(outside);
  const editor = await start();
  const offered = require("../package.json").contributes.commands.map(({ command }) => command);
  assert.deepEqual(offered.filter((command) => !editor.commands.has(command)), []);
});
