"""A wheel or track is above or below the level of the others.

A wheel in the air carries no load and drives nothing; one that is too low lifts the adjacent ones.
The robot rocks and pulls to one side, although each wheel looks right on its own. No accepted
package that we checked has this fault.

Fix: correct the height of the wheel's link, or the radius of its collision.
Source: geometry of collisions in the robot's initial pose.
"""

from checker.model.locomotion.wheel_positions import Foot, uneven_wheels
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("GEO006", "uneven-wheel-heights", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, *, error_above: float = 0.02, warning_above: float = 0.005) -> Findings:
    """Report wheels and tracks whose lowest points are above or below those of the others.

    A height that left and right wheel share is intended. Wheels on suspensions and on further
    segments of an articulated robot are skipped: they can move.

    Options:
        error_above: Metres that a wheel or track may be above or below the level of the others
            before it is an error.
        warning_above: Metres above or below the level of the others; more is a warning, unless the
            wheel on the other side has the same height within this distance.
    """
    for foot in uneven_wheels(robot, warning_above):
        yield finding(
            foot.part.link.pose,
            _message(foot),
            severity=Severity.ERROR if abs(foot.off) > error_above else Severity.WARNING,
            related=[(foot.part.link, "the part")],
        )


def _message(foot: Foot) -> str:
    kind = "track" if foot.part.is_track else "wheel"
    how = "is {:.3g} mm above" if foot.off > 0 else "is {:.3g} mm below"
    return (
        f"{kind} {foot.part.link.name.value!r} {how.format(abs(foot.off) * 1e3)} the level of the "
        f"other {kind}s, expected 0 mm"
    )


def _rover(
    front_left: str = "0", mark: str = "", suspension: str = "fixed", front_right: str = "0"
) -> str:
    plugin = "".join(
        f"<{side}_joint>{end}_{side}_axle</{side}_joint>"
        for end in ("front", "rear")
        for side in ("left", "right")
    )
    parts = [
        _wheel(f"{end}_{side}", f"{x} {y} {front_right if end == 'front' else 0}", "base_link")
        for end, x in (("front", 0.3), ("rear", -0.3))
        for side, y in (("left", 0.2), ("right", -0.2))
        if (end, side) != ("front", "left")
    ]
    return f"""
<link name="arm"/>
<joint name="spring" type="{suspension}"><parent>base_link</parent><child>arm</child></joint>
{_wheel("front_left", f"0.3 0.2 {front_left}", "arm", mark)}
{"".join(parts)}
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">{plugin}</plugin>
"""


def _wheel(name: str, at: str, parent: str, mark: str = "") -> str:
    return f"""
<link name="{name}">
  <pose>{at} 0 0 0</pose>{mark}
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="{name}_axle" type="revolute">
  <parent>{parent}</parent>
  <child>{name}</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
"""


_MARK = "  <!-- ^ GEO006 -->"
GOOD = [
    _rover(),
    _rover("0.004"),
    _rover("0.05", front_right="0.05"),
    _rover("0.05", suspension="prismatic"),
]
BAD = [_rover("0.05", _MARK), _rover("-0.007", _MARK)]
