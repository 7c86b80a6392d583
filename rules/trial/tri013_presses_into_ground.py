"""A robot that stands in the ground when it is at rest.

What carries it is too light for its load, so the contact is soft: it sinks in, trembles, and
drives as through mud. Parts that start inside each other are GEO015's.

Fix: give the links that touch the ground the mass and inertia of the real parts.
Source: contact forces are worked out against the inertia of the bodies that touch; accepted robots
press 0.1 to 0.3 mm into the ground.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI013", "presses-into-ground", Severity.WARNING)
def check(
    driven: RobotTrial,
    *,
    rest_penetration_above: float = 0.01,
    rest_penetration_up_to: float = 0.05,
) -> Findings:
    """Report a robot that presses into the ground when it is at rest.

    Options:
        rest_penetration_above: Metres that the deepest contact at rest may lie in the ground;
            deeper is reported.
        rest_penetration_up_to: Metres beyond which nothing is said here: set it as
            `rest_penetration_above` of TRI002, which reports what is deeper.
    """
    deep = driven.trial.value("rest_penetration")
    if deep is not None and rest_penetration_above < deep <= rest_penetration_up_to:
        yield finding(
            driven.robot,
            f"at rest it presses {deep * 1000:.0f} mm into the ground, expected at most "
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
  <parent>base_link</parent><child>{name}</child><axis><xyz>0 0 1</xyz></axis>
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
