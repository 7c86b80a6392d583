"""Table of the elements and attributes of SDF, URDF and SRDF that name a part of the robot."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from checker.base.resources import table
from checker.editor.names.mention import FRAMES, JOINT_ONLY, LINK_ONLY, PARTS, NameKind
from checker.editor.xacro_names import PREFIX

TEXTS: Mapping[tuple[str, str], tuple[NameKind, ...]] = {
    ("joint", "parent"): PARTS,
    ("joint", "child"): PARTS,
    ("joint", "gearbox_reference_body"): LINK_ONLY,
    ("gripper", "gripper_link"): LINK_ONLY,
    ("gripper", "palm_link"): LINK_ONLY,
    ("include", "placement_frame"): PARTS,
}
"""Texts that name a part, by the tags of the parent and of the element."""
ATTRIBUTES: Mapping[tuple[str, str], tuple[NameKind, ...]] = {
    # SDF
    ("pose", "relative_to"): PARTS,
    ("pose", "frame"): PARTS,
    ("frame", "attached_to"): PARTS,
    ("xyz", "expressed_in"): PARTS,
    ("model", "canonical_link"): LINK_ONLY,
    ("model", "placement_frame"): PARTS,
    # URDF
    ("mimic", "joint"): JOINT_ONLY,
    ("parent", "link"): LINK_ONLY,
    ("child", "link"): LINK_ONLY,
    ("gazebo", "reference"): (NameKind.LINK, NameKind.JOINT),
    # SRDF
    ("virtual_joint", "child_link"): LINK_ONLY,
    ("virtual_joint", "parent_frame"): FRAMES,
    ("passive_joint", "name"): JOINT_ONLY,
    ("chain", "base_link"): LINK_ONLY,
    ("chain", "tip_link"): LINK_ONLY,
    ("end_effector", "parent_link"): LINK_ONLY,
    ("disable_collisions", "link1"): LINK_ONLY,
    ("disable_collisions", "link2"): LINK_ONLY,
    ("enable_collisions", "link1"): LINK_ONLY,
    ("enable_collisions", "link2"): LINK_ONLY,
    ("disable_default_collisions", "link"): LINK_ONLY,
    ("link_sphere_approximation", "link"): LINK_ONLY,
}
"""Attributes that name a part, by tag."""
BY_TAG = {"link": LINK_ONLY, "joint": JOINT_ONLY}
ELSEWHERE = frozenset({"transmission", "ros2_control", "group", "group_state", "actuator"})
"""Elements in which `<joint name="…">` or `<link name="…">` names one that is defined elsewhere."""
_JOINT_TAG = re.compile(r"joint", re.IGNORECASE)
_LINK_TAG = re.compile(r"link|frame|body", re.IGNORECASE)


def is_srdf(path: str) -> bool:
    """Return whether a file is an SRDF, which names the parts of a robot of another file."""
    return path.lower().endswith((".srdf", ".srdf.xacro"))


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
    if not attribute:
        return TEXTS.get((tags[-2] if len(tags) > 1 else "", tags[-1]), ())
    if attribute == "name" and ELSEWHERE.intersection(tags[:-1]):
        return BY_TAG.get(tags[-1], ())
    return ATTRIBUTES.get((tags[-1], attribute), ())


def _of_plugin(below: Sequence[str], attribute: str, plugin: str) -> tuple[NameKind, ...]:
    """Return what a parameter names, as the table states, else as its own name does."""
    path = "/".join((*below, f"@{attribute}") if attribute else below)
    known = table("plugin_references")["plugins"].get(plugin, {})
    if path in known:
        return (NameKind(known[path]),)
    last = attribute if attribute and attribute != "name" else below[-1]
    if _JOINT_TAG.search(last):
        return JOINT_ONLY
    return FRAMES if _LINK_TAG.search(last) else ()
