"""A model that the solver cannot simulate.

Positions or speeds grow without limit within moments. In Gazebo the robot flies off, vanishes or
stops the whole simulation.

Fix: look for inertias that are far too small for the part, joints with extreme stiffness or
damping, and masses that differ by many orders of magnitude across a joint.
Source: warnings BADQPOS, BADQVEL and BADQACC of MuJoCo that remain at half the time step.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("TRI012", "solver-warning", Severity.ERROR, Concern.ROBOT)
def check(driven: RobotTrial) -> Findings:
    """Report warnings of the solver, and figures that are not numbers."""
    for trouble in driven.trial.trouble:
        yield finding(driven.robot, f"the simulation {trouble}", key="trouble")


def _sprung(stiffness: float, reference: float, mark: str = "") -> dict[str, object]:
    added = f"""
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
</model>"""
    return {
        "@robot": "rover",
        "@change": {'sensor_config_1">': f'sensor_config_1">{mark}', "</model>": added},
    }


GOOD = [_sprung(1e3, 0.0)]
BAD = [_sprung(1e15, 1e3, "  <!-- ^ TRI012 -->")]
