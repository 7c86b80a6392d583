/** Starts `subt-check server` where there is a robot, and offers its commands. */
import * as vscode from "vscode";

import { hasRobotFiles, isRobotFile } from "./client";
import { LONG_COMMANDS, serverCommand } from "./commands";
import { Server } from "./server";
import { VerdictItem } from "./verdict";

/** The editor asks the module, not an object, to end. */
let active: Server | undefined;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const output = vscode.window.createOutputChannel("subt-check", { log: true });
  const verdict = new VerdictItem();
  const server = new Server(output, String(context.extension.packageJSON.homepage), verdict);
  active = server;
  context.subscriptions.push(output, verdict, ...commands(server), ...restarts(server));
  if (vscode.workspace.textDocuments.some(isRobotFile) || (await hasRobotFiles())) {
    await server.restart();
  } else {
    context.subscriptions.push(firstRobot(server));
  }
}

export async function deactivate(): Promise<void> {
  await active?.stop();
  active = undefined;
}

/** XML files of other trades start no server: wait for one of a robot. */
function firstRobot(server: Server): vscode.Disposable {
  const waiting = vscode.workspace.onDidOpenTextDocument((document) => {
    if (isRobotFile(document)) {
      waiting.dispose();
      void server.restart();
    }
  });
  return waiting;
}

function restarts(server: Server): vscode.Disposable[] {
  const started = ["subt-check.path", "subt-check.args"];
  return [
    vscode.workspace.onDidChangeConfiguration((change) => {
      if (started.some((setting) => change.affectsConfiguration(setting))) {
        void server.restart();
      }
    }),
    // Now the environments of the workspace count.
    vscode.workspace.onDidGrantWorkspaceTrust(() => void server.restart()),
  ];
}

function commands(server: Server): vscode.Disposable[] {
  const register = vscode.commands.registerCommand;
  return [
    register("subt-check.restart", () => server.restart()),
    register("subt-check.showOutput", () => server.output.show()),
    ...Object.keys(LONG_COMMANDS).map((name) =>
      register(`subt-check.${name}`, () => executeHere(server, name)),
    ),
  ];
}

/** Have the server execute a command for the package of the file that is shown. */
async function executeHere(server: Server, name: string): Promise<void> {
  const shown = vscode.window.activeTextEditor?.document.uri;
  if (shown?.scheme !== "file") {
    void vscode.window.showInformationMessage("subt-check: open a file of a robot package first.");
    return;
  }
  if (!server.isRunning) {
    await server.restart();
  }
  if (server.isRunning) {
    await vscode.commands.executeCommand(serverCommand(name), shown.toString());
  }
}
