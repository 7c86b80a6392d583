"""Includes of packages that are not available, and whether a robot is whole without them.

An included file of macros alone is not needed when none of them is called. Nothing else states
what is in the file: a call of a macro that no other file defines, in a branch that is not taken.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

from checker.formats.xacro.macro_names import macro_names

_CALL = re.compile(r"<xacro:([A-Za-z_][\w.-]{0,200})")
_OWN = frozenset(
    {
        *("arg", "attribute", "call", "element", "else", "if", "include", "insert_block"),
        *("macro", "property", "unless"),
    }
)
"""Tags of xacro itself."""


def calls_another(texts: Collection[str]) -> bool:
    """Return whether files call a macro that none of them defines."""
    called = {name for text in texts for name in _CALL.findall(text)}
    return not called <= _OWN | macro_names(texts)


def is_closed(root: Any) -> bool:
    """Return whether all links that joints and extensions name are in the document."""
    parts = [child for child in root.childNodes if child.nodeType == child.ELEMENT_NODE]
    names = {it.getAttribute("name") for it in parts if it.tagName in ("link", "joint")}
    ends = {
        end.getAttribute("link")
        for joint in parts
        if joint.tagName == "joint"
        for end in joint.childNodes
        if end.nodeType == end.ELEMENT_NODE and end.tagName in ("parent", "child")
    }
    references = {it.getAttribute("reference") for it in parts if it.tagName == "gazebo"}
    return bool(names) and ends | references <= names | {""}
