"""Includes of packages that are not available, and whether a robot is whole without them.

An included file of macros alone is not needed when none of them is called. Nothing else states
what is in the file: a call of a macro that no other file defines. One at the top of the robot adds
whole links, such as a camera: the rest, if joints of its own move, is judged without them and
without what `<gazebo reference>` adds to them.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

from checker.formats.xacro.macro_names import macro_names

SKIPPED = "skipped_call"
"""Tag of what a call of a macro that no available file defines becomes."""
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


def skip(call: Any, defined: Collection[str]) -> str:
    """Mark an element as skipped if it calls a macro that no file defines.

    Returns:
        The name of the macro; empty if a file defines it.
    """
    name = str(call.tagName).removeprefix("xacro:")
    if name == call.tagName or name in _OWN or name.rpartition(".")[2] in defined:
        return ""
    call.tagName = call.nodeName = SKIPPED
    for attribute in list(call.attributes.keys()):
        call.removeAttribute(attribute)
    for child in list(call.childNodes):
        call.removeChild(child)
    return name


def is_robot_without(root: Any, skipped: Collection[Any]) -> bool:
    """Return whether a robot with movable joints is left without skipped calls, none in a link."""
    types = (joint.getAttribute("type") for joint in root.getElementsByTagName("joint"))
    return all(call.parentNode is root for call in skipped) and bool({*types} - {"", "fixed"})


def without_extensions(root: Any, skipped: Collection[Any]) -> None:
    """Remove skipped calls, and the extensions of links that only they can add."""
    for call in skipped:
        root.removeChild(call)
    names = {it.getAttribute("name") for it in root.childNodes if it.nodeType == it.ELEMENT_NODE}
    for extension in root.getElementsByTagName("gazebo") if skipped else ():
        reference = extension.getAttribute("reference")
        if extension.parentNode is root and reference and reference not in names:
            root.removeChild(extension)


def is_closed(root: Any) -> bool:
    """Return whether all links that joints and extensions name are in the document.

    So are joints that others mimic; those of `<ros2_control>` may be misspelt.
    """
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
    leaders = {mimic.getAttribute("joint") for mimic in root.getElementsByTagName("mimic")}
    return bool(names) and ends | references | leaders <= names | {""}
