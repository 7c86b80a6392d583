/** Finds the program `subt-check` that serves the editor. */
import { execFile } from "node:child_process";
import { accessSync, constants, realpathSync, statSync } from "node:fs";
import { homedir } from "node:os";
import * as path from "node:path";
import { promisify } from "node:util";
import * as vscode from "vscode";

const WINDOWS = process.platform === "win32";
const NAME = WINDOWS ? "subt-check.exe" : "subt-check";
/** Where an environment has its programs. */
const PROGRAMS = WINDOWS ? "Scripts" : "bin";
const PROBE_MILLISECONDS = 20_000;
const PYTHON_EXTENSION = "ms-python.python";
const NOWHERE = "subt-check is in no Python environment of this workspace, and not on PATH.";
const NOT_ON_PATH =
  "subt-check is not on PATH, and this workspace is not trusted: its environments are not used.";

/** Why no server can be started, as a sentence for the user. */
export class NoServer extends Error {}

/**
 * Return the path of the first program that has the command `server`.
 *
 * The setting decides alone, if it is set. A workspace that is not trusted names no program, and none
 * from within it is run.
 *
 * @param tell Is told about each program that is passed over.
 * @throws NoServer if there is none.
 */
export async function findProgram(tell: (line: string) => void): Promise<string> {
  const stated = vscode.workspace.getConfiguration("subt-check").get<string>("path", "").trim();
  const faults: string[] = [];
  for (const program of stated ? [expanded(stated)] : await candidates()) {
    const fault = await faultOf(program);
    if (fault === undefined) {
      return program;
    }
    tell(fault);
    faults.push(fault);
  }
  throw new NoServer(faults[0] ?? (vscode.workspace.isTrusted ? NOWHERE : NOT_ON_PATH));
}

/** Return the programs that exist, those of the workspace first. */
async function candidates(): Promise<string[]> {
  const trusted = vscode.workspace.isTrusted;
  const places = trusted ? [...environments(), ...(await interpreterFolders())] : [];
  const onPath = (process.env.PATH ?? "").split(path.delimiter).filter(path.isAbsolute);
  return [...new Set([...places, ...onPath].map((folder) => path.join(folder, NAME)))].filter(isProgram);
}

function environments(): string[] {
  return folders().flatMap((folder) =>
    [".venv", "venv"].map((name) => path.join(folder, name, PROGRAMS)),
  );
}

/** Return where the Python interpreter has its programs that the Python extension has selected. */
async function interpreterFolders(): Promise<string[]> {
  const extension = vscode.extensions.getExtension<PythonApi>(PYTHON_EXTENSION);
  try {
    const known = (await extension?.activate())?.environments;
    const selected = known?.getActiveEnvironmentPath(vscode.workspace.workspaceFolders?.[0]?.uri);
    const environment = selected && (await known?.resolveEnvironment(selected));
    const interpreter = environment?.executable.uri?.fsPath;
    const folder = interpreter && path.dirname(interpreter);
    // On Windows, the interpreter of an installation is one folder above its programs.
    return folder ? [folder, ...(WINDOWS ? [path.join(folder, PROGRAMS)] : [])] : [];
  } catch {
    return []; // an extension of others: it is not needed
  }
}

/** What is used of the API of the Python extension. */
interface PythonApi {
  readonly environments?: {
    getActiveEnvironmentPath(resource?: vscode.Uri): { readonly path: string };
    resolveEnvironment(
      environment: { readonly path: string },
    ): Promise<{ readonly executable: { readonly uri?: vscode.Uri } } | undefined>;
  };
}

/** Return what is wrong with a program, if anything. */
async function faultOf(program: string): Promise<string | undefined> {
  if (!vscode.workspace.isTrusted && isInWorkspace(program)) {
    return `${program} is not run, because it is in a workspace that is not trusted.`;
  }
  if (!isProgram(program)) {
    return `${program} is not a program. The setting subt-check.path names it.`;
  }
  return (await hasServer(program)) ? undefined : `${program} has no command \`server\`.`;
}

async function hasServer(program: string): Promise<boolean> {
  const options = {
    cwd: path.dirname(program),
    env: { ...process.env, NO_COLOR: "1" },
    timeout: PROBE_MILLISECONDS,
  };
  try {
    const { stdout } = await promisify(execFile)(program, ["server", "--help"], options);
    // A version without this command takes `server` for a package to check, and prints that help.
    return stdout.includes("subt-check server");
  } catch {
    return false;
  }
}

function isProgram(file: string): boolean {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}

/** Tell whether a file, or what a link leads to, is in a folder of the workspace. */
function isInWorkspace(file: string): boolean {
  const places = [file, real(file)];
  const roots = folders().flatMap((folder) => [folder, real(folder)]);
  return roots.some((root) => places.some((place) => isInside(place, root)));
}

function isInside(file: string, folder: string): boolean {
  const way = path.relative(folder, file);
  return way !== ".." && !way.startsWith(`..${path.sep}`) && !path.isAbsolute(way);
}

function real(file: string): string {
  try {
    return realpathSync.native(file);
  } catch {
    return path.resolve(file);
  }
}

/** Return a path of the settings as an absolute path. */
function expanded(stated: string): string {
  const root = folders()[0] ?? homedir();
  const replaced = stated.replaceAll("${workspaceFolder}", root).replace(/^~(?=[\\/]|$)/, homedir());
  return path.resolve(root, replaced);
}

function folders(): string[] {
  const open = vscode.workspace.workspaceFolders ?? [];
  return open.filter(({ uri }) => uri.scheme === "file").map(({ uri }) => uri.fsPath);
}
