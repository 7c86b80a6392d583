"""The specification sheet of a package, and the sensor devices of its robots."""

from __future__ import annotations

from checker.base.files import NotReadable
from checker.base.parts import NotAvailable, part
from checker.model.devices.devices import SensorDevices
from checker.model.devices.known import KnownDevices
from checker.model.devices.sensors import find_sensor_devices
from checker.model.robot import Robot
from checker.model.specification.sheet import Specification, read_specification
from checker.package.configuration import configuration_number
from checker.package.inheritance import Missing
from checker.package.kind import PackageKind
from checker.package.package import Package


@part
def specification(package: Package) -> Specification | NotAvailable:
    """Return the specification sheet."""
    if package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
        return NotAvailable("the package needs no specifications.md", applicable=False)
    sheet = package.part("specifications.md")
    if isinstance(sheet, Missing):
        # PKG003 reports a sheet that is nowhere; one of a sibling may say anything.
        return NotAvailable(sheet.reason, applicable=sheet.package_not_at_hand is not None)
    source = package.read(sheet.path)
    if isinstance(source, NotReadable):
        return NotAvailable(f"{sheet.path} {source.reason}")
    return read_specification(source)


@part
def sensor_devices(
    robots: tuple[Robot, ...],
    specification: Specification | NotAvailable,
    package: Package,
    devices: KnownDevices,
) -> SensorDevices:
    """Return the devices that sensors represent, as far as sheet or model identify them."""
    sheet = None if isinstance(specification, NotAvailable) else specification
    path = package.model_path
    numbers = {configuration_number(package)}
    if not isinstance(path, Missing):
        numbers.add(configuration_number(path.package))
    by_robot = [find_sensor_devices(robot, devices, sheet, numbers) for robot in robots]
    known = tuple(device for each in by_robot for device in each.known)
    return SensorDevices(known, by_robot[0].diversions)
