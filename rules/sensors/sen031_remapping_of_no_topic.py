"""A remapping of a sensor's plugin in Gazebo Classic names a topic that the plugin does not have.

The lidar and IMU plugins of ROS 2 publish on `~/out`, which is `/<plugin>/out`. A remapping from
another name, such as `scan:=scan`, has no effect: nothing is published on `/scan`, and mapping and
navigation wait for it.

It is reported of a plugin none of whose remappings names its topic.

Fix: write `<remapping>~/out:=scan</remapping>`.
Source: gazebo_ros_pkgs, branch ros2: gazebo_ros_ray_sensor.cpp and gazebo_ros_imu_sensor.cpp.
"""

from checker.launch.ros1.graph import resolve_name
from checker.model.components import Plugin
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.ros.wiring.endpoints import remap_rule, remap_texts
from checker.rule import (
    Concern,
    Context,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
)

_TOPIC = "~/out"
_LIBRARIES = ("gazebo_ros_ray_sensor", "gazebo_ros_imu_sensor")
_NOT_A_NAME = ("-", "__", ":", " ", "$")
"""What parts of a source make it more than the name of a topic: an option, a node in front."""


@rule("SEN031", "remapping-of-no-topic", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context) -> Findings:
    """Report remappings of sensors' plugins if none of them is of the plugin's topic."""
    if not context.is_classic or robot.shown_only:
        return
    for plugin in (plugin for sensor in robot.sensors for plugin in sensor.plugins):
        if library_stem(plugin.filename.value) not in _LIBRARIES:
            continue
        rules = [(text, *remap_rule(text.value)) for text in remap_texts(plugin)]
        sources = [source for _, source, _ in rules]
        if any(mark in source for source in sources for mark in _NOT_A_NAME):
            continue
        if any(_is_topic(plugin, source) for source in sources):
            continue
        for text, source, target in rules:
            line = f"{_TOPIC}:={target}"
            stands = len(rules) == 1 and text.span.text == text.value
            yield finding(
                text,
                f"plugin {plugin.name.value!r} has no topic {source!r}, so the remapping has no "
                f"effect: it publishes on {_TOPIC}; expected <remapping>{line}</remapping>",
                fix=replace_text(text, line, Safety.UNSAFE) if stands else None,
            )


def _is_topic(plugin: Plugin, source: str) -> bool:
    """Return whether a name is that of the plugin's topic, in whatever namespace it runs."""
    own = resolve_name(_TOPIC, "/", plugin.name.value)
    return resolve_name(source, "/", plugin.name.value).endswith(own)


def _lidar(remapping: str, mark: str = "", library: str = "ray_sensor") -> dict[str, object]:
    return {
        "@profile": "ros2-classic",
        "@urdf": f"""  <gazebo reference="upper_arm">
    <sensor name="lidar" type="ray">
      <plugin name="scanner" filename="libgazebo_ros_{library}.so">
        <ros><remapping>{remapping}</remapping></ros>{mark}
      </plugin>
    </sensor>
  </gazebo>""",
    }


_MARK = "  <!-- ^ SEN031 -->"
GOOD = [
    _lidar("~/out:=scan"),
    _lidar("scanner/out:=scan"),
    _lidar("~/out:=scan</remapping><remapping>tf:=lidar_tf"),
    _lidar("scan:=scan", library="camera"),
]
BAD = [_lidar("scan:=scan", _MARK), _lidar("out:=scan", _MARK)]
