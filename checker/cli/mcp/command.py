"""`subt-check mcp`: starts the server for programs that speak the Model Context Protocol."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from checker.base.errors import CheckerError
from checker.base.extras import MCP
from checker.base.output import EXIT_CLEAN


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.description = (
        "Start a server of the Model Context Protocol. Assistants start it and communicate over "
        "standard input and output. docs/mcp.md says how to set them up."
    )
    parser.add_argument(
        "workspace",
        nargs="?",
        default=".",
        metavar="FOLDER",
        help="the only folder whose paths are read (default: the current folder)",
    )
    parser.add_argument(
        "--write", action="store_true", help="let the tool `fix` change files in the folder"
    )
    parser.add_argument(
        "--allow-dirty",
        action="store_true",
        help="with --write: also change files that have uncommitted changes in git",
    )


def run(options: argparse.Namespace) -> int:
    """Serve until the client ends it."""
    MCP.require_for("mcp")
    if options.allow_dirty and not options.write:
        raise CheckerError("--allow-dirty needs --write")
    from checker.cli.mcp.server import server_of
    from checker.cli.mcp.tools import Tools
    from checker.cli.mcp.workspace import Workspace

    workspace = Workspace.at(Path(options.workspace))
    # Reports and patches then name files as the client does.
    os.chdir(workspace.root)
    server_of(Tools(workspace, options.write, options.allow_dirty)).run("stdio")
    return EXIT_CLEAN
