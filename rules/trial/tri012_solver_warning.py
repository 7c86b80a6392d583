"""A model that the solver cannot simulate.

Positions or speeds grow without limit within moments. In Gazebo the robot flies off, vanishes or
stops the whole simulation.

Fix: look for inertias that are far too small for the part, joints with extreme stiffness or
damping, and masses that differ by many orders of magnitude across a joint.
Source: warnings BADQPOS, BADQVEL and BADQACC of MuJoCo that remain at half the time step.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import rover_with_spring


@rule("TRI012", "solver-warning", Severity.ERROR, Concern.ROBOT)
def check(driven: RobotTrial) -> Findings:
    """Report warnings of the solver, and figures that are not numbers."""
    for trouble in driven.trial.trouble:
        yield finding(driven.robot, f"the simulation {trouble}", key="trouble")


GOOD = [rover_with_spring(1e3, 0.0)]
BAD = [rover_with_spring(1e15, 1e3, "  <!-- ^ TRI012 -->")]
