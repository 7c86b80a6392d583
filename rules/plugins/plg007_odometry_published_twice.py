"""Two plugins publish odometry on the same topic.

The messages of both plugins are mixed: the robot seems to jump between two places.

Fix: remove one of the plugins, or give it its own topic with `<odom_topic>`.
Source: default topics of the drive systems and of the odometry publisher of Gazebo. No accepted
package that we checked has this fault.
"""

from collections.abc import Iterator

from checker.model.components import Plugin
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located

PUBLISHERS = (
    "AckermannSteering",
    "DiffDrive",
    "MecanumDrive",
    "OdometryPublisher",
    "TrackedVehicle",
)
"""Classes that publish odometry on `<odom_topic>`, by default /model/<name>/odometry."""


@rule("PLG007", "odometry-published-twice", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot) -> Findings:
    """Report plugins whose odometry topic another plugin already uses."""
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    taken: dict[str, Plugin] = {}
    for plugin, topic in _publishers(robot):
        first = taken.setdefault(topic.value, plugin)
        if first is not plugin:
            yield finding(
                topic,
                f"{plugin.class_name} publishes odometry on {topic.value}, as {first.class_name} "
                "already does",
                related=[(first, "publishes the same topic")],
                covered_by=("PLG015",),
            )


def _publishers(robot: Robot) -> Iterator[tuple[Plugin, Located[str]]]:
    for plugin in robot.plugins:
        if plugin.class_name not in PUBLISHERS:
            continue
        stated = plugin.element.child("odom_topic")
        if stated is not None and stated.text.stated:
            yield plugin, Located("/" + stated.text.value.lstrip("/"), stated.text.span)
        else:
            model = plugin.nested_in or "<name>"
            yield plugin, Located(f"/model/{model}/odometry", plugin.span, stated=False)


def _plugins(second: str, topic: str = "") -> str:
    return f"""
<plugin filename="libignition-gazebo-diff-drive-system.so"
        name="ignition::gazebo::systems::DiffDrive"/>
<plugin filename="libignition-gazebo-odometry-publisher-system.so" name="{second}">{topic}
</plugin>
"""


_ODOMETRY = "ignition::gazebo::systems::OdometryPublisher"

GOOD = [
    _plugins(_ODOMETRY, "<odom_topic>true_odometry</odom_topic>"),
    _plugins("ignition::gazebo::systems::PosePublisher"),
]
BAD = [
    """
<plugin filename="libignition-gazebo-diff-drive-system.so" name="a::DiffDrive"/>
<plugin filename="o" name="b::OdometryPublisher"/>  <!-- ^ PLG007 -->
""",
    """
<plugin filename="d" name="a::DiffDrive"><odom_topic>odom</odom_topic></plugin>
<plugin filename="d" name="a::DiffDrive"><odom_topic>/odom</odom_topic></plugin> <!-- ^ PLG007 -->
""",
]
