"""Parts of launch: what the spawner of a package emits, and what its launch files start."""

from __future__ import annotations

from functools import partial

from checker.base.files import NotReadable
from checker.base.parts import NotAvailable, part
from checker.launch.ros1.graph import LaunchGraph
from checker.launch.ros1.package_launch import LaunchEntries, launch_entries, launch_graph
from checker.launch.ros2.graph import Ros2Launch
from checker.launch.ros2.package_launch import ros2_launch
from checker.launch.spawner.emitted_xml import (
    SpawnedXml,
    StartedXml,
    WorkspaceFiles,
    emitted_xml,
)
from checker.launch.spawner.reader import Spawner, read_spawner
from checker.package.inheritance import SPAWNER
from checker.package.kind import PackageKind
from checker.package.package import Package

_LAUNCHED = (PackageKind.URDF_DESCRIPTION, PackageKind.PLUGIN, PackageKind.UNKNOWN)
"""Kinds of packages of which any launch file may be the one that a person starts."""


@part
def spawner(package: Package) -> Spawner | NotAvailable:
    """Return the spawner, read without running it."""
    if package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
        return NotAvailable("the package needs no spawner", applicable=False)
    source = package.read(SPAWNER)
    if isinstance(source, NotReadable):
        return NotAvailable(f"{SPAWNER} {source.reason}")
    files = WorkspaceFiles(package)
    return read_spawner(files, files.entry, source)


@part
def spawned_xml(spawner: Spawner) -> SpawnedXml | NotAvailable:
    """Return what the function `spawner` emits."""
    return emitted_xml(partial(SpawnedXml, spawner=spawner), "spawner", spawner.spawn)


@part
def started(spawner: Spawner) -> StartedXml | NotAvailable:
    """Return what the function `rosExecutables` emits."""
    return emitted_xml(StartedXml, "rosExecutables", spawner.executables)


@part
def entries(package: Package) -> LaunchEntries:
    """Return the launch files that a package of ROS can be started with."""
    known = package.kind in _LAUNCHED
    return launch_entries(package) if known else LaunchEntries()


@part
def launch(
    package: Package, entries: LaunchEntries, started: StartedXml | NotAvailable
) -> LaunchGraph | NotAvailable:
    """Return what the launch files start that the spawner calls for; of a URDF package, all."""
    if package.kind is not PackageKind.URDF_DESCRIPTION:
        return launch_graph(package, started)
    if not entries.entries:
        return NotAvailable("the package has no launch files", applicable=False)
    return entries.graph


@part
def read_ros2_launch(package: Package) -> Ros2Launch | NotAvailable:
    """Return what the ROS 2 launch files of the package start."""
    return ros2_launch(package)
