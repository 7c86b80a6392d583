"""Differences of xacro 1.13 of ROS Melodic, which runs on Python 2, from newer releases.

All functions of Python are available in expressions, and `map`, `filter`, `range` and `zip` make
lists. A macro that is defined while another one is expanded is known everywhere. Tags need no
prefix.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

import xacro

from checker.formats.xacro.expression import builtins
from checker.formats.xacro.expression.bounds import Budget
from checker.formats.xacro.expression.builtins import Function, Work

_LAZY = ("map", "filter", "zip", "range")
FUNCTIONS = builtins.FUNCTIONS
"""Python's own functions, which `eval` of Python 2 finds."""


def _listing(work: Work) -> Work:
    """Return work whose result is a list."""

    def listing(budget: Budget, *arguments: Any, **named: Any) -> list[Any]:
        return builtins.listed(budget, work(budget, *arguments, **named))

    return listing


LISTS = {
    name: Function(name, _listing(FUNCTIONS[name].work), FUNCTIONS[name].takes) for name in _LAZY
}
"""Functions that make lists."""


def with_global_macros(evaluate: Callable[..., Any]) -> Callable[..., Any]:
    """Return `eval_all` so that what defines a macro within a macro defines it for all."""

    @wraps(evaluate)
    def evaluated(node: Any, macros: Any, symbols: Any) -> Any:
        while isinstance(getattr(macros, "parent", None), xacro.Table):
            macros = macros.parent
        return evaluate(node, macros, symbols)

    return evaluated


_TAGS = frozenset({"property", "macro", "include", "insert_block", "if", "unless"})


def prefix(root: Any, macros: frozenset[str]) -> None:
    """Write `xacro:` before the tags of xacro that lack it."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        waiting.extend(child for child in node.childNodes if child.nodeType == node.ELEMENT_NODE)
        if node.tagName in macros or (node.tagName in _TAGS and not _is_of_gazebo(node)):
            node.tagName = node.nodeName = f"xacro:{node.tagName}"


def _is_of_gazebo(node: Any) -> bool:
    """Return whether an `<include>` is one of SDF, which contains a `<uri>`."""
    return node.tagName == "include" and not node.hasAttribute("filename")
