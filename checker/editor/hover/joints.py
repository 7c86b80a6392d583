"""Hover text of a joint: its links, its axes with their limits, and the plugins that move it."""

from __future__ import annotations

from collections.abc import Iterator

from checker.editor.card import card, code, escaped_words
from checker.editor.figures import angle, limit, number, numbers, span_of
from checker.formats.urdf.description import joints_with_motor
from checker.model.components import Axis, Joint
from checker.model.frames import MODEL_FRAME
from checker.model.robot import Robot

_SLIDES = ("prismatic", "screw")
_LIMITLESS = ("continuous",)


def joint_card(robot: Robot, joint: Joint, note: str = "") -> str:
    """Return what is known of a joint of a robot, as Markdown."""
    rows = [("connects", f"{code(joint.parent.value)} → {code(joint.child.value)}")]
    for axis, title in zip(joint.axes, ("axis", "second axis"), strict=False):
        rows += _axis(joint, axis, title)
    rows.append(("copies", ", ".join(code(it.value) for it in joint.mimics)))
    rows.append(("moved by", _driver(robot, joint)))
    title = f"**{escaped_words(joint.type.value)} joint** {code(joint.scoped_name)}"
    return card(title, rows, note)


def _axis(joint: Joint, axis: Axis, title: str) -> Iterator[tuple[str, str]]:
    slides = joint.type.value in _SLIDES
    unit, force = ("m", "N") if slides else ("rad", "N·m")
    yield title, f"{numbers(it.value for it in axis.xyz)} in {_frame_of(axis)}"
    lower, upper = axis.lower.value, axis.upper.value
    if joint.type.value not in _LIMITLESS:
        yield "position", span_of(lower, upper, unit, turns=not slides)
    yield "velocity", _velocity(axis, slides=slides)
    yield "effort", limit(axis.effort.value, force)
    per = "N·s/m" if slides else "N·m·s/rad"
    if axis.damping.value or axis.friction.value:
        text = f"damping {number(axis.damping.value)} {per}"
        yield "dynamics", f"{text}, friction {number(axis.friction.value)} {force}"


def _velocity(axis: Axis, *, slides: bool) -> str:
    if slides or axis.velocity.value == float("inf"):
        return limit(axis.velocity.value, "m/s")
    return angle(axis.velocity.value).replace("rad", "rad/s").replace("°", "°/s")


def _frame_of(axis: Axis) -> str:
    if not axis.expressed_in:
        return "the joint's frame"
    if axis.expressed_in == MODEL_FRAME:
        return "the model's frame"
    return f"the frame of {code(axis.expressed_in)}"


def _driver(robot: Robot, joint: Joint) -> str:
    """Return what moves a joint: a plugin, a controller, or hardware of ros2_control."""
    name = joint.scoped_name
    found = []
    if (plugin := robot.driven_joints.get(name)) is not None:
        found.append(f"plugin {code(plugin.label)}")
    for controller in robot.controllers:
        texts = (text for it in controller.parameters.values() for text in it.texts)
        if any(text.value == joint.name.value for text in texts):
            found.append(f"controller {code(controller.name)} ({code(controller.class_name)})")
    if joint.name.value in joints_with_motor(robot):
        found.append("hardware, by a transmission or ros2_control")
    if not found and not joint.immovable and joint.type.value:
        return "nothing that is known"
    return ", ".join(found)
