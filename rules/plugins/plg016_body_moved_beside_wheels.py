"""A plugin sets the velocity of the whole robot on the commands that its wheels get, too.

`gazebo_ros_planar_move` of Gazebo Classic, and VelocityControl of Gazebo Sim, set the velocity of
the body in each step. A drive plugin on the same topic turns the wheels beside it, which have no
effect: friction, torque and slip are not simulated, a wrong wheel radius is not seen, and in
Classic both publish odometry.

Fix: keep the plugin that drives the real robot's wheels, and remove the other one.
Source: gazebo_ros_pkgs, gazebo_ros_planar_move.cpp; gz-sim, VelocityControl.
"""

from checker.model.locomotion.body_drive import body_drives
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ball_wheel


@rule("PLG016", "body-moved-beside-wheels", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report plugins that move the body on the topic of a drive plugin."""
    for it in body_drives(robot):
        drive = it.wheels.class_name or library_stem(it.wheels.filename.value)
        yield finding(
            it.plugin,
            f"{it.name} sets the velocity of the body on {it.topic!r}, so the wheels that {drive} "
            "turns on the same topic do not move the robot: remove one of the two",
            related=[(it.wheels, "turns the wheels")],
        )


def _rover(topic: str, mark: str = "") -> str:
    return f"""
{ball_wheel("left", 0, 0.2)}
{ball_wheel("right", 0, -0.2)}
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>left_axle</left_joint>
  <right_joint>right_axle</right_joint>
</plugin>
<plugin filename="libv.so" name="ignition::gazebo::systems::VelocityControl">{mark}
  {topic}
</plugin>
"""


_MARK = "  <!-- ^ PLG016 -->"
GOOD = [_rover("<topic>/push</topic>")]
BAD = [_rover("", _MARK), _rover("<topic>/cmd_vel</topic>", _MARK)]
