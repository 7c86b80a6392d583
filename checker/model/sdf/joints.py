"""Joints and frames of SDF."""

from __future__ import annotations

import math

from checker.model.components import UNLIMITED, Axis, Frame, Joint
from checker.model.frames import MODEL_FRAME, FrameNode
from checker.model.sdf.links import read_sensor
from checker.model.sdf.scope import Scope
from checker.source.text import Located
from checker.source.xml import Element


def read_joint(element: Element, scope: Scope) -> Joint:
    """Read a `<joint>` and enter its frame into the graph: posed in its child by default."""
    name = scope.values.name(element)
    scoped_name = scope.scoped(name.value)
    child = _end(element, "child", scope)
    pose = scope.pose(element)
    scope.graph.add(
        scoped_name,
        FrameNode(
            pose.relative_to or scope.scoped(child.value),
            pose.transform,
            pose.span,
            f"joint '{name.value}'",
        ),
    )
    return Joint(
        name,
        element,
        scoped_name,
        scope.prefix,
        element.attribute("type") or Located("", element.span, stated=False),
        _end(element, "parent", scope),
        child,
        pose,
        tuple(_read_axis(axis, scope) for axis in element.children if axis.tag in _AXES),
        tuple(read_sensor(sensor, scoped_name, scope) for sensor in element.all("sensor")),
    )


_AXES = ("axis", "axis2")


def _end(joint: Element, tag: str, scope: Scope) -> Located[str]:
    """Read `<parent>` or `<child>`; SDF before 1.3 had the name in an attribute `link`."""
    child = joint.child(tag)
    if child is not None and not child.text.stated and (link := child.attribute("link")):
        return link
    return scope.values.text(joint, tag)


def _read_axis(element: Element, scope: Scope) -> Axis:
    values = scope.values
    limit = element.child("limit") or element
    dynamics = element.child("dynamics") or element
    return Axis(
        values.numbers(element, "xyz", (0.0, 0.0, 1.0)),
        _expressed_in(element, scope),
        _bound(values.number(limit, "lower", -math.inf)),
        _bound(values.number(limit, "upper", math.inf)),
        _maximum(values.number(limit, "effort", -1.0)),
        _maximum(values.number(limit, "velocity", -1.0)),
        values.number(dynamics, "damping", 0.0),
        values.number(dynamics, "friction", 0.0),
        values.number(dynamics, "spring_stiffness", 0.0),
        values.number(element, "initial_position", 0.0),
        element.span,
    )


def _expressed_in(axis: Element, scope: Scope) -> str:
    """Return the frame of the axis: empty for the joint's own.

    SDF 1.4 always means the model's frame, 1.5 and 1.6 say so by `use_parent_model_frame`,
    1.7 and later by `expressed_in`.
    """
    if scope.version >= (1, 7):
        xyz = axis.child("xyz")
        written = xyz.get("expressed_in") if xyz is not None else None
        return scope.scoped(written) if written else ""
    in_model_frame = scope.values.boolean(
        axis, "use_parent_model_frame", scope.version <= (1, 4)
    ).value
    return scope.scoped(MODEL_FRAME) if in_model_frame else ""


def _bound(limit: Located[float]) -> Located[float]:
    if abs(limit.value) < UNLIMITED:
        return limit
    return Located(math.copysign(math.inf, limit.value), limit.span, limit.stated)


def _maximum(limit: Located[float]) -> Located[float]:
    """Effort and velocity: −1 (any negative number) and huge ones mean without limit."""
    if 0.0 <= limit.value < UNLIMITED:
        return limit
    return Located(math.inf, limit.span, limit.stated)


def read_frame(element: Element, scope: Scope) -> Frame:
    """Read a `<frame>`: posed in the frame it is attached to by default."""
    name = scope.values.name(element)
    attached = element.get("attached_to") or ""
    pose = scope.pose(element)
    scope.graph.add(
        scope.scoped(name.value),
        FrameNode(
            pose.relative_to or scope.scoped(attached),
            pose.transform,
            pose.span,
            f"frame '{name.value}'",
        ),
    )
    return Frame(name, element, scope.scoped(name.value), attached, pose)
