"""A camera whose range is too large or empty.

A camera sees only what is between `<near>` and `<far>`: if near is not below far, nothing is
rendered, and a renderer refuses a near of 0. In the SubT challenge RGBD cameras measure up to 10 m
and thermal cameras see up to 100 m; with a copied 300 m the robot sees farther than any device. An
RGBD camera has two ranges: `<clip>` is for the colour picture, and for depth too unless
`<depth_camera><clip>` is set. With `<clip><far>10` alone, the picture also ends at 10 m, and
everything farther away is missing in it.

Fix: write near above 0 and below far; `<depth_camera><clip><far>10` for depth and
`<clip><far>300` for the picture; `<clip><far>100` for thermal cameras.
Source: SDFormat specification, camera/clip; OGRE, Frustum::setNearClipDistance; gz-sensors,
RgbdCameraSensor: both pictures are drawn within `<clip>`, then depth is cut at that of
`<depth_camera>`; SubT review findings (`subt_standards.json`: rgbd, thermal).
"""

from collections.abc import Iterator

from checker.formats.corrections import rewrite
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.camera import Camera, Clip
from checker.model.sensing.kind import SensorType
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule


@rule("SEN011", "camera-clip", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot, context: Context, *, depth_far: float = 10.0, thermal_far: float = 100.0
) -> Findings:
    """Report empty ranges, and in SubT ranges of RGBD and thermal cameras that are too large.

    In SubT also RGBD cameras without a range for depth, whose picture ends where depth may.

    Options:
        depth_far: Greatest distance, metres, at which an RGBD camera may measure depth in the SubT
            profile; more is reported, and so is less in `<clip>` without a range for depth.
        thermal_far: Greatest distance, metres, at which a thermal camera may see in the SubT
            profile; more is reported.
    """
    farthest = {SensorType.RGBD_CAMERA: depth_far, SensorType.THERMAL_CAMERA: thermal_far}
    for sensor in robot.sensors:
        camera = sensor.camera
        if camera is None or not sensor.kind.takes_pictures:
            continue
        yield from _empty(sensor, camera)
        if context.profile == "subt" and sensor.kind in farthest:
            yield from _too_far(sensor, camera, farthest[sensor.kind])
            yield from _picture_ends(sensor, camera, farthest[sensor.kind])


def _empty(sensor: Sensor, camera: Camera) -> Iterator[Finding]:
    measured = Clip(camera.depth_near, camera.depth_far, camera.span)
    clips = {"sees": camera.clip, "measures depth": measured}
    for what, clip in clips.items():
        near, far = clip.near, clip.far
        if near.stated and near.value <= 0.0:
            yield finding(
                near,
                f"camera {sensor.name.value!r} {what} from {near.value:g} m, which the renderer "
                "refuses; expected more than 0",
                severity=Severity.ERROR,
            )
            return
        if near.value < far.value:
            continue
        yield finding(
            near if near.stated else far,
            f"camera {sensor.name.value!r} {what} from {near.value:g} m to {far.value:g} m, an "
            "empty range; expected near below far",
            severity=Severity.ERROR,
            fix=rewrite([(near, far.value), (far, near.value)]) if far.value > 0.0 else None,
        )
        return


def _too_far(sensor: Sensor, camera: Camera, limit: float) -> Iterator[Finding]:
    depth = sensor.kind.measures_depth
    far = camera.depth_far if depth else camera.clip.far
    if far.value <= limit:
        return
    tag = "<depth_camera><clip><far>" if depth else "<clip><far>"
    shared = depth and far is camera.clip.far
    yield finding(
        far,
        f"{sensor.kind.replace('_', ' ')} {sensor.name.value!r} {'measures' if depth else 'sees'} "
        f"up to {far.value:g} m, expected at most {limit:g} m (the SubT standard): "
        f"{'add' if shared else 'correct'} {tag}",
        key=f"{sensor.kind} {far.value:g}",
    )


def _picture_ends(sensor: Sensor, camera: Camera, limit: float) -> Iterator[Finding]:
    far = camera.clip.far
    if not sensor.kind.measures_depth or camera.depth_far is not far or not far.stated:
        return
    if camera.clip.near.value < far.value <= limit:
        yield finding(
            far,
            f"the picture of {sensor.kind.replace('_', ' ')} {sensor.name.value!r} ends at "
            f"{far.value:g} m, because <clip> holds for picture and depth: expected the range of "
            "depth in <depth_camera><clip>, and more in <clip><far>",
            key=f"picture {far.value:g}",
        )


def _camera(kind: str, clip: str) -> str:
    return f"""
<sensor name="front" type="{kind}">
  <camera>
    {clip}
  </camera>
</sensor>
"""


def _clip(near: str, far: str) -> str:
    return f"<clip><near>{near}</near>\n<far>{far}\n</far></clip>"


_MARK = "  <!-- ^ SEN011 -->"

GOOD = [
    _camera("camera", _clip("0.01", "300")),
    _camera("thermal", _clip("0.1", "100")),
    _camera(
        "rgbd_camera", f"{_clip('0.01', '300')}<depth_camera>{_clip('0.1', '10')}</depth_camera>"
    ),
    _camera("depth_camera", _clip("0.1", "4")),
]
BAD = [
    _camera("camera", f"<clip><near>0</near>{_MARK}\n<far>2</far></clip>"),
    _camera("camera", f"<clip><near>5</near>{_MARK}\n<far>2</far></clip>"),
    _camera("camera", f"<clip>\n<near>200</near>{_MARK}\n</clip>"),
    _camera("thermal_camera", _clip("0.1", f"300{_MARK}")),
    _camera("rgbd_camera", _clip("0.01", f"300{_MARK}")),
    _camera("rgbd_camera", _clip("0.01", f"10{_MARK}")),
    _camera("rgbd_camera", f"{_clip('0.01', f'8{_MARK}')}<depth_camera/>"),
    _camera(
        "rgbd_camera",
        f"{_clip('0.01', '300')}<depth_camera>{_clip('0.1', f'25{_MARK}')}</depth_camera>",
    ),
    _camera(
        "rgbd_camera",
        f"{_clip('0.01', '300')}<depth_camera><clip><near>9</near>{_MARK}<far>3</far></clip>"
        "</depth_camera>",
    ),
]
