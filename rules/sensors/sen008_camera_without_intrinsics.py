"""A camera without intrinsics.

Gazebo Dome fills `camera_info` from `<lens><intrinsics>` only. Without them it publishes SDFormat's
defaults (fx = fy = 277, cx = 160, cy = 120), which fit an image of 320 × 240 pixels and 60°. With
any other image, points that are projected into or out of it are wrong.

Fix: add `<lens><intrinsics>` with fx = fy = width / (2·tan(horizontal_fov / 2)),
cx = (width - 1) / 2 and cy = (height - 1) / 2.
Source: SubT maintainers require the intrinsics of cameras in their reviews; SDFormat specification,
camera/lens/intrinsics. From memory of gz-sensors, later releases compute them.
"""

from checker.finding import Fix
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.camera import DEFAULT_PINHOLE, Camera
from checker.model.sensing.kind import SensorType
from checker.rule import Concern, Context, Findings, Safety, Severity, finding, rule
from checker.source.xml_insertion import append_to


@rule("SEN008", "camera-without-intrinsics", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot,
    context: Context,
    *,
    tolerance: float = 0.01,
    centre_tolerance: float = 1.0,
    releases: tuple[str, ...] = ("dome",),
) -> Findings:
    """Report cameras without intrinsics, on releases that do not compute them.

    Cameras whose focal length and centre fit the defaults are skipped.

    Options:
        tolerance: Share by which the default focal length, 277 px, may differ from the image's
            before it is reported.
        centre_tolerance: Pixels by which the default centre, 160 and 120 px, may differ from the
            image's before it is reported.
        releases: Names of Gazebo releases, in lower case, on which cameras need intrinsics; on
            other releases nothing is reported.
    """
    if context.release not in releases:
        return
    for sensor in robot.sensors:
        camera = sensor.camera
        if camera is None or not _is_plain(sensor) or camera.intrinsics is not None:
            continue
        expected = camera.pinhole
        if expected is None or DEFAULT_PINHOLE.agrees(expected, tolerance, centre_tolerance):
            continue
        yield finding(
            camera,
            f"camera {sensor.name.value!r} has no <intrinsics>, so camera_info gives the defaults "
            f"fx = 277, cx = 160; expected fx = fy = {expected.fx:.6g}, "
            f"cx = {expected.cx:g} and cy = {expected.cy:g} px",
            key=f"{expected.fx:g} {expected.cx:g} {expected.cy:g}",
            fix=_fix(camera),
        )


def _is_plain(sensor: Sensor) -> bool:
    """Return whether a sensor has the projection of a pinhole camera."""
    return sensor.kind.takes_pictures and sensor.kind is not SensorType.WIDE_ANGLE_CAMERA


def _fix(camera: Camera) -> Fix | None:
    expected = camera.pinhole
    if expected is None:
        return None
    figures = {"fx": expected.fx, "fy": expected.fy, "cx": expected.cx, "cy": expected.cy, "s": 0.0}
    inner = [f"  <{tag}>{value:.6g}</{tag}>" for tag, value in figures.items()]
    lines = ["<intrinsics>", *inner, "</intrinsics>"]
    lens = camera.element.child("lens")
    if lens is None:
        lines = ["<lens>", *(f"  {line}" for line in lines), "</lens>"]
    return Fix(Safety.UNSAFE, (append_to(lens or camera.element, lines),))


def _camera(width: int, height: int, fov: float, lens: str = "", *, kind: str = "camera") -> str:
    mark = "" if lens or (width, fov) == (320, 1.047) else "  <!-- ^ SEN008 -->"
    return f"""
<sensor name="front" type="{kind}">
  <camera>{mark}
    <horizontal_fov>{fov}</horizontal_fov>
    <image><width>{width}</width><height>{height}</height></image>
    {lens}
  </camera>
</sensor>
"""


_INTRINSICS = "<fx>1008</fx><fy>1008</fy><cx>1007.5</cx><cy>755.5</cy><s>0</s>"

GOOD = [
    _camera(2016, 1512, 1.5708, f"<lens><intrinsics>{_INTRINSICS}</intrinsics></lens>"),
    _camera(320, 240, 1.047),
    _camera(640, 480, 1.2, "<lens/>", kind="wideanglecamera"),
    '<sensor name="seer" type="logical_camera"><logical_camera/></sensor>',
]
BAD = [
    _camera(2016, 1512, 1.5708),
    _camera(224, 171, 1.0821, kind="depth_camera"),
    """
<sensor name="front" type="rgbd_camera">
  <camera>  <!-- ^ SEN008 -->
    <lens><type>stereographic</type></lens>
    <image><width>640</width><height>480</height></image>
  </camera>
</sensor>
""",
]
