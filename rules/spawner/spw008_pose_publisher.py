"""A PosePublisher that is missing, or whose settings differ from other robots.

From this plugin ROS gets the transforms between the robot's links and sensors; once per second is
enough for static ones. `publish_nested_model_pose` publishes the robot's true pose in the world,
which only the organisers may switch on.

Fix: add the plugin as in the example spawner, with
`<publish_nested_model_pose>#{$enableGroundTruth}</publish_nested_model_pose>`. A robot with its own
robot_state_publisher needs no link poses.
Source: Model Migration Guide, example spawner; `static_publisher` is missing in some accepted
packages that write `static_pose_publisher`.
"""

from collections.abc import Iterator, Sequence

from checker.launch.ros1.graph import LaunchGraph
from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.launch.spawner.reader import GROUND_TRUTH, Spawner
from checker.model.components import Plugin
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.xml import Element

WANTED = (
    "publish_link_pose",
    "publish_sensor_pose",
    "use_pose_vector_msg",
    "static_publisher",
)
"""Parameters that must be true."""

TRUE_POSE = "publish_nested_model_pose"
_YES = ("true", "1")


@rule("SPW008", "pose-publisher", Severity.ERROR, Concern.INTERFACE)
def check(
    robot: Robot, spawner: Spawner, spawned: SpawnedXml, launch: LaunchGraph, *, rate: float = 1.0
) -> Findings:
    """Report missing PosePublishers, and settings that are missing or unusual.

    Options:
        rate: Hertz at which static poses are published; any other stated
            `<static_update_frequency>` is a warning.
    """
    publishers = [plugin for plugin in robot.plugins if plugin.class_name == "PosePublisher"]
    if not publishers:
        function = spawner.functions.get("spawner")
        yield finding(
            function or spawner.entry.whole(), "no PosePublisher: ROS gets no poses of the links"
        )
        return
    yield from _true_pose(publishers, spawned)
    if not any(node.package == "robot_state_publisher" for node in launch.nodes):
        yield from _settings(publishers, rate)


def _true_pose(publishers: Sequence[Plugin], spawned: SpawnedXml) -> Iterator[Finding]:
    for plugin in publishers:
        for element in plugin.element.all(TRUE_POSE):
            emitted = element.document is spawned.document
            wanted = emitted and GROUND_TRUTH in spawned.parameters_of(element.text_span)
            if not wanted and element.text.value.lower() in _YES:
                yield finding(
                    element,
                    f"<{TRUE_POSE}> is always {element.text.value}, expected the value of "
                    f"{GROUND_TRUTH}",
                    severity=Severity.WARNING,
                )


def _settings(publishers: Sequence[Plugin], rate: float) -> Iterator[Finding]:
    """Check all publishers together: each may publish a part."""
    parameters = [child for plugin in publishers for child in plugin.element.children]
    on = {child.tag for child in parameters if child.text.value.lower() in _YES}
    missing = [tag for tag in WANTED if tag not in on]
    if missing:
        yield finding(
            publishers[0],
            f"PosePublisher lacks {', '.join(f'<{tag}>true' for tag in missing)}",
            severity=Severity.WARNING,
        )
    for child in parameters:
        if child.tag == "static_update_frequency" and _number(child) not in (None, rate):
            yield finding(
                child,
                f"static poses are published at {child.text.value} Hz, expected {rate:g} Hz",
                severity=Severity.WARNING,
            )


def _number(element: Element) -> float | None:
    try:
        return float(element.text.value)
    except ValueError:
        return None


def _spawner(nested: str, more: str = "", mark: str = "") -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}"><sdf version="1.6"><include>
      <plugin filename="p" name="ignition::gazebo::systems::PosePublisher"> {mark}
        <publish_link_pose>true</publish_link_pose>
        <publish_sensor_pose>true</publish_sensor_pose>
        <publish_nested_model_pose>{nested}
        <use_pose_vector_msg>true</use_pose_vector_msg>
        {more}
      </plugin>
    </include></sdf></spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


_STATIC = "<static_publisher>true</static_publisher><static_update_frequency>1"
_END = f"</{TRUE_POSE}>"
_ASKED = f"#{{{GROUND_TRUTH}}}{_END}"
_RATE = "</static_update_frequency>"
_MARK = "<!-- ^ SPW008 -->"

GOOD = [{"launch/spawner.rb": _spawner(_ASKED, _STATIC + _RATE)}]
BAD = [
    {"launch/spawner.rb": _spawner("true" + _END + _MARK, _STATIC + _RATE)},
    {"launch/spawner.rb": _spawner(_ASKED, mark=_MARK)},
    {"launch/spawner.rb": _spawner(_ASKED, f"{_STATIC}000{_RATE} {_MARK}")},
    {
        "launch/spawner.rb": f"def spawner(_name, *_rest) # {_MARK}\n  '<spawn/>'\nend\n"
        "def rosExecutables(a, b)\n  ''\nend\n"
    },
]
