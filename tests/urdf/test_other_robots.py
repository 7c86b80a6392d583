"""Robots that a xacro file makes with other values of its arguments than the defaults."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.robots.other_robots import TRIED_LIMIT
from checker.settings import find_settings
from tests.urdf.test_ros2_launch_arguments import PACKAGE

HEAD = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">'
HAND = """<link name="hand"/>
<joint name="wrist" type="fixed"><parent link="base_link"/><child link="hadn"/></joint>"""
CHOSEN = f"""{HEAD}
  <xacro:arg name="tool" default="none"/>
  <link name="base_link"/>
  @
</robot>
"""
TEST = f"<xacro:if value=\"${{'$(arg tool)' == 'hand'}}\">{HAND}</xacro:if>"
INCLUDE = '<xacro:include filename="tools/$(arg tool).xacro"/>'
LAUNCH = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

def generate_launch_description():
    file = PathJoinSubstitution([FindPackageShare('acme_description'), 'urdf', 'r.urdf.xacro'])
    return LaunchDescription([
        DeclareLaunchArgument('tool', default_value='none', choices=['none', 'hand']),
        Node(package='robot_state_publisher', executable='robot_state_publisher', parameters=[
            {'robot_description': Command(['xacro ', file, ' tool:=', LaunchConfiguration('tool')])}
        ]),
    ])
"""


def judged(folder: Path, body: str, *others: tuple[str, str]) -> PackageReport:
    files = [("package.xml", PACKAGE), ("urdf/r.urdf.xacro", CHOSEN.replace("@", body)), *others]
    for path, text in files:
        file = folder / "acme_description" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    package = folder / "acme_description"
    settings = find_settings([package]).with_overrides(trial=False, cache=False)
    (report,) = check_package(package, settings).packages
    return report


def messages(report: PackageReport, rule: str) -> list[str]:
    return [found.message for found in report.findings if found.rule == rule]


PARTS = (
    ("urdf/tools/none.xacro", f"{HEAD}</robot>"),
    ("urdf/tools/hand.xacro", f"{HEAD}{HAND}</robot>"),
)
PROPERTY = "<xacro:property name='own' value='$(arg tool)'/>"
COMPUTED = PROPERTY + INCLUDE.replace("$(arg tool)", "${own}")
IN_A_MACRO = f"""<xacro:macro name="arm" params="end">
  <xacro:if value="${{end == 'hand'}}">{HAND}</xacro:if>
</xacro:macro>
<xacro:arm end="$(arg tool)"/>"""
TWICE = INCLUDE.replace("tools/", "tools/$(arg tool)/arm_")
IN_FOLDERS = (
    ("urdf/tools/none/arm_none.xacro", f"{HEAD}</robot>"),
    ("urdf/tools/hand/arm_hand.xacro", f"{HEAD}{HAND}</robot>"),
    ("urdf/tools/other.xacro", f"{HEAD}</robot>"),
)
BY_PYTHON = f"{PROPERTY}<xacro:if value='${{own.startswith(\"ha\")}}'>{HAND}</xacro:if>"


@pytest.mark.parametrize(
    ("body", "others"),
    [
        (TEST, ()),
        (INCLUDE, PARTS),
        (COMPUTED, PARTS),
        (TWICE, IN_FOLDERS),
        (IN_A_MACRO, ()),
        (BY_PYTHON, [("launch/view.launch.py", LAUNCH)]),
    ],
    ids=[
        "compared",
        "file name",
        "property in a file name",
        "twice in a file name",
        "parameter",
        "choice of a launch file",
    ],
)
def test_what_another_value_leads_to_is_judged(
    tmp_path: Path, body: str, others: Sequence[tuple[str, str]]
) -> None:
    report = judged(tmp_path, body, *others)
    (message,) = messages(report, "KIN001")
    assert message.endswith("(with tool:=hand)")
    assert report.facts["also_tried"] == "tool:=hand"
    assert report.facts["links"] == 1


def test_a_file_that_a_choice_leads_to_gets_the_arguments(tmp_path: Path) -> None:
    launch = LAUNCH.replace("'r.urdf.xacro'", "[LaunchConfiguration('tool'), '.urdf.xacro']")
    launch = launch.replace("' tool:=', LaunchConfiguration('tool')", "' side:=left'")
    robot = f"{HEAD}<link name='base_link'/><link name='$(arg side)_arm'/>@</robot>"
    files = [
        ("launch/view.launch.py", launch),
        ("urdf/none.urdf.xacro", robot.replace("@", "")),
        ("urdf/hand.urdf.xacro", robot.replace("@", HAND)),
    ]
    report = judged(tmp_path, "", *files)
    (found,) = (it for it in report.findings if it.rule == "KIN001")
    assert found.places[0].file == "urdf/hand.urdf.xacro"
    assert not any(it.rule == "URD001" for it in report.findings)


def test_a_flag_is_tried_both_ways(tmp_path: Path) -> None:
    flag = "<xacro:arg name='hand' default='false'/><xacro:if value='$(arg hand)'>"
    report = judged(tmp_path, f"{flag}{HAND}</xacro:if>")
    assert report.facts["also_tried"] == "hand:=true"
    assert len(messages(report, "KIN001")) == 1


def test_what_the_default_shows_too_is_told_once(tmp_path: Path) -> None:
    lens = TEST.replace(HAND, '<link name="lens"/>')
    report = judged(tmp_path, HAND + lens.replace("'hand'", "'lens'"))
    assert report.facts["also_tried"] == "tool:=lens"
    (message,) = messages(report, "KIN001")
    assert "with" not in message.split()


def test_a_value_that_the_user_gives_is_the_only_one(tmp_path: Path) -> None:
    (tmp_path / "acme_description").mkdir()
    (tmp_path / "acme_description/subt-check.toml").write_text('[xacro-args]\ntool = "none"\n')
    report = judged(tmp_path, TEST)
    assert "also_tried" not in report.facts
    assert not messages(report, "KIN001")


def test_a_suppression_of_what_another_value_leads_to_is_of_use(tmp_path: Path) -> None:
    comment = "<!-- subt-check: ignore[KIN001] the file is being rewritten -->"
    body = TEST.replace("<joint", f"{comment}<joint")
    report = judged(tmp_path, body)
    assert not messages(report, "KIN001")
    assert [it.finding.message for it in report.suppressed]
    assert not messages(report, "CFG002")


SWITCHES = """
  <xacro:arg name="classic" default="false"/>
  <xacro:arg name="fortress" default="false"/>
  <xacro:if value="$(arg fortress)"><link name="simulated"/></xacro:if>
  <xacro:if value="$(arg classic)"><link name="simulated"/></xacro:if>
"""
EITHER = '<xacro:if value="$(eval classic or fortress)"><link name="sensor"/></xacro:if>'


@pytest.mark.parametrize(("body", "expected"), [(SWITCHES, True), (SWITCHES + EITHER, False)])
def test_a_switch_is_tried_without_the_one_that_it_excludes(
    tmp_path: Path, body: str, *, expected: bool
) -> None:
    launch = LAUNCH.replace("' tool:=', LaunchConfiguration('tool')", "' fortress:=true'")
    report = judged(tmp_path, body, ("launch/view.launch.py", launch))
    assert any("simulated" in message for message in messages(report, "URD004")) is expected


def test_robots_are_tried_before_files_of_macros(tmp_path: Path) -> None:
    numbers = range(TRIED_LIMIT - 1)
    tests = "".join(f"<xacro:if value=\"${{tool == 'a{n}'}}\"/>" for n in numbers)
    macros = (
        f'{HEAD}<xacro:arg name="tool" default="none"/>'
        f'<xacro:macro name="m" params="tool">{tests}</xacro:macro></robot>'
    )
    assert messages(judged(tmp_path, TEST, ("urdf/a.xacro", macros)), "KIN001")


def test_an_argument_without_a_value_is_a_text_that_it_is_compared_with(tmp_path: Path) -> None:
    real = "<xacro:if value=\"${'$(arg via)' == 'real'}\"><link name='drive'/></xacro:if>"
    body = f"{real}<xacro:unless value=\"${{'$(arg via)' == 'gz'}}\">{HAND}</xacro:unless>"
    report = judged(tmp_path, body)
    assert report.facts["assumed"] == "via:=gz"
    assert report.facts["also_tried"] == "via:=real"
    (message,) = messages(report, "KIN001")
    assert message.endswith("(with via:=real)")


def test_a_launch_file_that_gives_no_value_is_wrong(tmp_path: Path) -> None:
    launch = LAUNCH.replace(", ' tool:=', LaunchConfiguration('tool')", "")
    body = TEST.replace("arg tool", "arg via")
    report = judged(tmp_path, body, ("launch/view.launch.py", launch))
    assert "arg via is neither given" in messages(report, "URD001")[0]


def test_a_default_behind_its_use_is_taken(tmp_path: Path) -> None:
    late = '<link name="$(arg via)"/><xacro:arg name="via" default="cable"/>'
    test = "<xacro:if value=\"${'$(arg via)' == 'gz'}\"/>"
    assert judged(tmp_path, late + test).facts["assumed"] == "via:=cable"


FAULTY = """<xacro:if value="$(arg tool)"><link name="hand"/>
  <joint name="wrist" type="fixed"><parent link="base_link"/><child link="hadn"/></joint>
</xacro:if>"""
MOTORS = """<xacro:if value="$(arg tool)">
  <ros2_control name="m" type="system"><hardware><plugin>mock/Motors</plugin></hardware>
    <joint name="lift"><command_interface name="speed"/></joint></ros2_control>
</xacro:if>"""
BY_COMMAND = LAUNCH.replace("'none', choices=['none', 'hand']", "'false'")
BY_MAPPINGS = """
import os
import xacro
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    file = os.path.join(get_package_share_directory('acme_description'), 'urdf', 'r.urdf.xacro')
    text = xacro.process_file(file, mappings={'tool': 'true'}).toxml()
    return LaunchDescription([
        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': text}]),
    ])
"""


def launched(folder: Path, body: str, default: str) -> PackageReport:
    """Judge a robot that two launch files load: `default` without the tool, another with it."""
    files = (f"launch/{default}.launch.py", BY_COMMAND), ("launch/lift.launch.py", BY_MAPPINGS)
    declared = '<xacro:arg name="tool" default="false"/>'
    return judged(folder, f"{declared}{body}", *files)


@pytest.mark.parametrize("default", ["a_show", "z_show"])
def test_what_any_launch_file_gives_is_given(default: str, tmp_path: Path) -> None:
    """The names of the launch files do not decide on it."""
    report = launched(tmp_path, FAULTY, default)
    (found,) = (it for it in report.findings if it.rule == "KIN001")
    assert found.severity is Severity.ERROR
    assert found.message.endswith("not exist (with tool:=true)") is (default == "a_show")
    assert not [it for it in report.findings if "no launch file" in it.message]


@pytest.mark.parametrize("default", ["a_show", "z_show"])
def test_a_robot_that_only_one_launch_file_controls_is_judged(default: str, tmp_path: Path) -> None:
    report = launched(tmp_path, MOTORS, default)
    assert ["'lift'" in message for message in messages(report, "R2C001")] == [True]
    assert not [it for it in report.not_checked if "no robot is controlled" in it.reason]


def test_control_that_no_launch_file_chooses_is_named(tmp_path: Path) -> None:
    declared = '<xacro:arg name="tool" default="false"/>'
    report = judged(tmp_path, f"{declared}{MOTORS}", ("launch/show.launch.py", BY_COMMAND))
    assert (
        "a robot is controlled by ros2_control only with tool:=true: check it with --xacro-arg"
        " tool:=true" in {it.reason for it in report.not_checked}
    )
