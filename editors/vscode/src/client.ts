/** What the client tells the server, and which files it shows it. */
import * as path from "node:path";
import * as vscode from "vscode";
import {
  CloseAction,
  type CloseHandlerResult,
  type ErrorHandler,
  LanguageClient,
  type LanguageClientOptions,
} from "vscode-languageclient/node";

import { executeCommand } from "./commands";

const ROBOT_FILES = "{package.xml,model.config,*.sdf,*.urdf,*.xacro,*.world}";
const OTHER_FILES = "{*.launch,*.launch.py,CMakeLists.txt,spawner.rb,specifications.md,subt-check.toml}";
const LANGUAGES = ["xml", "yaml", "ruby", "python", "cmake", "markdown"];
const START_MILLISECONDS = 60_000;

/** Tell whether a document is a file that only robot packages have. */
export function isRobotFile(document: vscode.TextDocument): boolean {
  return vscode.languages.match({ scheme: "file", pattern: `**/${ROBOT_FILES}` }, document) > 0;
}

/** Tell whether there is such a file in the workspace. */
export async function hasRobotFiles(): Promise<boolean> {
  return (await vscode.workspace.findFiles(`**/${ROBOT_FILES}`, undefined, 1)).length > 0;
}

/** The client of one server process. Its owner reports a failed start; the client itself does not. */
export class Client extends LanguageClient {
  /** Whether the server has answered, and nobody has asked it to end. */
  #runs = false;

  /**
   * @param program The path of `subt-check`.
   * @param output Where the server's log goes.
   */
  constructor(program: string, output: vscode.LogOutputChannel) {
    const more = settings().get<string[]>("args", []);
    // Nothing of a workspace that is not trusted is near the program.
    const place = vscode.workspace.isTrusted ? {} : { cwd: path.dirname(program) };
    super(
      "subt-check",
      "subt-check",
      { command: program, args: ["server", ...more], options: place },
      optionsOf(output, () => this),
    );
    this.clientOptions.errorHandler = this.#handler();
  }

  /** Start the server. (The library calls `start` whenever it sends something.) */
  async begin(): Promise<void> {
    const stuck = setTimeout(() => this.serverProcess?.kill(), START_MILLISECONDS);
    try {
      await this.start();
      this.#runs = true;
    } finally {
      clearTimeout(stuck);
    }
  }

  /** End the server, for good. */
  async end(): Promise<void> {
    this.#runs = false;
    await this.dispose();
  }

  override error(message: string, data?: unknown, show?: boolean | "force"): void {
    super.error(message, data, this.#runs ? show : false);
  }

  /** A server that ends before it has answered is not started again. */
  #handler(): ErrorHandler {
    const usual = this.createDefaultErrorHandler();
    const never: CloseHandlerResult = { action: CloseAction.DoNotRestart, handled: true };
    return {
      error: (error, message, count) => usual.error(error, message, count),
      closed: () => (this.#runs ? usual.closed() : never),
    };
  }
}

function optionsOf(
  outputChannel: vscode.LogOutputChannel,
  client: () => LanguageClient,
): LanguageClientOptions {
  return {
    documentSelector: [
      ...LANGUAGES.map((language) => ({ scheme: "file", language })),
      { scheme: "file", pattern: `**/${ROBOT_FILES}` },
      { scheme: "file", pattern: `**/${OTHER_FILES}` },
    ],
    initializationOptions: () => ({
      trial: settings().get("trial"),
      debounce: settings().get("debounce"),
      verdict: true,
    }),
    initializationFailedHandler: () => false,
    middleware: {
      executeCommand: (command, given, next) => executeCommand(client(), command, given, next),
    },
    outputChannel,
    synchronize: { configurationSection: "subt-check" },
  };
}

function settings(): vscode.WorkspaceConfiguration {
  return vscode.workspace.getConfiguration("subt-check");
}
