"""A friction direction whose frame is named with the prefix of an older Gazebo release.

`<fdir1>` is the direction in which `<mu>` counts. Without a frame that is read, it turns with the
wheel, so rollers of a mecanum wheel push in changing directions and the robot does not move
sideways. From Garden on, physics engines read the attribute `gz:expressed_in`; the one with
`ignition:` is for Fortress and older.

Fix: write `gz:expressed_in`, and `xmlns:gz="http://gazebosim.org/schema"` in `<sdf>`.
Source: gz-physics, dartsim/src/SDFFeatures.cc (gz-physics 7 to 9).
"""

from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule

_OLD, _NEW = "ignition:expressed_in", "gz:expressed_in"
_RELEASES = ("harmonic", "ionic", "jetty")


@rule("SDF019", "prefix-of-another-release", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report `ignition:expressed_in` where the release reads `gz:expressed_in`."""
    if context.release not in _RELEASES:
        return
    for direction in robot.element.descendants("fdir1"):
        frame = direction.attribute(_OLD)
        if frame is not None and direction.attribute(_NEW) is None:
            yield finding(
                frame,
                f"{_OLD} of <fdir1> is not read by Gazebo {context.release.capitalize()}, so the "
                f"direction turns with the wheel: expected {_NEW}",
                key=_OLD,
            )


def _roller(prefix: str, mark: str = "", profile: str = "gazebo-harmonic") -> dict[str, str]:
    fragment = f"""<sdf version="1.9" xmlns:{prefix}="http://gazebosim.org/schema">
<model name="rover">
<link name="wheel"><collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry>
<surface><friction><ode><mu>1</mu><mu2>0</mu2>
<fdir1 {prefix}:expressed_in="base">1 -1 0</fdir1>{mark}
</ode></friction></surface></collision></link>
<link name="base"/>
</model>
</sdf>
"""
    return {"@fragment": fragment, "@profile": profile}


GOOD = [_roller("gz"), _roller("ignition", profile="gazebo-fortress")]
BAD = [_roller("ignition", "  <!-- ^ SDF019 -->")]
