"""The joints that MoveIt plans: those of the groups of an SRDF."""

from __future__ import annotations

from checker.model.components import Joint
from checker.model.robot import Robot
from checker.source.xml import Element

_MOVABLE = ("revolute", "continuous", "prismatic")


def planned_joints(root: Element, group: str, robot: Robot) -> dict[str, Joint]:
    """Return the joints of a group that move by themselves, by name, those that it names or chains.

    Args:
        root: The `<robot>` of the SRDF.
        group: The name of the group.
        robot: The robot that the SRDF describes.
    """
    by_child = {joint.child.value: joint for joint in robot.joints}
    passive = {it.get("name") for it in root.all("passive_joint")}
    found: list[Joint] = []
    for element in root.all("group"):
        if element.get("name") != group:
            continue
        named = (robot.joints_by_name.get(it.get("name") or "") for it in element.all("joint"))
        found += [joint for joint in named if joint is not None]
        for chain in element.all("chain"):
            found += _chain(by_child, chain.get("base_link"), chain.get("tip_link"))
    return {
        joint.name.value: joint
        for joint in found
        if joint.type.value in _MOVABLE and not joint.mimics and joint.name.value not in passive
    }


def _chain(by_child: dict[str, Joint], base: str | None, tip: str | None) -> list[Joint]:
    """Return the joints from a link up to another; none if that is not above it."""
    found: list[Joint] = []
    link = tip or ""
    while link != base:
        joint = by_child.get(link)
        if joint is None or joint in found:
            return []
        found.append(joint)
        link = joint.parent.value
    return found
