"""What comes with the checker beside its code: tables of facts (`checker/data`), and templates."""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any


@cache
def table(name: str) -> Any:
    """Return a JSON table by its file name without `.json`; read once.

    Raises:
        FileNotFoundError: There is no such table.
    """
    return json.loads(files("checker").joinpath("data", f"{name}.json").read_text("utf-8"))


def templates(name: str) -> Traversable:
    """Return a folder of templates: in the wheel below `checker`, in a checkout beside it."""
    installed = files("checker").joinpath("templates", name)
    return installed if installed.is_dir() else Path(__file__).parents[1] / "templates" / name
