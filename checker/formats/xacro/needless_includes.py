"""Includes of packages that are not available, and whether a robot is whole without them.

An included file of macros alone is not needed when none of them is called. Nothing else states
what is in the file: a call of a macro that no other file defines. One at the top of the robot adds
whole links, such as a camera: the rest, if joints of its own move, is judged without them, without
what `<gazebo reference>` adds to them, and without links that joints connect to them alone.
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


def reduce_to_robot(root: Any, skipped: Collection[Any]) -> bool:
    """Remove skipped calls, and what only their links can hold.

    Returns:
        Whether a robot with movable joints is left, and no call was in a link.
    """
    if any(call.parentNode is not root for call in skipped):
        return False
    for call in skipped:
        root.removeChild(call)
    while any(_remove(root, joint) for joint in _parts(root, "joint")):
        pass  # a link that was removed may have been the parent of others
    names = {part.getAttribute("name") for part in _parts(root)}
    for extension in _parts(root, "gazebo"):
        if extension.getAttribute("reference") not in names | {""}:
            root.removeChild(extension)
    types = {joint.getAttribute("type") for joint in _parts(root, "joint")}
    return bool(types - {"", "fixed"})


def _remove(root: Any, joint: Any) -> bool:
    """Remove a joint at a link that is not there, and its child; return whether it was one."""
    links = {link.getAttribute("name"): link for link in _parts(root, "link")}
    ends = {end.tagName: end.getAttribute("link") for end in _parts(joint)}
    parent, child = ends.get("parent", ""), ends.get("child", "")
    if {parent, child} <= links.keys() | {""}:
        return False
    root.removeChild(joint)
    if parent not in links and child in links:
        root.removeChild(links[child])
    return True


def _parts(parent: Any, *tags: str) -> list[Any]:
    """Return the elements in another one that have one of these tags; all if none is given."""
    elements = (child for child in parent.childNodes if child.nodeType == child.ELEMENT_NODE)
    return [element for element in elements if not tags or element.tagName in tags]


def is_closed(root: Any) -> bool:
    """Return whether all links that joints and extensions name are in the document.

    So are joints that others mimic; those of `<ros2_control>` may be misspelt.
    """
    names = {part.getAttribute("name") for part in _parts(root, "link", "joint")}
    joints = _parts(root, "joint")
    ends = {end.getAttribute("link") for it in joints for end in _parts(it, "parent", "child")}
    references = {tag.getAttribute("reference") for tag in _parts(root, "gazebo")}
    leaders = {mimic.getAttribute("joint") for mimic in root.getElementsByTagName("mimic")}
    return bool(names) and ends | references | leaders <= names | {""}
