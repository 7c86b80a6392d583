"""Reasons why a package's robot was not read: a verdict needs a robot."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import chain

from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.base.words import count
from checker.engine.subject import Subject
from checker.formats.mjcf.model import MjcfModel
from checker.formats.mjcf.models import MODELS_LIMIT, MjcfFiles
from checker.launch.ros1.package_launch import LaunchEntries
from checker.launch.ros2.descriptions import loaded_descriptions
from checker.launch.ros2.graph import LaunchGraph, Ros2Launch, SharePath
from checker.launch.ros2.named_paths import named_paths, unavailable
from checker.model.robot import Robot
from checker.package.formats import robot_suffixes
from checker.package.kind import PackageKind, is_urdf
from checker.package.model_file import own_model
from checker.package.package import Package
from checker.package.released import distributions_with
from checker.package.unchecked_models import unchecked_models
from checker.report.report import FILES, ROBOT, Cause, NotChecked
from checker.ros.simulation import Simulations
from checker.source.xml import XmlDocument

_NO_ROBOT = "no URDF, xacro, SDF or MJCF file of it is a robot, and no launch file starts one"
_BESIDE_URDF = (
    "{0} is not checked beside the URDF that launch files load: check it with subt-check {0}"
)
_TEMPLATE = re.compile(r"\.(?:sdf|urdf|xacro)\.(?:jinja2?|j2|em|erb)$")
_OF_ROBOT = frozenset({"controller_manager", "robot_state_publisher"})
"""Packages whose nodes are started for a robot alone."""
_WITHOUT_ROBOT = (PackageKind.PLUGIN, PackageKind.WORLD)


class _Reason(Record):
    """Why a robot was not read.

    Attributes:
        text: The reason.
        released: Whether it is in a launch file that is included from a package of ROS.
    """

    text: str
    released: bool = False


def unread_robots(subject: Subject) -> Iterator[NotChecked]:
    """Yield why robots of a package were not read; nothing if all were, or none is expected."""
    package = subject.package
    if package.only:
        return
    was_read = _was_read(subject)
    cause = Cause.NOT_SUPPORTED if was_read else Cause.NOT_AT_HAND
    for reason in unchecked_models(file.path for file in package.index.files):
        yield NotChecked(FILES, reason, cause)
    model = own_model(package) if package.kind is PackageKind.URDF_DESCRIPTION else None
    if model is not None and not is_urdf(model):
        yield NotChecked(FILES, _BESIDE_URDF.format(model), Cause.NOT_SUPPORTED)
    mujoco = subject.one(MjcfFiles)
    if isinstance(mujoco, MjcfFiles) and mujoco.left_out:
        beyond = f"only {MODELS_LIMIT} of its MuJoCo models are checked, {mujoco.left_out} are not"
        yield NotChecked(FILES, beyond, Cause.NOT_AT_HAND)
    if not was_read and package.kind not in _WITHOUT_ROBOT:
        yield from _without_robot(subject)
    elif not was_read:
        yield from _reported(subject, _of_roslaunch_files(subject))


def _without_robot(subject: Subject) -> Iterator[NotChecked]:
    package = subject.package
    sources = chain(
        _of_launch_files(subject),
        _of_roslaunch_files(subject),
        _of_templates(package),
        _of_misnamed_model(package),
        _of_mujoco(subject),
    )
    reasons = list(dict.fromkeys(sources))
    yield from _reported(subject, reasons)
    if reasons or _loads_robot_beside(subject):
        return
    if package.kind in (PackageKind.UNKNOWN, PackageKind.MUJOCO_MODEL):
        # Beside other packages, one without a robot may hold messages, maps or code.
        others = package.other_packages
        beside = any(other.kind is not PackageKind.UNKNOWN for other in others)
        none_expected = beside or (others and _holds_none(subject))
        cause = Cause.NOT_APPLICABLE if none_expected else Cause.NOT_AT_HAND
        yield NotChecked(ROBOT, _NO_ROBOT, cause)


def _loads_robot_beside(subject: Subject) -> bool:
    """Return whether a launch file loads an available description, judged in its own package."""
    launch = subject.one(Ros2Launch)
    graphs = () if isinstance(launch, NotAvailable) else launch.entries
    return any(True for graph in graphs for _ in loaded_descriptions(subject.package, graph))


def _reported(subject: Subject, reasons: Iterable[_Reason]) -> Iterator[NotChecked]:
    """Yield reasons; they matter little beside a robot that a launch file loads from elsewhere.

    What a package without robot includes from ROS keeps nothing from it.
    """
    beside = _loads_robot_beside(subject)
    for reason in reasons:
        needless = beside or (reason.released and _holds_none(subject))
        cause = Cause.NOT_APPLICABLE if needless else Cause.NOT_AT_HAND
        yield NotChecked(ROBOT, reason.text, cause)


def _holds_none(subject: Subject) -> bool:
    """Return whether a package neither describes nor starts a robot."""
    kinds = (PackageKind.UNKNOWN, PackageKind.PLUGIN)
    return subject.package.kind in kinds and not _starts_robot(subject)


def _starts_robot(subject: Subject) -> bool:
    """Return whether an own launch file may start what every robot needs, or was not read."""
    launch, entries = subject.one(Ros2Launch), subject.one(LaunchEntries)
    nodes: list[str] = []
    if not isinstance(launch, NotAvailable):
        own = (node for node in launch.nodes if not node.span.source.file.startswith("../"))
        nodes += (node.package.value for node in own if node.starts is not False)
        nodes += _OF_ROBOT if launch.unread else ()
    if not isinstance(entries, NotAvailable):
        nodes += (node.package for node in entries.graph.nodes)
    return not _OF_ROBOT.isdisjoint(nodes)


def _was_read(subject: Subject) -> bool:
    if not all(isinstance(subject.one(kind), NotAvailable) for kind in (Robot, MjcfModel)):
        return True
    simulations = subject.one(Simulations)
    launched = () if isinstance(simulations, NotAvailable) else simulations.launched
    return any(simulation.robots or simulation.classic_robots for simulation in launched)


def _of_launch_files(subject: Subject) -> Iterator[_Reason]:
    launch, simulations = subject.one(Ros2Launch), subject.one(Simulations)
    graphs = () if isinstance(launch, NotAvailable) else launch.entries
    elsewhere = [*_elsewhere(subject.package, graphs)]
    yield from elsewhere
    if not elsewhere and not isinstance(simulations, NotAvailable):
        for simulation in simulations.launched:
            file = simulation.graph.file if simulation.graph is not None else ""
            yield from (_Reason(f"{file}: {reason}") for reason in simulation.unknown_robots)


def _of_roslaunch_files(subject: Subject) -> Iterator[_Reason]:
    """Yield what launch files of ROS 1 include from packages that are not available."""
    launch = subject.one(LaunchEntries)
    for include in () if isinstance(launch, NotAvailable) else launch.graph.unresolved_includes:
        path = SharePath(include.package, include.file)
        if include.package and (why := unavailable(subject.package, path)):
            file = include.span.source.file
            yield _Reason(
                f"{file} includes $(find {include.package})/{include.file}: {why}",
                bool(distributions_with(include.package)),
            )


def _elsewhere(package: Package, graphs: Iterable[LaunchGraph]) -> Iterator[_Reason]:
    """Yield what launch files take from packages that are not available, each file of it once."""
    files: dict[tuple[str, bool], dict[str, None]] = {}
    for graph in graphs:
        for named in named_paths(graph):
            concerns = named.needed and (
                named.include or named.path.path.endswith(robot_suffixes())
            )
            if concerns and (why := unavailable(package, named.path)):
                what = "includes" if named.include else "takes the robot from"
                released = named.include and bool(distributions_with(named.path.package))
                taken = f"{what} {named.path}: {why}"
                files.setdefault((taken, released), {})[graph.file] = None
    for (taken, released), (first, *others) in files.items():
        more = f" (and so with {count(len(others), 'more launch file')})" if others else ""
        yield _Reason(f"{first} {taken}{more}", released)


def _of_mujoco(subject: Subject) -> Iterator[_Reason]:
    """Yield why there is no model of MuJoCo although files of one are there."""
    models = subject.one(MjcfModel)
    if isinstance(models, NotAvailable) and models.applicable:
        yield _Reason(models.reason)


def _of_misnamed_model(package: Package) -> Iterator[_Reason]:
    """Yield that the model of a package has the name of an SDF file, and contains URDF."""
    model = own_model(package)
    document = package.xml(model) if model is not None and not package.only else None
    if isinstance(document, XmlDocument) and document.root.tag == "robot":
        yield _Reason(f"{model} is URDF by its root element, and is not read: name it .urdf")


def _of_templates(package: Package) -> Iterator[_Reason]:
    for file in package.index.files:
        if _TEMPLATE.search(file.path):
            reason = f"{file.path} is a template, which is not read: check the model that it makes"
            yield _Reason(reason)
