"""Gravity or forces do not act on a link of the robot.

A link without gravity drives up every slope and never tips over; a kinematic link pushes through
everything. Both are usually left over from debugging, or hide that a model is unstable. DART, the
default engine of Gazebo Sim, ignores `<kinematic>`: the link falls. No accepted package that we
checked has this fault.

An arm without gravity may be intended, to replace springs that balance the real one. For links
other than the base and the wheels, it is an info, and so is a model all of whose links have none. A
model without joints, sensors and plugins is an object that may be held in the air: there it is not
reported.

Fix: remove `<gravity>` and `<kinematic>` from the link.
Source: SDFormat specification, link/gravity and link/kinematic; URDF, `<turnGravityOff>`; what
gz-physics reads of a link (dartsim/src/SDFFeatures.cc).
"""

from checker.model.robot import Robot
from checker.rule import (
    Concern,
    Context,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
)


@rule("KIN016", "link-without-gravity", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report links without gravity, and kinematic links.

    For a link that is neither of the base nor a wheel, nor between them, it is an info.
    """
    carrying = _carrying_links(robot)
    is_object = not (robot.joints or robot.sensors or robot.all_plugins)
    floats = len(robot.links) > 1 and not any(link.gravity.value for link in robot.links)
    if floats and not is_object:
        message = "no gravity acts on any link: the whole model floats"
        yield finding(robot.links[0].gravity, message, severity=Severity.INFO, key="gravity")
    for link in robot.links:
        if not (link.gravity.value or is_object or floats):
            stated = link.gravity.span.text
            name = link.name.value
            carries = link.scoped_name in carrying
            severity = Severity.WARNING if carries else Severity.INFO
            advice = "remove the setting" if carries else "expected only where springs balance it"
            message = f"no gravity acts on link {name!r} (set to {stated}): {advice}"
            fix = replace_text(link.gravity, "true", Safety.UNSAFE) if carries else None
            yield finding(link.gravity, message, severity=severity, key="gravity", fix=fix)
        if link.kinematic.value:
            ignored = "Gazebo's default engine ignores it; in others, no force moves the link"
            message = (
                f"<kinematic> of link {link.name.value!r} is {link.kinematic.span.text}: "
                f"{ignored if context.is_gazebo_sim else 'no force moves the link'}"
            )
            yield finding(link.kinematic, message, key="kinematic")


def _carrying_links(robot: Robot) -> set[str]:
    """Return the links of the base, the wheels, and those between them."""
    found = {*robot.tree.base}
    waiting = [link.scoped_name for link in robot.wheels]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += [tie.parent for tie in robot.tree.ties_above.get(name, ())]
    return found


_BASE = """<link name="base_link"><gravity>0</gravity></link>  <!-- ^ KIN016 -->
<plugin name="a" filename="acme"/>"""
_OBJECT = '<link name="box"><gravity>0</gravity></link>'
GOOD = [
    '<link name="mast"><gravity>1</gravity><kinematic>0</kinematic></link>',
    '<link name="mast"><gravity>true</gravity></link>',
    f'<sdf version="1.6"><model name="box">{_OBJECT}</model></sdf>',
]
_FIGURE = """<sdf version="1.6"><model name="figure">
<link name="hip"><gravity>0</gravity></link>  <!-- ^ KIN016 -->
<link name="leg"><gravity>0</gravity></link>
<joint name="knee" type="revolute"><parent>hip</parent><child>leg</child></joint>
</model></sdf>"""
BAD = [
    _FIGURE,
    f'<sdf version="1.6"><model name="acme_rover_sensor_config_1">{_BASE}</model></sdf>',
    """<link name="mast"><gravity>0</gravity></link>  <!-- ^ KIN016 -->
<joint name="foot" type="fixed"><parent>base_link</parent><child>mast</child></joint>""",
    '<link name="mast"><kinematic>true</kinematic></link>  <!-- ^ KIN016 -->',
]
