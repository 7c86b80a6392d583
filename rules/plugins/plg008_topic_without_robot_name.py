"""A topic that does not contain the robot's name.

Topics are global. Two robots of a team share such a topic: one command drives both, and one robot's
motion drains the other's battery.

Fix: start the topic with `/model/#{_name}/`.
Source: Model Migration Guide, example spawner. No accepted package that we checked has this fault.
"""

import re
from collections.abc import Iterator

from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.launch.spawner.reader import Spawner
from checker.model.components import Plugin
from checker.model.locomotion.drive import DRIVE_CLASSES
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.text import Located

_TOPICS = (
    "topic",
    "odom_topic",
    "tf_topic",
    "power_draining_topic",
    "robotNamespace",
    "steering_efficiency_topic",
    "center_of_rotation_topic",
    "desired_joint_positions_topic",
    "robot_base_twist_topic",
)
_OTHERS = ("LinearBatteryPlugin", "Breadcrumbs", "MulticopterMotorModel", "GasDetector")


_FIXED_NAME = re.compile(r"\A/model/[^/]+(?=/)")


@rule("PLG008", "topic-without-robot-name", Severity.ERROR, Concern.INTERFACE)
def check(robot: Robot, spawner: Spawner, spawned: SpawnedXml) -> Findings:
    """Report topics of drives, batteries, breadcrumbs and gas detectors that are constants."""
    function = spawner.functions.get("spawner")
    name = function.parameters[0].name if function and function.parameters else ""
    for plugin in robot.plugins:
        if plugin.class_name not in (*DRIVE_CLASSES, *_OTHERS):
            continue
        emitted = plugin.element.document is spawned.document
        for topic in _topics(plugin):
            if not emitted or name not in spawned.parameters_of(topic.span):
                yield finding(
                    topic,
                    f"topic {topic.value!r} of {plugin.class_name} does not contain the robot's "
                    f"name, so two robots share it",
                    fix=replace_text(
                        topic,
                        _FIXED_NAME.sub(f"/model/#{{{name}}}", topic.value),
                        Safety.UNSAFE,
                    )
                    if emitted and _FIXED_NAME.match(topic.value)
                    else None,
                )


def _topics(plugin: Plugin) -> Iterator[Located[str]]:
    for tag in _TOPICS:
        for element in plugin.element.all(tag):
            if element.text.stated:
                yield element.text


def _spawner(topic: str) -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}">
      <sdf version="1.6"><include>
        <plugin filename="libignition-gazebo-diff-drive-system.so"
                name="ignition::gazebo::systems::DiffDrive">
          {topic}
        </plugin>
      </include></sdf>
    </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


GOOD = [{"launch/spawner.rb": _spawner("<topic>/model/#{_name}/cmd_vel_relay</topic>")}]
BAD = [
    {"launch/spawner.rb": _spawner("<topic>/model/rover/cmd_vel_relay</topic>  <!-- ^ PLG008 -->")},
    {
        "launch/spawner.rb": _spawner(
            "<topic>#{'/cmd_vel' unless _name.empty?}</topic>  <!-- ^ PLG008 -->"
        )
    },
    """
<plugin filename="libignition-gazebo-diff-drive-system.so"
        name="ignition::gazebo::systems::DiffDrive">
  <topic>/cmd_vel</topic>  <!-- ^ PLG008 -->
</plugin>
""",
]
