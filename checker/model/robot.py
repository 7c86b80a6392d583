"""The robot: what SDF and URDF have in common, in SI units, everything with its place."""

from __future__ import annotations

import math
import posixpath
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

from checker.model.faults import Fault, FaultKind
from checker.model.frames import MODEL_FRAME, FrameGraph
from checker.model.shapes import Geometry, Material
from checker.model.transform import Transform, Vector
from checker.source.text import Located, Span
from checker.source.xml import Element, XmlDocument

UNLIMITED = 1e16
"""SDFormat's own bound: limits at or beyond ±1e16 mean that there is none."""

_LINKS_ONLY = ("1.4", "1.5", "1.6")
"""SDF versions in which joints tie links and nothing else."""


@dataclass(frozen=True, eq=False)
class Part:
    """Anything of a robot that has a name and an element.

    Attributes:
        name: As written.
        element: Where it is described; it leads to whatever the model does not spell out.
    """

    name: Located[str]
    element: Element

    @property
    def span(self) -> Span:
        """The start tag."""
        return self.element.span


@dataclass(frozen=True, eq=False)
class Pose:
    """A pose as written.

    Attributes:
        transform: The numbers, as a transform into the frame `relative_to`.
        relative_to: Name of that frame; empty for the default of the place it stands in.
        numbers: x, y, z (metres), roll, pitch, yaw (radians), each with its place.
        span: The pose element, or the element that could have stated one.
    """

    transform: Transform
    relative_to: str
    numbers: tuple[Located[float], ...]
    span: Span


@dataclass(frozen=True, eq=False)
class Inertial:
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


@dataclass(frozen=True, eq=False)
class Collision(Part):
    """A shape that touches things, posed in its link's frame."""

    pose: Pose
    geometry: Geometry


@dataclass(frozen=True, eq=False)
class Visual(Part):
    """A shape that is seen, posed in its link's frame."""

    pose: Pose
    geometry: Geometry
    material: Material | None


@dataclass(frozen=True, eq=False)
class Plugin(Part):
    """A plugin and its parameters (below `element`).

    Attributes:
        filename: The library.
        owner: Name of the link or sensor it stands in; empty for the model.
        nested_in: Scoped name of the nested model it stands in, else empty.
    """

    filename: Located[str]
    owner: str = ""
    nested_in: str = ""

    @property
    def class_name(self) -> str:
        """Last word of the class: `DiffDrive` of `ignition::gazebo::systems::DiffDrive`."""
        return self.name.value.rsplit("::", 1)[-1]

    def values(self, *tags: str) -> list[Located[str]]:
        """Return the texts of all elements of these names, at any depth."""
        return [e.text for e in self.element.descendants() if e.tag in tags and e.text.stated]


@dataclass(frozen=True, eq=False)
class Sensor(Part):
    """A sensor.

    Attributes:
        type: As written (`gpu_lidar`).
        link: Name of the link (or joint) that carries it.
        pose: In that link's frame, unless it says otherwise.
        topic: Empty for the default.
    """

    type: Located[str]
    link: str
    pose: Pose
    topic: Located[str]
    plugins: tuple[Plugin, ...] = ()


@dataclass(frozen=True, eq=False)
class Light(Part):
    """A light and the link that carries it."""

    type: str
    link: str
    pose: Pose


@dataclass(frozen=True, eq=False)
class Link(Part):
    """A rigid body.

    Attributes:
        scoped_name: With the names of nested models in front: `arm::wrist`.
        inertial: None when the file states none.
        default_mass: Kilograms of a link without inertial: 1 in SDF, 0 in URDF.
    """

    scoped_name: str
    pose: Pose
    inertial: Inertial | None
    collisions: tuple[Collision, ...]
    visuals: tuple[Visual, ...]
    sensors: tuple[Sensor, ...]
    lights: tuple[Light, ...]
    default_mass: float = 1.0

    @property
    def mass(self) -> float:
        """Kilograms; what simulators assume where the file states none."""
        return self.inertial.mass.value if self.inertial is not None else self.default_mass


@dataclass(frozen=True, eq=False)
class Axis:
    """One axis of a joint.

    Attributes:
        xyz: Direction, expressed in `expressed_in`.
        expressed_in: Name of a frame; empty for the joint's own, `__model__` for the model's.
        lower: Metres or radians; −inf without limit.
        upper: Metres or radians; inf without limit.
        effort: Newtons or newton metres; inf without limit.
        velocity: Metres or radians a second; inf without limit.
    """

    xyz: tuple[Located[float], ...]
    expressed_in: str
    lower: Located[float]
    upper: Located[float]
    effort: Located[float]
    velocity: Located[float]
    damping: Located[float]
    friction: Located[float]
    span: Span


@dataclass(frozen=True, eq=False)
class Joint(Part):
    """A joint.

    Attributes:
        parent: Name of a link or frame, as written; `world` for the world.
        child: Name of a link or frame, as written.
        scope: Scoped name of the model it stands in, with `::` behind; empty for the robot.
    """

    scoped_name: str
    scope: str
    type: Located[str]
    parent: Located[str]
    child: Located[str]
    pose: Pose
    axes: tuple[Axis, ...]
    sensors: tuple[Sensor, ...] = ()


@dataclass(frozen=True, eq=False)
class Frame(Part):
    """A named frame (SDF 1.7 and later)."""

    scoped_name: str
    attached_to: str
    pose: Pose


@dataclass(frozen=True, eq=False)
class Model(Part):
    """A nested model, or an include that was read.

    Attributes:
        scoped_name: `arm` for a model nested in the robot.
        included_from: URI of the include; None for a model written in place.
    """

    scoped_name: str
    pose: Pose
    included_from: Located[str] | None = None


@dataclass(frozen=True, eq=False)
class Robot(Part):
    """A whole robot; the parts of nested models stand in the same tuples, with scoped names.

    Attributes:
        document: The file it was read from.
        format: `sdf` or `urdf`.
        version: SDF version as written.
        plugins: Of the model file and, in a package, of what the spawner emits.
        frame_graph: Where everything is.
        faults: What could not be read as it stands.
        unresolved_includes: URIs of includes whose model is not at hand.
        unread_plugins: Why plugins that the spawner adds are not among these; else empty.
    """

    document: XmlDocument
    format: str
    version: str
    pose: Pose
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    frames: tuple[Frame, ...]
    models: tuple[Model, ...]
    plugins: tuple[Plugin, ...]
    frame_graph: FrameGraph = field(repr=False)
    faults: tuple[Fault, ...] = ()
    unresolved_includes: tuple[Located[str], ...] = ()
    unread_plugins: str = ""

    @cached_property
    def links_by_name(self) -> dict[str, Link]:
        """Links by scoped name; the first one when a name is given twice."""
        return {link.scoped_name: link for link in reversed(self.links)}

    @cached_property
    def joints_by_name(self) -> dict[str, Joint]:
        """Joints by scoped name; the first one when a name is given twice."""
        return {joint.scoped_name: joint for joint in reversed(self.joints)}

    @cached_property
    def sensors(self) -> tuple[Sensor, ...]:
        """All sensors, of links and of joints."""
        on_links = [sensor for link in self.links for sensor in link.sensors]
        return (*on_links, *(sensor for joint in self.joints for sensor in joint.sensors))

    @property
    def mass(self) -> float:
        """Kilograms of all links together."""
        # math.fsum would raise where the sum overflows.
        return sum(link.mass for link in self.links)

    @cached_property
    def wheels(self) -> tuple[Link, ...]:
        """Links that a drive plugin turns, and links that are called wheels."""
        from checker.model.drive import find_wheels

        return tuple(find_wheels(self.links, self.joints, self.plugins))

    @cached_property
    def attachable_names(self) -> frozenset[str]:
        """Scoped names that a joint may tie: links, and in SDF 1.7 and later any frame."""
        names = {link.scoped_name for link in self.links}
        names |= {frame.scoped_name for frame in self.frames}
        if self.format == "sdf" and self.version not in _LINKS_ONLY:
            names |= {model.scoped_name for model in self.models}
            names |= {joint.scoped_name for joint in self.joints}
        return frozenset(names)

    @cached_property
    def all_plugins(self) -> tuple[Plugin, ...]:
        """Plugins of the model and of its sensors."""
        return (*self.plugins, *(plugin for sensor in self.sensors for plugin in sensor.plugins))

    @property
    def folder(self) -> str:
        """Folder of the model file, from the package's folder: where relative URIs start."""
        return posixpath.dirname(self.document.source.file)

    @cached_property
    def file_uris(self) -> tuple[Located[str], ...]:
        """URIs of meshes and textures; those of material scripts are left out."""
        uris = []
        for shape in self.shapes():
            if shape.geometry.uri is not None:
                uris.append(shape.geometry.uri)
            if isinstance(shape, Visual) and shape.material is not None:
                uris.extend(shape.material.textures)
        return tuple(uri for uri in uris if uri.stated)

    def shapes(self) -> Iterator[Collision | Visual]:
        """Yield every collision and visual of every link."""
        for link in self.links:
            yield from link.collisions
            yield from link.visuals

    def faults_of(self, kind: FaultKind) -> list[Fault]:
        """Return the faults of one kind."""
        return [fault for fault in self.faults if fault.kind is kind]

    def pose_of(self, name: str) -> Transform | None:
        """Return the pose of a link, joint or frame in the robot's frame; None if unknown.

        Where a joint has the name of a link, it is the link's; see `pose_of_joint`.
        """
        return self.frame_graph.pose(name)

    def pose_of_joint(self, joint: Joint) -> Transform | None:
        """Return the pose of a joint's frame in the robot's frame; None if unknown.

        SDF poses a joint in its child by default, URDF always in its parent.
        """
        end = (joint.parent if self.format == "urdf" else joint.child).value
        if end == MODEL_FRAME:
            base = joint.scope.removesuffix("::") or MODEL_FRAME
        else:
            base = joint.scope + end
        frame = self.pose_of(joint.pose.relative_to or base)
        return None if frame is None else frame @ joint.pose.transform

    def pose_of_part(self, owner: Link | Joint, pose: Pose) -> Transform | None:
        """Return the pose of a part in the robot's frame; None if unknown.

        Args:
            owner: The link (or joint) that carries the part.
            pose: Of its collision, visual, sensor, light or inertial.
        """
        if pose.relative_to:
            base = self.pose_of(pose.relative_to)
        elif isinstance(owner, Joint):
            base = self.pose_of_joint(owner)
        else:
            base = self.pose_of(owner.scoped_name)
        return None if base is None else base @ pose.transform

    def axis_in_model(self, joint: Joint, axis: Axis) -> Vector | None:
        """Return the direction of a joint's axis in the robot's frame, of length 1.

        None for an axis of length 0 and where the frame that it is expressed in is unknown.
        """
        own = not axis.expressed_in
        frame = self.pose_of_joint(joint) if own else self.pose_of(axis.expressed_in)
        x, y, z = (number.value for number in axis.xyz)
        length = math.hypot(x, y, z)
        if frame is None or not 0.0 < length < math.inf:
            return None
        return frame.rotate((x / length, y / length, z / length))
