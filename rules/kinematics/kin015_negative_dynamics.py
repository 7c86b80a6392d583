"""A joint with negative damping, friction or stiffness.

Negative damping or friction adds energy with every movement, and a negative stiffness pushes the
joint away from its rest position: the motion grows until the simulation diverges. No accepted
package that we checked has this fault.

Fix: write a positive number, or 0 for none.
Source: SDFormat specification, axis/dynamics; URDF, joint/dynamics.
"""

from checker.formats.corrections import rewrite
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("KIN015", "negative-dynamics", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report axes with a negative coefficient."""
    for joint in robot.joints:
        for axis in joint.axes:
            stated = {
                "damping": axis.damping,
                "friction": axis.friction,
                "spring stiffness": axis.stiffness,
            }
            for kind, value in stated.items():
                if value.value < 0.0:
                    message = f"joint {joint.name.value!r} has the {kind} {value.value:g}"
                    fix = rewrite([(value, -value.value)])
                    yield finding(value, f"{message}, expected 0 or more", fix=fix)


def _hinge(dynamics: str) -> str:
    return f"""
<link name="lid"/>
<joint name="hinge" type="revolute">
  <parent>base_link</parent>
  <child>lid</child>
  <axis>
    <xyz>0 0 1</xyz>
    <dynamics>{dynamics}
    </dynamics>
  </axis>
</joint>
"""


_MARK = "  <!-- ^ KIN015 -->"
GOOD = [_hinge("<damping>0.1</damping>\n<friction>0</friction>"), _hinge("")]
BAD = [
    _hinge(f"<damping>-0.1</damping>{_MARK}"),
    _hinge(f"<damping>0.1</damping>\n<friction>-1</friction>{_MARK}"),
    _hinge(f"<spring_stiffness>-5</spring_stiffness>{_MARK}"),
]
