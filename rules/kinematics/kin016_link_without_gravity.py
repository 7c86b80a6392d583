"""Gravity or forces do not act on a link of the robot.

A link without gravity drives up every slope and never tips over; a kinematic link pushes through
everything. Both are usually left over from debugging, or hide that a model is unstable. DART, the
default engine of Gazebo Sim, ignores `<kinematic>`: the link falls. None of the accepted packages
that we checked shows this.

Fix: remove `<gravity>` and `<kinematic>` from the link.
Source: SDFormat specification, link/gravity and link/kinematic; URDF, `<turnGravityOff>`; what
gz-physics reads of a link (dartsim/src/SDFFeatures.cc).
"""

from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule


@rule("KIN016", "link-without-gravity", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report links without gravity, and kinematic links."""
    for link in robot.links:
        if not link.gravity.value:
            stated = link.gravity.span.text
            name = link.name.value
            message = f"no gravity acts on link {name!r}, by the value {stated}: remove the setting"
            yield finding(link.gravity, message, key="gravity")
        if link.kinematic.value:
            ignored = "Gazebo's default engine ignores it, others let no force move it"
            message = (
                f"<kinematic> of link {link.name.value!r} is {link.kinematic.span.text}: "
                f"{ignored if context.of_gazebo_sim else 'no force moves it'}"
            )
            yield finding(link.kinematic, message, key="kinematic")


GOOD = [
    '<link name="mast"><gravity>1</gravity><kinematic>0</kinematic></link>',
    '<link name="mast"><gravity>true</gravity></link>',
]
BAD = [
    '<link name="mast"><gravity>0</gravity></link>  <!-- ^ KIN016 -->',
    '<link name="mast"><kinematic>true</kinematic></link>  <!-- ^ KIN016 -->',
]
