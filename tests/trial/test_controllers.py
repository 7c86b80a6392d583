"""Each wheel controller of ros2_controllers drives a small robot as commanded."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.trial import Trial
from checker.rule_testing import write_example
from tests.model.controlled import controlled, robot_in
from tests.trial.machines import trial_in_child, value

_INERTIAL = """<inertial><mass value="{}"/><inertia ixx="{}" iyy="{}" izz="{}" ixy="0" ixz="0"
  iyz="0"/></inertial>"""
CORNERS = {"front_left": (0.3, 0.25), "front_right": (0.3, -0.25)} | {
    "rear_left": (-0.3, 0.25),
    "rear_right": (-0.3, -0.25),
}


def wheel(name: str, x: float, y: float, yaw: float = 0.0, parent: str = "base_link") -> str:
    return f"""
<link name="{name}_wheel">{_INERTIAL.format(1, 0.003, 0.005, 0.003)}<collision>
  <origin rpy="1.5707963267948966 0 0"/>
  <geometry><cylinder radius="0.1" length="0.05"/></geometry></collision></link>
<joint name="{name}" type="continuous"><origin xyz="{x} {y} 0" rpy="0 0 {yaw}"/>
  <parent link="{parent}"/><child link="{name}_wheel"/><axis xyz="0 1 0"/></joint>"""


def steered(name: str, x: float, y: float) -> str:
    return f"""
<link name="{name}_knuckle">{_INERTIAL.format(0.5, 0.01, 0.01, 0.01)}</link>
<joint name="{name}_steering" type="revolute"><origin xyz="{x} {y} 0"/><parent link="base_link"/>
  <child link="{name}_knuckle"/><axis xyz="0 0 1"/>
  <limit lower="-0.8" upper="0.8" effort="50" velocity="9"/></joint>
{wheel(name, 0.0, 0.0, parent=f"{name}_knuckle")}"""


FOUR = "".join(wheel(name, *place) for name, place in CORNERS.items())
REAR = "".join(wheel(name, *CORNERS[name]) for name in ("rear_left", "rear_right"))
CAR = REAR + "".join(steered(name, *CORNERS[name]) for name in ("front_left", "front_right"))
TRICYCLE = REAR + steered("front", 0.3, 0.0)
THREE = "".join(
    # Axes that point outwards: the joint's y axis.
    wheel(f"w{n}", 0.3 * math.cos(angle), 0.3 * math.sin(angle), angle - math.pi / 2)
    for n, angle in enumerate(2 * math.pi * k / 3 for k in range(3))
)
BALL = """<link name="ball"><inertial><mass value="0.1"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4"
  ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry><sphere radius="0.05"/></geometry>
  </collision></link>
<joint name="ball" type="fixed"><origin xyz="0.3 0 -0.05"/><parent link="base_link"/>
  <child link="ball"/></joint>
<gazebo reference="ball"><mu1>0.001</mu1><mu2>0.001</mu2></gazebo>"""

LIMITS = {"linear.x.max_velocity": 0.8, "angular.z.max_velocity": 1.5}
MECANUM = {f"{name}_wheel_command_joint_name": name for name in CORNERS} | LIMITS
OMNI = {"wheel_names": "[w0, w1, w2]", "wheel_offset": 0.0, "robot_radius": 0.3} | {
    "wheel_radius": 0.1
}
PLANAR = {"kinematics.wheels_radius": 0.1} | {
    "kinematics.sum_of_robot_center_projection_on_X_Y_axis": 0.55
}


TRUNK = f"""<link name="trunk">{_INERTIAL.format(10, 0.15, 0.25, 0.35)}<collision><geometry>
  <box size="0.3 0.3 0.1"/></geometry></collision></link>
<joint name="trunk" type="fixed"><parent link="base_link"/><child link="trunk"/></joint>"""


def robot(folder: Path, links: str, kind: str, parameters: dict[str, object]) -> Robot:
    lines = "".join(f"    {name}: {value}\n" for name, value in parameters.items())
    return controlled(folder, TRUNK + links, kind, lines)


def driven(folder: Path, links: str, kind: str, parameters: dict[str, object]) -> Trial:
    trial = trial_in_child(robot(folder, links, kind, parameters))
    assert isinstance(trial, Trial), trial
    assert not trial.not_driven
    return trial


STEERING = {"wheelbase": 0.6}
CASES = {
    "diff_drive": (
        REAR + BALL,
        "diff_drive_controller/DiffDriveController",
        {"left_wheel_names": "[rear_left]", "right_wheel_names": "[rear_right]"}
        | {"wheel_radius": 0.1, "wheel_separation": 0.5},
        "differential drive",
    ),
    "diff_drive with a side that is turned round": (
        wheel("rear_left", *CORNERS["rear_left"])
        + wheel("rear_right", *CORNERS["rear_right"], yaw=math.pi)
        + BALL,
        "diff_drive_controller/DiffDriveController",
        {"left_wheel_names": "[rear_left]", "right_wheel_names": "[rear_right]"}
        | {"wheel_radius": 0.1, "wheel_separation": 0.5, "right_wheel_radius_multiplier": -1.0},
        "differential drive",
    ),
    "mecanum": (
        FOUR,
        "mecanum_drive_controller/MecanumDriveController",
        MECANUM | PLANAR,
        "Mecanum drive",
    ),
    "older mecanum": (
        FOUR,
        "mecanum_drive_controller/MecanumDriveController",
        {f"{name.replace('rear', 'back')}_joint_name": name for name in CORNERS}
        | {"wheel_radius": 0.1, "wheel_base": 0.6, "wheel_separation": 0.5},
        "Mecanum drive",
    ),
    "omni": (
        THREE,
        "omni_wheel_drive_controller/OmniWheelDriveController",
        OMNI,
        "omni-wheel drive",
    ),
    "tricycle": (
        TRICYCLE,
        "tricycle_controller/TricycleController",
        {"traction_joint_name": "front", "steering_joint_name": "front_steering"}
        | {"wheelbase": 0.6, "wheel_radius": 0.1},
        "Ackermann steering",
    ),
    "tricycle steering": (
        TRICYCLE,
        "tricycle_steering_controller/TricycleSteeringController",
        {"traction_joints_names": "[rear_right, rear_left]"}
        | {"steering_joints_names": "[front_steering]", "traction_track_width": 0.5}
        | {"traction_wheels_radius": 0.1, **STEERING},
        "Ackermann steering",
    ),
    "bicycle": (
        wheel("rear", -0.3, 0.0) + steered("front", 0.3, 0.0) + BALL.replace('"0.3 0', '"0 0.3')
        + BALL.replace('"ball"', '"other"').replace('"0.3 0', '"0 -0.3'),
        "bicycle_steering_controller/BicycleSteeringController",
        {"traction_joints_names": "[rear]", "steering_joints_names": "[front_steering]"}
        | {"traction_wheel_radius": 0.1, **STEERING},
        "Ackermann steering",
    ),
    "ackermann": (
        CAR,
        "ackermann_steering_controller/AckermannSteeringController",
        {"traction_joints_names": "[rear_right, rear_left]"}
        | {"steering_joints_names": "[front_right_steering, front_left_steering]"}
        | {"traction_track_width": 0.5, "steering_track_width": 0.5}
        | {"traction_wheels_radius": 0.1, **STEERING},
        "Ackermann steering",
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_it_drives_and_turns_as_commanded(tmp_path: Path, name: str) -> None:
    *case, drive = CASES[name]
    trial = driven(tmp_path, *case)  # type: ignore[arg-type]
    assert trial.drive == drive
    assert value(trial, "speed_ratio") == pytest.approx(1.0, abs=0.02)
    assert value(trial, "yaw_ratio") == pytest.approx(1.0, abs=0.05)
    assert abs(value(trial, "path_sideways")) < 0.02


@pytest.mark.slow
@pytest.mark.parametrize("name", ["mecanum", "omni"])
def test_wheels_on_rollers_turn_with_the_stated_arm(tmp_path: Path, name: str) -> None:
    links, kind, parameters, _ = CASES[name]
    (arm,) = set(parameters) & {"robot_radius", *PLANAR} - {"kinematics.wheels_radius"}
    trial = driven(tmp_path, links, kind, {**parameters, arm: parameters[arm] / 2})
    assert value(trial, "yaw_ratio") == pytest.approx(0.5, abs=0.03)
    assert "ideal rollers" in trial.notes[0]


def test_a_wheel_that_does_not_exist_leaves_a_robot_on_rollers_where_it_is(tmp_path: Path) -> None:
    links, kind, parameters, _ = CASES["omni"]
    plan = plan_of(robot(tmp_path, links, kind, {**parameters, "wheel_names": "[w0, w1]"}))
    assert "fewer than three" in plan.not_driven


HARDWARE = """<ros2_control name="base" type="system">
  <joint name="rear_left"><command_interface name="velocity"/></joint></ros2_control>"""


def workspace(folder: Path, others: int, more: str = "") -> Path:
    """Write a description and further packages that configure its drive."""
    _, kind, parameters, _ = CASES["diff_drive"]
    lines = "".join(f"    {name}: {text}\n" for name, text in parameters.items())
    package = write_example({"@urdf": TRUNK + REAR + BALL + HARDWARE + more}, folder)
    for number in range(others):
        other = package.parent / f"acme_control_{number}"
        (other / "config").mkdir(parents=True)
        (other / "package.xml").write_text(f"<package><name>{other.name}</name></package>")
        text = f"base:\n  ros__parameters:\n    type: {kind}\n{lines}"
        (other / "config" / "base.yaml").write_text(text)
    return package


def test_the_package_beside_a_description_configures_its_drive(tmp_path: Path) -> None:
    (drive,) = robot_in(workspace(tmp_path, 1)).locomotion.wheel_drives
    assert drive.plugin.span.source.file == "../acme_control_0/config/base.yaml"


@pytest.mark.parametrize(
    ("others", "more"),
    [
        (2, ""),
        (
            1,
            '<gazebo><plugin filename="gz_ros2_control-system" name="p">'
            "<parameters>own.yaml</parameters></plugin></gazebo>",
        ),
    ],
)
def test_what_is_not_certain_to_be_its_own_drives_nothing(
    tmp_path: Path, others: int, more: str
) -> None:
    assert not robot_in(workspace(tmp_path, others, more)).locomotion.wheel_drives
