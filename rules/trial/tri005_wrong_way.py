"""A robot that drives or turns the other way than it is told.

Whoever steers it runs into the wall that he wants to avoid. The axes of the wheels point to the
right instead of to the left, or left and right wheels are swapped in the plugin.

Fix: let wheels turn about an axis that points to the robot's left (`0 1 0` in its frame), and
name in `<left_joint>` the wheels at positive y.
Source: REP 103: x forward, y left, z up; a positive turn rate is counter-clockwise from above.
"""

from collections.abc import Iterator

from checker.model.components import Joint
from checker.model.locomotion.locomotion import Side
from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI005", "moves-the-wrong-way", Severity.ERROR)
def check(driven: RobotTrial) -> Findings:
    """Report motion against the command, by more than a creep."""
    said = {}
    if driven.drives_backwards:
        ratio, leg = driven.trial.value("speed_ratio") or 0.0, driven.leg("drive")
        told = f" at {leg.linear:.3g} m/s" if leg else ""
        said["speed_ratio"] = f"told to drive forward{told}, it drives backward ({ratio:.0%})"
    if driven.turns_backwards:
        ratio = driven.trial.value("yaw_ratio") or 0.0
        said["yaw_rate"] = f"told to turn left, it turns right ({ratio:.0%})"
    if said:
        yield finding(
            driven.drive,
            "; ".join(said.values()) + _CAUSES[driven.drives_backwards, driven.turns_backwards],
            key=" ".join(said),
            related=_suspects(driven),
        )


_CAUSES = {
    (True, True): ": the wheels' axes are reversed",
    (False, True): ": left and right are swapped",
    (True, False): ": it faces backward, or its axes are reversed and its sides swapped",
}


def _suspects(driven: RobotTrial) -> Iterator[tuple[Joint, str]]:
    """Yield the wheels whose axis points to the right or whose side is not where they are."""
    for wheel in driven.robot.locomotion.wheels:
        if wheel.axis is not None and wheel.axis[1] < 0.0:
            yield wheel.joint, f"the axis of {wheel.name.value!r} points to the right"
        if wheel.centre is not None and (wheel.centre[1] > 0.0) is not (wheel.side is Side.LEFT):
            yield wheel.joint, f"{wheel.name.value!r} is named as a {wheel.side} wheel"


_WHEEL = """
<link name="{name}">
  <pose>{x} {y} 0.1 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>4e-3</ixx><iyy>4e-3</iyy><izz>4e-3</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="{name}_joint" type="revolute">
  <parent>base_link</parent><child>{name}</child><axis><xyz>0 1 0</xyz></axis>
</joint>
"""
_PLACES = {"fl": (0.2, 0.2), "rl": (-0.2, 0.2), "fr": (0.2, -0.2), "rr": (-0.2, -0.2)}


def _rover(axis: str = "0 1 0", swap: bool = False, mark: str = "") -> str:
    wheels = "".join(
        _WHEEL.format(name=name, x=x, y=-y if swap else y) for name, (x, y) in _PLACES.items()
    ).replace("0 1 0", axis)
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <pose>0 0 0.15 0 0 0</pose>
  <inertial><mass>10</mass><inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.4 0.3 0.1</size></box></geometry></collision>
</link>
{wheels}
<plugin filename="libdiff-drive.so" name="ignition::gazebo::systems::DiffDrive">{mark}
  <left_joint>fl_joint</left_joint><left_joint>rl_joint</left_joint>
  <right_joint>fr_joint</right_joint><right_joint>rr_joint</right_joint>
  <wheel_separation>0.4</wheel_separation>
  <wheel_radius>0.1</wheel_radius>
  <max_velocity>1</max_velocity><min_velocity>-1</min_velocity>
  <max_acceleration>2</max_acceleration><min_acceleration>-2</min_acceleration>
</plugin>
</model>
</sdf>
"""


_MARK = "  <!-- ^ TRI005 -->"
GOOD = [_rover()]
BAD = [_rover("0 -1 0", mark=_MARK), _rover(swap=True, mark=_MARK)]
