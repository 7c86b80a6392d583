"""Hover text of a robot, a nested model and a frame."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.words import count
from checker.editor.card import card, code, escaped_words
from checker.editor.figures import number, pose
from checker.model.components import Frame, Model
from checker.model.locomotion.drive import NO_DRIVE, drive_name
from checker.model.robot import Robot


def robot_card(robot: Robot, note: str = "") -> str:
    """Return what is known of a robot as a whole, as Markdown."""
    parts = [count(len(robot.links), "link"), count(len(robot.joints), "joint")]
    parts += [count(len(robot.sensors), "sensor"), count(len(robot.all_plugins), "plugin")]
    mass = (
        f"not known: {escaped_words(robot.unweighed)}"
        if robot.unweighed
        else f"{number(robot.mass)} kg"
    )
    drive = drive_name(robot.plugins)
    rows = [("mass", mass), ("holds", ", ".join(parts))]
    rows.append(("moves by", "" if drive == NO_DRIVE else drive))
    return card(f"**robot** {code(robot.name.value)}", rows, note)


def frame_card(robot: Robot, frame: Frame | Model, note: str = "") -> str:
    """Return what is known of a frame or a nested model, as Markdown."""
    rows = []
    if isinstance(frame, Frame):
        kind = "frame"
        rows.append(("attached to", code(frame.attached_to) if frame.attached_to else "the model"))
    else:
        kind = "model"
        uri = frame.included_from
        rows.append(("included from", code(uri.value) if uri is not None else ""))
        rows.append(("file", code(frame.definition.source.file) if uri is not None else ""))
        rows += _contents(robot, frame)
    place = robot.pose_of(frame.scoped_name)
    rows.append(("place", f"{pose(place)} in the model" if place is not None else "not known"))
    return card(f"**{kind}** {code(frame.name.value)}", rows, note)


def _contents(robot: Robot, model: Model) -> Iterator[tuple[str, str]]:
    """Yield what a nested model adds to the robot; a merged one has no names."""
    inside = {element.node for element in model.definition.children}
    links = [link for link in robot.links if link.element.node in inside]
    joints = [joint for joint in robot.joints if joint.element.node in inside]
    yield "holds", f"{count(len(links), 'link')}, {count(len(joints), 'joint')}"
    yield "mass", f"{number(sum(link.mass for link in links))} kg"
