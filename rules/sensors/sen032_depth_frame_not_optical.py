"""The point cloud of a depth camera in Gazebo Classic is in a frame that is not optical.

The camera plugin writes points as a lens sees them: z ahead, x to the right and y down. RViz,
costmaps and octomaps place them by the axes of the frame that the message names. In a frame with x
ahead the cloud stands on end: the floor is a wall. The sensor itself looks along x, so its own link
cannot be that frame.

It is reported of sensors of type `depth` whose plugin states its frame, and in ROS 2 also of those
whose plugin states none, which is the frame of the sensor's link. Frames off by other angles than
a quarter turn are not judged.

Fix: add a link `camera_optical_frame` below the camera's link, with a fixed joint of
`rpy="-1.5708 0 -1.5708"`, and name it as the frame of the plugin; leave the sensor where it is.
Source: REP 103, suffix frames; gazebo_ros_pkgs, gazebo_ros_camera.cpp and
gazebo_ros_openni_kinect.cpp; issue 1329 there.
"""

import math
from collections.abc import Iterator

from checker.model.components import Sensor
from checker.model.geometry.transform import dot
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.model.sensing.mounts import mounted_sensors
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located

_FRAMES = {
    "gazebo_ros_camera": "frame_name",
    "gazebo_ros_openni_kinect": "frameName",
    "gazebo_ros_depth_camera": "frameName",
}
"""What names the frame in each plugin that publishes point clouds."""
_WITH_DEFAULT = "gazebo_ros_camera"
_NEAR = math.cos(math.radians(20))
"""Cosine of the angle between axes up to which they count as alike."""


@rule("SEN032", "depth-frame-not-optical", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot) -> Findings:
    """Report depth cameras whose point cloud is in a frame with x ahead and z up."""
    if robot.shown_only:
        return
    for mounted in mounted_sensors(robot):
        if not mounted.sensor.kind.measures_depth:
            continue
        ahead, up = (mounted.pose.rotate(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
        for frame in _frames(mounted.sensor):
            pose = robot.pose_of(frame.value.strip("/"))
            if pose is None:
                continue
            along, above = pose.rotate((1.0, 0.0, 0.0)), pose.rotate((0.0, 0.0, 1.0))
            if dot(along, ahead) > _NEAR and dot(above, up) > _NEAR:
                yield finding(
                    frame,
                    f"the point cloud of {mounted.sensor.name.value!r} is turned by 90°: its frame "
                    f"{frame.value!r} has x ahead and z up, expected an optical frame, z ahead "
                    'and x to the right: rpy="-1.5708 0 -1.5708" below the camera\'s link',
                    key=frame.value,
                )


def _frames(sensor: Sensor) -> Iterator[Located[str]]:
    """Yield the frames of the point clouds that a sensor's plugins publish."""
    for plugin in sensor.plugins:
        stem = library_stem(plugin.filename.value)
        stated = next(plugin.at(_FRAMES[stem]), None) if stem in _FRAMES else None
        if stated is not None:
            yield stated
        elif stem == _WITH_DEFAULT:
            yield Located(sensor.link, plugin.span, stated=False)


def _camera(frame: str, turn: str = "-1.5708 0 -1.5708", type: str = "depth") -> dict[str, object]:
    return {
        "@profile": "ros2-classic",
        "@urdf": f"""  <link name="eye"/>
  <joint name="eye_joint" type="fixed">
    <parent link="upper_arm"/><child link="eye"/><origin rpy="{turn}"/>
  </joint>
  <gazebo reference="upper_arm">
    <sensor name="depth" type="{type}">
      <plugin name="camera" filename="libgazebo_ros_camera.so">
        {frame}
      </plugin>
    </sensor>
  </gazebo>""",
    }


_EYE = "<frame_name>eye</frame_name>"
_MARK = "  <!-- ^ SEN032 -->"
GOOD = [
    _camera(_EYE),
    _camera(_EYE, "0 0 0", type="camera"),
    _camera("<frame_name>lens</frame_name>"),
]
BAD = [
    _camera(f"{_EYE}{_MARK}", "0 0 0"),
    _camera(f"<frame_name>upper_arm</frame_name>{_MARK}"),
]
