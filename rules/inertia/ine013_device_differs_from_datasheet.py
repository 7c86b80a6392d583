"""The mass, size or inertia of a known sensor differs from its datasheet.

A link that is named after a device and carries its sensor models that device. An Ouster OS-1 weighs
380 g and is 84 mm wide and 73 mm high; a model with 3.8 kg is wrong by one digit. The inertia is
compared with that of a solid of the device's mass and size. Mounts, frames without shapes, and
sensors that are part of a chassis are not judged. If a figure does not come from a datasheet or a
similar source, this is an info.

Fix: take mass and size from the datasheet, and compute the inertia with the formula of a solid
cylinder or box.
Source: the seed tutorial "Simulating the Ouster OS-1" for that device; `devices.json` names others.
"""

import re
from collections.abc import Iterator

from checker.model.components import Link
from checker.model.devices.devices import Device
from checker.model.devices.known import KnownDevices, spaced
from checker.model.geometry.boxes import box_around
from checker.model.robot import Robot
from checker.physics.mass.link_geometry import not_looked_at, solid
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Span

_BESIDE = re.compile(
    r"\b(?:adapt[eo]r|arm|attach|base plate|bracket|cable|cage|case|cover|frame|guard|holder|joint"
    r"|mount|optical|plate|pole|protector|ring|scan|stand|support|tower)(?:s|ed|ing|ment)?\b",
    re.I,
)
"""Words for parts that hold or cover a device."""


@rule("INE013", "device-differs-from-datasheet", Severity.WARNING, Concern.ROBOT)
def check(masses: MassProperties, known: KnownDevices, *, tolerance: float = 0.1) -> Findings:
    """Report devices that differ from their datasheets; figures from memory are infos.

    Options:
        tolerance: Share of the expected figure by which the mass, each side of the size and each
            principal moment may differ.
    """
    robot = masses.robot
    for inertia in masses.links.values():
        link = inertia.link
        device = _device(robot, link, known)
        if device is None or link.inertial is None:
            continue
        unknown = not_looked_at(robot, link)
        if unknown:
            yield unchecked(unknown)
            continue
        severity = Severity.INFO if device.is_from_memory("body") else Severity.WARNING
        for where, what in _differences(robot, inertia, device, tolerance):
            yield finding(
                where,
                f"link {link.name.value!r} {what} ({device.name})",
                severity=severity,
            )


def _device(robot: Robot, link: Link, known: KnownDevices) -> Device | None:
    """Return the device that a link models, found by its name, its shapes and its sensors."""
    names = [link.name.value] + ([robot.name.value] if len(robot.links) == 1 else [])
    text = " ".join(names)[:200]
    if _BESIDE.search(spaced(text)) or not solid((*link.collisions, *link.visuals)):
        return None
    # Where sensors can be in other files, the name has to do.
    stated = robot.conventions.states_devices
    types = [sensor.type.value for sensor in link.sensors] if stated else None
    device = known.find_in_name(text, types)
    return device if device is not None and device.body else None


def _differences(
    robot: Robot, inertia: LinkInertia, device: Device, tolerance: float
) -> Iterator[tuple[Span, str]]:
    """Yield the differences, each with the place that states it."""
    link = inertia.link
    mass = _mass(device)
    if link.scoped_name in robot.unknown_masses:
        mass = None
    if mass is not None and _off(inertia.mass, mass, tolerance):
        stated = link.inertial.mass.span if link.inertial is not None else link.span
        yield stated, f"weighs {inertia.mass:.4g} kg, expected {mass:g} kg"
    size = _size(device)
    if size is None:
        return
    sizes = _sizes(robot, link)
    if sizes and all(_any_off(lengths, sorted(size), tolerance) for lengths in sizes):
        measured = " × ".join(f"{1000 * length:.3g}" for length in sizes[0])
        expected = " × ".join(f"{1000 * length:.3g}" for length in sorted(size))
        yield link.span, f"measures {measured} mm, expected {expected} mm"
    moments = _moments(device, mass, size) if mass is not None else None
    if moments is not None and _any_off(inertia.principal, moments, tolerance):
        measured = ", ".join(f"{moment:.3g}" for moment in inertia.principal)
        expected = ", ".join(f"{moment:.3g}" for moment in moments)
        yield (
            inertia.moments_span,
            f"has the principal moments {measured} kg·m², expected {expected} kg·m²",
        )


def _off(value: float, expected: float, tolerance: float) -> bool:
    return not abs(value - expected) <= tolerance * expected


def _any_off(values: tuple[float, ...], expected: list[float], tolerance: float) -> bool:
    return any(_off(a, b, tolerance) for a, b in zip(values, expected, strict=True))


def _mass(device: Device) -> float | None:
    """Return the mass in kilograms; None if it is not known."""
    mass = device.body.get("mass_kg")
    return None if mass is None else float(mass)


def _size(device: Device) -> tuple[float, float, float] | None:
    """Return x, y, z in metres; None if they are not known."""
    size = {name: length / 1000 for name, length in device.body.get("size_mm", {}).items()}
    if "diameter" in size:
        return (size["diameter"], size["diameter"], size["height"])
    return (size["x"], size["y"], size["z"]) if size else None


def _moments(device: Device, mass: float, size: tuple[float, float, float]) -> list[float]:
    """Return the principal moments of a solid cylinder or box, ascending, kg·m²."""
    x, y, z = size
    if "diameter" in device.body["size_mm"]:
        across, along = mass * (3 * x * x / 4 + z * z) / 12, mass * x * x / 8
        return sorted((across, across, along))
    return sorted(mass / 12 * (a * a + b * b) for a, b in ((x, y), (x, z), (y, z)))


def _sizes(robot: Robot, link: Link) -> list[tuple[float, ...]]:
    """Return the sizes of collisions and of visuals, each ascending, metres."""
    frame = robot.pose_of(link.scoped_name)
    sizes = []
    for shapes in (link.collisions, link.visuals):
        placed = []
        for shape in solid(shapes):
            pose = robot.pose_of_part(link, shape.pose)
            if frame is not None and pose is not None:
                placed.append((shape.geometry, frame.inverse @ pose))
        box = box_around(placed, robot.scaled_meshes)
        if box is not None:
            sizes.append(tuple(sorted(b - a for a, b in zip(box.low, box.high, strict=True))))
    return sizes


_FINE = "<ixx>3.3631e-4</ixx><iyy>3.3631e-4</iyy><izz>3.3516e-4</izz>"


def _lidar(
    mass: str = "0.38</mass>",
    moments: str = _FINE,
    width: float = 0.042,
    name: str = "os1_sensor",
    marks: tuple[str, str] = ("", ""),
) -> str:
    return f"""
<link name="{name}">{marks[0]}
  <inertial>
    <mass>{mass}
    <inertia>{marks[1]}{moments}</inertia>
  </inertial>
  <collision name="c">
    <geometry><cylinder><radius>{width}</radius><length>0.073</length></cylinder></geometry>
  </collision>
  <sensor name="lidar" type="gpu_lidar"/>
</link>
"""


_MARK = "  <!-- ^ INE013 -->"
_COARSE = "<ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz>"
GOOD = [
    _lidar(),
    _lidar(mass="2.0</mass>", name="os1_mount"),
    _lidar(mass="2.0</mass>", name="lidar_mast"),
]
BAD = [
    _lidar(mass="3.8</mass>" + _MARK),
    _lidar(width=0.084, marks=(_MARK, "")),
    _lidar(moments=_COARSE, marks=("", _MARK)),
]
