"""Joints of URDF in SDF 1.6. Both let a joint stand where the child's frame stands."""

from __future__ import annotations

import math
from collections.abc import Sequence

from lxml import etree

from checker.convert.gazebo_tags import Setting
from checker.convert.notes import Notes
from checker.convert.writing import add, child_of, exact, exact_numbers
from checker.model.components import UNLIMITED, Axis, Joint
from checker.record import record

_TYPES = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "fixed": "fixed",
}


@record()
class Ends:
    """The links that a joint ties, by their names in the result."""

    parent: str
    child: str


def add_joint(
    model: etree._Element,
    joint: Joint,
    name: str,
    ends: Ends,
    settings: Sequence[Setting],
    notes: Notes,
) -> etree._Element | None:
    """Add a joint to a model; None for one of a type that leaves its child free in Gazebo."""
    kind = _TYPES.get(joint.type.value)
    if kind is None:
        said = (
            f"joint {joint.name.value!r} has the type {joint.type.value!r}, which SDF does not have"
        )
        notes.say(joint, f"{said}: left out, so link {ends.child!r} moves freely")
        return None
    element = add(model, "joint", name=name, type_=kind)
    add(element, "parent", ends.parent)
    add(element, "child", ends.child)
    if kind != "fixed":
        for axis in joint.axes:
            _add_axis(element, axis, endless=joint.type.value == "continuous")
    for setting in settings:
        if kind != "fixed" or setting.path[0] != "axis":
            child_of(element, *setting.path).text = setting.value
    for named in joint.mimics:
        said = f"joint {joint.name.value!r} mimics {named.value!r}, which SDF 1.6 cannot describe"
        notes.say(named, f"{said}: it moves independently")
    return element


def _add_axis(joint: etree._Element, axis: Axis, *, endless: bool) -> None:
    element = add(joint, "axis")
    add(element, "xyz", exact_numbers(axis.xyz))
    limit = add(element, "limit")
    lower, upper = axis.lower.value, axis.upper.value
    add(limit, "lower", _bound(-math.inf if endless else lower))
    add(limit, "upper", _bound(math.inf if endless else upper))
    for tag, most in (("effort", axis.effort), ("velocity", axis.velocity)):
        if most.stated and math.isfinite(most.value):
            add(limit, tag, exact(most.value))
    resisting = [("damping", axis.damping), ("friction", axis.friction)]
    if any(value.stated for _, value in resisting):
        dynamics = add(element, "dynamics")
        for tag, value in resisting:
            add(dynamics, tag, exact(value.value))


def _bound(value: float) -> str:
    """Return a limit; SDFormat's own ±1e16 for none."""
    return exact(math.copysign(UNLIMITED, value) if abs(value) >= UNLIMITED else value)
