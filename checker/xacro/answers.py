"""What the process that expands xacro files may answer: it may have been taken over."""

from __future__ import annotations

from typing import Any

from checker.xacro.fault import XacroFaultKind

_KINDS = frozenset(kind.value for kind in XacroFaultKind)


def is_answer(said: Any) -> bool:
    """Say whether something has the form of what became of one file (`processor.expand`)."""
    match said:
        case {"xml": str(), "origins": list(origins), "files": list(files)}:
            return all(map(_is_place, origins)) and all(isinstance(each, str) for each in files)
        case {"kind": str(kind), "message": str()}:
            return kind in _KINDS and _is_told(said.get("at"), said.get("through"))
        case {"refused": str(), "expression": str()}:
            return _is_told(said.get("at"), None)
        case {"missing": str()} | {"unread": str()}:
            return True
    return False


def _is_place(said: Any) -> bool:
    match said:
        case [int(), int()]:
            return True
    return False


def _is_told(at: Any, through: Any) -> bool:
    """Say whether a fault tells of its place and macros as such, if at all."""
    match at:
        case None | [str(), int()]:
            macros = [] if through is None else through
            return isinstance(macros, list) and all(isinstance(each, str) for each in macros)
    return False
