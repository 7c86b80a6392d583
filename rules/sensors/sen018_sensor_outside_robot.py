"""A sensor far outside the robot that carries it.

The sensor floats next to the robot and measures from a place where there is nothing. The usual
cause is a wrong decimal point (0.82 for 0.082), or a pose in another frame or unit. The sensor
passes through walls, and its data fits no transform of the real robot.

Fix: write the pose in metres in the frame of the sensor's link, at the device that it models.
Source: SDFormat specification, sensor/pose; in 18 accepted packages all sensors are within the box
around the robot's shapes or up to 5 cm outside it.
"""

from checker.model.components import Collision, Link, Visual
from checker.model.geometry.boxes import Box
from checker.model.geometry.placed_shapes import place_shapes, union
from checker.model.robot import Robot
from checker.model.sensing.mounts import Mounted, mounted_sensors
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("SEN018", "sensor-outside-robot", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, *, sizes: float = 0.5) -> Findings:
    """Report sensors far outside the robot.

    Options:
        sizes: Distance of a sensor from the box around the robot's shapes, as a multiple of that
            box's diagonal; more is reported.
    """
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    sensors = list(mounted_sensors(robot))
    # Meshes take long; a sensor near the other shapes is near the whole robot as well.
    box = _box_around(robot, meshes_too=False)
    if box is not None and not _far(sensors, box, sizes):
        return
    box = _box_around(robot, meshes_too=True)
    if box is None:
        return
    far = _far(sensors, box, sizes)
    unknown = next((use for use in robot.mesh_uses if use.mesh is None), None)
    if far and unknown is not None:
        # A mesh that is missing will stand there again once its path is mended.
        yield unchecked(f"the size of {unknown.uri.value} is not known")
        return
    for mounted, gap in far:
        yield finding(
            mounted.sensor.pose,
            f"sensor {mounted.sensor.name.value!r} is {gap:.3g} m outside the robot, whose box is "
            f"{box.diagonal:.3g} m from corner to corner; expected at or in the robot",
        )


def _box_around(robot: Robot, *, meshes_too: bool) -> Box | None:
    return union(
        piece.box
        for link in robot.links
        for piece in place_shapes(robot, link, _shapes(link, meshes_too=meshes_too))
    )


def _shapes(link: Link, *, meshes_too: bool) -> list[Collision | Visual]:
    shapes: list[Collision | Visual] = [*link.collisions, *link.visuals]
    return [shape for shape in shapes if meshes_too or shape.geometry.shape != "mesh"]


def _far(sensors: list[Mounted], box: Box, sizes: float) -> list[tuple[Mounted, float]]:
    """Return the sensors that are far from a box, and how far, metres."""
    gaps = (
        (sensor, box.gap(Box(sensor.pose.translation, sensor.pose.translation)))
        for sensor in sensors
    )
    return [(mounted, gap) for mounted, gap in gaps if gap > sizes * box.diagonal]


def _robot(pose: str, visual: str = "<box><size>0.6 0.4 0.2</size></box>") -> str:
    return f"""
<link name="chassis">
  <visual name="hull"><geometry>{visual}</geometry></visual>
  <sensor name="front" type="camera">
    <pose>{pose}
  </sensor>
</link>
"""


_MARK = "</pose>  <!-- ^ SEN018 -->"
GOOD = [
    _robot("0.3 0 0.082 0 0 0</pose>"),
    # On a mast that is not modelled.
    _robot("0 0 0.3 0 0 0</pose>"),
    '<sensor name="imu" type="imu"><pose>5 0 0 0 0 0</pose></sensor>',
]
BAD = [
    _robot(f"0.3 0 0.82 0 0 0{_MARK}"),
    _robot(f"300 0 82 0 0 0{_MARK}"),
    # The pose of the link counts as well.
    '<link name="mast"><pose>0 0 1 0 0 0</pose>'
    + _robot(f"0 0 0.2 0 0 0{_MARK}")
    .replace('<link name="chassis">', "")
    .replace('<visual name="hull">', '<visual name="hull"><pose>0 0 -1 0 0 0</pose>'),
]
