"""Descriptions in URDF files."""

from __future__ import annotations

from contextlib import ExitStack

from checker.base.parts import NotAvailable, part
from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.expansion import Expander, XacroArguments
from checker.launch.ros2.graph import Ros2Launch
from checker.package.package import Package
from checker.robots.package_descriptions import PackageDescriptions
from checker.robots.urdf_files import UrdfFiles


@part
def package_descriptions(
    package: Package,
    expander: Expander,
    arguments: XacroArguments,
    launch: Ros2Launch | NotAvailable,
    ends: ExitStack,
) -> PackageDescriptions:
    """Return the URDF files that represent a robot, as they are being expanded."""
    ros2 = None if isinstance(launch, NotAvailable) else launch
    read = PackageDescriptions(package, expander, args=arguments.values, ros2=ros2)
    ends.callback(read.stop)
    return read


@part
def files(read: PackageDescriptions) -> UrdfFiles | NotAvailable:
    """Return the results of the URDF files."""
    if not read.applicable:
        return NotAvailable("no URDF file describes a robot", applicable=False)
    return read.files


@part
def descriptions(package: Package, files: UrdfFiles) -> tuple[UrdfDescription, ...] | NotAvailable:
    """Return the robots that URDF files describe."""
    if files.descriptions:
        return files.descriptions
    wrong = [f"{fault.file} cannot be expanded" for fault in files.faults]
    large = [f"{file.path} {file.reason}" for file in package.too_large]
    reasons = [*wrong, *files.unread, *files.unused, *large]
    reason = next(iter((*reasons, *files.set_aside)), "the URDF files contain no robot")
    return NotAvailable(reason, applicable=bool(reasons))
