"""Meshes of a description package that a launch file of another package has Gazebo look for."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import find_settings

MANIFEST = """<package format="3">
  <name>@</name><version>1.0.0</version><description>A</description>
  <maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
BUILD = """project(@)
find_package(ament_cmake REQUIRED)
install(DIRECTORY launch meshes urdf DESTINATION share/${PROJECT_NAME})
ament_package()
"""
XACRO = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
  <link name="base"><visual><geometry>
    <mesh filename="package://arm_description/meshes/base.dae"/>
  </geometry></visual></link>
</robot>
"""
LAUNCH = """import os
from pathlib import Path
from ament_index_python.packages import get_package_prefix, get_package_share_directory
from launch import LaunchDescription
from launch.actions import (
    AppendEnvironmentVariable, ExecuteProcess, IncludeLaunchDescription, SetEnvironmentVariable)
from launch.substitutions import (
    Command, EnvironmentVariable, LaunchConfiguration, PathJoinSubstitution)
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackagePrefix, FindPackageShare


def generate_launch_description():
    share = get_package_share_directory('arm_description')
    robot = Command(['xacro ', os.path.join(share, 'urdf', 'arm.urdf.xacro')])
    return LaunchDescription([
        BEFORE
        IncludeLaunchDescription(PathJoinSubstitution(
            [FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py'])),
        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': robot}]),
        Node(package='ros_gz_sim', executable='create', arguments=['-topic', 'robot_description']),
    ])
"""
SET = "SetEnvironmentVariable('GZ_SIM_RESOURCE_PATH', @),"
HOOK = 'ament_environment_hooks("hooks/arm.dsv")\nament_package'
DSV = "prepend-non-duplicate;GZ_SIM_RESOURCE_PATH;share\n"


def found(folder: Path, before: str = "", more: Mapping[str, str] | None = None) -> list[str]:
    """Return what is reported of two packages, some of whose files are others."""
    files = {
        "arm_description/package.xml": MANIFEST.replace("@", "arm_description"),
        "arm_description/CMakeLists.txt": BUILD.replace("@", "arm_description"),
        "arm_description/urdf/arm.urdf.xacro": XACRO,
        "arm_description/meshes/base.dae": "<COLLADA/>",
        "arm_bringup/package.xml": MANIFEST.replace("@", "arm_bringup"),
        "arm_bringup/CMakeLists.txt": BUILD.replace("@", "arm_bringup"),
        "arm_bringup/launch/arm.launch.py": LAUNCH.replace("BEFORE", before),
        **(more or {}),
    }
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    package = folder / "arm_bringup"
    settings = find_settings([package]).with_overrides(trial=False, cache=False)
    (report,) = check_package(package, settings).packages
    return [finding.message for finding in report.findings if finding.rule == "LCH012"]


def test_nothing_puts_the_packages_on_the_path(tmp_path: Path) -> None:
    (message,) = found(tmp_path)
    assert message.startswith("package://arm_description/meshes/base.dae is visible in RViz")
    assert "package.xml of arm_description" in message


def test_gazebo_without_its_launch_file_reads_no_package_xml(tmp_path: Path) -> None:
    started = LAUNCH.replace(
        "IncludeLaunchDescription(PathJoinSubstitution(\n"
        "            [FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py']))",
        "ExecuteProcess(cmd=['gz', 'sim', '-r', 'empty.sdf'])",
    )
    assert started != LAUNCH
    files = {"arm_bringup/launch/arm.launch.py": started.replace("BEFORE", "")}
    (message,) = found(tmp_path, "", files)
    assert "environment hook" in message
    assert "package.xml" not in message


@pytest.mark.parametrize(
    "before",
    [
        SET.replace("@", "str(Path(share).parent)"),
        SET.replace("@", "os.path.dirname(share)"),
        SET.replace("@", "os.path.join(get_package_prefix('arm_description'), 'share')"),
        SET.replace("@", "[FindPackagePrefix('arm_description'), '/share']"),
        SET.replace("@", "[os.path.join(share, 'x'), os.pathsep, share + '/..']"),
        SET.replace("@", "[EnvironmentVariable('GZ_SIM_RESOURCE_PATH'), ':', '/x']"),
        SET.replace("@", "os.environ['HOME']"),
        SET.replace("@", "LaunchConfiguration('resources')"),
        SET.replace("GZ_SIM_", "IGN_GAZEBO_").replace("@", "os.path.dirname(share)"),
        SET.replace("@", "compute()"),
        "*actions(),",
        "IncludeLaunchDescription(PathJoinSubstitution([FindPackageShare('x'), 'y.launch.py'])),",
        "ExecuteProcess(cmd=['gz'], additional_env={'GZ_SIM_RESOURCE_PATH': 'x'}),",
    ],
)
def test_the_launch_file_puts_them_there_or_may(tmp_path: Path, before: str) -> None:
    assert found(tmp_path, before) == []


@pytest.mark.parametrize("path", ["share", "os.path.join(share, 'models')", "'/usr/share/models'"])
def test_another_folder_is_of_no_use(tmp_path: Path, path: str) -> None:
    (message,) = found(tmp_path, SET.replace("@", path))
    assert ("and not the folder above it" in message) is (path == "share")


@pytest.mark.parametrize(
    "more",
    [
        {
            "arm_description/CMakeLists.txt": BUILD.replace("ament_package", HOOK),
            "arm_description/hooks/arm.dsv": DSV,
        },
        {"arm_description/README.md": "export GZ_SIM_RESOURCE_PATH=~/ws/install/share\n"},
        {"arm_bringup/docker/Dockerfile": "ENV GZ_SIM_RESOURCE_PATH=/ws/install/share\n"},
        {
            "other/package.xml": MANIFEST.replace("@", "other").replace(
                "<export>", '<export><gazebo_ros gazebo_model_path="${prefix}/.."/>'
            )
        },
        {
            "other/package.xml": MANIFEST.replace("@", "other"),
            "other/launch/all.launch.py": LAUNCH.replace("BEFORE", SET.replace("@", "'x'")),
        },
        {
            "arm_description/urdf/arm.urdf.xacro": XACRO.replace(
                "package://arm_description", "file://$(find arm_description)"
            )
        },
    ],
)
def test_something_else_puts_them_there_or_may(tmp_path: Path, more: dict[str, str]) -> None:
    assert found(tmp_path, "", more) == []
