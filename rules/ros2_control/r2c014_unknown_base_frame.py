"""A drive controller whose base frame is not a link of the robot.

The controller publishes the transform from `odom` to its `base_frame_id`; robot_state_publisher
publishes those of the links. If no link has that name, there are two trees: data of a sensor cannot
be transformed into `odom`, and navigation waits for the transform.

Fix: write the robot's root link as `base_frame_id`; without it the controllers take `base_link`.
Source: ros2_controllers, `base_frame_id` of diff_drive_controller, tricycle_controller and the
steering controllers; REP 105.
"""

from checker.launch.ros2.graph import Ros2Launch
from checker.model.controllers import Controller
from checker.ros.ros2_control.distributions import controller_types
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located

_FRAME = "base_frame_id"
_STATIC = ("static_transform_publisher", "tf2_ros::StaticTransformBroadcasterNode")


@rule("R2C014", "unknown-base-frame", Severity.WARNING, Concern.INTERFACE)
def check(control: RobotControl, launch: Ros2Launch) -> Findings:
    """Report frames that are not links, unless a launch file publishes more transforms."""
    if control.robot.missing_parts:
        yield unchecked(control.robot.missing_parts)
        return
    links = {link.name.value for link in control.robot.links}
    if any(node.executable.value in _STATIC for node in launch.nodes):
        return
    for controller in control.controllers:
        frame = _base_frame(controller)
        if frame is None or frame.value in links or "/" in frame.value:
            continue
        leaves = f"has {_FRAME} {frame.value!r}"
        if not frame.stated:
            leaves = f"states no {_FRAME}, so it is {frame.value!r}"
        yield finding(
            frame,
            f"{controller.label} {leaves}, which is not a link of robot "
            f"{control.robot.name.value!r}",
        )


def _base_frame(controller: Controller) -> Located[str] | None:
    """Return what a controller takes for the robot's base; None if unknown."""
    known = controller_types().get(controller.type.value)
    usual = known.params.get(_FRAME) if known is not None else None
    if usual is None:
        return None
    stated = controller.parameters.get(_FRAME)
    if stated is None:
        return Located(str(usual.default), controller.span, stated=False)
    return next(iter(stated.texts), None)


def _arm(frame: str, package: str = "robot_state_publisher", publisher: str = "") -> object:
    node = f"Node(package='{package}', executable='{publisher or package}')"
    return {
        "@urdf": """
<ros2_control name="arm" type="system">
  <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
  <joint name="shoulder"><command_interface name="velocity"/></joint>
</ros2_control>
""",
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    drive_controller: {{type: diff_drive_controller/DiffDriveController}}
drive_controller:
  ros__parameters:
    left_wheel_names: [shoulder]
    {frame}
""",
        "launch/arm.launch.py": f"""from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([{node}])
""",
    }


_MARK = "  # ^ R2C014"
GOOD = [
    _arm("base_frame_id: base_link"),
    _arm(""),
    _arm('base_frame_id: "$(var frame)"'),
    _arm("base_frame_id: base_footprint", "tf2_ros", _STATIC[0]),
]
BAD = [_arm(f"base_frame_id: base_footprint{_MARK}")]
