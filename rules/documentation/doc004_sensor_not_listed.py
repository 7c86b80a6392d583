"""A sensor of the model that specifications.md does not list.

Teams choose a robot by its specification sheet: they do not use a sensor that is not listed, and
the real robot may not carry it. Every robot has a gas detector and a barometer, which need no
entry. Most IMUs contain a magnetometer; a missing one is an info.

Fix: list the sensor in the section "Sensors" with its device and the type that models it, or remove
it from the model.
Source: SubT maintainers compare model and specifications.md sensor by sensor; a review required the
    thermal camera to be listed.
"""

from collections import defaultdict
from collections.abc import Iterator

from checker.model.components import Sensor
from checker.model.devices.known import KnownDevices, known_devices
from checker.model.robot import Robot
from checker.model.specification.quantities import configurations_in
from checker.model.specification.sensor_kinds import SUBSTITUTES, TYPES, SensorKind, kinds_in
from checker.model.specification.sheet import Section, Specification
from checker.package.package import Package
from checker.package.submissions import configuration_number
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.markdown import PassageKind

EXEMPT = ("air_pressure",)
MINOR = ("magnetometer",)
MOST_PASSAGES = 1000
NOTED = 8


@rule("DOC004", "sensor-not-listed", Severity.WARNING, Concern.PAPERWORK)
def check(
    package: Package,
    robot: Robot,
    specification: Specification,
    *,
    exempt: tuple[str, ...] = EXEMPT,
    minor: tuple[str, ...] = MINOR,
) -> Findings:
    """Compare the model's types of sensors with what the section names for this configuration.

    Options:
        exempt: Values of the `type` of a `<sensor>` that need no entry in specifications.md.
        minor: Values of the `type` of a `<sensor>` that are reported as an info instead of a
            warning when specifications.md does not list them.
    """
    section = specification.section("sensors")
    if section is None or specification.says_nothing(section) or not specification.sensors:
        return
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
    if specification.other_sensors:
        yield unchecked(
            f"specifications.md refers to {specification.other_sensors} for its sensors"
        )
        return
    texts = list(_texts(section, configuration_number(package.name)))
    listed = _types_in(texts, {sensor.type.value for sensor in robot.sensors})
    devices = known_devices()
    unlisted = defaultdict(list)
    for sensor in robot.sensors:
        kind = _kind(sensor)
        if kind is not None and sensor.type.value not in (*exempt, *listed):
            unlisted[kind].append(sensor)
    for kind, sensors in unlisted.items():
        if not _is_named(devices, texts, sensors[0]):
            name = kind.value.replace("_", " ")
            yield finding(
                section,
                f"specifications.md lists no {name}, but the model has {len(sensors)}",
                severity=Severity.INFO if sensors[0].type.value in minor else None,
                related=[(sensor, f"sensor {sensor.name.value!r}") for sensor in sensors[:NOTED]],
            )


def _texts(section: Section, number: int | None) -> Iterator[str]:
    """Yield what the section states about one configuration, or about all."""
    lead: frozenset[int] = frozenset()
    for passage in section.passages[:MOST_PASSAGES]:
        named = configurations_in(passage.words)
        if passage.kind is not PassageKind.ITEM:
            lead = named
        # Later configurations add to earlier ones: `Sensor Config 2 adds 12 breadcrumbs`.
        applies = named or lead
        if not applies or number is None or min(applies) <= number:
            yield passage.words


def _types_in(texts: list[str], carried: set[str]) -> frozenset[str]:
    """Return the types of `<sensor>` that words may mean.

    Words for cameras mean cameras that also measure depth only on a robot without other cameras.
    """
    kinds = {kind for text in texts for kind in kinds_in(text, text)}
    types = (
        own if carried & (own := TYPES.get(kind, frozenset())) else own | SUBSTITUTES.get(kind, own)
        for kind in kinds
    )
    return frozenset().union(*types)


def _is_named(devices: KnownDevices, texts: list[str], sensor: Sensor) -> bool:
    """Return whether a named device may be a sensor, although no word states its kind."""
    types = {sensor.type.value}
    return any(devices.find_in_text(text, types) is not None for text in texts)


def _kind(sensor: Sensor) -> SensorKind | None:
    """Return the kind of sensor in the words of a sheet; None for types that have none."""
    kinds = (kind for kind, types in TYPES.items() if sensor.type.value in types)
    return next(kinds, None)


_SHEET = "# Rover\n### Sensors{mark}\n"
_MARK = " <!-- ^ DOC004 -->"
_THERMAL = '<sensor name="t" type="thermal"/><sensor name="i" type="imu"/>'


def _example(sensors: str, items: str, mark: str = "") -> dict[str, str]:
    return {
        "@fragment": sensors,
        "specifications.md": _SHEET.format(mark=mark) + items,
    }


GOOD = [
    _example(_THERMAL, "* IMU: Microstrain GX5\n* 1 x thermal camera\n"),
    _example(_THERMAL, "It has an IMU.\n* FLIR Boson thermography\n"),
    _example('<sensor name="p" type="air_pressure"/>', "* IMU\n"),
    _example('<sensor name="c" type="rgbd_camera"/>', "* 2 x cameras that measure depth\n"),
    _example('<sensor name="l" type="gpu_lidar"/>', "* IMU\n* Velodyne VLP-16\n"),
    _example('<sensor name="l" type="gpu_lidar"/>', ""),
    _example('<sensor name="c" type="contact"/>', "* IMU\n"),
]
BAD = [
    _example(_THERMAL, "* IMU: Microstrain GX5\n", _MARK),
    _example('<sensor name="m" type="magnetometer"/>', "* IMU: Microstrain GX5\n", _MARK),
    _example(_THERMAL, "* IMU\n* Sensor configurations 3 and 4 carry a thermal camera\n", _MARK),
    _example(
        '<sensor name="c" type="camera"/>' + _THERMAL, "* thermal camera, IMU\n* IMU\n", _MARK
    ),
    _example(
        '<sensor name="c" type="camera"/><sensor name="d" type="rgbd_camera"/>',
        "* 2 x cameras\n",
        _MARK,
    ),
]
