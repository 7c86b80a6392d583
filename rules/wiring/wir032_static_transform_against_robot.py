"""A static transform in ROS 1 contradicts the joints of the robot, or its odometry.

tf keeps one parent for each frame. robot_state_publisher publishes each joint as a transform from
its parent to its child, and the drive plugin of Gazebo publishes `odom` to the base. A
`static_transform_publisher` whose child is one of these frames gives it a second parent: the frame
jumps between two places, and lookups fail at times. One whose parent is below its child in the
robot closes a loop, with which no transform of the robot is found at all: an error.

The robot is the one that the launch file describes or spawns, also that of another package. It is
not reported where the launch file sets `tf_prefix`, or its robot is not known; WIR001 reports the
same in ROS 2.

Fix: remove the static_transform_publisher; the URDF has the transform already.
Source: tf2, `BufferCore::setTransform` and "The tf tree is invalid because it contains a loop";
gazebo_plugins of ROS 1, `gazebo_ros_diff_drive` and `gazebo_ros_planar_move`.
"""

from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.formats.xacro.expansion import Expander
from checker.launch.ros1.graph import LaunchGraph, Node
from checker.launch.ros1.package_launch import LaunchEntries
from checker.launch.ros1.substitution import is_known
from checker.launch.ros2.package_launch import is_ros2_only
from checker.model.components import Joint
from checker.model.locomotion.odometry import classic_odometry
from checker.model.robot import Robot
from checker.package.package import Package
from checker.ros.launched_robots import launched_robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Span

_STATIC = "static_transform_publisher"
_WORDS = {"tf": (9, 10), "tf2_ros": (8, 9)}
"""Words of its command line: a place, three or four numbers, two frames; in tf also a period."""
_STATE_PUBLISHER = "robot_state_publisher"


class _Static(Record, eq=False):
    """A static transform of a launch file."""

    node: Node
    parent: str
    child: str


@rule("WIR032", "static-transform-against-robot", Severity.WARNING, Concern.INTERFACE)
def check(package: Package, launch: LaunchEntries, expander: Expander) -> Findings:
    """Report static transforms that give a frame of the robot a second parent, or close a loop."""
    if is_ros2_only(package):
        return
    for entry in launch.entries:
        statics = [*_statics(entry.graph)]
        prefixed = any(param.name.endswith("tf_prefix") for param in entry.graph.params)
        robot = launched_robot(package, entry.graph, expander) if statics and not prefixed else None
        if robot is None:
            continue
        published = any(node.package == _STATE_PUBLISHER for node in entry.graph.nodes)
        joints = {_frame(it.child.value): it for it in robot.joints} if published else {}
        drives = dict(_odometry(robot))
        for static in statics:
            found = _against_joints(static, joints) or _against_drive(static, drives)
            yield from [found] if found is not None else []


def _statics(graph: LaunchGraph) -> Iterator[_Static]:
    for node in graph.nodes:
        words = [word.value for word in node.words]
        if node.type == _STATIC and len(words) in _WORDS.get(node.package, ()):
            parent, child = words[-3:-1] if node.package == "tf" else words[-2:]
            if is_known(parent) and is_known(child):
                yield _Static(node, _frame(parent), _frame(child))


def _frame(name: str) -> str:
    return name.strip().removeprefix("/")


def _odometry(robot: Robot) -> Iterator[tuple[str, tuple[str, Span]]]:
    """Yield the frames that drive plugins place, each with its parent and the plugin."""
    for plugin in robot.plugins:
        odometry = classic_odometry(plugin)
        if odometry is not None:
            yield _frame(odometry.child.value), (odometry.parent, plugin.span)


def _against_joints(static: _Static, joints: Mapping[str, Joint]) -> Finding | None:
    above = _above(static.parent, joints)
    if static.child in above:
        joint = above[static.child]
        return finding(
            static.node,
            f"node {static.node.name!r} puts {static.child!r} below {static.parent!r}, which the "
            f"robot has below {static.child!r}: a loop, with which tf finds no transform; "
            "remove the node",
            severity=Severity.ERROR,
            key=f"{static.parent} {static.child}",
            related=[(joint.span, f"joint {joint.name.value!r}")],
        )
    if static.child not in joints:
        return None
    joint = joints[static.child]
    return _second(static, _frame(joint.parent.value), f"joint {joint.name.value!r}", joint.span)


def _above(frame: str, joints: Mapping[str, Joint]) -> dict[str, Joint]:
    """Return the frames above a frame, each with the joint below it on the way."""
    found: dict[str, Joint] = {}
    while frame in joints and _frame(joints[frame].parent.value) not in found:
        joint = joints[frame]
        frame = _frame(joint.parent.value)
        found[frame] = joint
    return found


def _against_drive(static: _Static, drives: Mapping[str, tuple[str, Span]]) -> Finding | None:
    if static.child not in drives:
        return None
    parent, span = drives[static.child]
    return _second(static, parent, "the drive plugin", span)


def _second(static: _Static, parent: str, by: str, span: Span) -> Finding:
    name, child = static.node.name, static.child
    fault = (
        f"transform {parent} → {child} has two publishers, node {name!r} and {by}"
        if parent == static.parent
        else f"frame {child!r} has two parents, {static.parent!r} from node {name!r} and "
        f"{parent!r} from {by}"
    )
    return finding(
        static.node,
        f"{fault}: remove the node",
        key=f"{static.parent} {child}",
        related=[(span, f"{by} publishes {parent} → {child}")],
    )


_ROBOT = '<param name="robot_description" textfile="$(find acme_arm_description)/urdf/arm.urdf"/>'
_PUBLISHER = '<node name="states" pkg="robot_state_publisher" type="robot_state_publisher"/>'
_SPAWN = """<node name="spawn" pkg="gazebo_ros" type="spawn_model"
  args="-urdf -model arm -file $(find acme_arm_description)/urdf/arm.urdf"/>"""
_PLUGIN = """<robot name="arm">
  <link name="base_footprint"/>
  <gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so">{}</plugin></gazebo>
</robot>
"""


def _launch(
    frames: str, mark: str = "", more: str = _PUBLISHER, package: str = "tf"
) -> dict[str, object]:
    period = " 100" if package == "tf" else ""
    args = f'args="0 0 0.1 0 0 0 {frames}{period}"'
    node = f'<node name="mount" pkg="{package}" type="static_transform_publisher" {args}/>{mark}'
    return {
        "@urdf": True,
        "launch/show.launch": f"<launch>\n{_ROBOT}\n{more}\n{node}\n</launch>\n",
    }


def _driven(inside: str, mark: str = "") -> dict[str, object]:
    return {
        **_launch("base_link base_footprint", mark, more=_SPAWN),
        "urdf/arm.urdf": _PLUGIN.format(inside),
    }


_MARK = "  <!-- ^ WIR032 -->"
GOOD = [
    _launch("map base_link"),
    _launch("upper_arm tool"),
    _launch("base_link upper_arm", more=""),
    _launch("base_link upper_arm", more=f'{_PUBLISHER}\n<param name="tf_prefix" value="a"/>'),
    _driven("<publishOdomTF>false</publishOdomTF>"),
]
BAD = [
    _launch("base_link upper_arm", _MARK),
    _launch("/upper_arm /base_link", _MARK),
    _launch("map upper_arm", _MARK, package="tf2_ros"),
    _driven("", _MARK),
]
