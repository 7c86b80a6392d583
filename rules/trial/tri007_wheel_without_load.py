"""A drive wheel that carries no load, or almost none.

The wheel turns in the air: the robot is weaker than it looks, and drifts to one side on uneven
ground. Its collision is missing or too small, or the wheel is higher than the others.

Fix: give the wheel a collision with its radius, and put all wheels on one plane.
Source: experience; the load is the mean while the robot is at rest, compared with an equal share of
the weight.
"""

from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("TRI007", "wheel-without-load", Severity.ERROR, Concern.ROBOT, judges=("load_share",))
def check(
    driven: SettledTrial, *, warning_below: float = 0.05, error_below: float = 0.002
) -> Findings:
    """Report wheels that carry far less than an equal share of the weight.

    Options:
        warning_below: Share of an equal part of the weight (weight divided by number of drive
            wheels); a wheel that carries less is a warning.
        error_below: Share of an equal part of the weight; a wheel that carries less is an error
            instead of a warning.
    """
    for load in driven.trial.all("load_share"):
        if load.value >= warning_below:
            continue
        bare = load.value < error_below
        carried = "carries nothing" if bare else f"carries {load.value:.1%} of an equal share"
        yield finding(
            driven.part(load.part),
            f"the wheel on {load.part!r} {carried} of the robot's weight, expected at least "
            f"{warning_below:.0%} of an equal share",
            severity=Severity.ERROR if bare else Severity.WARNING,
            key="load_share",
        )


_WHEEL = """
<link name="{name}">
  <pose>{x} {y} 0.1 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>4e-3</ixx><iyy>4e-3</iyy><izz>4e-3</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="{name}_joint" type="revolute">{mark}
  <parent>base_link</parent><child>{name}</child><axis><xyz>0 1 0</xyz></axis>
</joint>
"""
_PLACES = {"fl": (0.2, 0.2), "rl": (-0.2, 0.2), "fr": (0.2, -0.2), "rr": (-0.2, -0.2)}


def _rover(radius: float, mark: str = "") -> str:
    wheels = "".join(
        _WHEEL.format(name=name, x=x, y=y, mark=mark if name == "fl" else "")
        for name, (x, y) in _PLACES.items()
    ).replace("<radius>0.1<", f"<radius>{radius}<", 1)
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <pose>0 0 0.15 0 0 0</pose>
  <inertial>
    <pose>-0.05 -0.05 0 0 0 0</pose>
    <mass>10</mass><inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia>
  </inertial>
  <collision name="c"><geometry><box><size>0.4 0.3 0.1</size></box></geometry></collision>
</link>
{wheels}
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


GOOD = [_rover(0.1)]
BAD = [_rover(0.05, "  <!-- ^ TRI007 -->")]
