"""Frames that parts and axes of a robot name and that do not exist.

Links, joints and frames are part of the frame graph, which finds those itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.formats.sdf.document import sdf_version
from checker.formats.sdf.poses import frame_of
from checker.model.components import Frame, Joint, Link, Part, Pose
from checker.model.faults import Fault, FaultKind
from checker.model.frames import MODEL_FRAME
from checker.model.robot import Robot
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

# Frames that worlds and outermost models refer to; those inside a model are the robot's.
#
# A name with `::` leads into a model; what an include brings is not looked into.


_WORLD = "world"
_IN_WORLD = frozenset({"frame", "model", "include", "actor", "light"})
_HOLDERS = frozenset({_WORLD, "model"})
_IN_MODEL = frozenset({"link", "joint", "frame", "model", "include"})


def world_frame_faults(document: XmlDocument) -> Iterator[Fault]:
    """Yield a fault for each reference to a frame that does not exist, and for circles."""
    root = document.root
    scopes = _Scopes()
    for world in root.all("world"):
        yield from _in_world(world, scopes)
        for model in world.all("model"):
            yield from _placement(model, scopes)
    for model in root.all("model"):
        yield from _placement(model, scopes)
        relative_to = _relative_to(model)
        if relative_to is not None:
            message = f"the pose of the outermost model is relative to {relative_to.value!r}"
            yield _fault(relative_to, f"{message}, but there is no frame around it")


class _Scopes:
    """Names in worlds and models; each is read once."""

    def __init__(self) -> None:
        self._named: dict[Element, dict[str, Element]] = {}

    def named(self, holder: Element) -> dict[str, Element]:
        """Return frames by name; empty represents an include whose name is not known."""
        if holder not in self._named:
            kinds = _IN_WORLD if holder.tag == _WORLD else _IN_MODEL
            children = (child for child in reversed(holder.children) if child.tag in kinds)
            self._named[holder] = {_name(child): child for child in children}
        return self._named[holder]

    def exists(self, holder: Element, path: str) -> bool:
        """Return whether a world or model contains a frame, or may get it from an include."""
        at: Element | None = holder
        for name in path.split("::"):
            if at is None or at.tag not in _HOLDERS:
                return False
            named = self.named(at)
            unknown = named.get("")
            if unknown is not None and unknown.tag == "include":
                return True
            own = name == MODEL_FRAME and at.tag == "model"
            at = at if own else named.get(name)
            if at is not None and at.tag == "include":
                return True
        return at is not None


def _in_world(world: Element, scopes: _Scopes) -> Iterator[Fault]:
    attached: dict[str, str] = {}
    posed: dict[str, str] = {}
    for child in world.children:
        if child.tag not in _IN_WORLD:
            continue
        name = _name(child)
        at = _stated(child.attribute("attached_to")) if child.tag == "frame" else None
        relative_to = _relative_to(child)
        for target, what in ((at, "attached"), (relative_to, "posed relative")):
            if (
                target is not None
                and target.value != _WORLD
                and not scopes.exists(world, target.value)
            ):
                message = (
                    f"{child.tag} {name!r} is {what} to {target.value!r}, which does not exist"
                )
                yield _fault(target, message)
        if at is not None:
            attached[name] = at.value
        if frame := relative_to or at:
            posed[name] = frame.value
    named = scopes.named(world)
    circles = (*_circles(attached), *_circles(posed))
    for name in dict.fromkeys(circle[0] for circle in circles):
        yield _fault(named[name], f"{named[name].tag} {name!r} is placed relative to itself")


def _placement(model: Element, scopes: _Scopes) -> Iterator[Fault]:
    frame = _stated(model.attribute("placement_frame"))
    if frame is not None and not scopes.exists(model, frame.value):
        yield _fault(frame, f"placement frame {frame.value!r} does not exist in the model")


def _circles(edges: Mapping[str, str]) -> Iterator[list[str]]:
    """Yield the names of each circle."""
    done: set[str] = set()
    for start in edges:
        path: dict[str, None] = {}
        at = start
        while at in edges and at not in done and at not in path:
            path[at] = None
            at = edges[at]
        if at in path:
            names = list(path)
            yield names[names.index(at) :]
        done.update(path)


def _name(element: Element) -> str:
    if element.tag == "include":
        name = element.child("name")
        return name.text.value if name is not None else ""
    return element.get("name") or ""


def _relative_to(element: Element) -> Located[str] | None:
    pose = element.child("pose")
    return frame_of(pose, sdf_version(element.document)) if pose is not None else None


def _stated(attribute: Located[str] | None) -> Located[str] | None:
    return attribute if attribute is not None and attribute.value.strip() else None


def _fault(where: Located[str] | Element, message: str) -> Fault:
    return Fault(FaultKind.FRAME, where.span, message)


def unknown_frames(robot: Robot) -> Iterator[Fault]:
    """Yield a fault for each part or axis whose frame does not exist."""
    known = robot.frame_graph.nodes
    for link in robot.links:
        for label, pose in _poses(link):
            if pose.relative_to and pose.relative_to not in known:
                message = f"{label} is posed relative to {pose.relative_to!r}"
                yield Fault(FaultKind.FRAME, pose.span, f"{message}, which does not exist")
    for joint in robot.joints:
        for axis in joint.axes:
            if axis.expressed_in and axis.expressed_in not in known:
                message = f"the axis of joint {joint.name.value!r} is expressed in"
                yield Fault(
                    FaultKind.FRAME,
                    axis.span,
                    f"{message} {axis.expressed_in!r}, which does not exist",
                )
    yield from _attachments(robot)


def _attachments(robot: Robot) -> Iterator[Fault]:
    """Yield a fault for each frame attached to nothing or, over others, to itself.

    A frame that states no other frame for its pose is posed in the one it is attached to: then
    the graph has found it.
    """
    attached = {
        frame.scoped_name: frame.scoped_name.removesuffix(frame.name.value) + frame.attached_to
        for frame in reversed(robot.frames)
        if frame.attached_to not in ("", MODEL_FRAME)
    }
    frames = {frame.scoped_name: frame for frame in reversed(robot.frames)}
    known = robot.frame_graph.nodes
    for name, other in attached.items():
        if frames[name].pose.relative_to and other not in known:
            message = f"frame {name!r} is attached to {other!r}, which does not exist"
            yield Fault(FaultKind.FRAME, frames[name].span, message)
    # A joint is attached to its child.
    tied = {joint.scoped_name: joint.scope + joint.child.value for joint in reversed(robot.joints)}
    parts: dict[str, Joint | Frame] = {joint.scoped_name: joint for joint in robot.joints}
    parts |= frames
    edges = {**tied, **attached}
    for circle in _circles(edges):
        if any(parts[name].pose.relative_to for name in circle):
            first = next((name for name in circle if name in frames), circle[0])
            what = f"{parts[first].element.tag} {first!r}"
            message = f"{what} is attached to itself through {edges[first]!r}"
            yield Fault(FaultKind.FRAME, parts[first].span, message)


def _poses(link: Link) -> Iterator[tuple[str, Pose]]:
    parts: tuple[tuple[Part, Pose], ...] = (
        *((part, part.pose) for part in link.collisions),
        *((part, part.pose) for part in link.visuals),
        *((part, part.pose) for part in link.sensors),
        *((part, part.pose) for part in link.lights),
    )
    for part, pose in parts:
        yield f"{part.element.tag} {part.name.value!r}", pose
