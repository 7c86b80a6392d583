"""URDF → SDF 1.6, as Gazebo's parser does it: fixed joints lumped, `<gazebo>` tags applied."""

from __future__ import annotations

from collections.abc import Callable

from lxml import etree

from checker.convert.bodies import Body, bodies_of, frame_of, joined_inertial, single_inertial_part
from checker.convert.conversion import CarriedPlugin, Conversion, Lumped, Notes
from checker.convert.gazebo_extensions import Copier
from checker.convert.gazebo_tags import GazeboSettings, gazebo_tags
from checker.convert.names import Naming, naming_of
from checker.convert.sdf_shapes import Ends, ShapeWriter, add_joint
from checker.convert.urdf_materials import Materials
from checker.convert.xml_writer import (
    add,
    child_of,
    exact,
    is_identity,
    numbers,
    six_numbers,
    tidy,
)
from checker.formats.urdf.description import UrdfDescription
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.model.tree import WORLD

VERSION = "1.6"
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def sdf_of(
    robot: Robot,
    description: UrdfDescription,
    *,
    name: str,
    mesh_uri: Callable[[str], str],
    namespace: str = "",
) -> Conversion:
    """Write a URDF robot as an SDF 1.6 document.

    Args:
        robot: The robot as read from the description (`description.robot`, or the same with
            meshes).
        description: Its `<gazebo>` tags.
        name: The name of the model.
        mesh_uri: Gives the URI to write for a mesh or texture of the source, as written there.
        namespace: Prefix of names of links and joints, without the slash. When empty,
            the part before the slash that all links have in common, if there is one.

    Returns:
        The document with `<sdf>` outermost. Sensors, lights and plugins of `<gazebo>` tags are
        copied as they are, at the pose that they have after lumping, with prefixes removed.
    """
    writer = _Writer(robot, description, naming_of(robot, namespace), mesh_uri)
    root = etree.Element("sdf", version=VERSION)
    writer.write(add(root, "model", name=name))
    return Conversion(root, writer.notes.all, tuple(writer.plugins), writer.lumped())


class _Writer:
    """The parts of one conversion."""

    def __init__(
        self,
        robot: Robot,
        description: UrdfDescription,
        naming: Naming,
        mesh_uri: Callable[[str], str],
    ) -> None:
        self.robot = robot
        self.naming = naming
        self.notes = Notes()
        self.settings = gazebo_tags(robot, description, self.notes)
        self.found = bodies_of(robot, description, self.notes)
        self.plugins: list[CarriedPlugin] = []
        self.copier = Copier(naming, self.notes, self.plugins)
        materials = Materials(robot, self.notes)
        self.shapes = ShapeWriter(naming, self.settings, materials, mesh_uri, self.notes)

    def write(self, model: etree._Element) -> None:
        """Write everything into the model."""
        whole = self._settings_of("")
        for setting in whole.whole:
            child_of(model, *setting.path).text = setting.value
        for body in self.found.bodies.values():
            self._link(model, body)
            self._joint(model, body)
        for element in whole.copied:
            self.copier.copy(element, model, link="", reference="")
        self._retie(model.findall("joint"))
        self._say_what_is_cut()

    def lumped(self) -> dict[str, Lumped]:
        """Return where each link of the source is."""
        local = self.naming.local
        return {
            local(name): Lumped(local(body.link.name.value), self.found.poses[name])
            for name, body in self.found.holders.items()
        }

    def _link(self, model: etree._Element, body: Body) -> None:
        name = body.link.name.value
        link = add(model, "link", name=self.naming.local(name))
        pose = self.robot.pose_of(name)
        if pose is None:
            self.notes.say(body.link, f"the pose of link {name!r} is not known: the origin is used")
            pose = Transform()
        if not is_identity(pose):
            stated = body.tie.joint.pose if body.tie is not None else None
            add(link, "pose", " ".join(six_numbers(pose, stated)))
        self._settings(link, body)
        _add_inertial(link, body)
        self.shapes.collisions(body, link)
        self.shapes.visuals(body, link)
        for part in body.parts:
            source = part.link.name.value
            own, reference = self.naming.local(name), self.naming.local(source)
            for element in self._settings_of(source).copied:
                self.copier.copy(element, link, link=own, reference=reference, pose=part.pose)

    def _settings(self, link: etree._Element, body: Body) -> None:
        """Apply what tags state about the link itself; of lumped links it is noted."""
        for part in body.parts:
            for setting in self._settings_of(part.link.name.value).link:
                if part.link is body.link:
                    child_of(link, *setting.path).text = setting.value
                else:
                    message = (
                        f"<{setting.element.tag}> of link {part.link.name.value!r} is left out"
                    )
                    self.notes.say(setting.element, f"{message}: the link is lumped")

    def _joint(self, model: etree._Element, body: Body) -> None:
        if body.tie is None:
            return
        tie, local = body.tie, self.naming.local
        holder = self.found.holders.get(tie.parent)
        if holder is None and tie.parent != WORLD:
            return
        parent = WORLD if holder is None else local(holder.link.name.value)
        name, settings = tie.joint.name.value, self._settings_of(tie.joint.name.value)
        ends = Ends(parent, local(body.link.name.value))
        joint = add_joint(model, tie.joint, local(name), ends, settings.joint, self.notes)
        if joint is not None and name not in self.robot.links_by_name:
            for element in settings.copied:
                self.copier.copy(element, joint, link=ends.child, reference=local(name))

    def _retie(self, joints: list[etree._Element]) -> None:
        """Make copied joints connect the links of the result instead of those lumped into them."""
        lumped = self.lumped()
        for end in (end for joint in joints for end in joint if end.tag in ("parent", "child")):
            name = (end.text or "").strip()
            if name in lumped and lumped[name].link != name:
                end.text = lumped[name].link

    def _say_what_is_cut(self) -> None:
        for tie in self.found.left_out:
            message = f"joint {tie.joint.name.value!r} connects {tie.child!r}"
            self.notes.say(tie.joint, f"{message}, which already has a parent link: left out")
        for broken in self.robot.tree.broken:
            message = f"joint {broken.joint.name.value!r} connects {broken.missing.value!r}"
            self.notes.say(broken.joint, f"{message}, which is not a link: left out")
        free = [body for body in self.found.bodies.values() if body.tie is None]
        for body in free[1:]:
            message = f"link {body.link.name.value!r} has no parent link"
            self.notes.say(body.link, f"{message}: it moves freely in the model")

    def _settings_of(self, name: str) -> GazeboSettings:
        return self.settings.get(name, _NOTHING)


_NOTHING = GazeboSettings()


def _add_inertial(link: etree._Element, body: Body) -> None:
    """Add the inertia of a body; one that comes from a single link keeps its numbers."""
    only = single_inertial_part(body.parts)
    element = add(link, "inertial")
    if only is not None and only.link.inertial is not None:
        source = only.link.inertial
        pose = frame_of(only)
        if not is_identity(pose):
            add(element, "pose", " ".join(six_numbers(pose, source.pose)))
        # A single link's moments stay along its own axes.
        mass, moments = exact(source.mass.value), [exact(moment.value) for moment in source.moments]
    else:
        joined = joined_inertial(body.parts)
        if any(joined.centre):
            add(element, "pose", f"{numbers(joined.centre)} 0 0 0")
        mass, moments = tidy(joined.mass), [tidy(moment) for moment in joined.moments]
    add(element, "mass", mass)
    inertia = add(element, "inertia")
    for name, moment in zip(_MOMENTS, moments, strict=True):
        add(inertia, name, moment)
