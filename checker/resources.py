"""Tables of facts that come with the checker (`checker/data`)."""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import Any


@cache
def table(name: str) -> Any:
    """Return a JSON table by its file name without `.json`; read once.

    Raises:
        FileNotFoundError: There is no such table.
    """
    return json.loads(files("checker").joinpath("data", f"{name}.json").read_text("utf-8"))
