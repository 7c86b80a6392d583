"""URDF robots on the course: Gazebo Classic drives them, and controllers hold their arms."""

from __future__ import annotations

import pytest

from checker.model.robot import Robot
from checker.physics.trial.course import DRIVE
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.trial import Trial
from tests.model.robots import urdf
from tests.trial.machines import trial_in_child

_INERTIAL = """<inertial><mass value="{}"/><inertia ixx="{}" iyy="{}" izz="{}" ixy="0" ixz="0"
  iyz="0"/></inertial>"""
_WHEEL = """
<link name="{name}_wheel">{inertial}<collision>
  <origin rpy="1.5707963267948966 0 0"/>
  <geometry><cylinder radius="0.1" length="0.06"/></geometry></collision></link>
<joint name="{name}" type="continuous"><origin xyz="{x} {y} 0"/><parent link="base"/>
  <child link="{name}_wheel"/><axis xyz="0 1 0"/></joint>
"""
_ARM = f"""
<link name="arm">{_INERTIAL.format(0.5, 0.01, 0.01, 0.01)}</link>
<joint name="shoulder" type="revolute"><origin xyz="0 0 0.2"/><parent link="base"/>
  <child link="arm"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1" effort="9" velocity="1"/></joint>
"""
_MOTOR = """<transmission name="{0}_motor"><type>transmission_interface/SimpleTransmission</type>
  <joint name="{0}"/></transmission>"""
_CONTROL = """<ros2_control name="c" type="system"><joint name="shoulder">
  <command_interface name="position"/></joint></ros2_control>"""


def rover(content: str, more: str = _ARM, wheel: str = _WHEEL) -> Robot:
    wheels = "".join(
        wheel.format(
            name=f"{end}_{side}", x=x, y=y, inertial=_INERTIAL.format(1, 0.003, 0.005, 0.003)
        )
        for end, x in (("front", 0.25), ("rear", -0.25))
        for side, y in (("left", 0.25), ("right", -0.25))
    )
    body = f"""<link name="base">{_INERTIAL.format(10, 0.15, 0.25, 0.35)}<collision>
  <geometry><box size="0.5 0.4 0.1"/></geometry></collision></link>"""
    plugin = f'<gazebo><plugin name="d" filename="{content}</plugin></gazebo>'
    return urdf(body + wheels + more + plugin)


_SIZES = "<wheelSeparation>0.5</wheelSeparation><wheelDiameter>0.2</wheelDiameter>"
SKID = f"""libgazebo_ros_skid_steer_drive.so">
<leftFrontJoint>front_left</leftFrontJoint><rightFrontJoint>front_right</rightFrontJoint>
<leftRearJoint>rear_left</leftRearJoint><rightRearJoint>rear_right</rightRearJoint>{_SIZES}"""
DIFF = f"""libgazebo_ros_diff_drive.so">
<leftJoint>front_left</leftJoint><rightJoint>front_right</rightJoint>{_SIZES}"""


def figures(robot: Robot) -> tuple[float, float]:
    trial = trial_in_child(robot)
    assert isinstance(trial, Trial)
    speed, turn = trial.value("speed_ratio"), trial.value("yaw_ratio")
    assert speed is not None
    assert turn is not None
    return speed, turn


def test_a_skid_steer_drive_moves_a_urdf_robot() -> None:
    speed, turn = figures(rover(SKID))

    assert speed == pytest.approx(1.0, abs=0.03)
    assert turn > 0.2


def test_a_drive_of_classic_replaces_the_friction_of_its_joints() -> None:
    rubbing = _WHEEL.replace("</joint>", '<dynamics friction="50" damping="0"/></joint>')
    speed, _ = figures(rover(SKID, wheel=rubbing))

    assert speed == pytest.approx(1.0, abs=0.03)


def test_a_wheel_diameter_that_is_half_doubles_the_speed() -> None:
    speed, _ = figures(rover(SKID.replace("0.2</wheelD", "0.1</wheelD")))

    assert speed == pytest.approx(2.0, abs=0.1)


def test_the_old_diff_drive_turns_the_other_way() -> None:
    _, turn = figures(rover(DIFF))
    _, corrected = figures(rover(DIFF + "<legacyMode>false</legacyMode>"))

    assert turn < -0.05
    assert corrected > 0.05


@pytest.mark.parametrize(
    ("stated", "rate"), [("", 1.0), ("<wheelAcceleration>0.4</wheelAcceleration>", 0.4)]
)
def test_wheels_need_the_torque_that_speeds_the_robot_up(stated: str, rate: float) -> None:
    trial = trial_in_child(rover(DIFF + stated, more=""))
    assert isinstance(trial, Trial)
    drive = next(leg for leg in trial.legs if leg.name == DRIVE)
    torque = max(
        abs(value)
        for time, value in zip(trial.series["time"], trial.series["torque:front_left"], strict=True)
        if drive.start < time < drive.end
    )

    turning = 4 * 0.005 / 0.1**2  # kg: the moments of the wheels at their rims
    assert torque == pytest.approx((14 + turning) * rate * 0.1 / 2, rel=0.05)


class TestJointsWithMotor:
    @pytest.mark.parametrize("motor", [_MOTOR.format("shoulder"), _CONTROL])
    def test_are_held(self, motor: str) -> None:
        assert "shoulder" in plan_of(rover(SKID, _ARM + motor)).places

    @pytest.mark.parametrize(
        "more", ["", _CONTROL.replace("command_i", "state_i"), _MOTOR.format("elbow")]
    )
    def test_others_are_not(self, more: str) -> None:
        assert "shoulder" not in plan_of(rover(SKID, _ARM + more)).places

    def test_wheels_beside_those_that_are_driven_roll(self) -> None:
        plan = plan_of(rover(DIFF, _MOTOR.format("rear_left") + _MOTOR.format("front_left")))

        assert set(plan.speeds) == {"front_left", "front_right"}
        assert not plan.places
