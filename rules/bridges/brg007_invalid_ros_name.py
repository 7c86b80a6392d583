"""A topic of a bridge whose name ROS refuses.

Each part of a topic's name in ROS begins with a letter or `_` and contains only letters, digits and
`_`. Gazebo allows more: the default topic of a joint's position is `…/joint/J/0/cmd_pos`. The
bridge cannot create a ROS topic with such a name.

Fix: give it another name in ROS: `ros_topic_name` in the bridge's YAML file.
Source: rcl, validation of topic names; gazebosim/ros_gz issue 660.
"""

import re

from checker.launch.ros2.graph import is_known
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule

_LEGAL = re.compile(r"(?:~(?=/|\Z))?/?(?:[A-Za-z_]\w*(?:/[A-Za-z_]\w*)*)?\Z", re.ASCII)
_DIGIT = re.compile(r"(?:\A|/)(\d[^/]*)")
_STRANGE = re.compile(r"[^\w/~]", re.ASCII)


@rule("BRG007", "invalid-ros-name", Severity.ERROR, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report names that ROS refuses and that nothing remaps."""
    for simulation in simulations.all:
        for entry in simulation.entries:
            name = entry.passed.ros_topic
            text = name.value
            unknown = not is_known(text) or any(mark in text for mark in "{<$")
            if entry.is_own and not unknown and not entry.remapped and not _LEGAL.match(text):
                yield finding(name, f"ROS refuses the topic {text!r:.200}: {_reason(text)}")


def _reason(name: str) -> str:
    if digit := _DIGIT.search(name):
        return f"{digit[1]!r} begins with a digit"
    if strange := _STRANGE.search(name):
        return f"it contains {strange[0]!r}"
    return "a part of it is empty"


def _entry(key: str, topic: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": f"- {key}: {topic}{mark}\n  ros_type_name: std_msgs/msg/Float64\n"
        "  gz_type_name: gz.msgs.Double\n  direction: ROS_TO_GZ\n"
    }


_MARK = "  # ^ BRG007"
_TOPIC = "/model/rover/joint/mast/0/cmd_pos"
GOOD = [
    {"@bridge": True},
    _entry("topic_name", "mast/cmd_pos"),
    _entry(f"gz_topic_name: {_TOPIC}\n  ros_topic_name", "/mast_2/cmd_pos"),
]
BAD = [
    _entry("topic_name", _TOPIC, _MARK),
    _entry("topic_name", "3dbot/cmd_pos", _MARK),
    _entry("topic_name", "/front-mast/cmd_pos", _MARK),
]
