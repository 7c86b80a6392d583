"""A drive of ROS 1 publishes odometry for a link that has a parent in the robot.

tf keeps one parent for each frame. robot_state_publisher publishes the transform from the parent
link, and the drive that from its odometry frame: the robot jumps between two places, and lookups
fail at times. Odometry ends at the root of the robot, usually `base_footprint`. A link for the
odometry frame itself in the URDF is such a parent as well.

It is reported for `gazebo_ros_diff_drive` and `diff_drive_controller` of robots in whose workspace
a launch file starts robot_state_publisher. WIR001 reports the same in ROS 2.

Fix: name the root of the robot: `base_frame_id: base_footprint` for a controller,
`<robotBaseFrame>base_footprint</robotBaseFrame>` for the plugin; remove a link for the odometry
frame with its joint. Else state `enable_odom_tf: false` or `<publishOdomTF>false</publishOdomTF>`.
Source: tf2, `BufferCore::setTransform`; ros_controllers, diff_drive_controller.cpp; gazebo_plugins,
gazebo_ros_diff_drive.cpp.
"""

from checker.launch.ros2.package_launch import is_ros2_only
from checker.model.components import Plugin
from checker.model.locomotion.locomotion import WheelDrive
from checker.model.locomotion.odometry import Odometry, classic_odometry
from checker.model.robot import Robot
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located

_STATE_PUBLISHER = "robot_state_publisher"
_CONTROLLER = "diff_drive_controller/DiffDriveController"


@rule("KIN023", "odometry-of-child-frame", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, package: Package) -> Findings:
    """Report drives whose odometry ends at a link that is the child of a joint."""
    if is_ros2_only(package) or _STATE_PUBLISHER not in package.workspace.launch_words:
        return
    joints = {joint.child.value: joint for joint in robot.joints}
    for drive in robot.locomotion.wheel_drives:
        odometry = _odometry(drive)
        frame = odometry.child.value.strip("/") if odometry is not None else ""
        joint = joints.get(frame)
        if odometry is None or joint is None:
            continue
        parent = joint.parent.value
        switch = "<robotBaseFrame>" if isinstance(drive.plugin, Plugin) else "base_frame_id"
        cure = (
            f"remove link {parent!r}"
            if parent == odometry.parent
            else f"name the root of the robot as {switch}"
        )
        yield finding(
            odometry.child,
            f"tf gets two transforms to {frame!r}: from {odometry.parent!r} by the odometry, and "
            f"from {parent!r} by joint {joint.name.value!r}, so the robot jumps: {cure}",
            key=frame,
            related=[(joint, "the joint")],
        )


def _odometry(drive: WheelDrive) -> Odometry | None:
    source = drive.plugin
    if isinstance(source, Plugin):
        return classic_odometry(source)
    if source.type.value != _CONTROLLER or not source.flag("enable_odom_tf", default=True):
        return None
    usual = Located("base_link", source.span, stated=False)
    child = next(iter(source.texts("base_frame_id")), usual)
    parent = next((it.value for it in source.texts("odom_frame_id")), "odom")
    return Odometry(parent.strip("/"), child)


_ROBOT = """<robot name="cart">
<link name="base_footprint"/><link name="base_link"/>
<joint name="base" type="fixed"><parent link="base_footprint"/><child link="base_link"/></joint>
{wheels}
<gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so">
<leftJoint>left</leftJoint>
<rightJoint>right</rightJoint>
{frame}
</plugin></gazebo>
</robot>
"""
_WHEEL = """<link name="{0}_wheel">
<collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="{0}" type="continuous"><parent link="base_link"/><child link="{0}_wheel"/>
<origin xyz="0 {1} 0"/><axis xyz="0 1 0"/></joint>"""
_UNPUBLISHED = {"launch/control.launch": None, "launch/spawn.launch": None}


def _cart(frame: str) -> dict[str, object]:
    wheels = "\n".join(_WHEEL.format(side, y) for side, y in (("left", 0.2), ("right", -0.2)))
    return {"@urdf": True, "urdf/arm.urdf": _ROBOT.format(wheels=wheels, frame=frame)}


_MARK = "  <!-- ^ KIN023 -->"
_BASE = "<robotBaseFrame>base_link</robotBaseFrame>"
GOOD = [
    _cart("<robotBaseFrame>base_footprint</robotBaseFrame>"),
    _cart(""),
    _cart(f"{_BASE}<publishOdomTF>0</publishOdomTF>"),
    {**_cart(_BASE), **_UNPUBLISHED},
]
BAD = [
    _cart(f"{_BASE}{_MARK}"),
    _cart(f"<robotBaseFrame>/base_link</robotBaseFrame>{_MARK}"),
]
