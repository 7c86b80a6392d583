"""A lidar whose samples per row differ from those of the real device at this rate.

The model sees more or fewer points than the real robot, and too many slow down the simulation of
all robots. A VLP-16 measures 1800 to 1875 points per row at 10 Hz and 900 at 20 Hz. The number
10000 comes from an old template, together with a scan resolution of 0.1, and was copied into many
robots. A lidar that scans only part of a turn may have a proportional number of samples. If the
device's figure was never compared with a datasheet, the finding is an info. So are fewer samples
than the device's, outside the challenge: they save time.

Fix: write the number of samples that the device measures at the model's `<update_rate>`.
Source: reviews of SubT models; the seed tutorial "Simulating the Ouster OS-1"; `devices.json` has
the source of each other figure.
"""

import math
from collections.abc import Iterator

from checker.base.words import or_list
from checker.model.components import Sensor
from checker.model.devices.devices import Device, SensorDevice, SensorDevices
from checker.model.robot import Robot
from checker.model.sensing.lidar import Lidar
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule


@rule("SEN004", "lidar-samples", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot,
    devices: SensorDevices,
    context: Context,
    *,
    copied: int = 10_000,
    tolerance: float = 0.02,
) -> Findings:
    """Report rows of far too many samples, or of another number than the device has.

    Options:
        copied: Samples per row; this number or more is reported as copied from an old template,
            even if no device is known.
        tolerance: Share by which the samples per row may differ from those of the device at that
            rate; a difference of one sample is always accepted.
    """
    for sensor in robot.sensors:
        lidar = sensor.lidar
        if lidar is None or not sensor.kind.is_lidar:
            continue
        known = devices.device_of(sensor)
        if known is not None and "rays" in known.device.values:
            yield from _rays(sensor, lidar, known.device)
            continue
        expected = _expected_samples(sensor, lidar, known.device) if known is not None else []
        samples = lidar.horizontal.samples
        too_many = samples.value >= copied
        if too_many or (expected and not _fits(samples.value, expected, tolerance)):
            fewer = not context.is_subt and samples.value < min(expected, default=0.0)
            mild = fewer or (known is not None and _is_from_memory(known.device, too_many=too_many))
            yield _finding(sensor, lidar, known, expected, Severity.INFO if mild else None)


def _rays(sensor: Sensor, lidar: Lidar, device: Device) -> Iterator[Finding]:
    """Compare the number of rays of a device that measures a single distance."""
    rays = device.values["rays"]
    if lidar.rays not in (rays, 1):
        yield finding(
            lidar.horizontal.samples,
            f"lidar {sensor.name.value!r} has {lidar.rays:g} rays, expected {rays:g} "
            f"({device.name})",
            severity=Severity.INFO if device.is_from_memory("rays") else None,
            key=f"{device.id} {lidar.rays:g} rays",
        )


def _expected_samples(sensor: Sensor, lidar: Lidar, device: Device) -> list[float]:
    """Return the device's samples at the sensor's rate; at any rate if it has no such rate."""
    by_rate = {
        float(rate): samples for rate, samples in device.values.get("samples_by_rate", {}).items()
    }
    at_rate = by_rate.get(sensor.update_rate.value)
    listed = at_rate or [sample for samples in by_rate.values() for sample in samples]
    share = _share_of_turn(lidar, device)
    expected = [float(number) for number in listed]
    if share < 1 and any(samples > 1 for samples in expected):
        expected += [float(round(number * share)) for number in listed]
    defaults = device.values.get("seed_defaults", {})
    if expected and "samples" in defaults and sensor.update_rate.value == defaults.get("rate"):
        expected.append(float(defaults["samples"]))
    return sorted(set(expected))


def _share_of_turn(lidar: Lidar, device: Device) -> float:
    """Return the share of the device's field of view that a sensor covers."""
    whole = device.values.get("hfov_deg")
    if not whole or whole <= 0:
        return 1.0
    share = math.degrees(lidar.horizontal.angle) / float(whole)
    return share if 0 < share < 0.99 else 1.0


def _fits(samples: float, expected: list[float], tolerance: float) -> bool:
    return any(abs(samples - number) <= max(1.0, tolerance * number) for number in expected)


def _is_from_memory(device: Device, *, too_many: bool) -> bool:
    return device.is_from_memory("samples_by_rate") and not too_many


def _finding(
    sensor: Sensor,
    lidar: Lidar,
    known: SensorDevice | None,
    expected: list[float],
    severity: Severity | None,
) -> Finding:
    samples, rate = lidar.horizontal.samples, sensor.update_rate.value
    message = f"lidar {sensor.name.value!r} has {samples.value:g} samples per row"
    message += f" at {rate:g} Hz" if rate > 0 else ""
    if known is None or not expected:
        return finding(
            samples,
            f"{message}, a number copied from an old template: expected the number of the device",
            key="copied",
        )
    return finding(
        samples,
        f"{message}, expected {or_list(expected)} ({known.device.name})",
        severity=severity,
        key=f"{known.device.id} {samples.value:g} {rate:g}",
        related=[(known.words, "names the device")],
    )


def _lidar(
    samples: str, rate: float = 10, name: str = "vlp16", angle: float = 3.14159, rows: int = 16
) -> str:
    return f"""
<sensor name="{name}" type="gpu_lidar">
  <update_rate>{rate}</update_rate>
  <lidar>
    <scan>
      <horizontal>
        <samples>{samples}
        <min_angle>{-angle}</min_angle>
        <max_angle>{angle}</max_angle>
      </horizontal>
      <vertical><samples>{rows}</samples></vertical>
    </scan>
  </lidar>
</sensor>
"""


_END, _MARK = "</samples>", "</samples>  <!-- ^ SEN004 -->"
_SHEET = "# Rover\n### Sensors\n* Velodyne VLP-16 lidar, modeled by `gpu_lidar` plugin\n"

GOOD = [
    _lidar("1800" + _END),
    _lidar("1875" + _END),
    _lidar("900" + _END, rate=20),
    _lidar("900" + _END, angle=1.5708),
    _lidar("512" + _END, name="os1_lidar"),
    _lidar("720" + _END, name="scanner"),
    _lidar("1" + _END, rate=50, name="lidar_lite", angle=0.0, rows=1),
    _lidar("3" + _END, name="tf_mini", angle=0.03, rows=3),
    {"@fragment": _lidar("1800" + _END, name="front_laser"), "specifications.md": _SHEET},
    {
        "@fragment": _lidar("720" + _END, name="front_laser"),
        "specifications.md": _SHEET + "* Ouster OS0 lidar, modeled by `gpu_lidar` plugin\n",
    },
]
BAD = [
    _lidar("10000" + _MARK, name="scanner"),
    _lidar("10000" + _MARK),
    _lidar("1200" + _MARK),
    _lidar("1800" + _MARK, name="os1_lidar"),
    _lidar("7" + _MARK, name="tf_mini", angle=0.03, rows=3),
    "<!-- Based on RPLidar S1 -->" + _lidar("720" + _MARK, name="front_laser", rows=1),
    {"@fragment": _lidar("720" + _MARK, name="front_laser"), "specifications.md": _SHEET},
]
