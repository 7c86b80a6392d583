"""The parts of a package whose robots URDF files describe."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.model.urdf.description import UrdfDescription
from checker.model.urdf.files import UrdfFiles
from checker.model.urdf.package_descriptions import PackageDescriptions
from checker.package.kind import PackageKind

if TYPE_CHECKING:
    from checker.engine.subject import Subject
    from checker.expand.launch.package_launch import LaunchEntries
    from checker.model.control.controllers import ControlSystem


class UrdfParts(Record, eq=False, dict=True):
    """What URDF files describe, and what controls it.

    Attributes:
        subject: The package under review.
    """

    subject: Subject

    @cached_property
    def package_descriptions(self) -> PackageDescriptions:
        """The URDF files that stand for a robot, as they are being expanded."""
        subject, launch = self.subject, self.subject.ros2_launch
        ros2 = None if isinstance(launch, NotAvailable) else launch
        args = subject.xacro_args
        return PackageDescriptions(subject.package, subject.expander, args=args, ros2=ros2)

    @property
    def files(self) -> UrdfFiles | NotAvailable:
        """What became of the URDF files."""
        if self.subject.description is not None:
            return UrdfFiles((self.subject.description,))
        if not self.package_descriptions.applicable:
            return NotAvailable("no URDF file is a robot", applicable=False)
        return self.package_descriptions.files

    @cached_property
    def descriptions(self) -> tuple[UrdfDescription, ...] | NotAvailable:
        """The robots that URDF files describe."""
        files = self.files
        if isinstance(files, NotAvailable) or files.descriptions:
            return files if isinstance(files, NotAvailable) else files.descriptions
        wrong = [f"{fault.file} cannot be expanded" for fault in files.faults]
        large = [f"{file.path} {file.reason}" for file in self.subject.package.too_large]
        reasons = [*wrong, *files.unread, *large]
        reason = next(iter((*reasons, *files.set_aside)), "the URDF files contain no robot")
        return NotAvailable(reason, applicable=bool(reasons))

    @cached_property
    def launch_entries(self) -> LaunchEntries:
        """The launch files that a URDF package can be started with."""
        from checker.expand.launch.package_launch import LaunchEntries, launch_entries

        if self.subject.package.kind is not PackageKind.URDF_DESCRIPTION:
            return LaunchEntries()
        return launch_entries(self.subject.package)

    @cached_property
    def control(self) -> ControlSystem | NotAvailable:
        """What controls the joints of a URDF package."""
        alone = self.subject.package.only and self.package_descriptions.applicable
        if self.subject.package.kind is not PackageKind.URDF_DESCRIPTION and not alone:
            return NotAvailable("the package is not a URDF package", applicable=False)
        from checker.model.control.system import control_system

        package, robots = self.subject.package, self.subject.robots
        return control_system(package, self.launch_entries, robots, self.descriptions)
