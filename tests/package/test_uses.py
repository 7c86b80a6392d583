"""Which other packages a package uses."""

from __future__ import annotations

from pathlib import Path

from checker.package.dependencies import duplicate_files, uses_of
from checker.package.package import Package
from checker.package.workspace import Workspace

LAUNCH = """<launch>
  <!-- $(find not_this) -->
  <node pkg="ros_ign_bridge" type="a" name="b"/>
  <node pkg="$(arg p)" type="a" name="c"/>
  <include file="$(find subt_ros)/launch/a.launch"/>
  <param name="d" command="$(find xacro)/xacro $(find rover)/urdf/a.xacro"/>
</launch>
"""
SPAWNER = """
require_relative '../../x1_sensor_config_6/launch/common'
# roslaunch not_this description.launch
"<command>roslaunch --wait x2_sensor_config_7 description.launch</command>"
"""
MODEL = """<sdf version="1.6"><model name="m"><link name="l">
  <visual name="v"><geometry><mesh>
    <uri>model://x3_sensor_config_1/meshes/a.dae</uri>
  </mesh></geometry></visual>
</link><include><uri>model://crate/</uri></include></model></sdf>
"""


def test_launch_files_spawner_and_model_name_packages(tmp_path: Path) -> None:
    folder = tmp_path / "rover"
    (folder / "launch").mkdir(parents=True)
    (folder / "launch/a.launch").write_text(LAUNCH, "utf-8")
    (folder / "launch/b.launch").write_text("<launch>", "utf-8")
    (folder / "launch/spawner.rb").write_text(SPAWNER, "utf-8")
    (folder / "model.sdf").write_text(MODEL, "utf-8")
    uses = list(uses_of(Package(folder, Workspace((tmp_path,)))))
    assert {(use.package_name, str(use.place).rpartition(":")[0]) for use in uses} == {
        ("ros_ign_bridge", "launch/a.launch:3"),
        ("subt_ros", "launch/a.launch:5"),
        ("xacro", "launch/a.launch:6"),
        ("rover", "launch/a.launch:6"),
        ("x1_sensor_config_6", "launch/spawner.rb:2"),
        ("x2_sensor_config_7", "launch/spawner.rb:4"),
        ("x3_sensor_config_1", "model.sdf:3"),
    }


OTHER = "husky_sensor_config_1"
COPIED = f"""<robot>
  <a b="package://{OTHER}/meshes/a.dae"/>
  <a b="package://{OTHER}/meshes/b.dae"/>
  <a b="package://{OTHER}/meshes/${{c}}"/>
  <a b="package://{OTHER}/meshes"/>
  <a b="$(find {OTHER})/urdf/a.xacro"/>
  <a b="package://rover_sensor_config_2/meshes/a.dae"/>
  <!-- package://{OTHER}/meshes/a.dae -->
  <a>$(find {OTHER})/meshes/a.dae</a>
</robot>
"""


def test_files_of_another_robot_that_the_package_has_itself(tmp_path: Path) -> None:
    folder = tmp_path / "rover_sensor_config_1"
    for part in ("meshes", "urdf"):
        (folder / part).mkdir(parents=True)
    (folder / "meshes/a.dae").touch()
    (folder / "urdf/a.xacro").write_text(COPIED, "utf-8")
    taken = list(duplicate_files(Package(folder, Workspace((tmp_path,)))))
    assert [(use.place.line, use.package_name) for use in taken] == [(2, OTHER), (9, OTHER)]
