// The types of the module `vscode` that the client's library makes or extends.

/** Make a class of which the constructor keeps its arguments under these names. */
const record = (...names) =>
  class {
    constructor(...values) {
      names.forEach((name, index) => (this[name] = values[index]));
    }
  };

/** Make an enumeration that counts from `first`. */
const enumeration = (first, ...names) => Object.fromEntries(names.map((name, index) => [name, first + index]));

class Disposable {
  constructor(dispose) {
    this.dispose = dispose;
  }
}

class EventEmitter {
  #listeners = new Set();
  event = (listener, self, owners) => {
    const bound = listener.bind(self);
    this.#listeners.add(bound);
    const registered = new Disposable(() => this.#listeners.delete(bound));
    owners?.push(registered);
    return registered;
  };
  fire(value) {
    [...this.#listeners].forEach((listener) => listener(value));
  }
  dispose() {
    this.#listeners.clear();
  }
}

class CancellationTokenSource {
  #emitter = new EventEmitter();
  token = { isCancellationRequested: false, onCancellationRequested: this.#emitter.event };
  cancel() {
    this.token.isCancellationRequested = true;
    this.#emitter.fire();
  }
  dispose() {}
}

class Range {
  constructor(...given) {
    const [line, character, lastLine, lastCharacter] = given;
    const isOfNumbers = typeof line === "number";
    this.start = isOfNumbers ? new types.Position(line, character) : given[0];
    this.end = isOfNumbers ? new types.Position(lastLine, lastCharacter) : given[1];
  }
  get isEmpty() {
    return this.start.line === this.end.line && this.start.character === this.end.character;
  }
}

/** Edits by file, and the files that are made first, as `WorkspaceEdit` keeps them. */
class WorkspaceEdit {
  created = [];
  #edits = new Map();
  createFile(uri) {
    this.created.push(uri);
  }
  set(uri, edits) {
    this.#edits.set(uri.toString(), [uri, edits.map((edit) => (Array.isArray(edit) ? edit[0] : edit))]);
  }
  entries() {
    return [...this.#edits.values()];
  }
}

/** Values by file, as a `DiagnosticCollection` keeps them. */
class UriMap {
  #values = new Map();
  set(uri, values) {
    this.#values.set(uri.toString(), values ?? []);
  }
  get(uri) {
    return this.#values.get(uri.toString());
  }
  delete(uri) {
    this.#values.delete(uri.toString());
  }
  clear() {
    this.#values.clear();
  }
  dispose() {
    this.clear();
  }
}

class MarkdownString {
  constructor(value = "") {
    this.value = value;
  }
  appendMarkdown(text) {
    this.value += text;
    return this;
  }
  appendText(text) {
    return this.appendMarkdown(text.replace(/[\\`*_{}[\]()#+\-!~]/g, "\\$&"));
  }
}

class CodeActionKind {
  constructor(value) {
    this.value = value;
  }
  append(part) {
    return new CodeActionKind(this.value ? `${this.value}.${part}` : part);
  }
}
const NOTHING = new CodeActionKind("");
CodeActionKind.Empty = NOTHING;
CodeActionKind.QuickFix = NOTHING.append("quickfix");
CodeActionKind.Refactor = NOTHING.append("refactor");
CodeActionKind.RefactorExtract = CodeActionKind.Refactor.append("extract");
CodeActionKind.RefactorInline = CodeActionKind.Refactor.append("inline");
CodeActionKind.RefactorRewrite = CodeActionKind.Refactor.append("rewrite");
CodeActionKind.RefactorMove = CodeActionKind.Refactor.append("move");
CodeActionKind.Source = NOTHING.append("source");
CodeActionKind.SourceFixAll = CodeActionKind.Source.append("fixAll");
CodeActionKind.SourceOrganizeImports = CodeActionKind.Source.append("organizeImports");
CodeActionKind.Notebook = NOTHING.append("notebook");

const types = {
  CallHierarchyItem: record("kind", "name", "detail", "uri", "range", "selectionRange"),
  CancellationError: class extends Error {},
  CancellationTokenSource,
  CodeAction: record("title", "kind"),
  CodeActionKind,
  CodeActionTriggerKind: enumeration(1, "Invoke", "Automatic"),
  CodeLens: record("range", "command"),
  CompletionItem: record("label", "kind"),
  CompletionItemKind: { Text: 0, TypeParameter: 24 },
  CompletionItemTag: { Deprecated: 1 },
  CompletionList: record("items", "isIncomplete"),
  CompletionTriggerKind: enumeration(0, "Invoke", "TriggerCharacter", "TriggerForIncompleteCompletions"),
  Diagnostic: record("range", "message", "severity"),
  DiagnosticRelatedInformation: record("location", "message"),
  DiagnosticSeverity: enumeration(0, "Error", "Warning", "Information", "Hint"),
  DiagnosticTag: enumeration(1, "Unnecessary", "Deprecated"),
  Disposable,
  DocumentHighlightKind: enumeration(0, "Text", "Read", "Write"),
  DocumentLink: record("range", "target"),
  DocumentSymbol: record("name", "detail", "kind", "range", "selectionRange"),
  EventEmitter,
  FileType: enumeration(0, "Unknown", "File", "Directory"),
  FoldingRange: record("start", "end", "kind"),
  FoldingRangeKind: enumeration(1, "Comment", "Imports", "Region"),
  Hover: record("contents", "range"),
  InlayHint: record("position", "label", "kind"),
  InlineCompletionTriggerKind: enumeration(0, "Invoke", "Automatic"),
  Location: record("uri", "range"),
  LogLevel: enumeration(0, "Off", "Trace", "Debug", "Info", "Warning", "Error"),
  MarkdownString,
  NotebookCellKind: enumeration(1, "Markup", "Code"),
  Position: record("line", "character"),
  ProgressLocation: { SourceControl: 1, Window: 10, Notification: 15 },
  Range,
  StatusBarAlignment: enumeration(1, "Left", "Right"),
  RelativePattern: record("baseUri", "pattern"),
  SignatureHelpTriggerKind: enumeration(1, "Invoke", "TriggerCharacter", "ContentChange"),
  SnippetString: record("value"),
  SymbolInformation: record("name", "kind", "containerName", "location"),
  SymbolKind: { File: 0, TypeParameter: 25 },
  SymbolTag: { Deprecated: 1 },
  TextDocumentSaveReason: enumeration(1, "Manual", "AfterDelay", "FocusOut"),
  TextEdit: record("range", "newText"),
  ThemeColor: record("id"),
  TypeHierarchyItem: record("kind", "name", "detail", "uri", "range", "selectionRange"),
  UriMap,
  WorkspaceEdit,
};

module.exports = types;
