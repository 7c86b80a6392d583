"""A drive whose axle is not at the frame for which it publishes odometry.

The odometry of a drive with two sides is that of the point between its wheels, and it is published
as the pose of a frame of the robot. If this frame is elsewhere, a turn in place moves the frame
along a circle that the odometry does not tell: scans smear over each other in a turn, and the
controllers of Nav2 miss their path.

The middle between the foremost and the rearmost axle is compared, along x, for robots with one such
drive. Drives of Gazebo Classic take the pose from the simulator by default, and are not compared.

Fix: put the frame between the wheels, or name a link there (`base_footprint`) as the frame of the
odometry.
Source: REP 105, base_link; gz-math, DiffDriveOdometry: the pose is that of the middle of the axle.
"""

from collections.abc import Iterator

from checker.model.components import Plugin
from checker.model.locomotion.locomotion import WheelDrive
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ball_wheel
from checker.source.text import Located

_KINDS = ("DiffDrive", "DiffDriveController")
_FRAMES = ("child_frame_id", "base_frame_id")
"""Parameters of the frame that is placed: of Gazebo and of ros2_control."""


@rule("GEO018", "axle-away-from-base-frame", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, metres: float = 0.05, share: float = 0.2) -> Findings:
    """Report drives with two sides whose axle is in front of or behind their frame.

    Options:
        metres: Greatest distance along x.
        share: Greatest distance, divided by that of the left and the right wheels. What exceeds
            both is reported.
    """
    drives = [it for it in robot.locomotion.wheel_drives if it.plugin.class_name in _KINDS]
    for drive in drives if len(drives) == 1 else ():
        kind, frame = drive.plugin.class_name, next(_frames(drive), None)
        centres = [wheel.centre for wheel in drive.wheels if wheel.centre is not None]
        if frame is None or len(centres) != len(drive.wheels):
            continue
        pose = robot.pose_of(frame.value.strip("/").rpartition("/")[2])
        if pose is None or not centres:
            continue
        places = [pose.inverse.apply(centre) for centre in centres]
        x = (min(it[0] for it in places) + max(it[0] for it in places)) / 2
        across = max(it[1] for it in places) - min(it[1] for it in places)
        if abs(x) > max(metres, share * across):
            side = "in front of" if x > 0 else "behind"
            yield finding(
                frame,
                f"the axle of {kind} is {abs(x):.3g} m {side} {frame.value!r}, the frame of its "
                "odometry, which is wrong in turns: name a frame between the wheels",
            )


def _frames(drive: WheelDrive) -> Iterator[Located[str]]:
    """Yield the frame that the odometry of a drive places, if it is stated."""
    for name in _FRAMES:
        if isinstance(drive.plugin, Plugin):
            yield from drive.plugin.at(name)
        else:
            yield from drive.plugin.texts(name)


def _rover(x: float, frame: str = "base_link", mark: str = "") -> str:
    return f"""
<link name="axle"><pose>{x} 0 0 0 0 0</pose></link>
<joint name="mount" type="fixed"><parent>base_link</parent><child>axle</child></joint>
{ball_wheel("left", x, 0.2)}
{ball_wheel("right", x, -0.2)}
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>left_axle</left_joint>
  <right_joint>right_axle</right_joint>
  <child_frame_id>{frame}</child_frame_id>{mark}
</plugin>
"""


GOOD = [_rover(0.0), _rover(0.04), _rover(-0.15, "axle"), _rover(-0.15, "odom_frame")]
BAD = [
    _rover(-0.15, mark="  <!-- ^ GEO018 -->"),
    _rover(0.15, "acme/base_link", "  <!-- ^ GEO018 -->"),
]
