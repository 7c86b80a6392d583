/** The verdict on the package of the file that is shown, in the status bar. */
import * as vscode from "vscode";

/** The notification of the server; docs/editors.md explains its fields. */
export const VERDICT = "subt-check/verdict";
export interface Verdict {
  readonly uri: string;
  readonly verdict: "ready" | "paperwork" | "not_ready" | "incomplete" | "not_checked" | "none";
  readonly package?: string;
  readonly text?: string;
  readonly sentence?: string;
  readonly errors?: number;
  readonly warnings?: number;
}

const PROBLEMS = "workbench.actions.view.problems";
const LINKS = { "Open the report": "subt-check.show3d", "Check with trial": "subt-check.check" };

/** An item of the status bar; a click opens the view Problems. */
export class VerdictItem implements vscode.Disposable {
  readonly #item = vscode.window.createStatusBarItem("verdict", vscode.StatusBarAlignment.Left);
  readonly #verdicts = new Map<string, Verdict>();
  readonly #listening = [
    vscode.window.onDidChangeActiveTextEditor(() => this.#show()),
    vscode.workspace.onDidCloseTextDocument(({ uri }) => this.#verdicts.delete(uri.toString())),
  ];

  constructor() {
    this.#item.name = "Verdict of subt-check";
    this.#item.command = PROBLEMS;
  }

  /** Take over what the server has sent. */
  take(verdict: Verdict): void {
    this.#verdicts.set(verdict.uri, verdict);
    this.#show();
  }

  /** Forget all: the server has ended. */
  clear(): void {
    this.#verdicts.clear();
    this.#show();
  }

  dispose(): void {
    [this.#item, ...this.#listening].forEach((each) => each.dispose());
  }

  #show(): void {
    const uri = vscode.window.activeTextEditor?.document.uri.toString();
    const shown = uri === undefined ? undefined : this.#verdicts.get(uri);
    void vscode.commands.executeCommand("setContext", "subt-check.hasVerdict", shown?.text !== undefined);
    if (shown?.text === undefined) {
      this.#item.hide();
      return;
    }
    const severity = severityOf(shown);
    const colour = severity && new vscode.ThemeColor(`statusBarItem.${severity}Background`);
    this.#item.text = `$(${severity ?? "pass"}) ${shown.text}`;
    this.#item.backgroundColor = colour;
    this.#item.tooltip = tooltipOf(shown);
    this.#item.show();
  }
}

/** Return the colour's severity: that of the worst finding; what is not decided is a warning. */
function severityOf({ verdict, errors, warnings }: Verdict): "error" | "warning" | undefined {
  if (errors) {
    return "error";
  }
  return warnings || verdict !== "ready" ? "warning" : undefined;
}

function tooltipOf({ package: name, sentence }: Verdict): vscode.MarkdownString {
  const tooltip = new vscode.MarkdownString();
  tooltip.isTrusted = { enabledCommands: Object.values(LINKS) };
  // Names of packages are text of others.
  tooltip.appendText([name, sentence].filter(Boolean).join("\n"));
  const links = Object.entries(LINKS).map(([title, command]) => `[${title}](command:${command})`);
  return tooltip.appendMarkdown(`\n\n${links.join(" · ")}`);
}
