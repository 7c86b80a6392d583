"""The robot: what SDF and URDF have in common, in SI units, everything with its place."""

from __future__ import annotations

import math
import posixpath
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

from checker.model.components import (
    Axis,
    Collision,
    Frame,
    Joint,
    Link,
    Model,
    Part,
    Plugin,
    Pose,
    Sensor,
    Visual,
)
from checker.model.faults import Fault, FaultKind
from checker.model.frames import MODEL_FRAME, FrameGraph
from checker.model.transform import Transform, Vector
from checker.source.text import Located
from checker.source.xml import XmlDocument

_LINKS_ONLY = ("1.4", "1.5", "1.6")
"""SDF versions in which joints tie links and nothing else."""


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
