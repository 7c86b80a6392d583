"""Launch files of ROS 2, written into a package and read."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path
from textwrap import dedent

import pytest

from checker.launch.ros2.graph import LaunchGraph
from checker.launch.ros2.reader import read_launch
from checker.package.inputs import open_input

NAME = "acme_bringup"
PACKAGE_XML = f"""<package format="3">
  <name>{NAME}</name>
  <version>1.0.0</version>
  <description>A robot</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
CMAKE = f"""project({NAME})
install(DIRECTORY launch config urdf DESTINATION share/${{PROJECT_NAME}})
ament_package()
"""
HEAD = """\
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import (DeclareLaunchArgument, ExecuteProcess, GroupAction,
    IncludeLaunchDescription, OpaqueFunction, RegisterEventHandler, SetEnvironmentVariable,
    SetLaunchConfiguration, TimerAction)
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (Command, EnvironmentVariable, FindExecutable,
    LaunchConfiguration, PathJoinSubstitution, PythonExpression)
from launch_ros.actions import (ComposableNodeContainer, LoadComposableNodes, Node,
    PushRosNamespace, SetParameter, SetRemap)
from launch_ros.descriptions import ComposableNode
from launch_ros.parameter_descriptions import ParameterFile, ParameterValue
from launch_ros.substitutions import FindPackageShare
"""

Read = Callable[..., LaunchGraph]


@pytest.fixture
def read(tmp_path: Path) -> Iterator[Read]:
    """A function that writes files of packages and reads the first one; Python gets its imports."""
    with ExitStack() as stack:

        def reading(
            text: str,
            file: str = "launch/robot.launch.py",
            others: Mapping[str, str] | None = None,
            **arguments: str,
        ) -> LaunchGraph:
            contents = {"package.xml": PACKAGE_XML, "CMakeLists.txt": CMAKE}
            contents |= {file: python(text) if file.endswith(".py") else dedent(text)}
            contents |= others or {}
            for path, content in contents.items():
                target = tmp_path / NAME / path
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_text(content)
            opened = stack.enter_context(open_input(tmp_path / NAME))
            return read_launch(opened.packages[0], file, arguments)

        yield reading


def python(text: str) -> str:
    """Return a launch file: statements, and an expression on the last line that is returned."""
    text = dedent(text).strip("\n")
    if "def generate_launch_description" in text:
        return HEAD + text + "\n"
    lines = [f"    {line}" for line in text.splitlines()]
    return f"{HEAD}\n\ndef generate_launch_description():\n" + "\n".join(lines) + "\n"
