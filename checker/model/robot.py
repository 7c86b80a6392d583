"""The robot: what SDF and URDF have in common, in SI units, everything with its place."""

from __future__ import annotations

import math
import posixpath
from collections.abc import Iterator
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
from checker.model.controllers import Controller
from checker.model.conventions import Conventions
from checker.model.faults import Fault, FaultKind
from checker.model.frames import MODEL_FRAME, FrameGraph
from checker.model.geometry.boxes import Box, box_around
from checker.model.geometry.convex import support
from checker.model.geometry.mesh_units import ScaledMeshes
from checker.model.geometry.placed_shapes import union
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform, Vector
from checker.model.locomotion.balancing import balances
from checker.model.locomotion.drive import WING_CLASSES, driven_joints, find_wheels
from checker.model.locomotion.locomotion import DriveKind, Locomotion
from checker.model.locomotion.reader import read_locomotion
from checker.model.mesh import Mesh, Meshes, MeshFault, MeshUse, NoMeshes, mesh_of
from checker.model.tree import WORLD, LinkTree, link_tree
from checker.model.unknowns import (
    LooseParts,
    bare_wheel,
    loose_parts,
    stuck_wheel,
    unknown_masses,
    unplaced_part,
)
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

EARTH_GRAVITY = 9.81
"""m/s², as Pinocchio and MuJoCo have it; Gazebo's default is 9.8."""
_NEAR_EARTH = 0.05


OTHERS_SIMULATED = "Gazebo gets another description"
"""Why no simulator gets a robot, beside one that a simulator gets."""
MUJOCO_SIMULATED = "the package simulates a model of its own in MuJoCo, and nothing else"
"""Why no simulator gets a robot of URDF beside models of MuJoCo."""
UNDRIVEN = "no launch file that loads it starts a simulator, and nothing drives it in one"
"""Why no simulator gets a robot that has sensors or plugins for one."""


class Robot(Part, dict=True):
    """A whole robot; the parts of nested models are in the same tuples, with scoped names.

    Attributes:
        document: The file it was read from.
        format: The format of the file, such as `sdf`; facts in tables are listed by it.
        conventions: What this format states, and what it leaves to others.
        version: SDF version as written.
        plugins: The plugins of the model file and, in a package, of what the spawner emits.
        frame_graph: The poses of all frames.
        faults: What could not be read as it is.
        unresolved_includes: URIs of includes whose model is not available.
        merges_unknown: Whether such a model would have given its parts to the one around it.
        unread_plugins: The reasons why plugins that the spawner adds are not among these; else
            empty.
        meshes: The content of its mesh files.
        controllers: The controllers of ros2_control or ROS 1, that move its joints.
        driven_in: Path of the SDF file that describes the same robot with its drive; else empty.
        shown_only: Why no simulator gets it, as a clause; empty if one may.
        unloaded: That no launch file loads it, as a clause, where one loads another; else empty.
        gravity: The downward gravity of the world that it starts in, m/s²; else the Earth's.
    """

    document: XmlDocument
    format: str
    conventions: Conventions
    version: str
    pose: Pose
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    frames: tuple[Frame, ...]
    models: tuple[Model, ...]
    plugins: tuple[Plugin, ...]
    frame_graph: FrameGraph
    faults: tuple[Fault, ...] = ()
    unresolved_includes: tuple[Located[str], ...] = ()
    merges_unknown: bool = False
    unread_plugins: str = ""
    meshes: Meshes = NoMeshes()
    controllers: tuple[Controller, ...] = ()
    driven_in: str = ""
    shown_only: str = ""
    unloaded: str = ""
    gravity: float = EARTH_GRAVITY

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

    def poses(self) -> Iterator[tuple[Pose, str]]:
        """Yield every pose, those of collisions with the name of their link."""
        for link in self.links:
            yield from ((shape.pose, link.scoped_name) for shape in link.collisions)
            parts: tuple[Link | Visual | Sensor, ...] = (link, *link.visuals, *link.sensors)
            yield from ((part.pose, "") for part in parts)
            if link.inertial is not None:
                yield link.inertial.pose, ""
        yield from ((joint.pose, "") for joint in self.joints)

    @property
    def is_for_gazebo(self) -> bool:
        """True if it is written for Gazebo: by its format, or by an element for Gazebo."""
        tag = self.conventions.extension_tag
        return self.conventions.read_by_gazebo or bool(tag and self.element.child(tag))

    @property
    def never_simulated(self) -> str:
        """Why no simulator is meant to get it, as a clause; empty if one may be.

        Gazebo gets another description, nothing would drive it there, MuJoCo gets its own model, or
        its ros2_control is that of hardware alone.
        """
        stated = self.shown_only in (OTHERS_SIMULATED, MUJOCO_SIMULATED, UNDRIVEN)
        certain = stated or self.element.child("ros2_control")
        return self.shown_only if certain else ""

    @property
    def is_static(self) -> bool:
        """True if the model, or a `<gazebo>` of the whole URDF, states that it is static."""
        whole = (it for it in self.element.all("gazebo") if not it.get("reference"))
        return states_static(self.element) or any(map(states_static, whole))

    @property
    def other_gravity(self) -> str:
        """A gravity that is not the Earth's, for behind a weight; empty for the Earth's."""
        is_earth = abs(self.gravity - EARTH_GRAVITY) < _NEAR_EARTH
        return "" if is_earth else f" at a gravity of {self.gravity:.4g} m/s²"

    @cached_property
    def is_prop(self) -> bool:
        """True if it has no moving joint, sensor or plugin: a barrel, not a robot."""
        jointed = any(joint.type.value != "fixed" for joint in self.joints)
        return not (jointed or self.sensors or self.plugins)

    @property
    def is_fixture(self) -> bool:
        """True if fixed joints connect all its links to the world: a camera on a wall."""
        tree = self.tree
        return bool(tree.links) and tree.links_fixed_to_world >= tree.links.keys() - {WORLD}

    def is_still(self, link: Link) -> bool:
        """Return whether a model around a link, this one or one nested in it, is static."""
        element: Element | None = link.element
        while element is not None:
            if element.tag == "model" and states_static(element):
                return True
            element = element.parent
        return False

    @cached_property
    def mass(self) -> float:
        """Kilograms of all links together."""
        # math.fsum would raise where the sum overflows.
        return sum(link.mass for link in self.links)

    @cached_property
    def wheels(self) -> tuple[Link, ...]:
        """Links that a drive plugin turns, and links that are called wheels."""
        return tuple(find_wheels(self.links, self.joints, self.plugins))

    @cached_property
    def locomotion(self) -> Locomotion:
        """Parts that its drive plugins move, and their limits."""
        return read_locomotion(self)

    @cached_property
    def balances(self) -> bool:
        """True if a controller keeps it upright."""
        return balances(self)

    @cached_property
    def stands_alone(self) -> bool:
        """True if it stands on the ground according to its file.

        If the format does not state this (URDF), arms and hands are mounted on something, and legs
        fall without their controllers. So it needs wheels, or a plugin that drives it.
        """
        return self.conventions.states_start or self.drives

    def is_mounted(self, name: str) -> bool:
        """Return whether a link is of the base of a robot that does not stand alone."""
        return not self.stands_alone and name in self.tree.base

    @cached_property
    def drives(self) -> bool:
        """True if it has wheels, or a plugin that drives it."""
        return bool(self.wheels) or self.locomotion.kind is not DriveKind.NONE

    @cached_property
    def flies(self) -> bool:
        """True if rotors or wings carry it."""
        wings = any(plugin.class_name in WING_CLASSES for plugin in self.plugins)
        return wings or bool(self.locomotion.rotors)

    @cached_property
    def tree(self) -> LinkTree:
        """Tree of its links."""
        return link_tree(self)

    @cached_property
    def driven_joints(self) -> dict[str, Plugin]:
        """Scoped names of the joints that a plugin moves, with the first plugin that does."""
        return driven_joints(self.plugins, self.joints)

    @cached_property
    def attachable_names(self) -> frozenset[str]:
        """Scoped names that a joint may connect: links, and frames where the format has any."""
        names = {link.scoped_name for link in self.links}
        names |= {frame.scoped_name for frame in self.frames}
        if self.conventions.has_frames:
            names |= {model.scoped_name for model in self.models}
            names |= {f"{model.scoped_name}::{MODEL_FRAME}" for model in self.models}
            names.add(MODEL_FRAME)
            names |= {joint.scoped_name for joint in self.joints}
        return frozenset(names)

    @cached_property
    def all_plugins(self) -> tuple[Plugin, ...]:
        """Plugins of the model and of its sensors."""
        return (*self.plugins, *(plugin for sensor in self.sensors for plugin in sensor.plugins))

    @property
    def missing_parts(self) -> str:
        """Reason why parts of the robot are not known, as the end of a sentence; else empty."""
        uris = [uri.value or "a model without <uri>" for uri in self.unresolved_includes]
        return f"{uris[0]} is included, but not available" if uris else ""

    @cached_property
    def loose_parts(self) -> LooseParts:
        """Parts that no joint connects to the robot."""
        return loose_parts(self)

    @cached_property
    def unplaced_part(self) -> str:
        """Reason why a part has no place on the robot, as the end of a sentence; else empty."""
        return unplaced_part(self)

    @cached_property
    def bare_wheel(self) -> str:
        """Driven wheel or track without collision, as a sentence; empty if there is none."""
        return bare_wheel(self)

    @cached_property
    def stuck_wheel(self) -> str:
        """Joint of a driven wheel that cannot turn, as a sentence; empty if all can."""
        return stuck_wheel(self)

    @cached_property
    def unknown_masses(self) -> dict[str, str]:
        """Links whose mass is none, with the reason as the end of a sentence."""
        return unknown_masses(self)

    @property
    def unweighed(self) -> str:
        """Reason why the total mass is not known, as the end of a sentence; empty if it is."""
        return self.missing_parts or next(iter(self.unknown_masses.values()), "")

    def may_be_included(self, name: str) -> bool:
        """Return whether a part of this name could come from an include that is not available."""
        known = not name or not self.unresolved_includes
        return not known and (self.merges_unknown or "::" in name)

    @staticmethod
    def folder_of(uri: Located[str]) -> str:
        """Return the folder of the file that states a URI: where relative URIs start."""
        return posixpath.dirname(uri.span.source.file)

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
        """Return the pose of a joint's frame in the robot's frame; None if unknown."""
        in_parent = self.conventions.joint_posed_in == "parent"
        end = (joint.parent if in_parent else joint.child).value
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
            pose: The pose of its collision, visual, sensor, light or inertial element.
        """
        if pose.relative_to:
            base = self.pose_of(pose.relative_to)
        elif isinstance(owner, Joint):
            base = self.pose_of_joint(owner)
        else:
            base = self.pose_of(owner.scoped_name)
        return None if base is None else base @ pose.transform

    def pose_in_link(self, link: Link, pose: Pose) -> Transform | None:
        """Return the pose of a part in the frame of the link that carries it; None if unknown."""
        if not pose.relative_to:
            return pose.transform
        frame, at = self.pose_of(link.scoped_name), self.pose_of_part(link, pose)
        return None if frame is None or at is None else frame.inverse @ at

    def support_of(self, geometry: Geometry, pose: Transform, direction: Vector) -> float | None:
        """Return how far a shape reaches in a direction, metres; see `support`."""
        return support(geometry, pose, direction, self.scaled_meshes)

    def box_of(self, link: Link, *, visuals_too: bool = True) -> Box | None:
        """Return the box around a link's collisions and visuals, in the robot's frame.

        Meshes count by their convex hull. None for a link without shapes, and where a mesh or a
        place is unknown.
        """
        shapes: tuple[Collision | Visual, ...] = link.collisions
        if visuals_too:
            shapes = (*shapes, *link.visuals)
        boxes = [self.box_of_shape(link, shape) for shape in shapes]
        known = [box for box in boxes if box is not None]
        return union(known) if len(known) == len(boxes) else None

    def box_of_shape(self, link: Link, shape: Collision | Visual) -> Box | None:
        """Return the box around one shape of a link, in the robot's frame; None if unknown."""
        if shape not in self._shape_boxes:
            pose = self.pose_of_part(link, shape.pose)
            placed = [] if pose is None else [(shape.geometry, pose)]
            self._shape_boxes[shape] = box_around(placed, self.scaled_meshes)
        return self._shape_boxes[shape]

    @cached_property
    def _shape_boxes(self) -> dict[Collision | Visual, Box | None]:
        """Boxes computed so far: many rules need the same ones."""
        return {}

    def own_box_of(self, link: Link) -> Box | None:
        """Return the box around a link's shapes in the link's frame: alike links have like boxes.

        None for a link without shapes, and where a mesh or a place is unknown.
        """
        frame = self.pose_of(link.scoped_name)
        placed = []
        shapes: tuple[Collision | Visual, ...] = (*link.collisions, *link.visuals)
        for shape in shapes:
            pose = self.pose_of_part(link, shape.pose)
            if frame is None or pose is None:
                return None
            placed.append((shape.geometry, frame.inverse @ pose))
        return box_around(placed, self.scaled_meshes)

    def mesh_of(self, shape: Collision | Visual) -> Mesh | MeshFault | None:
        """Return the mesh that a collision or visual consists of; None for other shapes."""
        return mesh_of(shape.geometry, self.scaled_meshes)

    @cached_property
    def scaled_meshes(self) -> ScaledMeshes:
        """Content of its mesh files, without those in a wrong unit."""
        return ScaledMeshes(self)

    @cached_property
    def mesh_uses(self) -> tuple[MeshUse, ...]:
        """Every collision and visual that names a mesh file."""
        named = (
            (shape, shape.geometry.uri) for shape in self.shapes() if shape.geometry.shape == "mesh"
        )
        return tuple(
            MeshUse(shape, uri, self.meshes.load(uri))
            for shape, uri in named
            if uri is not None and uri.value
        )

    @cached_property
    def unseen_meshes(self) -> tuple[str, ...]:
        """Reasons why mesh files are not known although Gazebo may read them, one for each."""
        reasons = (use.reason_unseen for use in self.mesh_uses)
        return tuple(dict.fromkeys(reason for reason in reasons if reason))

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


def states_static(model: Element) -> bool:
    """Return whether a `<model>` states that nothing moves it."""
    static = model.child("static")
    return static is not None and static.text.value.lower() in ("1", "true")
