"""`subt-check server`: the language server for editors."""

from __future__ import annotations

import argparse

from checker.base.extras import EDITOR
from checker.base.output import EXIT_CLEAN


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.description = (
        "Start the language server. Editors start it and communicate over standard input and "
        "output. docs/editors.md says how to set up editors."
    )
    parser.add_argument(
        "--stdio",
        action="store_true",
        help="communicate over standard input and output (the default)",
    )


def run(_options: argparse.Namespace) -> int:
    """Serve until the editor ends it."""
    EDITOR.require_for("server")
    from checker.editor.features import serve

    serve()
    return EXIT_CLEAN
