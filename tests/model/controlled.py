"""Robots that a controller of ros2_control moves, out of a description and parameters."""

from __future__ import annotations

from pathlib import Path

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.rule_testing import write_example


def controlled(folder: Path, links: str, kind: str, parameters: str) -> Robot:
    """Return a robot of these links; `parameters` are lines of YAML, indented by four spaces."""
    package = write_example(
        {
            "@urdf": f"""{links}
<ros2_control name="base" type="system">
  <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
  <joint name="rear_left"><command_interface name="velocity"/></joint>
</ros2_control>
<gazebo>
  <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <parameters>$(find acme_arm_description)/config/base.yaml</parameters>
  </plugin>
</gazebo>""",
            "config/base.yaml": f"base:\n  ros__parameters:\n    type: {kind}\n{parameters}",
        },
        folder,
    )
    return robot_in(package)


def robot_in(package: Path) -> Robot:
    """Return the first robot of a package."""
    with open_input(package) as opened:
        subject = Subject(opened.packages[0])
        robots = subject.all(Robot)
        subject.close()
    assert not isinstance(robots, NotAvailable)
    return robots[0]
