"""A description whose launch file, in another package, is included by that of a third one."""

from __future__ import annotations

from pathlib import Path

from checker.finding import Severity
from checker.pipeline import check_package
from checker.settings import Settings
from tests.ros2_launch.conftest import CMAKE, NAME, PACKAGE_XML

_INERTIA = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
_URDF = f"""<robot name="arm">
<link name="base"><inertial><mass value="1"/>{_INERTIA}</inertial></link>
<link name="arm"/><joint name="j" type="revolute"><parent link="base"/><child link="arm"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
_STATE = f"""<launch><node pkg="robot_state_publisher" exec="robot_state_publisher">
<param name="robot_description" value="$(command 'cat $(find-pkg-share {NAME})/urdf/arm.urdf')"
  type="str"/></node></launch>"""
_GAZEBO = """<launch><include file="$(find-pkg-share arm_bringup)/launch/state.launch.xml"/>
<include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py"/>
<node pkg="ros_gz_sim" exec="create" args="-topic robot_description"/></launch>"""


def _write(folder: Path, name: str, files: dict[str, str]) -> Path:
    paperwork = {"package.xml": PACKAGE_XML, "CMakeLists.txt": CMAKE}
    for path, text in {**paperwork, **files}.items():
        target = folder / name / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text.replace(NAME, name) if path in paperwork else text)
    return folder / name


def test_a_description_is_simulated_by_a_chain_of_launch_files(tmp_path: Path) -> None:
    _write(tmp_path, "arm_bringup", {"launch/state.launch.xml": _STATE})
    _write(tmp_path, "arm_gazebo", {"launch/sim.launch.xml": _GAZEBO})
    package = _write(tmp_path, NAME, {"urdf/arm.urdf": _URDF})
    report = check_package(package, Settings(select=("URD007",), trial=False))

    assert Severity.WARNING in [found.severity for found in report.packages[0].findings]
