"""What rules of ros2_control say depends on the ROS 2 distribution."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.ros.ros2_control.distributions import distribution_of, is_from
from checker.rule import Context
from checker.rule_testing import write_example
from checker.settings import Settings

ARM = """
<link name="finger"/>
<joint name="finger_joint" type="revolute">
  <parent link="upper_arm"/><child link="finger"/><mimic joint="shoulder"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint>
<ros2_control name="arm" type="system">
  <hardware><plugin>@</plugin></hardware>
  <joint name="shoulder"><command_interface name="velocity"/></joint>
  <joint name="finger_joint"><command_interface name="position"/></joint>
  <joint name="elbow"><command_interface name="position"/></joint>
</ros2_control>
"""
CONTROLLERS = """
gripper:
  ros__parameters:
    type: position_controllers/GripperActionController
    joint: finger_joint
drive:
  ros__parameters:
    type: diff_drive_controller/DiffDriveController
    left_wheel_names: [shoulder]
    right_wheel_names: [shoulder]
    wheel_radius: 0.1
    wheel_separation: 0.5
    use_stamped_vel: false
"""


def said(folder: Path, distro: str, hardware: str = "mock_components/GenericSystem") -> set[str]:
    """Return the rules of the group that speak, with their severities."""
    example = {"@urdf": ARM.replace("@", hardware), "config/arm.yaml": CONTROLLERS}
    package = write_example(example, folder / distro)
    settings = Settings(profile="ros2", profile_chosen=True, distro=distro, trial=False)
    (report,) = check_package(package, settings).packages
    return {
        f"{each.rule} {each.severity.value}"
        for each in report.findings
        if each.rule.startswith("R2C")
    }


def test_humble_does_not_compare_joints_and_reads_twist(tmp_path: Path) -> None:
    assert said(tmp_path, "humble") == {"R2C001 warning", "R2C009 warning"}


def test_jazzy_does(tmp_path: Path) -> None:
    assert said(tmp_path, "jazzy") == {
        *("R2C001 error", "R2C002 error", "R2C009 warning", "R2C011 warning")
    }


def test_kilted_has_no_gripper_of_position_controllers(tmp_path: Path) -> None:
    assert "R2C008 warning" in said(tmp_path, "kilted")
    assert "R2C008 warning" in said(tmp_path, "lyrical")


@pytest.mark.parametrize(
    ("hardware", "distro", "severity"),
    [
        ("gazebo_ros2_control/GazeboSystem", "humble", ""),
        ("gazebo_ros2_control/GazeboSystem", "jazzy", "error"),
        ("fake_components/GenericSystem", "humble", ""),
        ("fake_components/GenericSystem", "jazzy", "error"),
        ("gz_ros2_control/GazeboSimSystem", "humble", ""),
        ("ign_ros2_control/IgnitionSystem", "kilted", "info"),
    ],
)
def test_hardware(tmp_path: Path, hardware: str, distro: str, severity: str) -> None:
    found = {each for each in said(tmp_path, distro, hardware) if each.startswith("R2C004")}

    assert found == ({f"R2C004 {severity}"} if severity else set())


def test_a_profile_without_distribution_judges_for_that_of_its_release() -> None:
    names = {
        release: distribution_of(Context(release=release))
        for release in ("fortress", "harmonic", "ionic", "jetty", "dome")
    }

    assert names == {
        "fortress": "humble",
        "harmonic": "jazzy",
        "ionic": "kilted",
        "jetty": "lyrical",
        "dome": "jazzy",
    }
    assert is_from("kilted", "jazzy")
    assert not is_from("humble", "jazzy")


@pytest.mark.parametrize(("launch", "severity"), [("drive", "error"), ("nothing", "warning")])
def test_an_interface_matters_once_its_controller_is_started(
    tmp_path: Path, launch: str, severity: str
) -> None:
    plugin = """<gazebo>
  <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <parameters>$(find acme_arm_description)/config/arm.yaml</parameters>
  </plugin>
</gazebo>"""
    example = {
        "@urdf": ARM.replace("@", "gz_ros2_control/GazeboSimSystem") + plugin,
        "config/arm.yaml": CONTROLLERS.replace("[shoulder]", "[elbow_wheel]"),
        "launch/arm.launch.py": f"Node(package='controller_manager', arguments=['{launch}'])\n",
    }
    settings = Settings(profile="ros2", profile_chosen=True, distro="jazzy", trial=False)
    (report,) = check_package(write_example(example, tmp_path), settings).packages
    drives = {
        found.severity.value
        for found in report.findings
        if found.rule == "R2C009" and "'drive'" in found.message
    }
    assert drives == {severity}


@pytest.mark.parametrize(
    ("more", "hint"), [("", "; did you mean 'wheel_radius'?"), ("    wheel_radius: 0.1\n", "")]
)
def test_no_parameter_that_is_stated_is_suggested(more: str, hint: str, tmp_path: Path) -> None:
    changed = CONTROLLERS.replace("wheel_radius: 0.1", "wheels_radius: 0.1")
    example = {"@urdf": ARM.replace("@", "a/B"), "config/arm.yaml": f"{changed}{more}"}
    settings = Settings(profile="ros2", profile_chosen=True, distro="jazzy", select=("R2C011",))
    (report,) = check_package(write_example(example, tmp_path), settings).packages
    (found,) = (it for it in report.findings if "wheels_radius" in it.message)
    assert found.message.endswith(f"has no parameter wheels_radius{hint}")


@pytest.mark.parametrize("rule", ["R2C010", "R2C011"])
def test_a_changed_copy_of_a_controller_has_parameters_of_its_own(
    rule: str, tmp_path: Path
) -> None:
    changed = CONTROLLERS.replace("wheel_radius: 0.1", "radius: 0.1")
    example = {"@urdf": ARM.replace("@", "a/B"), "config/arm.yaml": changed}
    package = write_example(example, tmp_path / "workspace")

    def found() -> tuple[bool, bool]:
        settings = Settings(profile="ros2", profile_chosen=True, distro="jazzy", trial=False)
        (report,) = check_package(package, settings).packages
        unchecked = [each for each in report.not_checked if "in the workspace" in each.reason]
        of_drive = [each for each in report.findings if "'drive'" in each.message]
        return rule in {each.rule for each in of_drive}, rule in {each.rule for each in unchecked}

    assert found() == (True, False)
    copy = package.parent / "diff_drive_controller"
    copy.mkdir()
    (copy / "package.xml").write_text("<package><name>diff_drive_controller</name></package>")
    assert found() == (False, True)
