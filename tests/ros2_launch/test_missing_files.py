"""A missing file that two nodes of a launch file name is one finding."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings
from tests.ros2_launch.conftest import CMAKE, NAME, PACKAGE_XML, python

_BODY = f"""
share = get_package_share_directory('{NAME}')
path = os.path.join(share, 'config', 'lift.yaml')
return LaunchDescription([
    Node(package='p', executable='e', parameters=[path]),
    Node(package='p', executable='f', condition=IfCondition('false'), parameters=[path])])
"""


def test_a_condition_makes_no_finding_of_its_own(tmp_path: Path) -> None:
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "launch/lift.launch.py": "from launch.conditions import IfCondition\n" + python(_BODY),
        "config/lift_real.yaml": "",
    }
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(text)
    settings = Settings(trial=False, select=("LCH001",))
    (report,) = check_package(tmp_path / NAME, settings).packages
    (found,) = report.findings
    assert found.message.endswith("does not exist; config has lift_real.yaml")


@pytest.mark.parametrize(
    ("command", "severity"),
    [
        (f"ros2 run nav2_map_server map_saver_cli -f ~/ws/src/{NAME}/config/hall", "warning"),
        (f"cp lift.yaml {NAME}/config/", "warning"),
        (f"cp {NAME}/config/lift.yaml /tmp/", "error"),
        (f"ls {NAME}/config/", "error"),
    ],
)
def test_a_file_that_users_make_is_a_warning(command: str, severity: str, tmp_path: Path) -> None:
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "launch/lift.launch.py": "from launch.conditions import IfCondition\n" + python(_BODY),
        "README.md": f"```bash\n{command}\n```\n",
    }
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(text)
    settings = Settings(trial=False, select=("LCH001",))
    (report,) = check_package(tmp_path / NAME, settings).packages
    assert [str(found.severity) for found in report.findings] == [severity]


def test_a_launch_file_outside_of_packages_takes_files_by_its_own_path(tmp_path: Path) -> None:
    for path, text in {
        "launch/arm.launch.py": """import os
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    with open(os.path.join(top, "urdf", "arm", "arm.urdf")) as file:
        text = file.read()
    return LaunchDescription([Node(package="robot_state_publisher",
        executable="robot_state_publisher", parameters=[{"robot_description": text}])])
""",
        "urdf/arm/arm.urdf": '<robot name="arm"><link name="base_link"/></robot>',
        f"urdf/{NAME}/package.xml": PACKAGE_XML,
        f"ros2/{NAME}_msgs/package.xml": PACKAGE_XML.replace(NAME, f"{NAME}_msgs"),
    }.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, "utf-8")

    report = check_package(tmp_path, Settings(trial=False))

    (launch,) = (package for package in report.packages if package.name == "launch")
    assert launch.launched
    assert not [it.reason for it in launch.not_checked if "not available" in it.reason]
