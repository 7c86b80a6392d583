// The client with a real server, which SUBT_CHECK_SERVER starts, on packages of samples/.
const assert = require("node:assert/strict");
const fs = require("node:fs");
const { tmpdir } = require("node:os");
const path = require("node:path");
const { afterEach, beforeEach, test } = require("node:test");

const { Editor } = require("./editor.cjs");
const { activate, ended, until } = require("./host.cjs");

const SERVER = process.env.SUBT_CHECK_SERVER ?? "subt-check server";
const SAMPLES = process.env.SAMPLES ?? path.join(__dirname, "../../../samples");
const PACKAGE = "broken_acme_scout";

let folder;
let editor;
let end;

beforeEach(async () => {
  folder = fs.realpathSync(fs.mkdtempSync(path.join(tmpdir(), "subt-check-")));
  fs.cpSync(path.join(SAMPLES, PACKAGE), path.join(folder, PACKAGE), { recursive: true });
  const program = path.join(folder, "subt-check");
  fs.writeFileSync(program, `#!/bin/sh\necho $$ > "$0.pid"\nshift\nexec ${SERVER} "$@"\n`, { mode: 0o755 });
  editor = new Editor({ folders: [folder], settings: { "subt-check.path": program } });
  end = await activate(editor);
  assert.deepEqual(editor.messages, [], editor.log.join("\n"));
});

afterEach(async () => {
  await end();
  await ended(pid());
  fs.rmSync(folder, { recursive: true });
});

function open(name, languageId) {
  const file = path.join(folder, PACKAGE, name);
  return editor.open(file, languageId, fs.readFileSync(file, "utf8"));
}

/** Wait until a rule has a finding in a document, and return the finding. */
function finding(document, rule) {
  return until(rule, () => editor.diagnostics(document).find(({ code }) => ruleOf(code) === rule));
}

/** Wait until a rule has none. */
function silence(document, rule) {
  return until(`no ${rule}`, () => editor.diagnostics(document).every(({ code }) => ruleOf(code) !== rule));
}

function ruleOf(code) {
  return typeof code === "object" ? code.value : code;
}

function pid() {
  return Number(fs.readFileSync(path.join(folder, "subt-check.pid"), "utf8"));
}

const NEVER = { isCancellationRequested: false, onCancellationRequested: () => ({ dispose() {} }) };

test("a finding has its place, its severity and its page", async () => {
  const document = open("config/controllers.yaml", "yaml");
  const found = await finding(document, "R2C010");
  const { DiagnosticSeverity } = editor.module;
  assert.equal(found.severity, DiagnosticSeverity.Error);
  assert.equal(found.range.start.line, 18);
  assert.match(found.message, /expected double/);
  assert.match(String(found.code.target), /R2C/);
});

test("what is typed counts, and not what is on disk", async () => {
  const document = open("config/controllers.yaml", "yaml");
  const { range } = await finding(document, "R2C010");
  const { Range } = editor.module;
  const line = range.start.line;
  const text = document.getText().split("\n")[line];
  editor.replace(document, new Range(line, text.lastIndexOf("1"), line, text.length), "1.0");
  await silence(document, "R2C010");
});

test("a fix is one key away, and corrects the fault", async () => {
  const document = open("config/controllers.yaml", "yaml");
  const found = await finding(document, "R2C010");
  const context = { diagnostics: [found], only: undefined, triggerKind: 1 };
  const provider = editor.provider("registerCodeActionsProvider");
  const offered = await provider.provideCodeActions(document, found.range, context, NEVER);
  const fix = offered.find((action) => action.isPreferred);
  const { edit } = fix.edit ? fix : await provider.resolveCodeAction(fix, NEVER);
  await editor.module.workspace.applyEdit(edit);
  assert.match(document.getText(), /cmd_vel_timeout: 1\.0/);
  await silence(document, "R2C010");
});

test("the status bar counts the errors of the package", async () => {
  open("config/controllers.yaml", "yaml");
  const [item] = editor.items;
  await until("the verdict", () => item.isVisible);
  assert.match(item.text, /^\$\(error\) Not ready: \d+ errors$/);
  assert.match(item.tooltip.value, /trial not run/);
});

test("a word explains itself", async () => {
  const document = open("urdf/scout.urdf.xacro", "xml");
  await finding(document, "URD006");
  const at = document.positionAt(document.getText().indexOf('"base_link"') + 2);
  const hover = await editor.provider("registerHoverProvider").provideHover(document, at, NEVER);
  assert.match([hover.contents].flat().map(({ value }) => value).join("\n"), /base_link/);
});

test("the check with trial, by the palette, adds what weighing finds", async () => {
  const document = open("urdf/scout.urdf.xacro", "xml");
  await finding(document, "URD006");
  assert.ok(editor.diagnostics(document).every(({ code }) => ruleOf(code) !== "INE004"));
  await editor.module.commands.executeCommand("subt-check.check");
  await finding(document, "INE004");
  assert.deepEqual(editor.messages, []);
});

test("the robot drives, by the palette, and the figures stay in the output", async () => {
  open("urdf/scout.urdf.xacro", "xml");
  await editor.module.commands.executeCommand("subt-check.drive");
  assert.match(editor.log.filter((line) => line.startsWith("appendLine: ")).join("\n"), /m\/s/);
  assert.ok(editor.messages.every(({ severity }) => severity === "information"));
});

test("the report with the robot in 3D is opened outside the editor", async () => {
  open("urdf/scout.urdf.xacro", "xml");
  await editor.module.commands.executeCommand("subt-check.show3d");
  assert.equal(editor.opened.length, 1);
  assert.match(editor.opened[0], /^file:.*\.html$/);
  assert.ok(fs.existsSync(new URL(editor.opened[0])));
});

test("the server ends with the editor", async () => {
  await end();
  end = async () => {};
  await ended(pid());
});
