"""A colour camera and a depth camera at the same pose.

They model one device, such as a RealSense, but Gazebo renders two sensors, which costs twice the
time. Their images are from different moments, and neither sensor publishes a coloured point cloud.
An `rgbd_camera` renders once and publishes all three; next to one, a separate colour camera is not
needed. If the images differ in size they may be two devices, and this is an info.

Fix: replace both by one sensor of type `rgbd_camera`, and bridge its `image`, `depth_image` and
`points`.
Source: Model Migration Guide of SubT (RGBD cameras are natively supported via the sensor type
`rgbd_camera`); colour and depth of a RealSense D435 are 15 mm apart (general knowledge).
"""

import math

from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.model.sensing.mounts import Mounted, mounted_sensors
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_COMPARED = 100
"""Greatest number of cameras of each kind; a robot has ten."""


@rule("SEN024", "separate-colour-and-depth-cameras", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, *, distance: float = 0.02, angle: float = 0.05) -> Findings:
    """Report colour and depth cameras with the same place and direction.

    Options:
        distance: Metres between a colour and a depth camera up to which they count as at the same
            place.
        angle: Radians between the directions of the two up to which they look in the same
            direction.
    """
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    sensors = list(mounted_sensors(robot))
    colours = [sensor for sensor in sensors if _sees_colours(sensor)]
    depths = [sensor for sensor in sensors if sensor.sensor.kind.measures_depth]
    for colour in colours[:_COMPARED]:
        beside = (
            depth for depth in depths[:_COMPARED] if _together(colour, depth, distance, angle)
        )
        depth = next(beside, None)
        if depth is None:
            continue
        apart = math.dist(colour.pose.translation, depth.pose.translation)
        kind = depth.sensor.kind.replace("_", " ")
        alike = _have_one_size(colour, depth)
        yield finding(
            colour.sensor,
            f"camera {colour.sensor.name.value!r} is {1000 * apart:.3g} mm from {kind} "
            f"{depth.sensor.name.value!r} and looks in the same direction; expected one "
            f"rgbd_camera for both{'' if alike else ', unless they are two devices'}",
            severity=None if alike else Severity.INFO,
            key="one device" if alike else "two devices",
            related=[(depth.sensor, f"the {kind}")],
        )


def _sees_colours(mounted: Mounted) -> bool:
    """Return whether a sensor is a colour camera; infrared ones have grey images."""
    sensor = mounted.sensor
    if sensor.kind is not SensorType.CAMERA:
        return False
    return sensor.camera is None or not sensor.camera.format.value.upper().startswith("L")


def _have_one_size(one: Mounted, other: Mounted) -> bool:
    """Return whether one sensor could publish the images of both, judged by their sizes."""
    first, second = one.sensor.camera, other.sensor.camera
    if first is None or second is None:
        return True
    pairs = ((first.width, second.width), (first.height, second.height))
    return all(a.value == b.value for a, b in pairs if a.stated and b.stated)


def _together(one: Mounted, other: Mounted, distance: float, angle: float) -> bool:
    if math.dist(one.pose.translation, other.pose.translation) > distance:
        return False
    ahead, beside = one.looking, other.looking
    if ahead is None or beside is None:
        return False
    # By the chord, which is exact where an angle is too small for its cosine.
    return 2.0 * math.asin(min(math.dist(ahead, beside) / 2.0, 1.0)) <= angle


def _cameras(one: str, other: str, pose: str, mark: str = "", image: str = "R8G8B8") -> str:
    return f"""
<link name="head">
  <sensor name="colour" type="{one}">{mark}
    <pose>0.1 0 0 0 0 0</pose>
    <camera><image><format>{image}</format></image></camera>
  </sensor>
  <sensor name="depth" type="{other}"><pose>{pose}</pose></sensor>
</link>
"""


_MARK = "  <!-- ^ SEN024 -->"
GOOD = [
    _cameras("camera", "depth_camera", "0.1 0.1 0 0 0 0"),
    _cameras("camera", "depth_camera", "0.1 0 0 0 0 1.57"),
    _cameras("camera", "camera", "0.1 0 0 0 0 0"),
    _cameras("rgbd_camera", "rgbd_camera", "0.1 0 0 0 0 0"),
    # Infrared.
    _cameras("camera", "depth_camera", "0.1 0 0 0 0 0", image="L8"),
]
BAD = [
    _cameras("camera", "depth_camera", "0.1 0 0 0 0 0", _MARK),
    _cameras("camera", "depth", "0.1 0.015 0 0 0 0", _MARK),
    _cameras("camera", "rgbd_camera", "0.1 0 0 0 0 0", _MARK),
]
