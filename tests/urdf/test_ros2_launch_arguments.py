"""What xacro is given by the ROS 2 launch files that load its files, and by the user."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.settings import find_settings

PACKAGE = """<package format="3">
  <name>acme_description</name><version>1.0.0</version><description>A</description>
  <maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
XACRO = """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:arg name="wide" default="false"/>
  <xacro:property name="size" value="${xacro.load_yaml('sizes.yaml')['$(arg kind)']}"/>
  <link name="$(arg base)"/>
  <xacro:if value="$(arg wide)"><link name="wing_${size}"/></xacro:if>
</robot>
"""
LAUNCH = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

def generate_launch_description():
    file = PathJoinSubstitution([FindPackageShare('acme_description'), 'urdf', 'r.urdf.xacro'])
    return LaunchDescription([
        DeclareLaunchArgument('base', default_value='base_link'),
        DeclareLaunchArgument('kind'@),
        Node(package='robot_state_publisher', executable='robot_state_publisher', parameters=[
            {'robot_description': Command(['xacro ', file, ' wide:=true kind:=',
                LaunchConfiguration('kind'), ' base:=', LaunchConfiguration('base')])}]),
    ])
"""


def package_with(folder: Path, default: str = "") -> Path:
    package = folder / "acme_description"
    files = {
        "package.xml": PACKAGE,
        "urdf/r.urdf.xacro": XACRO,
        "urdf/sizes.yaml": "small: 3\nlarge: 7\n",
        "launch/view.launch.py": LAUNCH.replace("@", default),
    }
    for path, text in files.items():
        (package / path).parent.mkdir(parents=True, exist_ok=True)
        (package / path).write_text(text)
    return package


def judged(package: Path) -> PackageReport:
    settings = find_settings([package]).with_overrides(trial=False, cache=False)
    (report,) = check_package(package, settings).packages
    return report


def test_arguments_of_launch_files_have_their_declared_defaults(tmp_path: Path) -> None:
    package = package_with(tmp_path, ", default_value='small'")
    assert judged(package).facts["links"] == 2


def test_a_missing_argument_names_the_launch_file_that_asks_for_it(tmp_path: Path) -> None:
    report = judged(package_with(tmp_path))
    reasons = {skipped.reason for skipped in report.not_checked}
    words = "launch/view.launch.py has no value for kind:=…"
    told = [reason for reason in reasons if words in reason]
    assert len(told) == 1
    assert not [f for f in report.findings if f.rule == "URD001"]


def test_a_launch_file_that_spawns_counts_before_one_that_shows(tmp_path: Path) -> None:
    package = package_with(tmp_path, ", default_value='small'")
    shown = (package / "launch/view.launch.py").read_text()
    spawn = "        Node(package='ros_gz_sim', executable='create',\n"
    spawn += "             arguments=['-topic', 'robot_description']),\n    ])"
    (package / "launch/zone.launch.py").write_text(shown.replace("    ])\n", spawn + "\n"))
    (package / "launch/view.launch.py").write_text(shown.replace("wide:=true", "wide:=false"))
    plugin = '<gazebo><plugin filename="ign_ros2_control-system" name="A"/></gazebo>'
    choice = f'<xacro:unless value="$(arg wide)">{plugin}</xacro:unless></robot>'
    (package / "urdf/r.urdf.xacro").write_text(XACRO.replace("</robot>", choice))
    report = judged(package)
    assert report.facts["links"] == 2
    (found,) = (it for it in report.findings if it.rule == "PLG002")
    assert found.severity is Severity.INFO
    assert "(Gazebo gets another description)" in found.message


@pytest.mark.parametrize("value", ['"small"', "true"])
def test_settings_give_arguments(tmp_path: Path, value: str) -> None:
    package = package_with(tmp_path)
    text = (package / "urdf/sizes.yaml").read_text() + "'true': 9\n"
    (package / "urdf/sizes.yaml").write_text(text)
    (package / "subt-check.toml").write_text(f"[xacro-args]\nkind = {value}\n")
    assert judged(package).facts["links"] == 2


def test_of_an_argument_without_default_the_first_choice_is_taken(tmp_path: Path) -> None:
    report = judged(package_with(tmp_path, ", choices=['small', 'large']"))
    assert (report.facts["links"], report.facts["assumed"]) == (2, "kind:=small")
    assert not [each for each in report.not_checked if "kind" in each.reason]


def test_a_choice_whose_files_are_not_there_gives_way_to_the_next_one(tmp_path: Path) -> None:
    package = package_with(tmp_path, ", choices=['huge', 'small']")
    file = package / "urdf/r.urdf.xacro"
    file.write_text(
        XACRO.replace("'sizes.yaml'", "'$(arg kind)/sizes.yaml'").replace("['$(arg kind)']", "")
    )
    (package / "urdf/small").mkdir()
    (package / "urdf/sizes.yaml").rename(package / "urdf/small/sizes.yaml")
    report = judged(package)
    assert report.facts["assumed"] == "kind:=small"
    reasons = {skipped.reason for skipped in report.not_checked}
    (told,) = (reason for reason in reasons if "huge" in reason)
    assert told.endswith("kind:=small is used instead")


def test_a_choice_serves_another_file_whose_default_is_none(tmp_path: Path) -> None:
    package = package_with(tmp_path, ", choices=['small', 'large']")
    (package / "urdf/other.urdf.xacro").write_text(
        """<robot name="other" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:arg name="kind" default="none"/>
  <xacro:property name="sizes" value="${xacro.load_yaml('$(arg kind)/sizes.yaml')}"/>
  <link name="base_${sizes['small']}"/>
</robot>
"""
    )
    (package / "urdf/large").mkdir()
    (package / "urdf/large/sizes.yaml").write_text("small: 3\n")
    assert not [each for each in judged(package).not_checked if "another value" in each.reason]


def test_a_launch_file_of_another_package_gives_arguments(tmp_path: Path) -> None:
    package = package_with(tmp_path)
    bringup = tmp_path / "acme_bringup"
    (bringup / "launch").mkdir(parents=True)
    (bringup / "package.xml").write_text(PACKAGE.replace("acme_description", "acme_bringup"))
    given = LAUNCH.replace("@", ", default_value='large'")
    (bringup / "launch/bringup.launch.py").write_text(given)
    assert judged(package).facts["links"] == 2
    (package / "launch/view.launch.py").unlink()
    assert judged(package).facts["links"] == 2
    (bringup / "launch/bringup.launch.py").write_text(LAUNCH.replace("@", ""))
    reasons = {skipped.reason for skipped in judged(package).not_checked}
    (told,) = (reason for reason in reasons if "has no value for kind:=…" in reason)
    assert "../acme_bringup/launch/bringup.launch.py" in told


CHOOSING = """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:arg name="kind" default=""/>
  <xacro:include filename="$(arg kind).xacro"/>
</robot>
"""
CLASSIC = """<launch>
  <arg name="kind"/>
  <param name="robot_description"
         command="xacro $(find acme_description)/urdf/r.urdf.xacro kind:=$(arg kind)"/>
</launch>
"""


@pytest.mark.parametrize("launch", ["view.launch.py", "view.launch", ""])
def test_an_argument_that_is_empty_by_default_is_asked_for(launch: str, tmp_path: Path) -> None:
    package = package_with(tmp_path)
    (package / "urdf/r.urdf.xacro").write_text(CHOOSING)
    (package / "urdf/small.xacro").write_text('<robot name="r"><link name="base"/></robot>')
    if launch != "view.launch.py":
        (package / "launch/view.launch.py").unlink()
    if launch == "view.launch":
        (package / "launch/view.launch").write_text(CLASSIC)
    report = judged(package)
    assert not [each for each in report.findings if each.rule == "URD001"]
    assert [each for each in report.not_checked if "needs --xacro-arg kind:=…" in each.reason]
    (package / "subt-check.toml").write_text('[xacro-args]\nkind = "small"\n')
    assert judged(package).facts["links"] == 1


def test_a_fault_that_the_argument_has_no_part_in_stays(tmp_path: Path) -> None:
    package = package_with(tmp_path)
    text = CHOOSING.replace("$(arg kind).xacro", "lost.xacro")
    (package / "urdf/r.urdf.xacro").write_text(text)
    assert [each for each in judged(package).findings if each.rule == "URD001"]
