"""What a robot that nothing moves in Gazebo needs, by its joints (WIR020)."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings

_SPAWN = """<launch>
  <include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf')"/>
  </node>
  <node pkg="ros_gz_sim" exec="create" args="-topic robot_description"/>
</launch>
"""
_JOINT = """<link name="{name}"/><joint name="{name}_joint" type="{type}">
  <parent link="base_link"/><child link="{name}"/><origin rpy="0 0 {yaw}"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="9" velocity="1"/></joint>
"""


@pytest.mark.parametrize(
    ("type", "name", "yaws", "advice"),
    [
        ("continuous", "wheel", (0, 3.14159265), "gz-sim-diff-drive-system"),
        ("continuous", "wheel", (0, 2.0944, -2.0944), "gz-sim-velocity-control-system"),
        ("revolute", "arm", (0, 0), "<ros2_control>"),
    ],
)
def test_advice(type: str, name: str, yaws: tuple[float, ...], advice: str, tmp_path: Path) -> None:
    joints = "".join(
        _JOINT.format(name=f"{name}_{number}", type=type, yaw=yaw)
        for number, yaw in enumerate(yaws)
    )
    robot = f'<robot name="cart"><link name="base_link"/>{joints}</robot>'
    files = {"launch/rover.launch.py": None, "launch/rover.launch.xml": _SPAWN}
    example = {"@bridge": True, **files, "urdf/rover.urdf": robot}
    package = write_example(example, tmp_path)
    (report,) = check_package(package, Settings(select=("WIR020",))).packages
    assert [f"; add {advice}" in it.message for it in report.findings] == [True]
