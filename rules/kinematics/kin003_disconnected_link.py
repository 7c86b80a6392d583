"""A link that no joint connects to the robot.

The link falls off when the simulation starts, or is inside the robot and pushes it. No accepted
package that we checked has this fault.

Fix: add a joint between the robot and the link, usually `<joint type="fixed">`; or remove the link.
Source: SDFormat specification: links of a model move freely unless joints connect them.
"""

from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_NOTE = "the rest of the robot starts here"


@rule("KIN003", "disconnected-link", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report links, and groups of links, that no joint connects to the robot.

    Of a thing without joints, sensors and plugins, such as obstacles in one model, it is an info.
    """
    # KIN002 reports loops and joints that connect a link to itself; SDF010, nested models.
    loose = robot.loose_parts
    for group in loose.groups:
        if group.unclear is not None:
            name = group.unclear.name.value
            yield unchecked(f"it is not known which link joint {name!r} connects")
            return
        others = f" and the {len(group.links) - 1} below it" if len(group.links) > 1 else ""
        yield finding(
            robot.tree.links[group.top],
            f"no joint connects link {group.top!r}{others} to the robot",
            severity=Severity.INFO if robot.is_prop and not robot.joints else None,
            key="loose",
            related=[(robot.tree.links[loose.main], _NOTE)],
        )


GOOD = [
    """
<link name="mast"/>
<joint name="mast_joint" type="fixed"><parent>base_link</parent><child>mast</child></joint>
""",
    """
<link name="mast"/>
<joint name="foot" type="fixed"><parent>world</parent><child>mast</child></joint>
<joint name="base" type="fixed"><parent>world</parent><child>base_link</child></joint>
""",
    '<model name="arm"><link name="hand"/></model>',
]
BAD = [
    """
<link name="toolbox"/>  <!-- ^ KIN003 -->
""",
    """
<link name="arm"/>
<joint name="shoulder" type="fixed"><parent>base_link</parent><child>arm</child></joint>
<link name="lens"/>
<link name="camera"/>  <!-- ^ KIN003 -->
<joint name="ring" type="fixed"><parent>camera</parent><child>lens</child></joint>
<link name="hook"/>
<joint name="tip" type="fixed"><parent>arm</parent><child>hook</child></joint>
""",
]
