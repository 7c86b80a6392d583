"""`import subt_check` in a checkout: each of its modules is another name of one in `checker`.

The wheel has no such file. There, `subt_check` is the checker's own package, and its rules lie in
`subt_check.rules`; scripts/hatch_build.py says how.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from types import ModuleType
from typing import TYPE_CHECKING, Any

import checker

if TYPE_CHECKING:  # to type checkers, the line at the end says nothing
    from checker import *  # noqa: F403


class _Alias:
    """Finds and loads the modules of `checker` and `rules` by their other names."""

    def find_spec(
        self, name: str, _path: Sequence[str] | None = None, _target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return a spec of what is there by its own name."""
        if name.startswith(f"{__name__}.") and find_spec(_own_name(name)) is not None:
            loader: Any = self  # not of the abstract class, which takes 20 ms to load
            return ModuleSpec(name, loader)
        return None

    def create_module(self, _spec: ModuleSpec) -> None:
        """Let an empty one be made."""

    def exec_module(self, module: ModuleType) -> None:
        """Put the module that is meant in the place of an empty one."""
        sys.modules[module.__name__] = import_module(_own_name(module.__name__))


def _own_name(name: str) -> str:
    inner = name.removeprefix(f"{__name__}.")
    return inner if inner.partition(".")[0] == "rules" else f"checker.{inner}"


sys.meta_path.insert(0, _Alias())
sys.modules[__name__] = checker
