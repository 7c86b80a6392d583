"""What moves a robot: wheels, tracks and rotors as drive plugins name them, and their limits."""

from __future__ import annotations

import math

import pytest

from checker.model.locomotion.locomotion import DriveKind, Side, Wheel
from checker.model.robot import Robot
from tests.model.robots import sdf, urdf

CYLINDER = """
<collision name="c">
  <pose>0 0 0 1.5707963267948966 0 0</pose>
  <geometry><cylinder><radius>0.1</radius><length>0.06</length></cylinder></geometry>
</collision>
"""


def wheel(
    name: str,
    at: str = "0 0 0",
    collision: str = CYLINDER,
    parent: str = "base",
    axis: str = "0 1 0",
) -> str:
    return f"""
<link name="{name}"><pose>{at} 0 0 0</pose>{collision}</link>
<joint name="{name}_axle" type="revolute">
  <parent>{parent}</parent><child>{name}</child>
  <axis><xyz>{axis}</xyz></axis>
</joint>
"""


def plugin(name: str, content: str) -> str:
    return f'<plugin name="ignition::gazebo::systems::{name}" filename="p.so">{content}</plugin>'


def tags(**named: str) -> str:
    return "".join(f"<{tag}>{text}</{tag}>" for tag, text in named.items())


BASE = '<link name="base"/>'
TWO = BASE + wheel("left", "0 0.2 0") + wheel("right", "0 -0.2 0")
LEFT_RIGHT = tags(left_joint="left_axle", right_joint="right_axle")


def only_wheel(robot: Robot) -> Wheel:
    (each,) = robot.locomotion.wheels
    return each


def driven(content: str, name: str = "DiffDrive", **more: str) -> Robot:
    return sdf(BASE + content + plugin(name, tags(left_joint="w_axle", **more)))


class TestKinds:
    @pytest.mark.parametrize(
        ("plugins", "kind"),
        [
            ("", DriveKind.NONE),
            (plugin("DiffDrive", LEFT_RIGHT), DriveKind.DIFFERENTIAL),
            (plugin("DiffDrive", LEFT_RIGHT + LEFT_RIGHT), DriveKind.DIFFERENTIAL),
            (plugin("DiffDrive", LEFT_RIGHT + tags(left_joint="right_axle")), DriveKind.SKID_STEER),
            (plugin("DiffDrive", tags(left_joint="left_axle")) * 2, DriveKind.SKID_STEER),
            (plugin("AckermannSteering", LEFT_RIGHT), DriveKind.ACKERMANN),
            (plugin("MecanumDrive", tags(front_left_joint="left_axle")), DriveKind.MECANUM),
            (plugin("TrackedVehicle", ""), DriveKind.TRACKED),
            (plugin("TrackController", "<link>left</link>"), DriveKind.TRACKED),
            (plugin("MulticopterMotorModel", ""), DriveKind.MULTICOPTER),
            (plugin("MulticopterVelocityControl", ""), DriveKind.MULTICOPTER),
            (plugin("DiffDrive", "<left_joint>nobody</left_joint>"), DriveKind.DIFFERENTIAL),
        ],
    )
    def test_kind(self, plugins: str, kind: DriveKind) -> None:
        assert sdf(TWO + plugins).locomotion.kind is kind

    def test_legs(self) -> None:
        above = {"left": "base", "right": "base"}
        above |= {f"{side}_knee": side for side in ("left", "right")}
        above |= {f"{side}_foot": f"{side}_knee" for side in ("left", "right")}
        legs = [wheel(name, parent=parent) for name, parent in above.items()]
        controllers = [
            plugin("JointPositionController", tags(joint_name=f"{name}_axle")) for name in above
        ]
        moves = sdf(BASE + "".join(legs + controllers)).locomotion
        assert moves.kind is DriveKind.LEGGED
        assert len(moves.leg_joints) == 6


class TestWheels:
    def test_where_a_wheel_is_and_how_large(self) -> None:
        left, right = sdf(TWO + plugin("DiffDrive", LEFT_RIGHT)).locomotion.wheels
        assert (left.side, right.side) == (Side.LEFT, Side.RIGHT)
        assert left.centre == pytest.approx((0, 0.2, 0))
        assert left.axis == pytest.approx((0, 1, 0))
        assert left.radius == pytest.approx(0.1)
        assert left.width == pytest.approx(0.06)
        assert left.name.value == "left_axle"
        assert left.steering is None

    def test_the_axis_need_not_have_length_one(self) -> None:
        assert only_wheel(driven(wheel("w", axis="0 -3 0"))).axis == pytest.approx((0, -1, 0))

    def test_a_wheel_of_urdf(self) -> None:
        robot = urdf("""
<link name="base"/>
<link name="w"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
<joint name="w_axle" type="continuous">
  <parent link="base"/><child link="w"/><origin xyz="0 1 0" rpy="0 0 1.5707963267948966"/>
  <axis xyz="1 0 0"/>
</joint>
<gazebo><plugin name="gz::sim::systems::DiffDrive" filename="p.so">
  <left_joint>w_axle</left_joint>
</plugin></gazebo>
""")
        one = only_wheel(robot)
        assert one.centre == pytest.approx((0, 1, 0))
        assert one.axis == pytest.approx((0, 1, 0))
        assert one.radius == pytest.approx(0.3)

    def test_collisions_of_links_fixed_to_it_are_its_own(self) -> None:
        tyre = """
<link name="tyre"><collision name="c"><geometry><sphere><radius>0.2</radius></sphere></geometry>
</collision></link>
<joint name="rim" type="fixed"><parent>w</parent><child>tyre</child></joint>
<joint name="back" type="fixed"><parent>tyre</parent><child>w</child></joint>
"""
        one = only_wheel(driven(wheel("w", collision="") + tyre))
        assert [link.name.value for link in one.body] == ["w", "tyre"]
        assert one.radius == pytest.approx(0.2)

    def test_an_eccentric_collision_reaches_farther(self) -> None:
        off = CYLINDER.replace("<pose>0 0 0 ", "<pose>0.02 0.01 0 ")
        one = only_wheel(driven(wheel("w", collision=off)))
        assert one.radius == pytest.approx(0.12)
        assert one.width == pytest.approx(0.06)

    @pytest.mark.parametrize(
        "content",
        [
            wheel("w", collision=""),
            wheel("w", collision="<collision name='c'/>"),
            wheel("w", axis="0 0 0"),
            wheel("w", collision="<collision name='c'><geometry><plane/></geometry></collision>"),
        ],
    )
    def test_without_known_collision_or_axis_it_has_no_size(self, content: str) -> None:
        one = only_wheel(driven(content))
        assert one.radius is None
        assert one.width is None

    @pytest.mark.parametrize("at", ["nan 0 0", "inf 0 0", "1e400 0 0", "x", "1e308 1e308 0"])
    def test_numbers_that_are_none(self, at: str) -> None:
        one = only_wheel(driven(wheel("w", at=at)))
        assert one.centre is None or all(map(math.isfinite, one.centre))
        assert one.radius is None or math.isfinite(one.radius)

    @pytest.mark.parametrize(
        "joint",
        [
            "<joint name='w_axle' type='revolute'><parent>base</parent><child>v</child></joint>",
            "<joint name='w_axle' type='revolute'/>",
            "",
        ],
    )
    def test_a_joint_that_turns_nothing_is_left_out(self, joint: str) -> None:
        assert not driven(f"<link name='w'/>{joint}").locomotion.wheels

    def test_listed_twice_for_a_side_is_one_wheel_for_both_sides_two(self) -> None:
        content = tags(left_joint="w_axle") * 2
        (drive,) = sdf(BASE + wheel("w") + plugin("DiffDrive", content)).locomotion.wheel_drives
        assert len(drive.wheels) == 1
        (drive,) = driven(wheel("w"), right_joint="w_axle").locomotion.wheel_drives
        assert [each.side for each in drive.wheels] == [Side.LEFT, Side.RIGHT]

    def test_several_drives_share_a_wheel_once(self) -> None:
        robot = sdf(TWO + plugin("DiffDrive", LEFT_RIGHT) * 2)
        assert [len(drive.wheels) for drive in robot.locomotion.wheel_drives] == [2, 2]
        assert len(robot.locomotion.wheels) == 2

    def test_a_plugin_means_joints_of_its_own_model(self) -> None:
        inside = BASE + wheel("w") + plugin("DiffDrive", "<left_joint>w_axle</left_joint>")
        robot = sdf(f'<model name="m"><pose>0 0 1 0 0 0</pose>{inside}</model>' + wheel("w"))
        one = only_wheel(robot)
        assert one.joint.scoped_name == "m::w_axle"
        assert one.centre == pytest.approx((0, 0, 1))

    def test_mecanum(self) -> None:
        names = ("front_left", "back_left", "front_right", "back_right")
        content = BASE + "".join(wheel(name) for name in names)
        joints = tags(**{f"{name}_joint": f"{name}_axle" for name in names})
        (drive,) = sdf(content + plugin("MecanumDrive", joints)).locomotion.wheel_drives
        assert [each.joint.name.value for each in drive.wheels_on(Side.LEFT)] == [
            "front_left_axle",
            "back_left_axle",
        ]

    def test_a_thousand_wheels_of_one_plugin_and_of_one_body(self) -> None:
        count = 1000
        names = [f"w{i}" for i in range(count)]
        rims = [
            f"<joint name='rim{i}' type='fixed'><parent>{name}</parent><child>rim</child></joint>"
            for i, name in enumerate(names)
        ]
        joints = "".join(f"<left_joint>{name}_axle</left_joint>" for name in names)
        steering = "".join(
            f"<left_steering_joint>{name}_axle</left_steering_joint>" for name in names
        )
        content = BASE + "<link name='rim'/>" + "".join(map(wheel, names)) + "".join(rims)
        robot = sdf(content + plugin("AckermannSteering", joints + steering))
        assert len(robot.locomotion.wheels) == count
        assert sum(len(each.body) for each in robot.locomotion.wheels) == count + 1


class TestParameters:
    def test_defaults_are_not_stated(self) -> None:
        (drive,) = driven(wheel("w")).locomotion.wheel_drives
        assert (drive.wheel_separation.value, drive.wheel_separation.stated) == (1.0, False)
        assert (drive.wheel_radius.value, drive.wheel_radius.stated) == (0.2, False)
        assert drive.wheel_base is None

    def test_what_cannot_be_read_counts_as_the_default(self) -> None:
        (drive,) = driven(wheel("w"), wheel_radius="0,1").locomotion.wheel_drives
        assert (drive.wheel_radius.value, drive.wheel_radius.stated) == (0.2, False)

    def test_steering(self) -> None:
        content = (
            BASE
            + wheel("knuckle", "0 0.2 0", "", axis="0 0 1")
            + wheel("w", "0 0.2 0", parent="knuckle")
            + wheel("rear", "-1 0.2 0")
        )
        parameters = tags(
            left_steering_joint="knuckle_axle",
            right_steering_joint="nobody",
            wheel_base="1.0",
            kingpin_width="0.5",
        )
        joints = "<left_joint>w_axle</left_joint><left_joint>rear_axle</left_joint>"
        robot = sdf(content + plugin("AckermannSteering", joints + parameters))
        (drive,) = robot.locomotion.wheel_drives
        front, rear = drive.wheels
        assert front.steering is robot.joints_by_name["knuckle_axle"]
        assert rear.steering is None
        assert [(joint.name.value, side) for joint, side in drive.steering] == [
            ("knuckle_axle", Side.LEFT)
        ]
        assert drive.wheel_base is not None
        assert drive.kingpin_width is not None
        assert drive.steering_limit is not None
        assert (drive.wheel_base.value, drive.kingpin_width.value) == (1.0, 0.5)
        assert (drive.steering_limit.value, drive.steering_limit.stated) == (0.5, False)


class TestLimits:
    def test_one_set_for_both_motions(self) -> None:
        (drive,) = driven(
            wheel("w"),
            min_velocity="-1",
            max_velocity="2",
            min_acceleration="-3",
            max_acceleration="4",
        ).locomotion.wheel_drives
        for limits in (drive.linear, drive.angular):
            assert limits.complete
            assert limits.min_velocity is not None
            assert limits.max_acceleration is not None
            assert (limits.min_velocity.value, limits.max_acceleration.value) == (-1, 4)

    def test_of_one_motion_counts_before_that_of_both(self) -> None:
        (drive,) = driven(
            wheel("w"), min_velocity="-1", min_linear_velocity="-2", max_angular_velocity="3"
        ).locomotion.wheel_drives
        assert drive.linear.min_velocity is not None
        assert drive.angular.min_velocity is not None
        assert drive.angular.max_velocity is not None
        assert drive.linear.min_velocity.value == -2
        assert drive.angular.min_velocity.value == -1
        assert drive.angular.max_velocity.value == 3
        assert drive.linear.max_velocity is None
        assert not drive.linear.complete

    def test_none_stated(self) -> None:
        (drive,) = driven(wheel("w"), max_velocity="fast").locomotion.wheel_drives
        assert drive.linear.max_velocity is None
        assert drive.linear.holder.text.startswith("<plugin")


class TestTracks:
    def test_vehicle_and_controllers(self) -> None:
        vehicle = plugin(
            "TrackedVehicle",
            """<left_track><link>left</link></left_track>
<right_track><link>right</link><link>ghost</link></right_track>
<tracks_separation>0.4</tracks_separation>
<linear_velocity><max_velocity>1.5</max_velocity></linear_velocity>""",
        )
        controllers = plugin("TrackController", "<link>left</link><max_velocity>2</max_velocity>")
        controllers += plugin("TrackController", "<link>right</link>")
        controllers += plugin("TrackController", "<link>base</link>")
        controllers += plugin("TrackController", "<link>nobody</link>")
        moves = sdf(TWO + vehicle + controllers).locomotion
        (drive,) = moves.tracked_drives
        sides = [(track.link.name.value, track.side) for track in moves.tracks]
        assert sides == [("left", Side.LEFT), ("right", Side.RIGHT), ("base", None)]
        assert drive.tracks == moves.tracks[:2]
        assert drive.separation.value == 0.4
        assert drive.linear.max_velocity is not None
        assert drive.linear.max_velocity.value == 1.5
        assert drive.angular.max_velocity is None
        assert moves.tracks[0].limits.max_velocity is not None
        assert moves.tracks[0].limits.max_velocity.value == 2

    def test_of_a_nested_model(self) -> None:
        inside = TWO + plugin("TrackController", "<link>left</link>")
        inside += plugin("TrackedVehicle", "<left_track><link>left</link></left_track>")
        moves = sdf(f'<model name="m">{inside}</model>{TWO}').locomotion
        assert [track.link.scoped_name for track in moves.tracks] == ["m::left"]
        assert moves.tracked_drives[0].tracks == moves.tracks
        assert moves.tracks[0].side is Side.LEFT

    def test_two_controllers_of_a_link_are_one_track(self) -> None:
        twice = plugin("TrackController", "<link>left</link>") * 2
        assert len(sdf(TWO + twice).locomotion.tracks) == 1


class TestCopters:
    def test_rotors(self) -> None:
        motor = tags(
            jointName="w_axle",
            linkName="w",
            motorNumber="2",
            turningDirection="cw",
            motorConstant="8.5e-06",
            momentConstant="0.016",
            maxRotVelocity="800",
        )
        robot = sdf(
            BASE + wheel("w", "0.1 0 0", axis="0 0 1") + plugin("MulticopterMotorModel", motor)
        )
        (rotor,) = robot.locomotion.rotors
        assert rotor.direction == -1
        assert rotor.joint is robot.joints_by_name["w_axle"]
        assert rotor.link is robot.links_by_name["w"]
        assert rotor.centre == pytest.approx((0.1, 0, 0))
        assert rotor.axis == pytest.approx((0, 0, 1))
        assert rotor.motor_constant is not None
        assert rotor.motor_constant.value == 8.5e-06

    def test_nothing_stated(self) -> None:
        (rotor,) = sdf(plugin("MulticopterMotorModel", "")).locomotion.rotors
        assert (rotor.joint, rotor.link, rotor.number, rotor.direction) == (None, None, None, 0)

    def test_controller(self) -> None:
        content = """
<maximumLinearVelocity>1 2 3</maximumLinearVelocity>
<maximumLinearAcceleration>4 5</maximumLinearAcceleration>
<rotorConfiguration><rotor><jointName>a</jointName><direction>1</direction></rotor><rotor/>
</rotorConfiguration>"""
        (copter,) = sdf(plugin("MulticopterVelocityControl", content)).locomotion.copters
        x, _, z = copter.linear
        assert x.min_velocity is not None
        assert x.max_acceleration is not None
        assert (x.min_velocity.value, x.max_acceleration.value) == (-1, 4)
        assert z.max_velocity is not None
        assert (z.max_velocity.value, z.max_acceleration) == (3, None)
        assert [entry.joint_name.value for entry in copter.entries] == ["a", ""]
        assert copter.entries[1].direction is None
