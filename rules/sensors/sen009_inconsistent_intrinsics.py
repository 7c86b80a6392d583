"""Camera intrinsics that do not match the image.

Every measurement made in the image is wrong: Gazebo renders it from width, height and
`horizontal_fov`, but publishes `camera_info` from `<intrinsics>`. In later releases the intrinsics
determine the image, which then does not have the stated field of view. The usual cause is
intrinsics copied from a camera of another resolution. For a calibrated camera, whose centre is not
at half the size, the finding is an info if the focal length is right.

Fix: write fx = fy = width / (2·tan(horizontal_fov / 2)), cx = (width - 1) / 2, cy = (height - 1) /
2 and s = 0, or correct `horizontal_fov`.
Source: projection of a pinhole camera; SubT review findings about wrong focal lengths. How releases
use the intrinsics is from memory of gz-sensors.
"""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from checker.finding import Fix
from checker.model.robot import Robot
from checker.model.sensing.camera import Intrinsics, Pinhole
from checker.model.sensing.kind import SensorType
from checker.rule import Concern, Findings, Safety, Severity, finding, rule
from checker.source.text import Located
from checker.source.xml_insertion import append_to


class _Wrong(NamedTuple):
    """A figure that does not match the image; `tag` is its element."""

    tag: str
    value: Located[float]
    expected: float


@rule("SEN009", "inconsistent-intrinsics", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, *, tolerance: float = 0.01, centre_tolerance: float = 1.0) -> Findings:
    """Compare intrinsics with the image.

    Options:
        tolerance: Share by which the focal lengths `<fx>` and `<fy>` may differ from those of the
            image.
        centre_tolerance: Pixels by which `<cx>` and `<cy>` may differ from half the image's width
            and height.
    """
    for sensor in robot.sensors:
        camera = sensor.camera
        if camera is None or camera.intrinsics is None or not sensor.kind.takes_pictures:
            continue
        if sensor.kind is SensorType.WIDE_ANGLE_CAMERA or camera.pinhole is None:
            continue
        intrinsics, picture = camera.intrinsics, camera.pinhole
        lengths = list(_wrong_lengths(intrinsics, picture, tolerance))
        others = list(_wrong_centre(intrinsics, picture, centre_tolerance))
        wrong = [*lengths, *others]
        if not wrong:
            continue
        stated = ", ".join(f"{entry.tag} = {entry.value.value:.6g}" for entry in wrong)
        expected = ", ".join(f"{entry.tag} = {entry.expected:.6g}" for entry in wrong)
        calibrated = intrinsics.are_measured and not lengths
        yield finding(
            intrinsics,
            f"camera {sensor.name.value!r} has the intrinsics {stated}, but an image of "
            f"{camera.width.value:g} × {camera.height.value:g} px with a field of view of "
            f"{camera.horizontal_fov.value:g} rad has {expected} px",
            severity=Severity.INFO if calibrated else None,
            key="calibrated" if calibrated else f"{stated}; {expected}",
            fix=_fix(intrinsics, wrong),
        )


def _wrong_lengths(intrinsics: Intrinsics, picture: Pinhole, tolerance: float) -> Iterator[_Wrong]:
    for tag, value, expected in (
        ("fx", intrinsics.fx, picture.fx),
        ("fy", intrinsics.fy, picture.fy),
    ):
        if not math.isclose(value.value, expected, rel_tol=tolerance):
            yield _Wrong(tag, value, expected)


def _wrong_centre(intrinsics: Intrinsics, picture: Pinhole, tolerance: float) -> Iterator[_Wrong]:
    """Yield wrong centres; a centre may include half a pixel and count from 0 or 1."""
    for tag, value, expected in (
        ("cx", intrinsics.cx, picture.cx),
        ("cy", intrinsics.cy, picture.cy),
    ):
        if not abs(value.value - (expected + 0.5)) <= tolerance:
            yield _Wrong(tag, value, expected)
    if intrinsics.skew.value != 0.0:
        yield _Wrong("s", intrinsics.skew, 0.0)


def _fix(intrinsics: Intrinsics, wrong: Sequence[_Wrong]) -> Fix:
    edits = [
        entry.value.span.replacement(f"{entry.expected:.6g}")
        for entry in wrong
        if entry.value.stated
    ]
    missing = [f"<{w.tag}>{w.expected:.6g}</{w.tag}>" for w in wrong if not w.value.stated]
    if missing:
        edits.append(append_to(intrinsics.element, missing))
    return Fix(Safety.UNSAFE, tuple(edits))


def _camera(intrinsics: str, mark: str = "", *, fov: float = 1.0472, kind: str = "camera") -> str:
    return f"""
<sensor name="front" type="{kind}">
  <camera>
    <horizontal_fov>{fov}</horizontal_fov>
    <lens>
      <intrinsics>{mark}
        {intrinsics}
      </intrinsics>
    </lens>
    <image><width>1280</width><height>960</height></image>
  </camera>
</sensor>
"""


def _figures(fx: float, fy: float, cx: float, cy: float, s: float = 0.0) -> str:
    return f"<fx>{fx}</fx><fy>{fy}</fy><cx>{cx}</cx><cy>{cy}</cy><s>{s}</s>"


_MARK = "  <!-- ^ SEN009 -->"

GOOD = [
    _camera(_figures(1108.5, 1108.5, 640.5, 480.5)),
    _camera(_figures(1108.5, 1108.5, 639.5, 479.5), kind="rgbd_camera"),
    _camera(_figures(1110, 1105, 640, 480)),
    _camera(_figures(300, 300, 640, 480), kind="wideanglecamera"),
    _camera(_figures(300, 300, 640, 480), fov=4),
]
BAD = [
    _camera(_figures(554.3, 554.3, 320.5, 240.5), _MARK),
    _camera(_figures(1108.5, 1108.5, 660.5, 480.5), _MARK),
    _camera(_figures(1108.5, 1108.5, 640.5, 480.5, 1), _MARK),
    _camera(_figures(1108.95, 1110.66, 649.534, 484.9857), _MARK),
    _camera("<fx>1108.5</fx><fy>1108.5</fy>", _MARK),
]
