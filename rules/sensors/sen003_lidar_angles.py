"""A lidar whose angles span more than a full turn, or are reversed or equal.

A full turn from -3.1459 to 3.1459 is 0.5 degrees too large: the last rays see what the first ones
saw, and every point of the cloud is slightly wrong. In the challenge a full turn goes from -π to π,
as on all other robots, and not from 0 to 2π; for later releases of Gazebo this is an info, because
many devices do so. If the first angle is not below the last, all rays point in one direction or the
scan is mirrored.

Fix: write the smaller angle first. For a full turn write -3.141592653589793 and 3.141592653589793,
or, for programs that expect ray 0 at the front, 0 and 6.283185307179586.
Source: reviews of SubT models, which had 3.1459 and 0 … 6.283 corrected to ±3.14159.
"""

import math
from collections.abc import Iterator

from checker.finding import Fix
from checker.model.robot import Robot
from checker.model.sensing.lidar import Scan
from checker.rule import Concern, Context, Finding, Findings, Safety, Severity, finding, rule

_TURN = 2 * math.pi
_AROUND = (-math.pi, math.pi)
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
            width counts as a full turn, which the fix writes: from 0 to 2π if it begins near 0.
    """
    for sensor in robot.sensors:
        lidar = sensor.lidar
        if lidar is None or not sensor.kind.is_lidar:
            continue
        name = f"lidar {sensor.name.value!r}"
        yield from _one_way(f"{name} scans", lidar.horizontal, tolerance, near, context)
        yield from _one_way(f"{name} scans vertically", lidar.vertical, tolerance, near, context)


def _one_way(
    phrase: str, scan: Scan, tolerance: float, near: float, context: Context
) -> Iterator[Finding]:
    lower, upper = scan.lower.value, scan.upper.value
    if not math.isfinite(lower) or not math.isfinite(upper):
        return
    phrase = f"{phrase} from {lower:.6g} to {upper:.6g} rad"
    if scan.angle > _TURN + tolerance:
        full_turn = abs(scan.angle - _TURN) < near
        # The first ray stays where programs look for it.
        ends, words = ((0.0, _TURN), "0 to 2π") if abs(lower) < near else (_AROUND, "-π to π")
        over = f"{phrase}, {scan.angle - _TURN:.2g} rad more than a full turn"
        expected = f": expected {words}" if full_turn else ""
        fix = _angles_fix(scan, *ends) if full_turn else None
        yield finding(scan.lower, over + expected, key=f"over {scan.angle:.6g}", fix=fix)
    elif abs(lower) < near and abs(upper - _TURN) < near:
        yield finding(
            scan.lower,
            f"{phrase}: expected -π to π",
            severity=None if context.is_subt else Severity.INFO,
            key="from 0",
            # It would turn ray 0 to the back, which only SubT requires.
            fix=_angles_fix(scan, *_AROUND) if context.profile == "subt" else None,
        )
    elif scan.angle <= 0 and scan.samples.value > 1:
        swapped = _angles_fix(scan, upper, lower) if scan.angle < 0 else None
        yield finding(
            scan.upper,
            f"{phrase} with {scan.samples.value:g} samples: expected the first angle below "
            "the last",
            key=f"no width {lower:.6g} {upper:.6g}",
            fix=swapped,
        )


def _angles_fix(scan: Scan, lower: float, upper: float) -> Fix | None:
    """Return the fix that writes other angles; None if the file states none."""
    if not scan.lower.stated or not scan.upper.stated:
        return None
    edits = (
        scan.lower.span.replacement(repr(lower)),
        scan.upper.span.replacement(repr(upper)),
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
