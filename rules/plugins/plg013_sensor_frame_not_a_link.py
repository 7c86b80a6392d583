"""Messages of a sensor in Gazebo Classic are in a frame that is no link of the robot.

`<frame_name>` of a sensor's plugin is the frame of its messages. robot_state_publisher publishes
the links under their own names: no transform leads to another frame, RViz shows nothing, and
mapping and navigation drop the messages.

It is reported for descriptions in URDF, and plugins that publish what their sensor measures. Frames
that a launch file or a program of the package publishes are right, and so are links of another
description that is loaded. Names with a namespace are not judged, nor any name where a launch file
sets `frame_prefix`. The frame of the link `/lens` is `lens`: tf2 removes a slash in front from each
transform that it gets, and refuses to look up a frame that begins with one.

Fix: write the name of the link; of a camera, that of its optical link.
Source: gazebo_ros, `SensorFrameID`; BRG009 reports the same in Gazebo Sim.
"""

from collections.abc import Iterator

from checker.base.words import Suggestions
from checker.launch.ros2.graph import is_known
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import frame_of
from checker.package.package import Package
from checker.robots.urdf_files import UrdfFiles
from checker.ros.broadcast_frames import is_broadcast
from checker.ros.wiring.classic import classic_endpoints
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.text import Located

_OF_EVERY_ROBOT = ("world", "map", "odom")
"""Frames that Gazebo, localization or the drive publish."""


@rule("PLG013", "sensor-frame-not-a-link", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, files: UrdfFiles, package: Package, context: Context) -> Findings:
    """Report the frames of sensors' plugins that nothing publishes."""
    if not context.is_classic or robot.format != "urdf" or robot.shown_only:
        return
    if package.workspace.launches_with("frame_prefix"):
        return
    robots = (robot, *(it.robot for it in files.descriptions if not it.unloaded))
    links = {
        *_OF_EVERY_ROBOT,
        *map(frame_of, (link for each in robots for link in each.links_by_name)),
    }
    suggestions = Suggestions(sorted(map(frame_of, robot.links_by_name)))
    for sensor, frame in _stated_frames(robot):
        name = frame.value.strip()
        if name in links or "/" in name or not is_known(name) or is_broadcast(package, name):
            continue
        meant = suggestions.closest(name) or frame_of(sensor.link)
        yield finding(
            frame,
            f"messages of the {sensor.type.value} sensor {sensor.name.value!r} are in the frame "
            f"{name!r}, which is not a link of the robot, so no transform leads to it; "
            f"did you mean {meant!r}?",
            key=name,
        )


def _stated_frames(robot: Robot) -> Iterator[tuple[Sensor, Located[str]]]:
    """Yield the frames of the messages that sensors' plugins publish."""
    publishing = {id(end.owner) for end in classic_endpoints(robot) if end.publishes}
    for sensor in robot.sensors:
        for plugin in sensor.plugins:
            if id(plugin) in publishing:
                yield from ((sensor, frame) for frame in plugin.at("frame_name"))


def _lidar(frame: str, mark: str = "", plugin: str = "ray_sensor") -> dict[str, object]:
    return {
        "@profile": "ros2-classic",
        "@urdf": f"""  <gazebo reference="upper_arm">
    <sensor name="lidar" type="ray">
      <plugin name="scan" filename="libgazebo_ros_{plugin}.so">
        <frame_name>{frame}</frame_name>{mark}
      </plugin>
    </sensor>
  </gazebo>""",
    }


_STATIC = """<launch><node pkg="tf2_ros" exec="static_transform_publisher"
  args="0 0 0 0 0 0 upper_arm lens"/></launch>
"""
_MARK = "  <!-- ^ PLG013 -->"
_SLASH = {
    **_lidar("lens"),
    "@urdf": """  <link name="/lens"/>
  <joint name="lens_joint" type="fixed">
    <parent link="upper_arm"/><child link="/lens"/>
  </joint>
"""
    + str(_lidar("lens")["@urdf"]),
}
GOOD = [
    _SLASH,
    _lidar("upper_arm"),
    _lidar("arm_1/lens"),
    _lidar("lens", plugin="camera"),
    {**_lidar("lens"), "launch/view.launch.xml": _STATIC},
]
BAD = [_lidar("upper_am", _MARK), _lidar("lens", _MARK)]
