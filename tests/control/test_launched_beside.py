"""Robots of ROS 1 whose controllers another package loads, in a launch file of a third one."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings

_WHEEL = """<link name="{side}_wheel">
  <collision><origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.05" length="0.02"/></geometry>
  </collision>
  <inertial><mass value="0.2"/>
    <inertia ixx="0.0002" iyy="0.0003" izz="0.0002" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="{side}_axle" type="continuous"><parent link="base_link"/><child link="{side}_wheel"/>
  <origin xyz="0 {y} 0"/><axis xyz="0 1 0"/></joint>
<transmission name="{side}"><type>transmission_interface/SimpleTransmission</type>
  <joint name="{side}_axle"><hardwareInterface>hardware_interface/VelocityJointInterface
  </hardwareInterface></joint><actuator name="{side}_motor"/></transmission>
"""
_ROBOT = f"""<robot name="cart"><link name="base_link"/>
{_WHEEL.format(side="left", y=0.1)}{_WHEEL.format(side="right", y=-0.1)}</robot>"""
_YAML = """drive:
  type: diff_drive_controller/DiffDriveController
  left_wheel: left_axle
  right_wheel: right_axle
  wheel_separation: 0.2
  wheel_radius: 0.2
"""
_LAUNCH = """<launch>
  <param name="robot_description" textfile="$(find cart_description)/urdf/{robot}.urdf"/>
  <rosparam command="load" file="$(find cart_control)/config/drive.yaml"/>
  <node pkg="controller_manager" type="spawner" name="spawner" args="drive"/>
</launch>
"""


@pytest.mark.parametrize(("launched", "count"), [("cart", 1), ("other", 0)])
def test_controllers_count_for_the_robot_that_is_launched_with_them(
    launched: str, count: int, tmp_path: Path
) -> None:
    files = {
        "cart_description/urdf/cart.urdf": _ROBOT,
        "cart_description/urdf/other.urdf": '<robot name="other"><link name="base_link"/></robot>',
        "cart_control/config/drive.yaml": _YAML,
        "cart_gazebo/launch/cart.launch": _LAUNCH.format(robot=launched),
    }
    for name in ("cart_description", "cart_control", "cart_gazebo"):
        files[f"{name}/package.xml"] = f"<package><name>{name}</name></package>"
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    settings = Settings(select=("GEO004",), trial=False)
    report = check_package(tmp_path / "cart_description", settings).packages[0]
    assert len(report.findings) == count
