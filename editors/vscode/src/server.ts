/** The server process: started, restarted and stopped, one after the other. */
import * as vscode from "vscode";

import { Client } from "./client";
import { findProgram, NoServer } from "./programs";
import { VERDICT, type VerdictItem } from "./verdict";

const REMEDY = "pip install 'subt-check[editor]'";

export class Server {
  #client: Client | undefined;
  #last: Promise<void> = Promise.resolve();

  /**
   * @param output Where the log goes.
   * @param page The address of the page that tells how to install it.
   * @param verdict Shows what the server says of the package of a file.
   */
  constructor(
    readonly output: vscode.LogOutputChannel,
    readonly page: string,
    readonly verdict: VerdictItem,
  ) {}

  get isRunning(): boolean {
    return this.#client !== undefined;
  }

  /** Start the server, or start it anew. */
  restart(): Promise<void> {
    return this.#next(async () => {
      await this.#end();
      await this.#begin();
    });
  }

  stop(): Promise<void> {
    return this.#next(() => this.#end());
  }

  #next(work: () => Promise<void>): Promise<void> {
    this.#last = this.#last.then(work);
    return this.#last;
  }

  async #begin(): Promise<void> {
    try {
      const program = await findProgram((line) => this.output.info(line));
      this.output.info(`Starting ${program} server`);
      await this.#serve(program);
    } catch (error) {
      const problem = error instanceof NoServer ? error.message : String(error);
      this.output.error(problem);
      void this.#tell(problem);
    }
  }

  async #serve(program: string): Promise<void> {
    const client = new Client(program, this.output);
    client.onNotification(VERDICT, (verdict) => this.verdict.take(verdict));
    try {
      await client.begin();
      this.#client = client;
      this.#tellWhetherItRuns();
    } catch (error) {
      this.output.error(String(error));
      throw new NoServer(`${program} started no server; the output says why.`);
    }
  }

  async #end(): Promise<void> {
    const client = this.#client;
    this.#client = undefined;
    this.#tellWhetherItRuns();
    try {
      await client?.end();
    } catch (error) {
      this.output.warn(`The server did not stop in order: ${String(error)}`);
    }
    this.verdict.clear();
  }

  /** Steps of the walkthrough depend on it. */
  #tellWhetherItRuns(): void {
    void vscode.commands.executeCommand("setContext", "subt-check.isRunning", this.isRunning);
  }

  /** Say what is wrong and what to do. Nobody waits for the answer. */
  async #tell(problem: string): Promise<void> {
    const [install, settings, output] = ["How to install", "Open settings", "Show output"];
    const text = `subt-check: ${problem} To install or update it: ${REMEDY}`;
    const chosen = await vscode.window.showErrorMessage(text, install, settings, output);
    if (chosen === install) {
      await vscode.env.openExternal(vscode.Uri.parse(this.page));
    } else if (chosen === settings) {
      await vscode.commands.executeCommand("workbench.action.openSettings", "subt-check.path");
    } else if (chosen === output) {
      this.output.show();
    }
  }
}
