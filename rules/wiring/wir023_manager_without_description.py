"""A controller manager that waits for a robot on a topic that nothing publishes.

Without a description, ros2_control_node loads no hardware: spawners wait, and no joint moves. Up to
Iron, it takes the parameter `robot_description`, else the topic `~/robot_description`, which is
`/controller_manager/robot_description`: robot_state_publisher publishes `/robot_description`, and a
remap must join both. Since Jazzy, the parameter is not read any more, and the topic is
`robot_description` in the namespace of the node: a namespace on only one of the two nodes makes the
topics differ.

It is reported where the launch file starts robot_state_publisher, or since Jazzy gives
ros2_control_node the parameter and starts nothing that publishes the robot; all that it includes
was read, and the distribution is known. Where another launch file names robot_state_publisher, that
is a warning. Not where it spawns a robot into Gazebo, which has a manager itself.

Fix: `remappings=[("~/robot_description", "/robot_description")]` at ros2_control_node; since Jazzy,
the same namespace for both nodes, or a remap of `robot_description`.
Source: ros2_control, pull requests 940, 1358, 1410, and 1541 (why Humble keeps its topic); its
issue 1138 and "Migration: Iron to Jazzy"; mjforan/rm_motors_ros, pull request 2.
"""

from checker.package.package import Package
from checker.ros.ros2_control.distributions import ORDER, is_from, named_distribution
from checker.ros.spawned import EVERY_SPAWN
from checker.ros.transforms import STATE_PUBLISHER
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_MANAGER = "controller_manager/ros2_control_node"
_MOVE_GROUP = "moveit_ros_move_group/move_group"
_NAME = "robot_description"
_SPAWNS = tuple("/".join(program) for program in EVERY_SPAWN)
_DESCRIPTION = "std_msgs/msg/String"


@rule("WIR023", "manager-without-description", Severity.ERROR, Concern.INTERFACE)
def check(wiring: Wiring, package: Package, context: Context) -> Findings:
    """Report each ros2_control_node that gets no description from its launch file."""
    distribution = named_distribution(package, context)
    publishers = [it for it in wiring.nodes if it.node.package.value == STATE_PUBLISHER]
    if any(it.program in _SPAWNS for it in wiring.nodes):
        return
    published = wiring.publishers(_DESCRIPTION)
    states = [topic for topic, by in published.items() if by in {it.label for it in publishers}]
    if not publishers and distribution in ORDER and is_from(distribution, "jazzy"):
        yield from _by_parameter(wiring, package, distribution)
    for node in wiring.nodes if states and distribution in ORDER else ():
        topic = _awaited(node, distribution) if node.program == _MANAGER else ""
        if not topic or topic in published:
            continue
        if unknown := _more(wiring):
            yield unchecked(f"the publishers of {topic} are not all known: {unknown}")
            continue
        own = _topic(distribution)
        yield finding(
            node.node.executable,
            f"ros2_control_node of {distribution.title()} waits for the robot on {topic}, but "
            f'robot_state_publisher publishes {states[0]}: add remappings=[("{own}", '
            f'"{states[0]}")]',
            key=topic,
            related=[(it.node.executable, f"{it.label} publishes it") for it in publishers],
        )


def _by_parameter(wiring: Wiring, package: Package, distribution: str) -> Findings:
    """Report managers that get the robot as a parameter alone, which they do not read."""
    nodes = [it for it in wiring.nodes if it.program == _MANAGER and _NAME in it.settings]
    if not nodes or any(map(_publishes, wiring.every_node)):
        return
    strange = next((it.program for it in wiring.every_node if it.facts is None), "")
    if unknown := (*wiring.unread, *filter(None, [strange])):
        yield unchecked(f"the publishers of {_NAME} are not all known: {unknown[0]}")
        return
    file = wiring.graph.file
    elsewhere = package.workspace.launches_with(STATE_PUBLISHER)
    for node in nodes:
        yield finding(
            node.node.executable,
            f"ros2_control_node of {distribution.title()} does not read the parameter {_NAME}, and "
            f"nothing that {file} starts publishes the topic {_NAME}: start {STATE_PUBLISHER} here",
            key=_NAME,
            severity=Severity.WARNING if elsewhere else None,
            related=[(node.settings[_NAME], "the parameter")],
        )


def _publishes(node: WiredNode) -> bool:
    """Return whether a node may publish the robot; move_group does where a parameter says so."""
    if node.program != _MOVE_GROUP:
        known = node.facts is None or node.program == _MANAGER
        return not known and bool(node.publishes_more(_DESCRIPTION))
    stated = node.settings.get(f"publish_{_NAME}")
    return not node.knows_parameters or (stated is not None and stated.text != "false")


def _topic(distribution: str) -> str:
    return _NAME if is_from(distribution, "jazzy") else f"~/{_NAME}"


def _awaited(node: WiredNode, distribution: str) -> str:
    """Return the topic on which a controller manager waits; empty if none, or not known."""
    by_parameter = not is_from(distribution, "jazzy") and _NAME in node.settings
    waits = node.knows_parameters and not by_parameter
    return node.resolve(_topic(distribution)) if waits else ""


def _more(wiring: Wiring) -> str:
    """Return why the topics of descriptions are not all known; else nothing."""
    publishers = (it for it in wiring.every_node if it.node.package.value == STATE_PUBLISHER)
    reasons = (it.publishes_more(_DESCRIPTION) for it in publishers)
    return next(iter((*wiring.unread, *filter(None, reasons))), "")


_LAUNCH = """<launch>
  <node pkg="robot_state_publisher" exec="robot_state_publisher"@>
    <param name="robot_description" value="" type="str"/>
  </node>
  <node pkg="controller_manager" exec="ros2_control_node"%
  </node>
</launch>
"""


def _rover(distribution: str, manager: str = ">", state: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "README.md": f"A rover for ROS 2 {distribution}.\n",
        "launch/rover.launch.py": None,
        "launch/rover.launch.xml": _LAUNCH.replace("@", state).replace("%", manager),
    }


_ALONE = f"""<launch>
  <node pkg="controller_manager" exec="ros2_control_node"@>
    <param name="{_NAME}" value="" type="str"/>
  </node>
</launch>
"""


def _alone(distribution: str, mark: str = "", more: str = "") -> dict[str, object]:
    launch = _ALONE.replace("@>", f">{mark}").replace("</launch>", f"{more}</launch>")
    return {**_rover(distribution), "launch/rover.launch.xml": launch}


_MARK = ">  <!-- ^ WIR023 -->"
_GIVEN = '>\n<param name="robot_description" value="" type="str"/>'
GOOD = [
    _rover("Humble", _GIVEN),
    _rover("Humble", '>\n<remap from="~/robot_description" to="/robot_description"/>'),
    _rover("Humble", f'>\n<remap from="/controller_manager/{_NAME}" to="{_NAME}"/>'),
    _rover("Jazzy"),
    _rover("Jazzy", ' namespace="r1">', ' namespace="r1"'),
    _alone("Humble"),
    _alone("Jazzy", more='<node pkg="topic_tools" exec="relay" args="/urdf /robot_description"/>'),
]
BAD = [
    _rover("Humble", _MARK),
    _rover("Humble", f'{_MARK}\n<remap from="robot_description" to="/robot_description"/>'),
    _rover("Jazzy", f' namespace="r1"{_MARK}'),
    _rover("Jazzy", f"{_MARK}{_GIVEN[1:]}", ' namespace="r1"'),
    _alone("Jazzy", _MARK[1:]),
]
