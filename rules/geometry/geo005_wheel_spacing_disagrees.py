"""The drive plugin's distances differ from those of the robot.

The plugin computes the rates of wheels or tracks from the turn rate with `wheel_separation` or
`tracks_separation`, and steering angles with `wheel_base` and `kingpin_width`. Skid-steer robots
raise the separation on purpose, by half or more, because their wheels slip sideways in a turn. A
separation below the true distance, or far above it, is a mistake: the robot turns too slowly or too
fast. Distances are those between the middles of the shapes that the wheels roll on, wherever the
origins of their links are. With a wrong wheel base or kingpin width the wheels steer about
different points. No accepted package that we checked has this fault.

Fix: set the plugin's `<wheel_separation>` to the distance of left and right wheels, in metres; for
a skid-steer robot to 1 to 2 times the distance. Set `<wheel_base>` to the distance of the axles and
`<kingpin_width>` to the distance of the steering joints.
Source: parameters of Gazebo's DiffDrive, AckermannSteering, MecanumDrive and TrackedVehicle.
"""

from checker.base.words import beyond
from checker.formats.corrections import rewrite
from checker.model.locomotion.wheel_positions import CountedDistance, counted_distances
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("GEO005", "wheel-spacing-disagrees", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot, *, least: float = 0.9, most: float = 2.5, most_of_steering: float = 1.1
) -> Findings:
    """Report distances less than `least` or more than `most` times the true ones.

    Steering depends on the geometry only, and so does the turning of a robot whose controller
    drives one wheel on each side: these have their own limit.

    Options:
        least: Smallest ratio of a distance in the plugin to the true distance; less is reported.
        most: Greatest ratio of the plugin's separation of wheels or tracks to the true distance;
            more is reported.
        most_of_steering: Greatest ratio of the plugin's wheel base or kingpin width, and of a
            separation of wheels that do not slip, to the true distance; more is reported.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    for counted in counted_distances(robot):
        exact = counted.steers or not counted.slips
        highest = most_of_steering if exact else most
        if not least * counted.true <= counted.stated.value <= highest * counted.true:
            fix = rewrite([(counted.stated, float(f"{counted.true:.4g}"))])
            yield finding(counted.stated, _message(counted, least, highest), fix=fix)


def _message(counted: CountedDistance, least: float, most: float) -> str:
    stated = counted.stated
    says = f"has {counted.tag}" if stated.stated else f"states no {counted.tag}, so it is"
    times = beyond(stated.value / counted.true, least, most)
    return (
        f"{counted.plugin.label} {says} {stated.value:g} m, but its {counted.what} are "
        f"{counted.true:.4g} m apart: {times} times, expected {least:g} "
        f"to {most:g}"
    )


def _rover(separation: str, *, outside: bool = False) -> str:
    return f"""{_pair("wheel", 0, outside=outside)}
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>wheel_left_joint</left_joint>
  <right_joint>wheel_right_joint</right_joint>
  {separation}
</plugin>
"""


def _car(sizes: str) -> str:
    return f"""{_pair("wheel", 0)}{_pair("knuckle", 0.5, "0 0 1")}
<plugin filename="libp.so" name="ignition::gazebo::systems::AckermannSteering">
  <left_joint>wheel_left_joint</left_joint>
  <right_joint>wheel_right_joint</right_joint>
  <left_steering_joint>knuckle_left_joint</left_steering_joint>
  <right_steering_joint>knuckle_right_joint</right_steering_joint>
  <wheel_separation>0.4</wheel_separation>
  {sizes}
</plugin>
"""


def _outside(side: int) -> str:
    """Return a wheel's cylinder 0.1 m outside of the origin of its link."""
    return f"""
<collision name="c">
  <pose>0 {side * 0.1} 0 1.5707963267948966 0 0</pose>
  <geometry><cylinder><radius>0.1</radius><length>0.05</length></cylinder></geometry>
</collision>
"""


def _pair(name: str, x: float, axis: str = "0 1 0", *, outside: bool = False) -> str:
    left, right = (_outside(1), _outside(-1)) if outside else ("", "")
    return "".join(
        f"""
<link name="{name}_{side}"><pose>{x} {y} 0 0 0 0</pose>{shape}</link>
<joint name="{name}_{side}_joint" type="revolute">
  <parent>base_link</parent>
  <child>{name}_{side}</child>
  <axis><xyz>{axis}</xyz></axis>
</joint>
"""
        for side, y, shape in (("left", 0.2, left), ("right", -0.2, right))
    )


def _crawler(separation: str) -> str:
    tracks = "".join(
        f"""
<link name="{side}_track">
  <pose>0 {y} 0 0 0 0</pose>
  <collision name="c"><geometry><box><size>0.5 0.1 0.2</size></box></geometry></collision>
</link>
<plugin filename="libp.so" name="ignition::gazebo::systems::TrackController">
  <link>{side}_track</link>
</plugin>
"""
        for side, y in (("left", 0.2), ("right", -0.2))
    )
    return f"""{tracks}
<plugin filename="libp.so" name="ignition::gazebo::systems::TrackedVehicle">
  <left_track><link>left_track</link></left_track>
  <right_track><link>right_track</link></right_track>
  <tracks_separation>{separation}
</plugin>
"""


_END = "</wheel_separation>"
_MARK = "  <!-- ^ GEO005 -->"
_BASE, _KINGPINS = "<wheel_base>0.5</wheel_base>", "<kingpin_width>0.4</kingpin_width>"
GOOD = [
    _rover(f"<wheel_separation>0.4{_END}"),
    _rover(f"<wheel_separation>0.6{_END}"),
    _rover(""),
    _rover(f"<wheel_separation>1.4{_END}", outside=True),
    _car(_BASE + _KINGPINS),
    _crawler("0.4</tracks_separation>"),
]
BAD = [
    _rover(f"<wheel_separation>0.2{_END}{_MARK}"),
    _rover(f"<wheel_separation>1.2{_END}{_MARK}"),
    _rover(f"<wheel_separation>0.4{_END}{_MARK}", outside=True),
    _car(f"<wheel_base>1.5</wheel_base>{_MARK}\n{_KINGPINS}"),
    _car(f"{_BASE}\n<kingpin_width>0.8</kingpin_width>{_MARK}"),
    _crawler(f"0.2</tracks_separation>{_MARK}"),
]
