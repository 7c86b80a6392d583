// A language server that writes down what the client sends: one message a line, into the file RECORD.
const { appendFileSync } = require("node:fs");
const protocol = require("vscode-languageserver-protocol/node");

const COMMANDS = ["check", "show3d", "drive"].map((name) => `subt-check.server.${name}`);
const connection = protocol.createProtocolConnection(
  new protocol.StreamMessageReader(process.stdin),
  new protocol.StreamMessageWriter(process.stdout),
);

function note(method, params) {
  appendFileSync(process.env.RECORD, `${JSON.stringify({ method, params, pid: process.pid, cwd: process.cwd() })}\n`);
}

const answers = {
  initialize: () => ({
    capabilities: {
      textDocumentSync: protocol.TextDocumentSyncKind.Incremental,
      executeCommandProvider: { commands: COMMANDS },
    },
  }),
  shutdown: () => null,
  "workspace/executeCommand": ({ command, ...rest }, token) => execute[command.split(".").at(-1)](rest, token),
};
const execute = {
  // Waits until it is cancelled.
  check: async ({ workDoneToken }, token) => {
    const value = { kind: "begin", title: "Checking", message: "weights", cancellable: true };
    await connection.sendProgress(protocol.WorkDoneProgress.type, workDoneToken, value);
    await new Promise((resolve) => token.onCancellationRequested(resolve));
    note("$/cancelled", {});
    return new protocol.ResponseError(protocol.LSPErrorCodes.RequestCancelled, "cancelled");
  },
  show3d: async () => {
    const uri = "file:///tmp/report.html";
    await connection.sendRequest(protocol.ShowDocumentRequest.type, { uri, external: true });
    return { uri };
  },
  drive: () => "It drove 3.2 m.",
};

connection.onRequest((method, params, token) => {
  note(method, params);
  return answers[method](params, token);
});
connection.onNotification((method, params) => {
  note(method, params);
  if (method === "textDocument/didOpen") {
    const { uri, text } = params.textDocument;
    const told = text.match(/<!-- (\{.*\}) -->/);
    void (told && connection.sendNotification("subt-check/verdict", { uri, ...JSON.parse(told[1]) }));
  }
  if (method === "exit") {
    process.exit(0);
  }
});
connection.listen();
