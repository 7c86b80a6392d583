"""The model file of a package, and the robots and worlds in it."""

from __future__ import annotations

from pkgutil import resolve_name

from msgspec.structs import replace

from checker.base.files import NotReadable
from checker.base.parts import Ask, NotAvailable, part
from checker.base.record import Record
from checker.formats.content import Content, Reader
from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.links import read_plugin
from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.expansion import Expander
from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.model.controllers import Controller
from checker.model.first_configuration import FirstConfiguration
from checker.model.named_files import NamedFiles, files_of
from checker.model.plugin_host import PluginHost, model_host, world_host
from checker.model.robot import Robot
from checker.model.world import World
from checker.package.configuration import first_configuration
from checker.package.formats import Format, format_of
from checker.package.inheritance import Missing
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.uris import Unknown, path_behind
from checker.robots.driven_elsewhere import driving_file
from checker.robots.expanded_sdf import expanded_model
from checker.robots.unspawned import unspawned
from checker.source.text import Located
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault

_WITHOUT_ROBOT = {
    PackageKind.PLUGIN: "the package contains only a plugin",
    PackageKind.UNKNOWN: "the package contains no robot",
    PackageKind.MUJOCO_MODEL: "the robot is a model of MuJoCo (MJCF)",
}
_SCENERY = ("light", "actor")
"""What an SDF file may contain instead of a model, to be included in worlds."""


class ModelFile(Record, eq=False):
    """The model file; of a package whose robots URDF files describe, the first of these.

    Attributes:
        document: Its XML.
        unloaded: That no launch file loads it, as a clause, where one loads another; else empty.
    """

    document: XmlDocument
    unloaded: str = ""

    @property
    def format(self) -> Format:
        """The format of the file."""
        return format_of(self.document.root.tag)


class PlainRobots(Record, eq=False):
    """The robots of a package without their meshes."""

    robots: tuple[Robot, ...]


class ControlledRobot(Record, eq=False):
    """A robot of a URDF file that ros2_control controls.

    Attributes:
        robot: The robot as the file describes it.
        controllers: The controllers that may run.
    """

    robot: Robot
    controllers: tuple[Controller, ...]


@part
def model_file(package: Package, expander: Expander, ask: Ask) -> ModelFile | NotAvailable:
    """Return the model file."""
    if (without := _WITHOUT_ROBOT.get(package.kind)) is not None:
        return NotAvailable(without, applicable=False)
    if package.kind is PackageKind.URDF_DESCRIPTION:
        return _first_description(ask)
    path = package.model_path
    if isinstance(path, Missing):
        return NotAvailable(path.reason)
    document = _document(package, path.path, expander)
    if isinstance(document, NotAvailable):
        return document
    model = ModelFile(document, unspawned(package, path.path))
    alone = model.format.is_grouped and package.only
    return _first_description(ask) if alone else model


def _first_description(ask: Ask) -> ModelFile | NotAvailable:
    first = ask.one(UrdfDescription)
    return first if isinstance(first, NotAvailable) else ModelFile(first.document)


def _document(package: Package, path: str, expander: Expander) -> XmlDocument | NotAvailable:
    """Return a file as XML, or state why it cannot be had."""
    document = package.xml(path)
    if isinstance(document, XmlFault):
        return NotAvailable(f"{path} is not well-formed")
    if isinstance(document, NotReadable):
        return NotAvailable(f"{path} {document.reason}")
    if document.root.tag == "sdf" and path.lower().endswith(".xacro"):
        return expanded_model(package, path, expander)
    return document


@part
def content(package: Package, model: ModelFile) -> Content | NotAvailable:
    """Return what the model file contains; robots of a grouped format have their own parts."""
    if model.format.is_grouped:
        reason = f"the model is a {model.format.name.upper()} file"
        return NotAvailable(reason, applicable=False)
    read: Reader = resolve_name(model.format.reader)
    return read(model.document, package)


@part
def sdf(model: ModelFile) -> SdfDocument | NotAvailable:
    """Return the model file as SDF."""
    if model.format.name != "sdf":
        reason = f"the model is a {model.format.name.upper()} file"
        return NotAvailable(reason, applicable=False)
    return SdfDocument(
        model.document, (model.document.root.get("version") or "").strip(), model.unloaded
    )


@part
def worlds(package: Package, content: Content | NotAvailable) -> tuple[World, ...] | NotAvailable:
    """Return the worlds of the model file."""
    if isinstance(content, NotAvailable):
        return NotAvailable(content.reason, applicable=package.kind is PackageKind.WORLD)
    return content.worlds or NotAvailable("the file contains no world", applicable=False)


@part
def plugin_hosts(
    robots: tuple[Robot, ...] | NotAvailable, worlds: tuple[World, ...] | NotAvailable
) -> tuple[PluginHost, ...] | NotAvailable:
    """Return what loads plugins: the robots, and the worlds of the model file."""
    hosts = () if isinstance(worlds, NotAvailable) else tuple(map(world_host, worlds))
    if isinstance(robots, NotAvailable):
        return hosts or robots
    return (*map(model_host, robots), *hosts)


@part
def named_files(
    package: Package,
    robots: tuple[Robot, ...] | NotAvailable,
    content: Content | NotAvailable,
) -> tuple[NamedFiles, ...] | NotAvailable:
    """Return the files that the robots name, and those of the static models of a world."""
    in_world = package.kind is PackageKind.WORLD
    known = () if isinstance(robots, NotAvailable) else robots
    of_robots = (files_of(it, in_world=in_world) for it in known)
    models = () if isinstance(content, NotAvailable) else content.robots
    scenery = (it for it in models if in_world and it.is_static)
    worlds = () if isinstance(content, NotAvailable) else content.worlds
    files = (
        *of_robots,
        *(_of_scenery(package, model) for model in scenery),
        *(NamedFiles((), frozenset(), it.unknown) for it in worlds if in_world and it.unknown),
    )
    return robots if isinstance(robots, NotAvailable) and not files else files


def _of_scenery(package: Package, model: Robot) -> NamedFiles:
    """Return the files that a model of a world names, those of absent models as includes.

    The world may get an absent model from Fuel, or from a folder of the user's.
    """
    files = files_of(model, in_world=True)
    absent = tuple(it for it in files.uris if _is_of_absent(package, it))
    uris = tuple(it for it in files.uris if it not in absent)
    return replace(files, uris=uris, includes=(*files.includes, *absent))


def _is_of_absent(package: Package, uri: Located[str]) -> bool:
    of_model = uri.value.startswith("model://")
    return of_model and isinstance(path_behind(package, Robot.folder_of(uri), uri.value), Unknown)


@part
def plain_robots(package: Package, model: ModelFile, ask: Ask) -> PlainRobots | NotAvailable:
    """Return the robot with the plugins that the spawner adds; of a lone file all robots."""
    if model.format.is_grouped:
        return _described(package, ask)
    read = ask.one(Content)
    if isinstance(read, NotAvailable):
        return read
    robots = read.robots
    if package.kind is PackageKind.WORLD:
        robots = tuple(robot for robot in robots if not robot.is_static)
    if not package.only:
        robots = robots[:1]
    if robots:
        spawned = ask.one(SpawnedXml)
        first = _with_spawned_plugins(robots[0], spawned)
        return PlainRobots(
            tuple(replace(it, unloaded=model.unloaded) for it in (first, *robots[1:]))
        )
    kind = "model that moves" if read.worlds else "model"
    reason = read.missing or f"{model.document.source.file} contains no {kind}"
    is_scenery = any(model.document.root.child(tag) is not None for tag in _SCENERY)
    return NotAvailable(reason, applicable=not (read.worlds or is_scenery))


def _described(package: Package, ask: Ask) -> PlainRobots | NotAvailable:
    """Return the robots of URDF files with their controllers."""
    descriptions, controlled = ask.all(UrdfDescription), ask.all(ControlledRobot)
    if isinstance(descriptions, NotAvailable):
        return descriptions
    robots = {id(it.robot): it.robot for it in descriptions}
    for each in () if isinstance(controlled, NotAvailable) else controlled:
        robots[id(each.robot)] = replace(each.robot, controllers=each.controllers)
    return PlainRobots(tuple(_with_driving_file(package, robot) for robot in robots.values()))


def _with_driving_file(package: Package, robot: Robot) -> Robot:
    if robot.driven_joints or robot.controllers or not robot.wheels or package.only:
        return robot
    return replace(robot, driven_in=driving_file(package, robot))


def _with_spawned_plugins(robot: Robot, spawned: SpawnedXml | NotAvailable) -> Robot:
    if isinstance(spawned, NotAvailable):
        return replace(robot, unread_plugins=spawned.reason if spawned.applicable else "")
    added = (read_plugin(element) for element in spawned.plugins)
    return replace(robot, plugins=(*robot.plugins, *added))


@part
def lowest_configuration(package: Package, ask: Ask) -> FirstConfiguration | NotAvailable:
    """Return the configuration of the same robot that has the lowest available number."""
    first = first_configuration(package)
    if first is None:
        return NotAvailable("no earlier configuration is available to compare", applicable=False)
    with ask.parts_of(first) as parts:
        plain = parts.one(PlainRobots)
    if isinstance(plain, NotAvailable):
        return NotAvailable(f"{first.name} cannot be compared: {plain.reason}")
    return FirstConfiguration(first.name, plain.robots[0])
