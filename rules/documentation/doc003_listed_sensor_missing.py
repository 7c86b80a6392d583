"""A sensor that specifications.md lists and the model lacks.

Teams choose a robot by its specification sheet. They notice only in the first run that a listed
sensor is missing, or is modelled under another type.

Fix: add the sensor to the model, or correct specifications.md; write "modeled by a … sensor" if the
device's name does not contain the type.
Source: SubT maintainers compare specifications.md and model sensor by sensor in their reviews.
"""

from collections import defaultdict
from collections.abc import Sequence

from checker.model.robot import Robot
from checker.model.specification.sensor_kinds import SUBSTITUTES, TYPES, SensorKind
from checker.model.specification.sensors import ListedSensor
from checker.model.specification.sheet import Specification
from checker.package.configuration import configuration_number
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("DOC003", "listed-sensor-missing", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, robot: Robot, specification: Specification) -> Findings:
    """Compare the listed kinds with the model, and their numbers where they are clear."""
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    number = configuration_number(package)
    listed = [
        item
        for item in specification.sensors
        if item.kind in TYPES and (not item.configurations or number in item.configurations)
    ]
    families: dict[frozenset[str], list[ListedSensor]] = defaultdict(list)
    for item in listed:
        families[TYPES[item.kind]].append(item)
    present = [sensor.type.value for sensor in robot.sensors]
    for types, items in families.items():
        amount = sum(kind in types for kind in present)
        accepted = types.union(*(SUBSTITUTES.get(item.kind, frozenset()) for item in items))
        if not accepted.intersection(present):
            for item in items:
                message = f"specifications.md lists {_words(item)!r}, but the model has no"
                how = "list it in both or in neither"
                yield finding(item, f"{message} {_name(item.kind)} sensor: {how}")
        elif amount and (total := _total(items)) is not None and total != amount:
            if total < amount and specification.other_sensors:
                yield unchecked(
                    f"specifications.md refers to {specification.other_sensors} for its sensors"
                )
                continue
            yield finding(
                items[0],
                f"specifications.md lists {total} × {_name(items[0].kind)}, but the model "
                f"has {amount}",
                severity=Severity.WARNING,
                related=[(item, "also listed here") for item in items[1:]],
            )


def _total(items: Sequence[ListedSensor]) -> int | None:
    """Return how many the sheet lists; None unless every item states a number."""
    counts = [item.count for item in items]
    return sum(count for count in counts if count) if all(counts) else None


def _name(kind: SensorKind) -> str:
    return kind.value.replace("_", " ")


def _words(item: ListedSensor) -> str:
    text = " ".join(item.text.split()).rstrip(".")
    return f"{text[:77]}..." if len(text) > 80 else text


_SHEET = "# Rover\n### Sensors\n"
_SENSORS = """
<sensor name="front" type="camera"/><sensor name="rear" type="camera"/>
<sensor name="imu" type="imu"/>
"""

GOOD = [
    {
        "@fragment": _SENSORS,
        "specifications.md": _SHEET
        + "* 2x FLIR Blackfly, modeled by the camera plugin\n* IMU: Microstrain GX5\n",
    },
]
BAD = [
    {
        "@fragment": _SENSORS,
        "specifications.md": _SHEET
        + "* Velodyne VLP-16, modeled by the gpu_lidar plugin <!-- ^ DOC003 -->\n",
    },
    {
        "@fragment": _SENSORS,
        "specifications.md": _SHEET
        + "Others are listed in [base](base.md).\n* 4x FLIR Blackfly, a camera "
        "<!-- ^ DOC003 -->\n",
    },
    {
        "@fragment": _SENSORS,
        "specifications.md": _SHEET
        + "* 4x FLIR Blackfly, modeled by the camera plugin <!-- ^ DOC003 -->\n",
    },
]
