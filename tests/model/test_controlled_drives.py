"""Wheels that controllers of ros2_control drive and steer."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.model.locomotion.locomotion import DriveKind, Side
from checker.model.locomotion.wheel_positions import counted_distances
from checker.model.robot import Robot
from tests.model.controlled import controlled

PLACES = {"front_left": (0.5, 0.3), "front_right": (0.5, -0.3)} | {
    "rear_left": (-0.5, 0.3),
    "rear_right": (-0.5, -0.3),
}


def wheel(name: str, more: str = "", axis: str = "0 1 0") -> str:
    x, y = PLACES.get(name, (0.0, 0.0))
    return f"""
<link name="{name}_wheel">
  <collision>
    <origin rpy="1.5707963267948966 0 0"/>
    <geometry><cylinder radius="0.1" length="0.05"/></geometry>
  </collision>
</link>
<joint name="{name}" type="continuous">
  <origin xyz="{x} {y} 0"/>
  <parent link="base_link"/>
  <child link="{name}_wheel"/>
  <axis xyz="{axis}"/>
  {more}
</joint>
"""


def robot(folder: Path, kind: str, parameters: str, links: str = "") -> Robot:
    return controlled(folder, links or "".join(map(wheel, PLACES)), kind, parameters)


DIFF = "diff_drive_controller/DiffDriveController"
PAIR = "    left_wheel_names: [rear_left]\n    right_wheel_names: [rear_right]\n"
BOTH = """    left_wheel_names: [front_left, rear_left]
    right_wheel_names: [front_right, rear_right]
"""
SIZES = "    wheel_radius: 0.1\n    wheel_separation: 0.6\n"


def test_a_differential_drive(tmp_path: Path) -> None:
    limits = "    linear.x.max_velocity: 1.5\n    angular: {z: {min_velocity: -2.0}}\n"
    moved = robot(tmp_path, DIFF, PAIR + SIZES + limits).locomotion
    (drive,) = moved.wheel_drives

    assert moved.kind is DriveKind.DIFFERENTIAL
    assert {each.name.value: each.side for each in drive.wheels} == {
        "rear_left": Side.LEFT,
        "rear_right": Side.RIGHT,
    }
    assert drive.wheel_radius.value == pytest.approx(drive.wheels[0].radius or 0.0)
    assert drive.linear.max_velocity is not None
    assert drive.linear.min_velocity is not None
    assert (drive.linear.min_velocity.value, drive.linear.max_velocity.value) == (-1.5, 1.5)
    assert drive.angular.min_velocity is not None
    assert drive.angular.max_velocity is None


def test_limits_that_are_off_count_for_nothing(tmp_path: Path) -> None:
    off = "    linear.x.max_velocity: 1.5\n    linear.x.has_velocity_limits: false\n"
    (drive,) = robot(tmp_path, DIFF, PAIR + SIZES + off).locomotion.wheel_drives

    assert drive.linear.max_velocity is None


def test_wheels_that_slip_have_the_separation_with_its_multiplier(tmp_path: Path) -> None:
    times = "    wheel_separation_multiplier: 1.5\n"
    skid = robot(tmp_path / "skid", DIFF, BOTH + SIZES + times)
    pair = robot(tmp_path / "pair", DIFF, PAIR + SIZES + times)

    assert skid.locomotion.kind is DriveKind.SKID_STEER
    (counted,) = counted_distances(skid)
    assert (counted.stated.value, counted.slips) == (pytest.approx(0.9), True)
    (counted,) = counted_distances(pair)
    assert (counted.stated.value, counted.slips) == (0.6, False)


def test_without_a_radius_nothing_is_driven(tmp_path: Path) -> None:
    moved = robot(tmp_path, DIFF, PAIR).locomotion

    assert (moved.kind, moved.wheel_drives) == (DriveKind.NONE, ())


STEERING = "ackermann_steering_controller/AckermannSteeringController"


def test_steering_controllers_in_both_spellings(tmp_path: Path) -> None:
    old = """    front_wheels_names: [front_left, front_right]
    rear_wheels_names: [rear_left, rear_right]
    wheelbase: 1.0
    rear_wheel_track: 0.6
    front_wheel_track: 0.5
    rear_wheels_radius: 0.1
"""
    new = """    steering_joints_names: [front_left, front_right]
    traction_joints_names: [rear_left, rear_right]
    wheelbase: 1.0
    traction_track_width: 0.6
    steering_track_width: 0.5
    traction_wheels_radius: 0.1
"""
    for name, text in (("old", old), ("new", new)):
        moved = robot(tmp_path / name, STEERING, text).locomotion
        (drive,) = moved.wheel_drives

        assert moved.kind is DriveKind.ACKERMANN
        assert [each.name.value for each in drive.wheels] == ["rear_left", "rear_right"]
        assert [joint.name.value for joint, _ in drive.steering] == ["front_left", "front_right"]
        assert drive.wheel_base is not None
        assert drive.kingpin_width is not None
        assert (drive.wheel_base.value, drive.kingpin_width.value) == (1.0, 0.5)
        assert (drive.wheel_separation.value, drive.wheel_radius.value) == (0.6, 0.1)
        # The old names are distances of wheels, not of steering joints.
        assert drive.kingpin_tag == ("steering_track_width" if name == "new" else "")


def test_rear_wheels_may_steer(tmp_path: Path) -> None:
    text = """    front_steering: false
    front_wheels_names: [front_left, front_right]
    rear_wheels_names: [rear_left, rear_right]
    wheelbase: 1.0
    front_wheel_track: 0.6
    front_wheels_radius: 0.1
"""
    (drive,) = robot(tmp_path, STEERING, text).locomotion.wheel_drives

    assert [each.name.value for each in drive.wheels] == ["front_left", "front_right"]
    assert [joint.name.value for joint, _ in drive.steering] == ["rear_left", "rear_right"]


def test_wheels_follow_the_joint_that_they_mimic(tmp_path: Path) -> None:
    links = '<link name="virtual_wheel"/>' + wheel("front_left") + wheel("front_right")
    links += """<joint name="virtual" type="continuous">
  <parent link="base_link"/><child link="virtual_wheel"/><axis xyz="0 1 0"/>
</joint>"""
    mimic = '<mimic joint="virtual"/>'
    links += wheel("rear_left", mimic) + wheel("rear_right", mimic)
    kind = "bicycle_steering_controller/BicycleSteeringController"
    text = """    traction_joints_names: [virtual]
    steering_joints_names: [front_left]
    wheelbase: 1.0
    traction_wheel_radius: 0.1
"""
    found = robot(tmp_path, kind, text, links)
    (drive,) = found.locomotion.wheel_drives

    assert {each.joint.name.value: each.side for each in drive.wheels} == {
        "rear_left": Side.LEFT,
        "rear_right": Side.RIGHT,
    }
    assert [each.tag for each in counted_distances(found)] == ["wheelbase"]


def test_wheels_on_rollers(tmp_path: Path) -> None:
    corners = "".join(f"    {corner}_wheel_command_joint_name: {corner}\n" for corner in PLACES)
    kind = "mecanum_drive_controller/MecanumDriveController"
    moved = robot(tmp_path, kind, f"{corners}    kinematics.wheels_radius: 0.1\n").locomotion

    assert moved.kind is DriveKind.MECANUM
    assert len(moved.wheels) == 4


def test_a_drive_that_no_launch_file_starts_is_idle_beside_one_that_is(tmp_path: Path) -> None:
    both = f"""{PAIR}    wheel_radius: 0.1
    wheel_separation: 0.6
other:
  ros__parameters:
    type: {DIFF}
{PAIR}    wheel_radius: 0.7
    wheel_separation: 0.6
"""
    two = robot(tmp_path / "two", DIFF, both).locomotion.wheel_drives
    assert [drive.wheel_radius.value for drive in two] == [0.1, 0.7]
    launch = tmp_path / "one" / "acme_arm_description" / "launch" / "base.launch.py"
    launch.parent.mkdir(parents=True)
    launch.write_text("Node(package='controller_manager', arguments=['base'])\n", "utf-8")
    (one,) = robot(tmp_path / "one", DIFF, both).locomotion.wheel_drives
    assert one.wheel_radius.value == 0.1
