"""What xacro itself makes of an expression: its own symbols, evaluated by Python."""

from __future__ import annotations

import builtins
import posixpath
import warnings
from collections.abc import Mapping
from typing import Any

import xacro
import yaml

from checker.formats.xacro.expression.builtins import Function

SYMBOLS: dict[str, Any] = xacro.create_global_symbols()
"""As xacro makes them, before anything in it is replaced."""


class Native(dict[str, Any]):
    """Names for Python's `eval`: ours, with xacro's own functions in place of the language's."""

    def __init__(self, names: Any) -> None:
        super().__init__(__builtins__={})
        self._names = names

    def __getitem__(self, name: str) -> Any:
        found = self._names[name]
        if name in ("math", "python", "xacro") and type(found) is xacro.NameSpace:
            return SYMBOLS[name]
        if type(found) is not Function:
            return copied(found)
        return SYMBOLS[name] if name in SYMBOLS else getattr(builtins, name)


def copied(value: Any) -> Any:
    """Return a copy: an expression may change what a name stands for, and is evaluated twice."""
    if isinstance(value, list):
        return type(value)(map(copied, list.__iter__(value)))
    if isinstance(value, dict) and type(value) is not xacro.NameSpace:
        return type(value)((key, copied(each)) for key, each in value.items())
    return value


def native_outcome(expression: str, names: Any) -> str:
    """Return the value, with its type, or the name of what is raised."""
    try:
        with warnings.catch_warnings():
            # `0[0]` is a SyntaxWarning of the compiler, and an error only where warnings are.
            warnings.simplefilter("ignore", SyntaxWarning)
            code = compile(expression.strip(), "<expression>", "eval")
        return shown(eval(code, Native(names)))  # noqa: S307 - real files, and expressions of ours
    except Exception as error:  # noqa: BLE001 - whatever it is
        return type(error).__name__


def shown(value: Any) -> str:
    """Return a value with its type; two that are not a number are equal."""
    return f"{type(value).__name__} {value!r}"


def read_yaml_as(texts: Mapping[str, str]) -> None:
    """Let xacro's own `load_yaml` read texts by their paths, in this process."""

    def load_yaml(filename: str) -> Any:
        path = posixpath.normpath(xacro.abs_filename_spec(filename))
        for unit in xacro.ConstructUnits:
            yaml.SafeLoader.add_constructor(unit.value.tag, unit.constructor)
        return xacro.YamlListWrapper.wrap(yaml.safe_load(texts[path]))

    xacro.load_yaml = load_yaml
    SYMBOLS.update(xacro.create_global_symbols())
