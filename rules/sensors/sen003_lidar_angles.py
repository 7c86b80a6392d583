"""A lidar whose angles span more than a full turn, or are reversed or equal.

A full turn from -3.1459 to 3.1459 is 0.5 degrees too large: the last rays see what the first ones
saw, and every point of the cloud is slightly wrong. In the challenge a full turn goes from -π to π,
as on all other robots, and not from 0 to 2π; for later releases of Gazebo that is information,
since many devices do so. If the first angle is not below the last, all rays point in one direction
or the scan is mirrored.

Fix: write -3.141592653589793 and 3.141592653589793 for a full turn, and the smaller angle first.
Source: reviews of SubT models, which had 3.1459 and 0 … 6.283 corrected to ±3.14159.
"""

import math
from collections.abc import Iterator

from checker.finding import Fix
from checker.model.robot import Robot
from checker.model.sensing.lidar import Scan
from checker.rule import Concern, Context, Finding, Findings, Safety, Severity, finding, rule

_TURN = 2 * math.pi
_NEAR = 0.1
"""Radians: an angle this close to a full turn is meant to be one."""


@rule("SEN003", "lidar-angles", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot, context: Context, *, tolerance: float = 1e-3, near: float = _NEAR
) -> Findings:
    """Report scans over more than a full turn, from 0 to 2π, or without width.

    Options:
        tolerance: Radians by which a scan may exceed a full turn; more is reported.
        near: Radians within which the ends of a scan count as 0 and 2π, which is reported, and its
            width counts as a full turn, which the fix writes as -π to π.
    """
    for sensor in robot.sensors:
        lidar = sensor.lidar
        if lidar is None or not sensor.kind.is_lidar:
            continue
        name = f"lidar {sensor.name.value!r}"
        usual = Severity.INFO if context.of_gazebo_sim else None
        yield from _one_way(f"{name} scans", lidar.horizontal, tolerance, near, usual)
        yield from _one_way(f"{name} scans vertically", lidar.vertical, tolerance, near, usual)


def _one_way(
    phrase: str, scan: Scan, tolerance: float, near: float, usual: Severity | None
) -> Iterator[Finding]:
    lower, upper = scan.lower.value, scan.upper.value
    if not math.isfinite(lower) or not math.isfinite(upper):
        return
    phrase = f"{phrase} from {lower:.6g} to {upper:.6g} rad"
    full_turn = _written(scan, -math.pi, math.pi) if abs(scan.angle - _TURN) < near else None
    if scan.angle > _TURN + tolerance:
        over = f"{phrase}, {scan.angle - _TURN:.2g} rad more than a full turn"
        expected = ": expected -π to π" if full_turn is not None else ""
        yield finding(scan.lower, over + expected, key=f"over {scan.angle:.6g}", fix=full_turn)
    elif abs(lower) < near and abs(upper - _TURN) < near:
        yield finding(
            scan.lower,
            f"{phrase}: expected -π to π",
            severity=usual,
            key="from 0",
            fix=full_turn,
        )
    elif scan.angle <= 0 and scan.samples.value > 1:
        swapped = _written(scan, upper, lower) if scan.angle < 0 else None
        yield finding(
            scan.upper,
            f"{phrase} with {scan.samples.value:g} samples: expected the first angle below "
            "the last",
            key=f"no width {lower:.6g} {upper:.6g}",
            fix=swapped,
        )


def _written(scan: Scan, lower: float, upper: float) -> Fix | None:
    """Return the fix that writes other angles; None if the file states none."""
    if not scan.lower.stated or not scan.upper.stated:
        return None
    edits = (
        scan.lower.span.replaced_by(repr(lower)),
        scan.upper.span.replaced_by(repr(upper)),
    )
    return Fix(Safety.UNSAFE, edits)


def _lidar(lower: str, upper: str, samples: int = 1800, rows: str = "") -> str:
    return f"""
<sensor name="front_laser" type="gpu_lidar">
  <lidar>
    <scan>
      <horizontal>
        <samples>{samples}</samples>
        <min_angle>{lower}
        <max_angle>{upper}
      </horizontal>
      {rows}
    </scan>
  </lidar>
</sensor>
"""


_MARK = "  <!-- ^ SEN003 -->"
_LOW, _HIGH = "-3.141592653589793</min_angle>", "3.141592653589793</max_angle>"
GOOD = [
    _lidar(_LOW, _HIGH),
    _lidar("-3.1416</min_angle>", "3.1416</max_angle>"),
    _lidar("0</min_angle>", "4.7</max_angle>"),
    _lidar("3.14</min_angle>", "3.14</max_angle>", samples=1),
    _lidar(_LOW, _HIGH, rows="<vertical><samples>1</samples></vertical>"),
]
BAD = [
    _lidar("-3.1459</min_angle>" + _MARK, "3.1459</max_angle>"),
    _lidar("-180</min_angle>" + _MARK, "180</max_angle>"),
    _lidar("0</min_angle>" + _MARK, "6.283185307</max_angle>"),
    _lidar("0.1</min_angle>", "-0.1</max_angle>" + _MARK, samples=9),
    _lidar("0.1</min_angle>", "0.1</max_angle>" + _MARK, samples=9),
    _lidar(_LOW, _HIGH, rows="<vertical><samples>16</samples></vertical>" + _MARK),
]
