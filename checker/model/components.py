"""The parts of a robot: links, joints, sensors, …, in SI units, each with its place."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property

from checker.base.record import Record
from checker.model.geometry.shapes import Geometry, Material
from checker.model.geometry.transform import Transform
from checker.model.lights import Attenuation, Beam, read_attenuation, read_beam
from checker.model.plugin_library import library_stem
from checker.model.sensing.camera import Camera, read_camera
from checker.model.sensing.imu import Imu, read_imu
from checker.model.sensing.kind import SensorType, sensor_type
from checker.model.sensing.lidar import Lidar, read_lidar
from checker.model.values import ValueReader, parse_number
from checker.source.text import Located, Span
from checker.source.xml import Element, Tagged

UNLIMITED = 1e16
"""SDFormat's own bound: limits at or beyond ±1e16 mean that there is none."""


_WITH_ALPHA = 4
"""Numbers of a colour that states how opaque it is."""


class Part(Tagged, Record, eq=False):
    """Anything of a robot that has a name and an element.

    Attributes:
        name: The name as written.
        element: The element that describes it, for what the model does not contain.
    """

    name: Located[str]
    element: Element


class Pose(Record, eq=False):
    """A pose as written.

    Attributes:
        transform: The numbers, as a transform into the frame `relative_to`.
        relative_to: Name of that frame; empty for the default of its place.
        numbers: The numbers as written, each with its place: x, y, z (metres), then roll, pitch,
            yaw (radians, or degrees), or a quaternion x, y, z, w.
        span: The pose element, or the element that could have stated one.
        in_radians: Whether the numbers end with three angles in radians.
    """

    transform: Transform
    relative_to: str
    numbers: tuple[Located[float], ...]
    span: Span
    in_radians: bool = True


class Inertial(Record, eq=False):
    """Mass and inertia of a link.

    Attributes:
        pose: Centre of mass and axes, in the link's frame.
        mass: Kilograms.
        moments: ixx, ixy, ixz, iyy, iyz, izz about the centre of mass, kg·m².
        span: The inertial element.
    """

    pose: Pose
    mass: Located[float]
    moments: tuple[Located[float], ...]
    span: Span


class Collision(Part):
    """A shape that touches things, posed in its link's frame."""

    pose: Pose
    geometry: Geometry


class Visual(Part, dict=True):
    """A shape that is seen, posed in its link's frame."""

    pose: Pose
    geometry: Geometry
    material: Material | None

    @cached_property
    def is_see_through(self) -> bool:
        """True if objects behind it can be seen, by its transparency or its colour."""
        diffuse = self.material.colours.get("diffuse", ()) if self.material is not None else ()
        clear = len(diffuse) == _WITH_ALPHA and diffuse[-1].value < 1.0
        return clear or ValueReader().number(self.element, "transparency", 0.0).value > 0.0


class Plugin(Part):
    """A plugin and its parameters (below `element`).

    Attributes:
        filename: The library.
        owner: Name of the link or sensor that contains it; empty for the model.
        nested_in: Scoped name of the nested model it is in, else empty.
    """

    filename: Located[str]
    owner: str = ""
    nested_in: str = ""

    @property
    def class_name(self) -> str:
        """Last word of the class: `DiffDrive` of `ignition::gazebo::systems::DiffDrive`."""
        return self.name.value.rsplit("::", 1)[-1]

    @property
    def label(self) -> str:
        """Name in messages: its class, or its library if the name is free to choose."""
        library = "" if "::" in self.name.value else library_stem(self.filename.value)
        return library or self.class_name

    def scoped(self, name: str) -> str:
        """Return the scoped name of what the plugin calls by this name."""
        return f"{self.nested_in}::{name}" if self.nested_in else name

    def values(self, *tags: str) -> list[Located[str]]:
        """Return the texts of all elements of these names, at any depth."""
        return [e.text for e in self.element.descendants() if e.tag in tags and e.text.stated]

    def at(self, path: str) -> Iterator[Located[str]]:
        """Yield what is at a path below: `a/b` in nested elements, `a/@x` in an attribute."""
        around, _, last = path.rpartition("/")
        holders = self.element.at(around) if around else [self.element]
        for holder in holders:
            if last.startswith("@"):
                attribute = holder.attribute(last[1:])
                yield from (attribute,) if attribute is not None else ()
            else:
                yield from (child.text for child in holder.all(last) if child.text.stated)

    def number(self, path: str) -> Located[float] | None:
        """Return the first number at a path; None if there is none that reads as one."""
        for text in self.at(path):
            value = parse_number(text.value)
            return Located(value, text.span) if value is not None else None
        return None


class Sensor(Part, dict=True):
    """A sensor.

    Attributes:
        type: The type as written (`gpu_lidar`).
        link: Name of the link (or joint) that carries it.
        pose: The pose in that link's frame, unless it states otherwise.
        topic: Empty for the default.
    """

    type: Located[str]
    link: str
    pose: Pose
    topic: Located[str]
    plugins: tuple[Plugin, ...] = ()

    @cached_property
    def kind(self) -> SensorType:
        """Kind of sensor, independent of the spelling of its type."""
        return sensor_type(self.type.value)

    @cached_property
    def camera(self) -> Camera | None:
        """Settings of its `<camera>`; None if it has none."""
        return read_camera(self.element)

    @cached_property
    def lidar(self) -> Lidar | None:
        """Settings of its `<lidar>` or `<ray>`; None if it has none."""
        return read_lidar(self.element)

    @cached_property
    def imu(self) -> Imu | None:
        """Settings of its `<imu>`; None if it has none."""
        return read_imu(self.element)

    @cached_property
    def update_rate(self) -> Located[float]:
        """Measurements a second; 0, SDFormat's default, is as often as the simulation steps."""
        return ValueReader().number(self.element, "update_rate", 0.0)


class Light(Part, dict=True):
    """A light and the link that carries it."""

    type: str
    link: str
    pose: Pose

    @cached_property
    def attenuation(self) -> Attenuation | None:
        """Attenuation of the light with distance; None if it is not stated."""
        return read_attenuation(self.element)

    @cached_property
    def beam(self) -> Beam | None:
        """The cone that it shines in; None for one that shines all around."""
        return read_beam(self.element)

    @cached_property
    def casts_shadows(self) -> bool:
        """True if objects in its way darken what is behind them."""
        return ValueReader().boolean(self.element, "cast_shadows", False).value


class Link(Part):
    """A rigid body.

    Attributes:
        scoped_name: The scoped name with the names of nested models in front: `arm::wrist`.
        inertial: None if the file states none.
        gravity: Whether gravity acts on it.
        kinematic: Whether it only follows its joints, and no force moves it.
        default_mass: Kilograms of a link without inertial: 1 in SDF, 0 in URDF.
    """

    scoped_name: str
    pose: Pose
    inertial: Inertial | None
    collisions: tuple[Collision, ...]
    visuals: tuple[Visual, ...]
    sensors: tuple[Sensor, ...]
    lights: tuple[Light, ...]
    gravity: Located[bool]
    kinematic: Located[bool]
    default_mass: float = 1.0

    @property
    def mass(self) -> float:
        """Kilograms; what simulators assume where the file states none."""
        return self.inertial.mass.value if self.inertial is not None else self.default_mass


class Axis(Record, eq=False):
    """One axis of a joint.

    Attributes:
        xyz: Direction, expressed in `expressed_in`.
        expressed_in: Name of a frame; empty for the joint's own, `__model__` for the model's.
        lower: Metres or radians; −inf without limit.
        upper: Metres or radians; inf without limit.
        effort: Newtons or newton metres; inf without limit.
        velocity: Metres or radians a second; inf without limit.
        damping: N·s/m or N·m·s/rad.
        friction: N or N·m.
        stiffness: The stiffness of a spring in the joint, N/m or N·m/rad.
        spring_reference: The position in which that spring exerts no force, metres or radians.
        initial_position: Metres or radians; 0 if the file states none.
    """

    xyz: tuple[Located[float], ...]
    expressed_in: str
    lower: Located[float]
    upper: Located[float]
    effort: Located[float]
    velocity: Located[float]
    damping: Located[float]
    friction: Located[float]
    stiffness: Located[float]
    spring_reference: Located[float]
    initial_position: Located[float]
    span: Span


class Joint(Part):
    """A joint.

    Attributes:
        parent: Name of a link or frame, as written; `world` for the world.
        child: Name of a link or frame, as written.
        scope: Scoped name of the model that contains it, with `::` behind; empty for the robot.
    """

    scoped_name: str
    scope: str
    type: Located[str]
    parent: Located[str]
    child: Located[str]
    pose: Pose
    axes: tuple[Axis, ...]
    sensors: tuple[Sensor, ...] = ()

    @property
    def immovable(self) -> str:
        """Reason why it cannot move, as a clause; empty for a joint that can."""
        if self.type.value == "fixed":
            return "it is fixed"
        if self.type.value not in ("revolute", "prismatic") or len(self.axes) != 1:
            return ""
        lower, upper = self.axes[0].lower, self.axes[0].upper
        stated = lower.stated and upper.stated and math.isfinite(lower.value)
        return f"both limits are {lower.value:g}" if stated and lower.value == upper.value else ""

    @property
    def mimics(self) -> list[Located[str]]:
        """Names of joints that this one copies: below `<joint>` in URDF, below `<axis>` in SDF."""
        holders = (self.element, *self.element.all("axis"), *self.element.all("axis2"))
        mimics = (mimic for holder in holders for mimic in holder.all("mimic"))
        return [named for mimic in mimics if (named := mimic.attribute("joint")) is not None]


class Frame(Part):
    """A named frame (SDF 1.7 and later)."""

    scoped_name: str
    attached_to: str
    pose: Pose


class Model(Part):
    """A nested model, or an include that was read.

    Attributes:
        scoped_name: `arm` for a model nested in the robot.
        pose: The pose in the model around it, unless it states otherwise.
        definition: The `<model>` itself, which an include takes from another file.
        scope: What is in front of scoped names around it; empty for the robot.
        prefix: What is in front of scoped names inside it.
        included_from: URI of the include; None for a model written in place.
    """

    scoped_name: str
    pose: Pose
    definition: Element
    scope: str
    prefix: str
    included_from: Located[str] | None = None
