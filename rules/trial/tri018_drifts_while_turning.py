"""A robot that moves away while it turns in place.

Path planners assume that the robot turns in place; in a narrow passage it hits the wall. A robot
with wheels in fixed directions turns about a point that depends on its loads: its centre of mass
should be in the middle of its wheels.

Fix: move heavy parts, such as the battery, so that the centre of mass is in the middle of the
wheels; if the real robot drifts too, say so in specifications.md.
Source: quasi-static balance of Coulomb friction at the contact points with their loads.
"""

from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("TRI018", "drifts-while-turning", Severity.WARNING, Concern.ROBOT, judges=("turn_drift",))
def check(driven: SettledTrial, *, warning_above: float = 0.5) -> Findings:
    """Report a robot that moves away while it turns in place.

    Options:
        warning_above: Metres that the middle of the wheels or tracks may move away from its place
            at the start of the turn; more is reported.
    """
    drift = driven.trial.value("turn_drift")
    if drift is None or drift <= warning_above:
        return
    yield finding(
        driven.drive,
        f"the robot drifts {drift:.2g} m while turning in place, expected at most "
        f"{warning_above:g} m" + _cause(driven, drift),
        key="turn_drift",
    )


def _cause(driven: SettledTrial, drift: float) -> str:
    explained = driven.trial.value("turn_drift_explained")
    side, front = (driven.trial.value(f"com_offset_{way}") for way in ("side", "front"))
    if explained is None or side is None or front is None:
        return ""
    if explained < _MOST * drift:
        return f": its centre of mass explains {explained:.2g} m of it; the rest has another cause"
    where = [
        f"{abs(offset) * 1000:.0f} mm {ahead if offset > 0 else behind}"
        for offset, ahead, behind in ((side, "left of", "right of"), (front, "before", "behind"))
        if abs(offset) > _SMALL
    ]
    place = " and ".join(where) or "near"
    return f": the centre of mass {place} the middle of the wheels explains {explained:.2g} m of it"


_MOST = 0.5
_SMALL = 0.005
"""Metres that do not matter."""


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
_PLACES = {"fl": (0.4, 0.3), "rl": (-0.4, 0.3), "fr": (0.4, -0.3), "rr": (-0.4, -0.3)}


def _rover(offset: float, mark: str = "") -> str:
    wheels = "".join(_WHEEL.format(name=name, x=x, y=y) for name, (x, y) in _PLACES.items())
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <pose>0 0 0.15 0 0 0</pose>
  <inertial>
    <pose>{offset} 0 0 0 0 0</pose>
    <mass>10</mass><inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia>
  </inertial>
  <collision name="c"><geometry><box><size>0.4 0.3 0.1</size></box></geometry></collision>
</link>
{wheels}
<plugin filename="libdiff-drive.so" name="ignition::gazebo::systems::DiffDrive">{mark}
  <left_joint>fl_joint</left_joint><left_joint>rl_joint</left_joint>
  <right_joint>fr_joint</right_joint><right_joint>rr_joint</right_joint>
  <wheel_separation>0.6</wheel_separation>
  <wheel_radius>0.1</wheel_radius>
  <max_velocity>2</max_velocity><min_velocity>-2</min_velocity>
  <max_acceleration>2</max_acceleration><min_acceleration>-2</min_acceleration>
</plugin>
</model>
</sdf>
"""


GOOD = [_rover(0.0)]
BAD = [_rover(0.4, "  <!-- ^ TRI018 -->")]
