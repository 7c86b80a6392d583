"""Folders of files without a package around them, and models within a package."""

from __future__ import annotations

from pathlib import Path

from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.settings import Settings

URDF = """<robot name="{name}">
  <link name="base">
    <inertial>
      <mass value="1"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
    <visual><geometry><mesh filename="../meshes/plate.obj"/></geometry></visual>
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
  </link>
</robot>
"""
PLATE = """v 0 0 0\nv 0.2 0 0\nv 0 0.2 0\nv 0 0 0.2
f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4
"""


def checked(given: Path, top: Path, *files: str) -> dict[str, PackageReport]:
    """Check a folder, with URDF files below its folder `top`; return the reports by package."""
    (top / "meshes").mkdir(parents=True)
    (top / "meshes" / "plate.obj").write_text(PLATE)
    for file in files:
        (top / file).parent.mkdir(parents=True, exist_ok=True)
        (top / file).write_text(URDF.format(name=Path(file).stem))
    return {report.name: report for report in check_package(given, Settings(trial=False)).packages}


def test_a_mesh_in_the_folder_beside_is_read(tmp_path: Path) -> None:
    report = checked(tmp_path, tmp_path / "dog", "solver/dog.urdf")["solver"]
    assert report.facts["visual_triangles"] == 4
    assert not any("in meshes" in it.reason for it in report.not_checked)


def test_a_mesh_above_the_given_folder_is_not_read(tmp_path: Path) -> None:
    top = tmp_path / "dog"
    report = checked(top / "solver", top, "solver/dog.urdf")["solver"]
    assert report.facts["visual_triangles"] == 0


def files_of(report: PackageReport) -> list[str]:
    """Return the files of a report's robots; of a single robot, its name."""
    robots = (report.facts, *report.other_robots)
    return [str(robot.get("file", robot["robot"])) for robot in robots]


def test_urdf_files_in_folders_below_are_judged_once(tmp_path: Path) -> None:
    files = "urdf/first.urdf", "xacro/second.urdf", "arm/urdf/third.urdf"
    reports = checked(tmp_path, tmp_path / "examples", *files)
    found = {name: files_of(report) for name, report in reports.items()}
    assert found == {"examples": ["urdf/first.urdf", "xacro/second.urdf"], "arm": ["third"]}


LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([Node(package='ros_gz_bridge', executable='parameter_bridge',
        arguments=['/clock@rosgraph_msgs/msg/Clok[gz.msgs.Clock'])])
"""
MANIFEST = """<package format="3"><name>tool</name><version>1.0.0</version>
<description>T</description>
<maintainer email="a@example.org">A</maintainer><license>MIT</license>
<export><build_type>ament_cmake</build_type></export></package>
"""


def test_launch_files_without_a_package_are_judged_once(tmp_path: Path) -> None:
    for file in "sim.launch.py", "bridges/more.launch.py", "tool/launch/own.launch.py":
        (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / file).write_text(LAUNCH)
    (tmp_path / "tool" / "package.xml").write_text(MANIFEST)
    reports = check_package(tmp_path, Settings(trial=False)).packages
    found = {
        (report.name, place.file)
        for report in reports
        for finding in report.findings
        if finding.rule == "BRG002"
        for place in finding.places
    }
    top = tmp_path.name
    assert found == {
        (top, "sim.launch.py"),
        (top, "bridges/more.launch.py"),
        ("tool", "launch/own.launch.py"),
    }


def test_the_robot_of_a_model_within_a_package_is_judged_there(tmp_path: Path) -> None:
    folder = tmp_path / "tool"
    for file in "urdf/arm.urdf", "models/box/box.urdf":
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_text(URDF.format(name=Path(file).stem))
    (folder / "package.xml").write_text(MANIFEST)
    (folder / "models/box/model.config").write_text("<model><sdf>box.urdf</sdf></model>")
    reports = check_package(tmp_path, Settings(trial=False)).packages
    found = {report.name: files_of(report) for report in reports}
    assert found == {"tool": ["arm"], "box": ["box"]}


def test_a_srdf_belongs_to_the_package_below_that_has_it(tmp_path: Path) -> None:
    arm = tmp_path / "src" / "arm_config"
    arm.mkdir(parents=True)
    (arm / "package.xml").write_text("<package><name>arm_config</name></package>")
    group = '<group name="g"><link name="base"/><link name="hand"/></group>'
    (arm / "arm.srdf").write_text(f'<robot name="arm">{group}</robot>')
    (tmp_path / "arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
    reports = check_package(tmp_path, Settings(trial=False)).packages
    assert len(reports) > 1
    assert not [it for report in reports for it in report.findings if it.rule == "URD031"]
