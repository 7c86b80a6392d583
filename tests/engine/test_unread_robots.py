"""A package is ready only where a robot was read, or where another package has one."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace

from checker.pipeline import check_package
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import ROBOT, Cause, PackageReport, Report, VerdictKind
from checker.report.summary import sentence
from checker.report.text_report import to_text
from checker.rule_testing import write_example
from checker.settings import Settings

MANNER = RenderSettings(Palette(enabled=False))
BRINGUP = "acme_arm_bringup"
ARM = "urdf/arm.urdf.xacro"
OF_ANOTHER = """        Node(package='robot_state_publisher', executable='robot_state_publisher',
            parameters=[{'robot_description': Command(['xacro ', os.path.join(
                get_package_share_directory('acme_hand'), 'urdf', 'hand.urdf.xacro')])}]),"""
CATKIN = """<package format="2"><name>acme_demo</name><version>1.0.0</version>
<description>A demo.</description><maintainer email="a@example.org">A</maintainer>
<license>Apache-2.0</license><buildtool_depend>catkin</buildtool_depend>
<exec_depend>acme_hand</exec_depend></package>
"""
WITHOUT_ROBOT = {
    "@ros2": True,
    ARM: None,
    "launch/arm.launch.py": None,
    "CMakeLists.txt": f"project({BRINGUP})\nfind_package(ament_cmake REQUIRED)\nament_package()\n",
}
HAND = {
    "../acme_hand/package.xml": "<package format='3'><name>acme_hand</name></package>",
    "../acme_hand/urdf/hand.urdf.xacro": "<robot name='hand'><link name='base_link'/></robot>",
}


def checked(example: dict[str, object], folder: Path) -> PackageReport:
    settings = Settings(profile="ros2", profile_chosen=True, trial=False)
    (report,) = check_package(write_example(example, folder), settings).packages
    return report


def reasons(report: PackageReport) -> list[str]:
    return [spot.reason for spot in report.blind_spots if spot.rule == ROBOT]


def test_a_robot_that_was_read_is_missed_by_nobody(tmp_path: Path) -> None:
    assert reasons(checked({"@ros2": True}, tmp_path)) == []


def test_a_model_beside_urdf_is_said_to_be_unchecked(tmp_path: Path) -> None:
    stage = '<sdf version="1.9"><model name="hall"><link name="wall"/></model></sdf>'
    report = checked({"@ros2": True, "model.sdf": stage}, tmp_path)
    assert report.facts["robot"] == "arm"
    assert any("subt-check model.sdf" in unseen.reason for unseen in report.not_checked)


def test_the_only_file_of_the_name_is_read_where_the_path_is_wrong(tmp_path: Path) -> None:
    robot = "<robot name='hand'><link name='palm'/></robot>"
    spawned = """        Node(package='ros_gz_sim', executable='create', arguments=[
            '-file', in_package('model', 'hand.urdf')]),"""
    report = checked({"@ros2": spawned, ARM: None, "parts/hand.urdf": robot}, tmp_path)
    assert report.facts["robot"] == "hand"
    assert any(found.rule == "LCH001" for found in report.findings)


def test_a_model_that_is_urdf_by_its_root_is_said_to_be_unread(tmp_path: Path) -> None:
    report = checked({"model.sdf": "<robot name='hand'><link name='palm'/></robot>"}, tmp_path)
    assert report.verdict is VerdictKind.INCOMPLETE
    assert any("model.sdf is URDF by its root element" in reason for reason in reasons(report))


def test_a_model_file_with_a_lamp_alone_has_no_robot_to_read(tmp_path: Path) -> None:
    lamp = '<sdf version="1.9"><light type="point" name="lamp"/></sdf>'
    config = "<model><name>lamp</name><sdf version='1.9'>model.sdf</sdf></model>"
    (tmp_path / "lamp").mkdir()
    (tmp_path / "lamp/model.sdf").write_text(lamp)
    (tmp_path / "lamp/model.config").write_text(config)
    (report,) = check_package(tmp_path / "lamp", Settings(trial=False)).packages
    assert report.verdict is not VerdictKind.INCOMPLETE
    assert report.blind_spots == ()


def test_a_package_without_robot_is_not_ready(tmp_path: Path) -> None:
    report = checked(WITHOUT_ROBOT, tmp_path)
    assert report.verdict is VerdictKind.INCOMPLETE
    assert "no robot was read: no URDF, xacro, SDF or MJCF file" in str(sentence(report))


def test_beside_a_package_with_a_robot_it_is(tmp_path: Path) -> None:
    report = checked({**WITHOUT_ROBOT, **HAND}, tmp_path)
    assert reasons(report) == []


def test_the_robot_of_another_package_is_a_robot(tmp_path: Path) -> None:
    report = checked({"@ros2": OF_ANOTHER, ARM: None, **HAND}, tmp_path)
    assert [it for it in report.not_checked if it.rule == ROBOT] == []
    assert "no robot of its own" not in str(sentence(report))


def test_beside_it_what_else_is_included_is_only_not_checked(tmp_path: Path) -> None:
    merger = """
        IncludeLaunchDescription(PythonLaunchDescriptionSource(os.path.join(
            get_package_share_directory('acme_lasers'), 'launch', 'merge.launch.py'))),"""
    report = checked({"@ros2": OF_ANOTHER + merger, ARM: None, **HAND}, tmp_path)
    assert report.verdict is not VerdictKind.INCOMPLETE
    text = to_text(Report((report,), {}), MANNER)
    assert "not checked: robot: launch/arm.launch.py includes" in text
    assert "no robot was read" not in text


MESSAGES = {"../acme_msgs/package.xml": "<package format='3'><name>acme_msgs</name></package>"}


def test_beside_other_packages_it_is_as_well(tmp_path: Path) -> None:
    report = checked({**WITHOUT_ROBOT, **MESSAGES}, tmp_path)
    assert reasons(report) == []
    assert "not checked: robot: no URDF" in to_text(Report((report,), {}), MANNER)


@pytest.mark.parametrize("starts", [False, True])
def test_what_a_package_of_ros_starts_is_missed_where_a_robot_is_started(
    tmp_path: Path, starts: bool
) -> None:
    camera = """        IncludeLaunchDescription(PythonLaunchDescriptionSource(os.path.join(
            get_package_share_directory('depthai_descriptions'), 'launch', 'urdf_launch.py'))),"""
    publisher = """
        Node(package='robot_state_publisher', executable='robot_state_publisher'),"""
    report = checked({"@ros2": camera + publisher * starts, ARM: None}, tmp_path)
    (unseen,) = (each for each in report.not_checked if each.rule == ROBOT)
    assert "depthai_descriptions is not available" in unseen.reason
    assert unseen.cause is (Cause.NOT_AT_HAND if starts else Cause.NOT_APPLICABLE)


def test_the_reason_is_told_once(tmp_path: Path) -> None:
    example = {"@ros2": OF_ANOTHER, ARM: None}
    report = checked(example, tmp_path)
    again = replace(report, name="acme_other", path="acme_other")
    text = to_text(Report((report, again), {}), MANNER)
    assert text.count("acme_hand is not available") == 1
    assert "no robot was read, for the reason given at acme_arm_bringup" in text


def test_launch_files_with_one_reason_are_told_of_together(tmp_path: Path) -> None:
    package = write_example({"@ros2": OF_ANOTHER, ARM: None}, tmp_path)
    launch = package / "launch"
    (launch / "arm_2.launch.py").write_text((launch / "arm.launch.py").read_text())
    settings = Settings(profile="ros2", profile_chosen=True, trial=False)
    (report,) = check_package(package, settings).packages
    (reason,) = reasons(report)
    assert reason.endswith("--package-path DIR (and so with 1 more launch file)")


@pytest.mark.parametrize("ignored", [False, True])
def test_a_launch_file_names_the_package_that_is_missing(tmp_path: Path, ignored: bool) -> None:
    example: dict[str, object] = {"@ros2": OF_ANOTHER, ARM: None}
    if ignored:
        example |= {**HAND, "../acme_hand/COLCON_IGNORE": ""}
    (reason,) = reasons(checked(example, tmp_path))
    assert "acme_hand)/urdf/hand.urdf.xacro" in reason
    assert ("COLCON_IGNORE" if ignored else "--package-path DIR") in reason


LIBRARY = {"src/node.cpp": "", "CMakeLists.txt": "add_library(a b)"}


@pytest.mark.parametrize("more", [{}, LIBRARY])
@pytest.mark.parametrize("included", ["acme_hand", "rgbd_launch"])
def test_a_launch_file_of_ros_1_does_so_too(
    tmp_path: Path, included: str, more: dict[str, object]
) -> None:
    folder = tmp_path / "acme_demo"
    folder.mkdir()
    launch = '<launch><include file="$(find @)/launch/hand.launch"/></launch>'
    files = {"package.xml": CATKIN, "launch/demo.launch": launch.replace("@", included), **more}
    for name, text in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(str(text))
    (report,) = check_package(folder, Settings(trial=False)).packages
    (unseen,) = (each for each in report.not_checked if each.rule == ROBOT)
    start = f"launch/demo.launch includes $(find {included})/launch/hand.launch:"
    assert unseen.reason.startswith(start)
    # What a package without robot includes from ROS is no robot of the user's.
    is_own = included == "acme_hand"
    assert unseen.cause is (Cause.NOT_AT_HAND if is_own else Cause.NOT_APPLICABLE)
    assert (report.verdict is VerdictKind.INCOMPLETE) == is_own


def test_a_template_is_no_robot(tmp_path: Path) -> None:
    example = {**WITHOUT_ROBOT, "urdf/arm.urdf.jinja": "<robot name='{{ name }}'/>"}
    (reason,) = reasons(checked(example, tmp_path))
    assert reason.startswith("urdf/arm.urdf.jinja is a template")


def test_a_world_in_a_missing_package_is_not_checked(tmp_path: Path) -> None:
    world = """        IncludeLaunchDescription(PathJoinSubstitution([
            FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py']), launch_arguments={
                'gz_args': [FindPackageShare('acme_worlds'), '/worlds/hall.sdf']}.items()),"""
    report = checked({"@ros2": world}, tmp_path)
    assert report.verdict is VerdictKind.INCOMPLETE
    assert any("acme_worlds is not available" in spot.reason for spot in report.blind_spots)
