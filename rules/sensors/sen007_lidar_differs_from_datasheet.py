"""A lidar's rows, vertical field of view, range or rate differ from its device.

Readers of "VLP-16" in specifications.md expect 16 rows over 30 degrees and 100 m. With a rate that
the device does not have, such as 15 Hz for an Ouster, the model publishes points that the real
device cannot. Where the list of sensors says just "3D lidar", a device that a link or another line
of specifications.md names counts, if it is the only one of its class. A figure of a lidar that
"Diversions from Physical Hardware" mentions is not reported. If nothing names the device, a range
that no lidar of this shape has is an info. A figure that was never compared with a datasheet is
also an info.

Fix: write the figures of the datasheet, or describe the difference under "Diversions from Physical
Hardware" in specifications.md.
Source: reviews of SubT models; `devices.json` names others, figure by figure.
"""

from collections.abc import Iterator, Sequence

from checker.base.record import Record
from checker.base.words import or_list
from checker.model.components import Sensor
from checker.model.devices.devices import Device, SensorDevice, SensorDevices
from checker.model.devices.known import KnownDevices, devices_of_shape, vertical_degrees
from checker.model.robot import Robot
from checker.model.sensing.lidar import Lidar
from checker.rule import Concern, Finding, Findings, HasSpan, Severity, finding, rule

_SPOKEN_OF = {
    "rows": r"\brows?\b|\bchannels?\b|\bbeams?\b|\brays?\b|\blayers?\b",
    "vfov_deg": r"\bfov\b|\bfield of view\b|\bangles?\b|\bvertical",
    "range_max": r"\branges?\b|\bdistances?\b|\breach|\bfar\b",
    "range_min": r"\branges?\b|\bdistances?\b|\bnear\b|\bblind",
    "rates": r"\brates?\b|\bhz\b|\bfrequenc",
}
"""Words with which "Diversions" mentions a figure."""


_ROUNDED = 1e-9
"""Metres that a difference of two decimals is off."""


class _Difference(Record, eq=False):
    """A wrong figure: its place, its kind, the stated and the expected value."""

    where: HasSpan
    figure: str
    stated: str
    expected: str


@rule("SEN007", "lidar-differs-from-datasheet", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot,
    devices: SensorDevices,
    known: KnownDevices,
    *,
    tolerance: float = 0.05,
    angle: float = 1.0,
    near: float = 0.02,
    near_share: float = 0.1,
) -> Findings:
    """Report figures that differ from those of the datasheet.

    Options:
        tolerance: Share by which the greatest range and the rate may differ from the datasheet's.
        angle: Degrees by which the lowest and the highest row may differ from the datasheet's; also
            used to find lidars of the same shape.
        near: Metres by which the minimum range may differ from the datasheet's.
        near_share: Share of the datasheet's minimum range by which it may differ, where that is
            less: below 0.2 m with the default of both.
    """
    for sensor in robot.sensors:
        lidar = sensor.lidar
        if lidar is None or not sensor.kind.is_lidar:
            continue
        named = devices.device_of(sensor)
        if named is None:
            yield from _by_shape(sensor, lidar, known, tolerance, angle)
            continue
        differences = [
            *_rows(lidar, named.device),
            *_vertical(lidar, named.device, angle),
            *_farthest(lidar, named, tolerance),
            *_nearest(lidar, named, near, near_share),
            *_rate(sensor, named.device, tolerance),
        ]
        for difference in differences:
            if not devices.are_diverted(named.device, _SPOKEN_OF[difference.figure]):
                yield _finding(sensor, named, difference)


def _rows(lidar: Lidar, device: Device) -> Iterator[_Difference]:
    rows = device.values.get("rows")
    if rows is None:
        return
    variants = rows if isinstance(rows, list) else [rows]
    if lidar.rows not in variants:
        stated = f"has {lidar.rows:g} rows"
        yield _Difference(lidar.vertical.samples, "rows", stated, or_list(variants))


def _vertical(lidar: Lidar, device: Device, tolerance: float) -> Iterator[_Difference]:
    expected = device.values.get("vfov_deg")
    scan = lidar.vertical
    if expected is None or not scan.lower.stated or not scan.upper.stated:
        return
    stated = vertical_degrees(lidar)
    off = [abs(a - b) > tolerance for a, b in zip(stated, expected, strict=True)]
    if any(off):
        yield _Difference(
            scan.lower if off[0] else scan.upper,
            "vfov_deg",
            f"looks from {scan.lower.value!r} to {scan.upper.value!r} rad vertically "
            f"({stated[0]:.3g} to {stated[1]:.3g} degrees)",
            f"{expected[0]:g} to {expected[1]:g} degrees",
        )


def _farthest(lidar: Lidar, named: SensorDevice, tolerance: float) -> Iterator[_Difference]:
    farthest = _known_values(named, "range_max")
    value = lidar.range_max
    if value.stated and not _is_near(value.value, farthest, tolerance):
        yield _Difference(
            value,
            "range_max",
            f"has a maximum range of {value.value:g} m",
            f"{or_list(farthest)} m",
        )


def _nearest(
    lidar: Lidar, named: SensorDevice, tolerance: float, share: float
) -> Iterator[_Difference]:
    nearest = _known_values(named, "range_min")
    value = lidar.range_min
    if (
        value.stated
        and nearest
        and all(abs(value.value - m) > min(tolerance, share * m) + _ROUNDED for m in nearest)
    ):
        stated = f"has a minimum range of {value.value:g} m"
        yield _Difference(value, "range_min", stated, f"{or_list(nearest)} m")


def _known_values(named: SensorDevice, figure: str) -> list[float]:
    """Return the figure of the datasheet, and accepted alternatives."""
    values = named.device.values
    if figure not in values:
        return []
    words = "".join(letter for letter in named.words.value.upper() if letter.isalnum())
    by_model = values.get(f"{figure}_by_model", {})
    of_model = [value for model, value in by_model.items() if model.upper() in words]
    defaults = values.get("seed_defaults", {})
    others = [*values.get(f"{figure}_seen", []), *(defaults[k] for k in (figure,) if k in defaults)]
    return sorted({float(number) for number in (*(of_model or [values[figure]]), *others)})


def _rate(sensor: Sensor, device: Device, tolerance: float) -> Iterator[_Difference]:
    rates = [float(rate) for rate in device.values.get("rates", ())]
    rate = sensor.update_rate
    if rate.stated and rate.value > 0 and not _is_near(rate.value, rates, tolerance):
        yield _Difference(rate, "rates", f"measures at {rate.value:g} Hz", f"{or_list(rates)} Hz")


def _is_near(value: float, expected: Sequence[float], tolerance: float) -> bool:
    """Return whether a value is close to an expected one; always, if none is known."""
    return not expected or any(abs(value - number) <= tolerance * number for number in expected)


def _finding(sensor: Sensor, named: SensorDevice, difference: _Difference) -> Finding:
    device = named.device
    return finding(
        difference.where,
        f"lidar {sensor.name.value!r} {difference.stated}, "
        f"expected {difference.expected} ({device.name})",
        severity=Severity.INFO if device.is_from_memory(difference.figure) else None,
        key=f"{device.id} {difference.stated}",
        related=[(named.words, "names the device")],
    )


def _by_shape(
    sensor: Sensor, lidar: Lidar, known: KnownDevices, tolerance: float, angle: float
) -> Iterator[Finding]:
    """Compare the range of a lidar without a named device with that of devices of its shape."""
    alike = [
        device for device in devices_of_shape(lidar, known, angle) if "range_max" in device.values
    ]
    ranges = sorted({float(device.values["range_max"]) for device in alike})
    reach = lidar.range_max
    if reach.stated and not _is_near(reach.value, ranges, tolerance):
        yield finding(
            reach,
            f"lidar {sensor.name.value!r} has the rows of a {alike[0].name} and a maximum range "
            f"of {reach.value:g} m, expected, as for lidars of this shape, {or_list(ranges)} m",
            severity=Severity.INFO,
            key=f"shape {reach.value:g}",
        )


def _lidar(
    *,
    name: str = "vlp16",
    rate: str = "10",
    rows: str = "16",
    lower: str = "-0.2618",
    nearest: str = "0.05",
    reach: str = "100",
) -> str:
    return f"""
<sensor name="{name}" type="gpu_lidar">
  <update_rate>{rate}</update_rate>
  <lidar>
    <scan>
      <vertical>
        <samples>{rows}</samples>
        <min_angle>{lower}</min_angle>
        <max_angle>0.2618</max_angle>
      </vertical>
    </scan>
    <range>
      <min>{nearest}</min>
      <max>{reach}</max>
    </range>
  </lidar>
</sensor>
"""


def _marked(text: str, part: str) -> str:
    return text.replace(part, f"{part}  <!-- ^ SEN007 -->", 1)


_SHEET = "# Rover\n### Sensors\n* Velodyne VLP-16 lidar, modeled by `gpu_lidar` plugin\n"
_DIVERSIONS = "### Diversions from Physical Hardware\nThe lidar's range is shortened to 50 m.\n"
_PLAIN = "# Rover\n### Sensors\n* 3D lidar, modeled by `gpu_lidar` plugin\n"
_LINKS = "### Links\n* [lidar](https://velodynelidar.com/vlp-16.html)\n"
_S1 = _lidar(name="rplidar_s1", rows="1", nearest="0.1", reach="40")
_OS0 = _lidar(name="os0", rows="64", lower="-0.785", nearest="0.3", reach="50").replace(
    "0.2618<", "0.785<"
)

GOOD = [
    _lidar(),
    _lidar(nearest="0.3"),
    _lidar(name="scanner"),
    _lidar(name="scanner", rows="24", reach="75"),
    _OS0,
    _S1,
    _S1.replace("<min>0.1<", "<min>0.109<"),
    {"@fragment": _lidar(name="scanner", rows="24", reach="75"), "specifications.md": _PLAIN},
    {
        "@fragment": _lidar(name="scanner", rows="24", reach="75"),
        "specifications.md": _PLAIN + _LINKS + "* [other lidar](https://ouster.com/os0)\n",
    },
    {
        "@fragment": _lidar(name="front_laser", reach="50"),
        "specifications.md": _SHEET + _DIVERSIONS,
    },
]
BAD = [
    _marked(_lidar(rows="8"), "<samples>8</samples>"),
    _marked(_lidar(lower="-0.5"), "<min_angle>-0.5</min_angle>"),
    _marked(_lidar(reach="300"), "<max>300</max>"),
    _marked(_lidar(rate="12"), "<update_rate>12</update_rate>"),
    _marked(_OS0.replace("<min>0.3", "<min>0.1"), "<min>0.1</min>"),
    _marked(_S1.replace("<min>0.1", "<min>0.115"), "<min>0.115</min>"),
    _marked(_lidar(name="scanner", reach="75"), "<max>75</max>"),
    {
        "@fragment": _marked(_lidar(name="front_laser", reach="50"), "<max>50</max>"),
        "specifications.md": _SHEET,
    },
    {
        "@fragment": _marked(_lidar(name="scanner", reach="50"), "<max>50</max>"),
        "specifications.md": _PLAIN + _LINKS,
    },
]
