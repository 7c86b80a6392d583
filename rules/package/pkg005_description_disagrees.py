"""The description in model.config or package.xml names sensors that the model does not have.

Fuel and the catalogue show this text. If it says two depth cameras and the model has four, one of
them is wrong. Numbers are compared only if the text states all of them; a kind of sensor that the
model does not have is also reported. The name of a known device counts as its type of sensor: a
D435 is an RGBD camera. Devices that take several sensors to model, such as fisheye cameras, are not
counted.

Fix: correct the description, or the model.
Source: model reviews: the list of sensors in model.config against model.sdf.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence

from checker.base.record import Record
from checker.model.devices.devices import Device
from checker.model.devices.known import KnownDevices
from checker.model.robot import Robot
from checker.model.specification.sensor_kinds import SUBSTITUTES, TYPES, SensorKind, kinds_in
from checker.model.specification.sensors import stated_count
from checker.package.manifests import Paperwork
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located, Span

_CLAUSE = re.compile(
    r"(?:(?!\s(?:and|with|has|having|plus)\s|[,;:.()]\s|\s-\s)[^()]){1,400}", re.DOTALL | re.I
)
_POINT = re.compile(r"\b(?:ceiling|cliff|distance|floor|point|range) sensors?\b", re.IGNORECASE)
_FISHEYE = re.compile(r"\bfish-?eye\b|\bpanoram", re.IGNORECASE)
_LIST_MARK = re.compile(r"[\s,;:.-]*(?:(?:and|with|has|having|plus)\s+)?", re.IGNORECASE)
_ONE_MORE = re.compile(
    r"(?:an?|one)\s(?:front|rear|back|left|right|top|bottom|side|upper|lower)(?:[- ]facing)?", re.I
)


class _Mention(Record):
    """A kind of sensor that a clause names, and how many; None if it states no number."""

    kind: SensorKind
    count: int | None
    span: Span


_OF_DEVICES = {
    "lidar3d": SensorKind.LIDAR,
    "lidar2d": SensorKind.PLANAR_LIDAR,
    "lidar1d": SensorKind.POINT_LIDAR,
    "camera": SensorKind.CAMERA,
    "rgbd": SensorKind.RGBD_CAMERA,
    "depth": SensorKind.DEPTH_CAMERA,
    "thermal": SensorKind.THERMAL_CAMERA,
    "imu": SensorKind.IMU,
    "air pressure": SensorKind.AIR_PRESSURE,
    "gas": SensorKind.GAS,
}
"""Kinds of `devices.json` in words."""


@rule("PKG005", "description-disagrees", Severity.WARNING, Concern.PAPERWORK)
def check(robot: Robot, paperwork: Paperwork, devices: KnownDevices) -> Findings:
    """Compare kinds and numbers of sensors."""
    mentioned = [
        list(_described_sensors(paper.description, devices))
        for paper in (paperwork.config, paperwork.manifest)
        if paper is not None and paper.description.stated
    ]
    if any(mentioned) and robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    present = Counter(sensor.type.value for sensor in robot.sensors)
    for mentions in mentioned:
        yield from _compare(mentions, present)


def _compare(mentions: Sequence[_Mention], present: Counter[str]) -> Iterator[Finding]:
    """Compare what one text names with what there is."""
    families: dict[frozenset[str], list[_Mention]] = defaultdict(list)
    for mention in mentions:
        families[TYPES[mention.kind]].append(mention)
    for types, items in families.items():
        others = SUBSTITUTES.get(items[0].kind, frozenset())
        mentioned = any(TYPES[mention.kind] == others for mention in families.get(others, ()))
        amounts = _amounts(present, types, frozenset() if mentioned else others)
        total = _total(items)
        name = items[0].kind.value.replace("_", " ")
        if max(amounts) == 0:
            yield finding(
                items[0],
                f"the description names {name}, but the model has no such sensor",
                key=name,
            )
        elif total is not None and total not in amounts:
            yield finding(
                items[0],
                f"the description names {total} × {name}, but the model has {amounts[0]}",
                key=name,
            )


def _described_sensors(description: Located[str], devices: KnownDevices) -> Iterator[_Mention]:
    """Yield the sensors that the clauses of a description name, the first of each clause."""
    text = description.span.text
    further = 0
    for clause in _CLAUSE.finditer(text):
        mark = _LIST_MARK.match(clause.group())
        start = clause.start() + (mark.end() if mark else 0)
        words = " ".join(text[start : clause.end()].split())
        device = devices.find_in_text(words)
        kind = _kind(words, device)
        if kind not in TYPES:
            # "A front and a rear camera" are two.
            further = further + 1 if _ONE_MORE.fullmatch(words) else 0
        else:
            span = Span(
                description.span.source,
                description.span.start + start,
                description.span.start + clause.end(),
            )
            count = None if _is_several(words, device) else stated_count(words)
            yield _Mention(kind, count + further if count else count, span)
            further = 0


def _is_several(words: str, device: Device | None) -> bool:
    """Return whether the words name a device that is modelled by several sensors."""
    values = device.values if device is not None else {}
    return bool(_FISHEYE.search(words) or {"cameras", "cameras_per_device"} & values.keys())


def _kind(words: str, device: Device | None) -> SensorKind | None:
    """Return what words name: a device that is known, else the first kind of sensor in TYPES."""
    if _POINT.search(words):
        return SensorKind.POINT_LIDAR
    if device is not None and device.kind in _OF_DEVICES:
        return _OF_DEVICES[device.kind]
    return next((kind for kind in kinds_in(words, words) if kind in TYPES), None)


def _amounts(
    present: Counter[str], types: frozenset[str], others: frozenset[str]
) -> tuple[int, int, int]:
    """Return the numbers of sensors: of the types, of what the words may also mean, of both."""
    own = sum(present[kind] for kind in types)
    substitutes = sum(present[kind] for kind in others)
    return own, substitutes, own + substitutes


def _total(items: Sequence[_Mention]) -> int | None:
    counts = [item.count for item in items]
    return sum(count for count in counts if count) if all(counts) else None


def _config(description: str) -> str:
    return f"""<model>
  <description>{description}</description>  <!-- ^ PKG005 -->
</model>
"""


def _manifest(*items: str) -> str:
    lines = "\n".join(f"    - {item}" for item in items)
    return f"""<package format="2">
  <name>acme_rover_sensor_config_1</name>
  <description>The rover with:
{lines}
  </description>
</package>
"""


_MARK = "  <!-- ^ PKG005 -->"
_SENSORS = """
<sensor name="front" type="camera"/><sensor name="rear" type="rgbd_camera"/>
<sensor name="imu" type="imu"/>
"""

_TWO_CAMERAS = "A rover with two cameras and an IMU"
_FRONT_AND_REAR = "A rover with a front and a rear camera, and an IMU"

GOOD = [
    {
        "@fragment": _SENSORS,
        "model.config": f"<model><description>{_FRONT_AND_REAR}</description></model>",
    },
    {
        "@fragment": _SENSORS,
        "model.config": f"<model><description>{_TWO_CAMERAS}</description></model>",
    },
    {
        "@fragment": _SENSORS,
        "model.config": "<model><description>A camera, an RGBD camera, IMU.</description></model>",
    },
    {
        "@fragment": _SENSORS,
        "package.xml": _manifest("Realsense D435", "Two fisheye cameras", "IMU Xsens MTi-30"),
    },
]
BAD = [
    {"@fragment": _SENSORS, "model.config": _config("A rover with six cameras and an IMU")},
    {
        "@fragment": _SENSORS,
        "package.xml": _manifest(f"Velodyne VLP-16{_MARK}", f"3x Realsense D435{_MARK}", "IMU"),
    },
    {"@fragment": _SENSORS, "model.config": _config("Sensors: 3D lidar, two cameras")},
]
