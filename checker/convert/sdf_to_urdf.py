"""SDF → URDF, for RViz: links, joints, inertials, visuals and collisions."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from lxml import etree

from checker.base.record import Record
from checker.convert.conversion import Conversion, Notes
from checker.convert.urdf_shapes import LinkWriter, add_material, add_origin
from checker.convert.xml_writer import add, exact, numbers, unique
from checker.model.components import UNLIMITED, Axis, Joint
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie
from checker.physics.mass.mechanism import Freedom, Motion, motions_of, spanning_tree_of

# Joints in URDF, where a joint turns about its child's origin and has one axis at most.


_NEAR = 1e-12
"""Metres between a joint and its child's origin that make no difference."""
_AXES: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_ENDLESS = (-math.inf, math.inf)


class Step(Record):
    """One joint of URDF.

    Attributes:
        kind: Its type.
        pose: The pose of its frame, and so of its child's, in the robot's frame.
        axis: The axis in that frame; None for a fixed joint.
        limits: What the source states about the axis, if anything.
    """

    kind: str
    pose: Transform
    axis: Vector | None = None
    limits: Axis | None = None


def steps_of(robot: Robot, tie: Tie, child: Transform) -> Sequence[Step]:
    """Return the joints of URDF that let a link move as a tie does; the last one carries the link.

    Where a joint turns its child about a point that is not the child's origin, a frame without
    mass is at that point, so that the child's own frame stays where it is.

    Args:
        robot: The tie's.
        tie: The tie of a link.
        child: The link's pose in the robot's frame.
    """
    motions = motions_of(robot, tie.joint)
    if not motions:
        return [Step("fixed", child)]
    at = robot.pose_of_joint(tie.joint)
    place = child if at is None else Transform(child.rotation, at.translation)
    if _passes(motions, place, child):
        place = child
    steps = [step for motion in motions for step in _steps(tie.joint, motion, place)]
    return steps if place is child else [*steps, Step("fixed", child)]


def _passes(motions: Sequence[Motion], place: Transform, child: Transform) -> bool:
    """Return whether the joints may as well stand at the child's origin."""
    arm = tuple(a - b for a, b in zip(child.translation, place.translation, strict=True))
    if len(motions) > 1 or motions[0].freedom is Freedom.BALL:
        return math.hypot(*arm) <= _NEAR
    along = sum(a * b for a, b in zip(arm, motions[0].axis, strict=True))
    beside = [a - along * b for a, b in zip(arm, motions[0].axis, strict=True)]
    return motions[0].freedom is Freedom.SLIDE or math.hypot(*beside) <= _NEAR


def _steps(joint: Joint, motion: Motion, place: Transform) -> Sequence[Step]:
    if motion.freedom is Freedom.BALL:
        return [Step("continuous", place, axis) for axis in _AXES]
    limits = joint.axes[motion.number]
    axis = Transform(place.inverse.rotation).rotate(motion.axis)
    if motion.freedom is Freedom.SLIDE:
        return [Step("prismatic", place, axis, limits)]
    endless = (limits.lower.value, limits.upper.value) == _ENDLESS
    endless = endless or joint.type.value == "continuous"
    return [Step("continuous" if endless else "revolute", place, axis, limits)]


class Named(Record):
    """A joint of URDF and the links that it ties, by name."""

    name: str
    parent: str
    child: str


def add_joint(robot: etree._Element, named: Named, step: Step, base: Transform) -> None:
    """Add a joint.

    Args:
        robot: The element of the result.
        named: What to call it.
        step: What it does.
        base: The parent's pose in the source robot's frame.
    """
    joint = add(robot, "joint", name=named.name, type_=step.kind)
    add_origin(joint, base.inverse @ step.pose)
    add(joint, "parent", link=named.parent)
    add(joint, "child", link=named.child)
    if step.axis is None:
        return
    add(joint, "axis", xyz=numbers(step.axis))
    if step.limits is not None:
        _add_limits(joint, step.kind, step.limits)


def _add_limits(joint: etree._Element, kind: str, axis: Axis) -> None:
    limits = {}
    if kind != "continuous":
        limits = {"lower": _finite(axis.lower.value), "upper": _finite(axis.upper.value)}
    most = (axis.effort.value, axis.velocity.value)
    if limits or any(map(math.isfinite, most)):
        # URDF wants both of every joint that states limits.
        limits |= {"effort": _finite(most[0]), "velocity": _finite(most[1])}
        add(joint, "limit", **limits)
    resistance = {"damping": axis.damping.value, "friction": axis.friction.value}
    if any(resistance.values()):
        add(joint, "dynamics", **{name: exact(value) for name, value in resistance.items()})


def _finite(value: float) -> str:
    return exact(math.copysign(UNLIMITED, value) if math.isinf(value) else value)


def urdf_of(robot: Robot, *, mesh_uri: Callable[[str], str], prefix: str = "") -> etree._Element:
    """Return the `<robot>` of `converted_to_urdf`."""
    return converted_to_urdf(robot, mesh_uri=mesh_uri, prefix=prefix).tree


def converted_to_urdf(
    robot: Robot, *, mesh_uri: Callable[[str], str], prefix: str = ""
) -> Conversion:
    """Write a robot as a URDF document.

    Each link keeps its frame, since TF places it there. Sensors have no frame: the
    simulation publishes those.

    Args:
        robot: The robot from SDF or URDF.
        mesh_uri: Gives the URI to write for a mesh or texture, as written in the robot's file.
        prefix: The prefix in front of the name of every link, with its slash: `${name}/`.
    """
    writer = _Writer(robot, mesh_uri, prefix)
    tree = writer.write()
    return Conversion(tree, writer.notes.all)


class _Writer:
    """The parts of one conversion."""

    def __init__(self, robot: Robot, mesh_uri: Callable[[str], str], prefix: str) -> None:
        self.robot = robot
        self.prefix = prefix
        self.notes = Notes()
        self.spanning_tree = spanning_tree_of(robot)
        self.links = LinkWriter(robot, mesh_uri, self.notes)
        self.root = etree.Element("robot", name=robot.name.value)
        self.link_names = dict.fromkeys(robot.tree.links, 0)
        self.joint_names: dict[str, int] = {}

    def write(self) -> etree._Element:
        """Write everything; return the element `<robot>`."""
        top = self._top()
        if top == WORLD:
            add(self.root, "link", name=WORLD)
        for name in self.spanning_tree.depth_first:
            if name == WORLD:
                continue
            self.links.write(
                self.robot.tree.links[name], add(self.root, "link", name=self._name(name))
            )
            if name != top:
                self._hang(name, top)
        for number, (look, name) in enumerate(self.links.looks.items()):
            add_material(self.root, name, look)
            # RViz and people look for what is used later at the top.
            self.root.insert(number, self.root[-1])
        self._say_what_is_cut()
        return self.root

    def _top(self) -> str:
        """Return the link that all others are connected to: `world` where one is tied to it."""
        if any(tie.parent == WORLD for tie in self.spanning_tree.by.values()):
            return WORLD
        return next(
            (name for name in self.spanning_tree.order if name not in self.spanning_tree.by), ""
        )

    def _hang(self, name: str, top: str) -> None:
        """Add the joints of a link to its parents."""
        tie, child = self.spanning_tree.by.get(name), self._pose(name)
        if tie is None:
            link = self.robot.tree.links[name]
            message = f"link {name!r} has no parent link: a floating joint connects it to {top!r}"
            self.notes.say(link, message)
        at = top if tie is None else tie.parent
        steps = [Step("floating", child)] if tie is None else self._steps(tie, child)
        base, parent = self._pose(at), self._name(at)
        stem = f"{name}_floating" if tie is None else tie.joint.scoped_name
        for number, step in enumerate(steps):
            last = number == len(steps) - 1
            joint = unique(stem, self.joint_names)
            below = name if last else unique(f"{stem}_frame", self.link_names)
            if not last:
                add(self.root, "link", name=self._name(below))
            add_joint(self.root, Named(joint, parent, self._name(below)), step, base)
            base, parent = step.pose, self._name(below)

    def _steps(self, tie: Tie, child: Transform) -> list[Step]:
        steps = list(steps_of(self.robot, tie, child))
        joint = tie.joint
        if steps[0].kind == "fixed" and joint.type.value != "fixed":
            message = (
                f"joint {joint.scoped_name!r} ({joint.type.value}) is written as a fixed joint"
            )
            self.notes.say(joint, f"{message}: its limits, its axis or URDF allow no motion")
        return steps

    def _pose(self, name: str) -> Transform:
        pose = Transform() if name == WORLD else self.robot.pose_of(name)
        if pose is None:
            self.notes.say(self.robot.tree.links[name], f"the pose of link {name!r} is not known")
        return pose or Transform()

    def _name(self, link: str) -> str:
        return link if link == WORLD else self.prefix + link

    def _say_what_is_cut(self) -> None:
        for tie in self.spanning_tree.left_out:
            message = (
                f"joint {tie.joint.scoped_name!r} closes a loop, which URDF cannot describe: left "
                "out"
            )
            self.notes.say(tie.joint, message)
        for broken in self.robot.tree.broken:
            message = f"joint {broken.joint.scoped_name!r} connects {broken.missing.value!r}"
            self.notes.say(broken.joint, f"{message}, which is not a link: left out")


# The URDF for RViz as a xacro file, whose argument `name` goes in front of every link.


XACRO = "http://www.ros.org/wiki/xacro"
_MARK = "\ue000"
"""Placeholder for the argument until all else is escaped; unused by robots, and legal in XML."""
_NAME = "${name}/"


def xacro_of(robot: Robot, *, name: str, mesh_uri: Callable[[str], str]) -> etree._Element:
    """Return the `<robot>` of a xacro file with `${name}/` in front of every link.

    Args:
        robot: The robot from SDF.
        name: The name of the package; the default of the argument `name`.
        mesh_uri: Gives the URI to write for a mesh or texture, as written in the robot's file.
    """
    urdf = urdf_of(robot, mesh_uri=mesh_uri, prefix=_MARK)
    root = etree.Element("robot", name=name, nsmap={"xacro": XACRO})
    etree.SubElement(root, f"{{{XACRO}}}arg", {"name": "name", "default": name})
    etree.SubElement(root, f"{{{XACRO}}}property", {"name": "name", "value": "$(arg name)"})
    for node in urdf.iter(etree.Element):
        for key, value in node.attrib.items():
            node.set(key, _escaped(str(value)).replace(_MARK, _NAME))
    root.extend(list(urdf))
    return root


def _escaped(value: str) -> str:
    """Return a value that xacro leaves as it is."""
    return value.replace("${", "$${").replace("$(", "$$(")
