"""Elements and attributes of XML that name a part of the robot: link, joint, frame, sensor."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from enum import StrEnum

from checker.base.resources import table
from checker.editor.xacro_names import PREFIX


class NameKind(StrEnum):
    """Kind of thing that a name represents. A frame is a named frame or a nested model."""

    LINK = "link"
    JOINT = "joint"
    FRAME = "frame"
    SENSOR = "sensor"


_LINK = (NameKind.LINK,)
_JOINT = (NameKind.JOINT,)
_ANY_FRAME = (NameKind.LINK, NameKind.FRAME, NameKind.JOINT)
"""In SDF, links and joints are frames, too."""
_END = (NameKind.LINK, NameKind.FRAME)

_TEXTS: Mapping[tuple[str, str], tuple[NameKind, ...]] = {
    ("joint", "parent"): _END,
    ("joint", "child"): _END,
    ("gripper", "gripper_link"): _LINK,
    ("gripper", "palm_link"): _LINK,
    ("joint", "gearbox_reference_body"): _LINK,
    ("include", "placement_frame"): _ANY_FRAME,
}
_ATTRIBUTES: Mapping[tuple[str, str], tuple[NameKind, ...]] = {
    ("pose", "relative_to"): _ANY_FRAME,
    ("pose", "frame"): _ANY_FRAME,
    ("frame", "attached_to"): _ANY_FRAME,
    ("xyz", "expressed_in"): _ANY_FRAME,
    ("model", "canonical_link"): _LINK,
    ("model", "placement_frame"): _ANY_FRAME,
    ("mimic", "joint"): _JOINT,
    ("parent", "link"): _LINK,
    ("child", "link"): _LINK,
    ("gazebo", "reference"): (NameKind.LINK, NameKind.JOINT),
    ("disable_collisions", "link1"): _LINK,
    ("disable_collisions", "link2"): _LINK,
}
_JOINT_HOLDERS = ("transmission", "ros2_control")
_JOINT_TAG = re.compile(r"joint", re.IGNORECASE)
_LINK_TAG = re.compile(r"link|frame|body", re.IGNORECASE)


def name_kinds(tags: Sequence[str], attribute: str, plugin: str = "") -> tuple[NameKind, ...]:
    """Return what a text or an attribute names; nothing if it names no part of a robot.

    Args:
        tags: The tags of the elements around it, outermost first, and its own tag; xacro's are
            ignored.
        attribute: Its name; empty for a text.
        plugin: Class of the plugin around it, its last word.
    """
    tags = [tag for tag in tags if not tag.startswith(PREFIX)]
    if not tags:
        return ()
    if "plugin" in tags[:-1]:
        below = tags[len(tags) - list(reversed(tags)).index("plugin") :]
        return _of_plugin(below, attribute, plugin)
    holder = tags[-2] if len(tags) > 1 else ""
    if not attribute:
        return _TEXTS.get((holder, tags[-1]), ())
    if attribute == "name" and tags[-1] == "joint" and holder in _JOINT_HOLDERS:
        return _JOINT
    return _ATTRIBUTES.get((tags[-1], attribute), ())


def _of_plugin(below: Sequence[str], attribute: str, plugin: str) -> tuple[NameKind, ...]:
    """Return what a parameter names, as the table states, else as its own name does."""
    path = "/".join((*below, f"@{attribute}") if attribute else below)
    known = table("plugin_references")["plugins"].get(plugin, {})
    if path in known:
        return (NameKind(known[path]),)
    last = attribute if attribute and attribute != "name" else below[-1]
    if _JOINT_TAG.search(last):
        return _JOINT
    return _END if _LINK_TAG.search(last) else ()
