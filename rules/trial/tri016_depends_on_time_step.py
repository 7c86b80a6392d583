"""A robot that moves differently when the time step is halved.

Its figures are those of the solver, not of the robot: another simulator, or the next release of
this one, shows another robot. Runs with `--thorough` only.

Fix: look for parts that are very light for what hangs on them, for wheels that hop, and for robots
that stand on the verge of tipping.
Source: a sound simulation converges: halving the step changes next to nothing.
"""

from checker.physics.trial.measures.figures import MEASURES
from checker.physics.trial.robot_trial import RepeatedTrial
from checker.rule import Findings, Severity, finding, rule

_MATTERS = {
    "settle_drop": 0.02,
    "settle_rise": 0.02,
    "settle_shift": 0.02,
    "settle_tilt": 0.05,
    "settle_speed": 0.05,
    "speed_ratio": 0.05,
    "path_sideways": 0.02,
    "path_heading": 0.035,
    "stop_speed": 0.05,
    "yaw_of_predicted": 0.2,
    "turn_drift": 0.2,
    "climbed": 0.2,
    "hold_tilt": 0.05,
}
"""How far a figure may move before another rule could think otherwise of it."""


@rule("TRI016", "depends-on-time-step", Severity.WARNING)
def check(driven: RepeatedTrial, *, factor: float = 1.0) -> Findings:
    """Report figures that differ by more than what matters.

    Options:
        factor: Multiple of what each figure may change at half the time step, such as 0.02 m of
            drop or 0.05 rad of tilt; more is reported.
    """
    said = []
    for name, matters in _MATTERS.items():
        once, again = driven.trial.value(name), driven.again.value(name)
        if once is not None and again is not None and abs(once - again) > factor * matters:
            measure = MEASURES[name]
            unit = f" {measure.unit}" if measure.unit else ""
            said.append(
                f"{measure.label} is {round(once, 3):g}{unit} and then {round(again, 3):g}{unit}"
            )
    if driven.trial.trouble != driven.again.trouble:
        said.append("the solver has trouble with one of the two only")
    if said:
        yield finding(
            driven.robot, f"driven again at half the time step: {'; '.join(said)}", key="again"
        )


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


def _rover(stiffness: float, reference: float, mark: str = "") -> str:
    wheels = "".join(_WHEEL.format(name=name, x=x, y=y) for name, (x, y) in _PLACES.items())
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">{mark}
<link name="base_link">
  <pose>0 0 0.15 0 0 0</pose>
  <inertial><mass>10</mass><inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.4 0.3 0.1</size></box></geometry></collision>
</link>
{wheels}
<link name="mast">
  <pose>0 0 0.4 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
</link>
<joint name="spring" type="prismatic">
  <parent>base_link</parent><child>mast</child>
  <axis>
    <xyz>0 0 1</xyz>
    <dynamics>
      <spring_stiffness>{stiffness}</spring_stiffness>
      <spring_reference>{reference}</spring_reference>
    </dynamics>
  </axis>
</joint>
<plugin filename="libdiff-drive.so" name="ignition::gazebo::systems::DiffDrive">
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


GOOD = [_rover(1e3, 0.0)]
BAD = [_rover(1e6, 1.0, "  <!-- ^ TRI016 -->")]
