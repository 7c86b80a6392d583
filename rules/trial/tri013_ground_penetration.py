"""A robot that is partly in the ground when at rest.

The parts that carry the robot are too light for its load, so the contact is soft: the robot sinks
in, trembles, and drives as if through mud. GEO015 reports parts that start inside each other.

Fix: give the links that touch the ground the mass and inertia of the real parts.
Source: contact forces depend on the inertia of the bodies that touch; accepted robots press 0.1 to
0.3 mm into the ground.
"""

from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("TRI013", "ground-penetration", Severity.WARNING, Concern.ROBOT, judges=("rest_penetration",))
def check(
    driven: SettledTrial,
    *,
    rest_penetration_above: float = 0.01,
    rest_penetration_up_to: float = 0.05,
) -> Findings:
    """Report a robot that presses into the ground when at rest.

    Options:
        rest_penetration_above: Metres that the deepest contact at rest may be in the ground; more
            is reported.
        rest_penetration_up_to: Metres above which this rule reports nothing; keep it equal to
            `rest_penetration_above` of TRI002, which reports larger values.
    """
    deep = driven.trial.value("rest_penetration")
    if deep is not None and rest_penetration_above < deep <= rest_penetration_up_to:
        yield finding(
            driven.robot,
            f"at rest the robot presses {deep * 1000:.3g} mm into the ground, expected at most "
            f"{rest_penetration_above * 1000:g} mm",
            key="rest_penetration",
        )


_FOOT = """
<link name="{name}">
  <pose>{x} {y} 0.05 0 0 0</pose>
  <inertial><mass>{mass}</mass>
    <inertia><ixx>{moment}</ixx><iyy>{moment}</iyy><izz>{moment}</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision>
</link>
<joint name="{name}_leg" type="prismatic">
  <parent>base_link</parent><child>{name}</child>
  <axis><xyz>0 0 1</xyz><limit><lower>-0.1</lower><upper>0</upper></limit></axis>
</joint>
"""
_PLACES = {"fl": (0.3, 0.3), "rl": (-0.3, 0.3), "fr": (0.3, -0.3), "rr": (-0.3, -0.3)}


def _table(mass: float, mark: str = "") -> str:
    feet = "".join(
        _FOOT.format(name=name, x=x, y=y, mass=mass, moment=mass * 1e-3)
        for name, (x, y) in _PLACES.items()
    )
    return f"""
<sdf version="1.6">
<model name="acme_table_sensor_config_1">{mark}
<link name="base_link">
  <pose>0 0 0.3 0 0 0</pose>
  <inertial><mass>200</mass><inertia><ixx>10</ixx><iyy>10</iyy><izz>10</izz></inertia></inertial>
</link>
{feet}
</model>
</sdf>
"""


GOOD = [_table(10.0)]
BAD = [_table(0.01, "  <!-- ^ TRI013 -->")]
