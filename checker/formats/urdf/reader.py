"""A URDF file as a robot. Its joints carry the poses: a child link's frame is its joint's."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from msgspec.structs import replace

from checker.formats.sdf.links import read_plugin, read_sensor
from checker.formats.sdf.scope import Scope
from checker.formats.urdf.conventions import CONVENTIONS
from checker.formats.urdf.specification import has_version
from checker.formats.xacro.expanded import ExpandedText
from checker.model.components import (
    Axis,
    Collision,
    Inertial,
    Joint,
    Link,
    Plugin,
    Pose,
    Sensor,
    Visual,
)
from checker.model.frames import MODEL_FRAME, FrameGraph, FrameNode
from checker.model.geometry.shapes import Geometry, Material
from checker.model.geometry.transform import Transform, Vector, rotation_from_quaternion
from checker.model.robot import Robot
from checker.model.values import ValueReader, parse_number
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

# Links of URDF: the same parts as in SDF, written as attributes.


_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_ZERO = (0.0, 0.0, 0.0)
_NO_TURN = (0.0, 0.0, 0.0, 1.0)
_ONES = (1.0, 1.0, 1.0)
_SIZES: Mapping[str, Mapping[str, tuple[float, ...]]] = {
    "box": {"size": _ONES},
    "cylinder": {"radius": (1.0,), "length": (1.0,)},
    "sphere": {"radius": (1.0,)},
    "capsule": {"radius": (1.0,), "length": (1.0,)},
    "mesh": {"scale": _ONES},
}


def read_link(element: Element, values: ValueReader) -> Link:
    """Read a `<link>`."""
    name = values.name(element)
    return Link(
        name,
        element,
        name.value,
        Pose(Transform(), "", (), element.span),
        _read_inertial(element, values),
        tuple(
            _read_collision(child, shape, values)
            for child, shape in _named_shapes(element, "collision", name.value)
        ),
        tuple(
            _read_visual(child, shape, values)
            for child, shape in _named_shapes(element, "visual", name.value)
        ),
        (),
        (),
        Located(True, element.span, stated=False),
        Located(False, element.span, stated=False),
        default_mass=0.0,
    )


def read_origin(parent: Element, values: ValueReader) -> Pose:
    """Read the `<origin xyz rpy>` below an element; zeros when it has none."""
    origin = parent.child("origin")
    if origin is None:
        numbers = tuple(Located(0.0, parent.span, stated=False) for _ in range(6))
        return Pose(Transform(), "", numbers, parent.span)
    xyz = values.finite(values.attribute_numbers(origin, "xyz", _ZERO))
    if origin.attribute("quat_xyzw") is not None and has_version(origin.document, "1.1"):
        turn = values.finite(values.attribute_numbers(origin, "quat_xyzw", _NO_TURN))
        x, y, z, w = (number.value for number in turn)
        if x or y or z or w:
            transform = Transform(rotation_from_quaternion(w, x, y, z), _vector(xyz))
            return Pose(transform, "", (*xyz, *turn), origin.span, in_radians=False)
    rpy = values.finite(values.attribute_numbers(origin, "rpy", _ZERO))
    transform = Transform.from_xyz_rpy(_vector(xyz), _vector(rpy))
    return Pose(transform, "", (*xyz, *rpy), origin.span)


def _vector(numbers: tuple[Located[float], ...]) -> Vector:
    return (numbers[0].value, numbers[1].value, numbers[2].value)


def _read_inertial(link: Element, values: ValueReader) -> Inertial | None:
    element = link.child("inertial")
    if element is None:
        return None
    mass = element.child("mass") or element
    inertia = element.child("inertia") or element
    return Inertial(
        read_origin(element, values),
        values.attribute_numbers(mass, "value", (0.0,))[0],
        tuple(values.attribute_numbers(inertia, name, (0.0,))[0] for name in _MOMENTS),
        element.span,
    )


def _named_shapes(link: Element, tag: str, owner: str) -> Iterator[tuple[Element, Located[str]]]:
    """Yield shapes with their names; those without one are called as libsdformat calls them."""
    for number, element in enumerate(link.all(tag)):
        default = f"{owner}_{tag}_{number}" if number else f"{owner}_{tag}"
        yield element, element.attribute("name") or Located(default, element.span, stated=False)


def _read_collision(element: Element, name: Located[str], values: ValueReader) -> Collision:
    return Collision(name, element, read_origin(element, values), _geometry(element, values))


def _read_visual(element: Element, name: Located[str], values: ValueReader) -> Visual:
    return Visual(
        name,
        element,
        read_origin(element, values),
        _geometry(element, values),
        _material(element, values),
    )


def _geometry(parent: Element, values: ValueReader) -> Geometry:
    geometry = parent.child("geometry") or parent
    shape = next((child for child in geometry.children if child.tag in _SIZES), None)
    if shape is None or geometry is parent:
        return Geometry("", {}, None, geometry)
    sizes = {
        name: values.attribute_numbers(shape, name, default)
        for name, default in _SIZES[shape.tag].items()
    }
    return Geometry(shape.tag, sizes, shape.attribute("filename"), shape)


def _material(parent: Element, values: ValueReader) -> Material | None:
    element = parent.child("material")
    if element is None:
        return None
    colour, texture = element.child("color"), element.child("texture")
    colours = {}
    if colour is not None:
        colours["diffuse"] = values.attribute_numbers(colour, "rgba", (0.0, 0.0, 0.0, 1.0))
    file = texture.attribute("filename") if texture is not None else None
    return Material(element, colours, (file,) if file is not None else (), ())


def read_urdf(document: XmlDocument) -> Robot:
    """Read a URDF file; SDF inside its `<gazebo>` tags is read as SDF."""
    root = document.root
    values, graph = ValueReader(), FrameGraph()
    graph.add(MODEL_FRAME, FrameNode(None, Transform(), root.span, "the model"))
    starts, tags = _starts(root), _tags_by_reference(root)
    joints = tuple(_read_joint(element, values, starts, tags) for element in root.all("joint"))
    sensors, gravity = _sensors(root, values, graph), _gravity(root, values)
    links = tuple(
        _extended(read_link(element, values), sensors, gravity) for element in root.all("link")
    )
    _place(graph, links, joints)
    for name in graph.nodes:
        graph.pose(name)
    return Robot(
        values.name(root),
        root,
        document,
        "urdf",
        CONVENTIONS,
        root.get("version") or "1.0",
        Pose(Transform(), "", (), root.span),
        links,
        joints,
        (),
        (),
        tuple(_plugins(root)),
        graph,
        (*values.faults, *graph.faults),
        unresolved_includes=tuple(_skipped(document)),
        merges_unknown=True,
    )


def _skipped(document: XmlDocument) -> Iterator[Located[str]]:
    """Yield the calls of macros that only packages that are not available may define."""
    source = document.source
    if isinstance(source, ExpandedText):
        for name in source.skipped:
            yield Located(name, source.written.whole())


def _starts(root: Element) -> dict[str, Located[float]]:
    """Return where joints start by their names, as hardware of ros2_control sets them."""
    starts: dict[str, Located[float]] = {}
    for joint in (joint for control in root.all("ros2_control") for joint in control.all("joint")):
        for state in joint.all("state_interface"):
            for param in state.all("param") if state.get("name") == "position" else ():
                value = parse_number(param.text.value)
                if param.get("name") != "initial_value" or value is None:
                    continue
                if math.isfinite(value):
                    starts.setdefault(joint.get("name") or "", Located(value, param.text.span))
    return starts


def _tags_by_reference(root: Element) -> Mapping[str, list[Element]]:
    """Return the `<gazebo>` tags by the name of the link or joint that they refer to."""
    tags: dict[str, list[Element]] = {}
    for tag in root.all("gazebo"):
        tags.setdefault(tag.get("reference") or "", []).append(tag)
    return tags


def _read_joint(
    element: Element,
    values: ValueReader,
    starts: Mapping[str, Located[float]],
    tags: Mapping[str, Sequence[Element]],
) -> Joint:
    name = values.name(element)
    return Joint(
        name,
        element,
        name.value,
        "",
        element.attribute("type") or Located("", element.span, stated=False),
        _end(element, "parent"),
        _end(element, "child"),
        read_origin(element, values),
        tuple(_read_axis(element, values, starts.get(name.value), tags.get(name.value, ()))),
    )


def _end(joint: Element, tag: str) -> Located[str]:
    end = joint.child(tag)
    if end is None:
        return Located("", joint.span, stated=False)
    return end.attribute("link") or Located("", end.span, stated=False)


def _read_axis(
    joint: Element, values: ValueReader, start: Located[float] | None, tags: Sequence[Element]
) -> Iterator[Axis]:
    """Yield the axis of a joint that moves; URDF's default is x."""
    if joint.get("type") in ("fixed", "floating"):
        return
    axis = joint.child("axis") or joint
    limit = joint.child("limit") or joint
    dynamics = joint.child("dynamics") or joint
    endless = joint.get("type") == "continuous"
    unlimited = endless or limit is joint or has_version(joint.document, "1.2")

    def number(element: Element, name: str, default: float) -> Located[float]:
        return values.attribute_numbers(element, name, (default,))[0]

    def bound(name: str, infinite: float) -> Located[float]:
        stated = number(limit, name, infinite if unlimited else 0.0)
        # Readers of URDF ignore the limits of a continuous joint.
        return Located(infinite, stated.span, stated=False) if endless else stated

    # libsdformat: the last <gazebo> of the joint that has the tag counts.
    def spring(name: str) -> Located[float]:
        stated = [tag for tag in tags if tag.child(name) is not None]
        return values.number(stated[-1] if stated else axis, name, 0.0)

    yield Axis(
        # urdfdom: x without an <axis>, no direction with one that states none.
        values.attribute_numbers(axis, "xyz", (1.0, 0.0, 0.0) if axis is joint else _ZERO),
        "",
        bound("lower", -math.inf),
        bound("upper", math.inf),
        number(limit, "effort", math.inf),
        number(limit, "velocity", math.inf),
        number(dynamics, "damping", 0.0),
        number(dynamics, "friction", 0.0),
        spring("springStiffness"),
        spring("springReference"),
        start or Located(0.0, axis.span, stated=False),
        axis.span,
    )


def _place(graph: FrameGraph, links: tuple[Link, ...], joints: tuple[Joint, ...]) -> None:
    """Enter the links into the graph; names of joints may repeat names of links."""
    above = {joint.child.value: joint for joint in reversed(joints)}
    for link in links:
        name = link.name.value
        joint = above.get(name)
        if joint is None:
            graph.add(name, FrameNode(MODEL_FRAME, Transform(), link.span, f"link {name!r}"))
        else:
            pose = joint.pose
            label = f"joint {joint.name.value!r}"
            graph.add(name, FrameNode(joint.parent.value, pose.transform, pose.span, label))
    for joint in joints:
        node = FrameNode(joint.child.value, Transform(), joint.span, f"joint {joint.name.value!r}")
        graph.add(joint.scoped_name, node)


def _sensors(root: Element, values: ValueReader, graph: FrameGraph) -> dict[str, list[Sensor]]:
    """Return the sensors of `<gazebo reference=…>` tags, by link."""
    scope = Scope("", MODEL_FRAME, (1, 6), values, graph)
    sensors: dict[str, list[Sensor]] = {}
    for tag in root.all("gazebo"):
        link = tag.get("reference") or ""
        for sensor in tag.all("sensor"):
            sensors.setdefault(link, []).append(read_sensor(sensor, link, scope))
    return sensors


def _gravity(root: Element, values: ValueReader) -> dict[str, Located[bool]]:
    """Return whether gravity acts, for links of which a `<gazebo reference=…>` tag states it."""
    gravity = {}
    for tag in root.all("gazebo"):
        off = values.boolean(tag, "turnGravityOff", False)
        on = values.boolean(tag, "gravity", True)
        if off.stated or on.stated:
            stated = off if off.stated else on
            acts = on.value and not off.value
            gravity[tag.get("reference") or ""] = Located(acts, stated.span)
    return gravity


def _extended(
    link: Link, sensors: dict[str, list[Sensor]], gravity: dict[str, Located[bool]]
) -> Link:
    """Add to a link what `<gazebo>` tags state about it."""
    name = link.name.value
    return replace(
        link, sensors=tuple(sensors.get(name, ())), gravity=gravity.get(name, link.gravity)
    )


def _plugins(root: Element) -> Iterator[Plugin]:
    for tag in root.all("gazebo"):
        for plugin in tag.all("plugin"):
            yield read_plugin(plugin)
