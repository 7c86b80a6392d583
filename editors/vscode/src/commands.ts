/** Commands of the server that take a while: with progress, and a way to cancel them. */
import { randomUUID } from "node:crypto";
import * as vscode from "vscode";
import {
  ExecuteCommandRequest,
  type ExecuteCommandSignature,
  type LanguageClient,
  WorkDoneProgress,
} from "vscode-languageclient/node";

/** Commands of the palette, each with what is shown while the server's command of that name runs. */
export const LONG_COMMANDS: Readonly<Record<string, string>> = {
  check: "subt-check: checking with trial",
  show3d: "subt-check: drawing the robot",
  drive: "subt-check: driving the robot",
};
const SERVER = "subt-check.server.";

/** Return the server's name of a command of the palette. */
export function serverCommand(name: string): string {
  return SERVER + name;
}

/** Have the server execute a command, from the palette or from a code lens. */
export async function executeCommand(
  client: LanguageClient,
  command: string,
  given: unknown[],
  next: ExecuteCommandSignature,
): Promise<unknown> {
  const name = command.startsWith(SERVER) ? command.slice(SERVER.length) : "";
  const title = LONG_COMMANDS[name];
  if (title === undefined) {
    return next(command, given);
  }
  const answer = await withProgress(client, title, command, given);
  if (typeof answer === "string") {
    client.outputChannel.appendLine(answer); // the server shows it, but only for a moment
  }
  return answer;
}

function withProgress(
  client: LanguageClient,
  title: string,
  command: string,
  given: unknown[],
): Thenable<unknown> {
  const location = vscode.ProgressLocation.Notification;
  return vscode.window.withProgress({ location, title, cancellable: true }, async (bar, token) => {
    const workDoneToken = randomUUID();
    const progress = client.onProgress(WorkDoneProgress.type, workDoneToken, (value) => {
      if (value.kind !== "end" && value.message !== undefined) {
        bar.report({ message: value.message });
      }
    });
    const request = { command, arguments: given, workDoneToken };
    try {
      return await client.sendRequest(ExecuteCommandRequest.type, request, token);
    } catch (error) {
      if (!token.isCancellationRequested) {
        const reason = error instanceof Error ? error.message : String(error);
        void vscode.window.showErrorMessage(`${title}: ${reason}`);
      }
      return undefined;
    } finally {
      progress.dispose();
    }
  });
}
