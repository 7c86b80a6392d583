// An editor in place of VS Code: the module `vscode` as far as the client and its library call it, and a
// record of what the user would see. Documents, edits, settings and globs are real; nothing is drawn.
const { readdirSync } = require("node:fs");
const path = require("node:path");
const { minimatch } = require("minimatch");
const { URI } = require("vscode-uri");

const manifest = require("../package.json");
const types = require("./types.cjs");

/** A document that is open. */
class Document {
  version = 1;
  isClosed = false;
  isDirty = false;
  eol = 1;

  constructor(file, languageId, text) {
    Object.assign(this, { uri: URI.file(file), fileName: file, languageId, text });
  }

  get lineCount() {
    return this.text.split("\n").length;
  }

  getText(range) {
    return range ? this.text.slice(this.offsetAt(range.start), this.offsetAt(range.end)) : this.text;
  }

  offsetAt({ line, character }) {
    const before = this.text.split("\n").slice(0, line);
    return before.reduce((sum, each) => sum + each.length + 1, 0) + character;
  }

  positionAt(offset) {
    const before = this.text.slice(0, offset).split("\n");
    return new types.Position(before.length - 1, before.at(-1).length);
  }
}

/** An editor with open folders, in which an extension can be activated. */
class Editor {
  messages = [];
  opened = [];
  log = [];
  progress = [];
  context = {};
  items = [];
  commands = new Map();
  providers = new Map();
  collections = [];
  documents = [];
  choose = () => undefined;
  #events = new Map();

  /**
   * @param folders The paths of the workspace's folders.
   * @param settings Values by their full names; what is missing has the default of the manifest.
   * @param trusted Whether the user trusts the workspace.
   * @param extensions What other extensions export, by their ids.
   */
  constructor({ folders = [], settings = {}, trusted = true, extensions = {} }) {
    const defaults = Object.entries(manifest.contributes.configuration.properties);
    this.settings = { ...Object.fromEntries(defaults.map(([name, { default: value }]) => [name, value])), ...settings };
    this.folders = folders.map((folder, index) => ({ uri: URI.file(folder), name: path.basename(folder), index }));
    this.trusted = trusted;
    this.extensions = extensions;
    this.module = { ...types, version: "1.91.0", Uri: URI, ...this.#namespaces() };
  }

  /** Fire an event, such as `onDidOpenTextDocument`. */
  fire(name, value) {
    this.#emitter(name).fire(value);
  }

  /** Open a file in the editor, as a user does. */
  open(file, languageId, text) {
    const document = new Document(file, languageId, text);
    this.documents.push(document);
    this.module.window.activeTextEditor = { document };
    this.module.window.visibleTextEditors = [{ document }];
    this.fire("onDidOpenTextDocument", document);
    this.fire("onDidChangeActiveTextEditor", { document });
    return document;
  }

  /** Show a file that is open, or none. */
  show(document) {
    this.module.window.activeTextEditor = document && { document };
    this.fire("onDidChangeActiveTextEditor", this.module.window.activeTextEditor);
  }

  /** Replace a stretch of a document, as typing does. */
  replace(document, range, text) {
    const [start, end] = [document.offsetAt(range.start), document.offsetAt(range.end)];
    document.text = document.text.slice(0, start) + text + document.text.slice(end);
    document.version += 1;
    document.isDirty = true;
    const change = { range, rangeOffset: start, rangeLength: end - start, text };
    this.fire("onDidChangeTextDocument", { document, contentChanges: [change], reason: undefined });
  }

  /** Change a setting, as a user does. */
  set(name, value) {
    this.settings[name] = value;
    const affectsConfiguration = (section) => name === section || name.startsWith(`${section}.`);
    this.fire("onDidChangeConfiguration", { affectsConfiguration });
  }

  /** Return the findings that are shown for a document. */
  diagnostics(document) {
    return this.collections.flatMap((collection) => collection.get(document.uri) ?? []);
  }

  /** Return the first provider that was registered by a function of `languages`. */
  provider(register) {
    return this.providers.get(register)?.[0];
  }

  #emitter(name) {
    if (!this.#events.has(name)) {
      this.#events.set(name, new types.EventEmitter());
    }
    return this.#events.get(name);
  }

  /** Let an object have all events: what is asked for as `onDid…` or `onWill…`. */
  #withEvents(namespace) {
    return new Proxy(namespace, {
      get: (target, name) => {
        const isEvent = !(name in target) && /^on(Did|Will)[A-Z]/.test(String(name));
        return isEvent ? this.#emitter(name).event : target[name];
      },
    });
  }

  #namespaces() {
    return {
      commands: this.#commands(),
      env: { appName: "An editor", language: "en", openExternal: async (uri) => this.opened.push(uri.toString()) > 0 },
      extensions: { getExtension: (id) => this.extensions[id] && { activate: async () => this.extensions[id] } },
      languages: this.#languages(),
      window: this.#withEvents(this.#window()),
      workspace: this.#withEvents(this.#workspace()),
    };
  }

  #commands() {
    return {
      registerCommand: (name, run) => {
        if (this.commands.has(name)) {
          throw new Error(`command '${name}' already exists`);
        }
        this.commands.set(name, run);
        return new types.Disposable(() => this.commands.delete(name));
      },
      executeCommand: async (name, ...given) => {
        if (name.startsWith("workbench.")) {
          return void this.opened.push([name, ...given].join(" "));
        }
        if (name === "setContext") {
          return void (this.context[given[0]] = given[1]);
        }
        if (!this.commands.has(name)) {
          throw new Error(`command '${name}' not found`);
        }
        return this.commands.get(name)(...given);
      },
    };
  }

  #languages() {
    const register = (name) => (...given) => {
      const provider = given.find((each) => typeof each === "object" && !Array.isArray(each));
      this.providers.set(name, [...(this.providers.get(name) ?? []), provider]);
      return new types.Disposable(() => this.providers.delete(name));
    };
    const known = {
      match: (selector, document) => ([selector].flat().some((filter) => matches(filter, document)) ? 10 : 0),
      createDiagnosticCollection: () => {
        const kept = new types.UriMap();
        this.collections.push(kept);
        return kept;
      },
    };
    return new Proxy(known, { get: (target, name) => target[name] ?? register(String(name)) });
  }

  #window() {
    const show = (severity) => async (message, ...choices) => {
      const offered = choices.filter((choice) => typeof choice === "string" || choice.title);
      this.messages.push({ severity, message, choices: offered });
      return this.choose(message, offered);
    };
    return {
      activeTextEditor: undefined,
      visibleTextEditors: [],
      tabGroups: this.#withEvents({ all: [] }),
      createOutputChannel: () => this.#output(),
      createStatusBarItem: () => this.#item(),
      showErrorMessage: show("error"),
      showWarningMessage: show("warning"),
      showInformationMessage: show("information"),
      withProgress: (options, task) => {
        const source = new types.CancellationTokenSource();
        const shown = { ...options, reports: [], cancel: () => source.cancel() };
        this.progress.push(shown);
        return task({ report: (value) => shown.reports.push(value.message) }, source.token);
      },
    };
  }

  #item() {
    const visible = (isVisible) => () => (item.isVisible = isVisible);
    const item = { isVisible: false, show: visible(true), hide: visible(false), dispose: visible(false) };
    this.items.push(item);
    return item;
  }

  #output() {
    const write = (level) => (text) => this.log.push(`${level}: ${text}`);
    const levels = ["append", "appendLine", "trace", "debug", "info", "warn", "error"];
    const output = Object.fromEntries(levels.map((level) => [level, write(level)]));
    const shown = () => (this.outputIsShown = true);
    return this.#withEvents({ ...output, name: "subt-check", logLevel: 3, show: shown, dispose() {} });
  }

  #workspace() {
    const editor = this;
    return {
      get isTrusted() {
        return editor.trusted;
      },
      get textDocuments() {
        return editor.documents;
      },
      workspaceFolders: this.folders.length > 0 ? this.folders : undefined,
      notebookDocuments: [],
      getConfiguration: (section) => configuration(this.settings, section),
      findFiles: async (glob, _, most) => this.#files().filter((file) => fits(glob, file)).slice(0, most).map(URI.file),
      createFileSystemWatcher: () => this.#withEvents({ dispose() {} }),
      applyEdit: async (edit) => this.#apply(edit),
    };
  }

  #files() {
    const within = (folder) => readdirSync(folder, { recursive: true }).map((name) => path.join(folder, name));
    return this.folders.flatMap(({ uri }) => within(uri.fsPath));
  }

  #apply(edit) {
    for (const [uri, changes] of edit.entries()) {
      const document = this.documents.find((each) => each.uri.toString() === uri.toString());
      const last = (change) => -document.offsetAt(change.range.start);
      for (const change of [...changes].sort((one, other) => last(one) - last(other))) {
        this.replace(document, change.range, change.newText);
      }
    }
    return true;
  }
}

function matches(filter, { uri, languageId }) {
  const { scheme, language, pattern } = typeof filter === "string" ? { language: filter } : filter;
  const isOfThem = (stated, value) => stated === undefined || stated === value;
  return isOfThem(scheme, uri.scheme) && isOfThem(language, languageId) && (!pattern || fits(pattern, uri.fsPath));
}

function fits(glob, file) {
  return minimatch(file, glob, { dot: true });
}

/** Return settings as `workspace.getConfiguration` does: single values, and sections as objects. */
function configuration(settings, section) {
  const full = (name) => (section ? `${section}.${name}` : name);
  const within = (name) => Object.keys(settings).filter((each) => each.startsWith(`${full(name)}.`));
  const get = (name, missing) => {
    if (full(name) in settings) {
      return settings[full(name)];
    }
    const parts = within(name).map((each) => [each.slice(full(name).length + 1), settings[each]]);
    return parts.length > 0 ? nested(parts) : missing;
  };
  return { get, has: (name) => get(name) !== undefined };
}

function nested(parts) {
  const whole = {};
  for (const [name, value] of parts) {
    const [first, ...rest] = name.split(".");
    whole[first] = rest.length > 0 ? { ...whole[first], ...nested([[rest.join("."), value]]) } : value;
  }
  return whole;
}

module.exports = { Editor };
