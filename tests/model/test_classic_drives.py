"""Wheels of URDF files: those that Gazebo Classic's plugins drive, and those that none drives."""

from __future__ import annotations

import math

import pytest

from checker.model.locomotion.locomotion import DriveKind, Side, WheelDrive
from checker.model.locomotion.motion_limits import bounded_motions
from checker.model.robot import Robot
from checker.rule import Finding
from checker.rulebook.discovery import all_rules
from tests.model.robots import sdf, urdf

JOINTS = ("front_left", "front_right", "rear_left", "rear_right")
DIFF, SKID = "libgazebo_ros_diff_drive.so", "libgazebo_ros_skid_steer_drive.so"


def wheel(joint: str, kind: str = "continuous", parent: str = "base", axis: str = "0 1 0") -> str:
    x, y = (0.3 if "front" in joint else -0.3), (0.2 if "left" in joint else -0.2)
    return f"""
<link name="{joint}_wheel"/>
<joint name="{joint}" type="{kind}">
  <origin xyz="{x} {y} 0"/>
  <parent link="{parent}"/>
  <child link="{joint}_wheel"/>
  <axis xyz="{axis}"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint>
"""


def rover(plugin: str = "", wheels: str = "") -> Robot:
    wheels = wheels or "".join(map(wheel, JOINTS))
    return urdf(f'<link name="base"/>{wheels}<gazebo>{plugin}</gazebo>')


def drives(library: str, content: str) -> tuple[WheelDrive, ...]:
    robot = rover(f'<plugin name="any" filename="{library}">{content}</plugin>')
    return robot.locomotion.wheel_drives


def sides(drive: WheelDrive) -> dict[str, Side]:
    return {wheel.name.value: wheel.side for wheel in drive.wheels}


LEFT, RIGHT = Side.LEFT, Side.RIGHT
ROS_1 = """<leftJoint>front_left</leftJoint><rightJoint>front_right</rightJoint>
<wheelSeparation>0.5</wheelSeparation><wheelDiameter>0.3</wheelDiameter>"""
ROS_2 = """<num_wheel_pairs>2</num_wheel_pairs>
<left_joint>front_left</left_joint><left_joint>rear_left</left_joint>
<right_joint>front_right</right_joint><right_joint>rear_right</right_joint>
<wheel_separation>0.5</wheel_separation><wheel_diameter>0.3</wheel_diameter>
<wheel_diameter>0.4</wheel_diameter>"""


def test_a_model_of_gazebo_classic_in_sdf_is_driven_too() -> None:
    wheels = "".join(
        f"""<link name="{side}"><pose>0 {y} 0 0 0 0</pose></link>
<joint name="{side}_axle" type="revolute"><parent>base</parent><child>{side}</child>
<axis><xyz>0 1 0</xyz></axis></joint>"""
        for side, y in (("left", 0.2), ("right", -0.2))
    )
    named = "<left_joint>left_axle</left_joint><right_joint>right_axle</right_joint>"
    plugin = f'<plugin name="drive" filename="{DIFF}">{named}</plugin>'
    publisher = "libgazebo_ros_joint_state_publisher.so"
    reads = f'<plugin name="r" filename="{publisher}"><joint_name>left_axle</joint_name></plugin>'

    robot = sdf(f'<link name="base"/>{wheels}{reads}{plugin}')

    assert robot.locomotion.kind is DriveKind.DIFFERENTIAL
    assert {joint: by.name.value for joint, by in robot.driven_joints.items()} == {
        "left_axle": "drive",
        "right_axle": "drive",
    }


class TestDiffDriveOfRos1:
    def test_says_how_far_apart_and_how_large_its_wheels_are(self) -> None:
        (drive,) = drives(DIFF, ROS_1)

        assert (drive.wheel_separation.value, drive.wheel_radius.value) == (0.5, 0.15)
        assert (drive.separation_tag, drive.diameter_tag) == ("wheelSeparation", "wheelDiameter")

    @pytest.mark.parametrize("mode", ["", "<legacyMode>true</legacyMode>"])
    def test_takes_left_for_right(self, mode: str) -> None:
        (drive,) = drives(DIFF, ROS_1 + mode)

        assert sides(drive) == {"front_left": RIGHT, "front_right": LEFT}
        assert drive.swaps

    def test_takes_left_for_left_where_it_is_told_to(self) -> None:
        (drive,) = drives(DIFF, ROS_1 + "<legacyMode>false</legacyMode>")

        assert sides(drive) == {"front_left": LEFT, "front_right": RIGHT}
        assert not drive.swaps

    def test_has_defaults(self) -> None:
        (drive,) = drives(DIFF, "<leftJoint>front_left</leftJoint>")

        assert (drive.wheel_separation.value, drive.wheel_separation.stated) == (0.34, False)
        assert (drive.wheel_radius.value, drive.wheel_radius.stated) == (0.075, False)

    def test_speeds_its_wheels_up_as_it_states(self) -> None:
        (drive,) = drives(DIFF, ROS_1 + "<wheelAcceleration>0.6</wheelAcceleration>")

        assert greatest_accelerations(drive) == pytest.approx((0.6, 2.4))

    @pytest.mark.parametrize("stated", ["", "<wheelAcceleration>0</wheelAcceleration>"])
    def test_speeds_its_wheels_up_at_once_without(self, stated: str) -> None:
        (drive,) = drives(DIFF, ROS_1 + stated)

        assert greatest_accelerations(drive) == (math.inf, math.inf)


def test_diff_drive_of_ros_2_speeds_its_wheels_up_as_it_states() -> None:
    stated = "<max_wheel_acceleration>0.6</max_wheel_acceleration>"
    front, rear = drives(DIFF, ROS_2 + stated)

    assert greatest_accelerations(front) == pytest.approx((0.6, 2.4))
    assert greatest_accelerations(rear)[0] == 0.6


def greatest_accelerations(drive: WheelDrive) -> tuple[float, float]:
    """Return the linear (m/s²) and the angular one (rad/s²)."""
    linear, angular = drive.linear.max_acceleration, drive.angular.max_acceleration
    return (
        linear.value if linear is not None else math.inf,
        angular.value if angular is not None else math.inf,
    )


def test_diff_drive_of_ros_2_has_a_separation_and_a_diameter_for_each_pair() -> None:
    front, rear = drives(DIFF, ROS_2)

    assert sides(front) == {"front_left": LEFT, "front_right": RIGHT}
    assert sides(rear) == {"rear_left": LEFT, "rear_right": RIGHT}
    assert [drive.wheel_radius.value for drive in (front, rear)] == [0.15, 0.2]
    assert [drive.wheel_separation.value for drive in (front, rear)] == [0.5, 0.34]


def test_skid_steer_drive_turns_four_wheels() -> None:
    names = zip(JOINTS, ("leftFront", "rightFront", "leftRear", "rightRear"), strict=True)
    (drive,) = drives(SKID, "".join(f"<{tag}Joint>{name}</{tag}Joint>" for name, tag in names))

    assert sides(drive) == {
        "front_left": LEFT,
        "rear_left": LEFT,
        "front_right": RIGHT,
        "rear_right": RIGHT,
    }
    assert drive.wheel_separation.value == 0.4


def test_a_plugin_of_classic_is_none_of_gazebo_whatever_its_name() -> None:
    robot = rover(f'<plugin name="DiffDrive" filename="{DIFF}">{ROS_2}</plugin>')

    assert {drive.diameter_tag for drive in robot.locomotion.wheel_drives} == {"wheel_diameter"}
    assert robot.locomotion.kind is DriveKind.SKID_STEER
    assert list(bounded_motions(robot.locomotion)) == []
    assert robot.plugins[0].label == "gazebo_ros_diff_drive"


def test_gazebo_drives_urdf_too() -> None:
    robot = rover("""<plugin name="gz::sim::systems::DiffDrive" filename="gz-sim-diff-drive-system">
<left_joint>front_left</left_joint><right_joint>front_right</right_joint></plugin>""")

    (drive,) = robot.locomotion.wheel_drives
    assert sides(drive) == {"front_left": LEFT, "front_right": RIGHT}
    assert robot.locomotion.undriven == ()


class TestUndriven:
    def test_wheels_have_the_side_that_they_stand_on(self) -> None:
        found = {w.joint.name.value: w.side for w in rover().locomotion.undriven}

        assert found == dict(zip(JOINTS, (LEFT, RIGHT, LEFT, RIGHT), strict=True))

    @pytest.mark.parametrize(
        "part",
        [
            wheel("front_left", "fixed"),
            wheel("front_left", "revolute"),
            wheel("front_left", axis="0 0 1"),
            wheel("front_left").replace("_wheel", "_roller"),
        ],
    )
    def test_what_does_not_roll_is_no_wheel(self, part: str) -> None:
        assert rover(wheels=part).locomotion.undriven == ()

    def test_a_caster_is_steered(self) -> None:
        fork = wheel("pivot", axis="0 0 1").replace("pivot_wheel", "fork")
        plate = wheel("plate", "fixed", "fork").replace("plate_wheel", "plate")
        (caster,) = rover(wheels=fork + plate + wheel("front", parent="plate")).locomotion.undriven

        assert caster.steering is not None
        assert caster.steering.name.value == "pivot"


def test_the_diameter_of_one_pair_is_not_that_of_the_other() -> None:
    ball = '<collision><geometry><sphere radius="0.15"/></geometry></collision>'
    wheels = "".join(map(wheel, JOINTS)).replace(
        '_wheel"/>\n<joint', f'_wheel">{ball}</link><joint'
    )
    one = ROS_2.replace("<wheel_diameter>0.4</wheel_diameter>", "")
    robot = rover(f'<plugin name="any" filename="{DIFF}">{one}</plugin>', wheels)
    (rule,) = (rule for rule in all_rules() if rule.id == "GEO004")

    (found,) = rule.check(robot)
    assert isinstance(found, Finding)
    assert found.message.startswith(
        "gazebo_ros_diff_drive states <wheel_diameter> for other pairs of wheels only; its default "
        "is 0.15 m, but wheel 'rear_left_wheel' has a diameter of 0.3 m"
    )
