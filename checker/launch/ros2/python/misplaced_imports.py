"""Imports of a launch file that take a class from another module than that which has it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import NamedTuple

from checker.base.resources import table


class MisplacedImport(NamedTuple):
    """A name that is in no module of the launch system but another one."""

    node: ast.alias
    module: str
    home: str


def misplaced_imports(tree: ast.Module) -> Iterator[MisplacedImport]:
    """Yield the names that the imports at the top of a file ask the wrong module for.

    A name that no module of the table has may be in a release that it does not know.
    """
    known = table("launch_modules")
    homes = {name: module for module, names in known["modules"].items() for name in names}
    for statement in tree.body:
        if not isinstance(statement, ast.ImportFrom) or statement.module not in known["closed"]:
            continue
        module = str(statement.module)
        for alias in statement.names:
            home = homes.get(alias.name, module)
            if home != module:
                yield MisplacedImport(alias, module, home)
