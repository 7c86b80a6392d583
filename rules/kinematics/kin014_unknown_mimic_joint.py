"""A joint that mimics an unknown joint, itself, or a joint that mimics it in turn.

There is no joint to follow: parsers refuse the model, or the joint, such as the finger of a
gripper, does not move. A multiplier of 0 also keeps it from moving, which is a warning. No accepted
package that we checked has this fault.

Fix: write the exact name of the leading joint, and the ratio of the motions as `multiplier`.
Source: URDF, joint/mimic; SDFormat 1.11, axis/mimic.
"""

from collections.abc import Iterator

from checker.base.words import Suggestions
from checker.model.components import Joint
from checker.model.robot import Robot
from checker.model.values import parse_number
from checker.rule import Concern, Finding, Findings, Severity, finding, misspelt, rule
from checker.source.text import Located


@rule("KIN014", "unknown-mimic-joint", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report mimic joints that follow an unknown joint or themselves."""
    suggestions = Suggestions(robot.joints_by_name)
    leaders: dict[str, tuple[Joint, Located[str]]] = {}
    for joint in robot.joints:
        for leader in joint.mimics:
            if joint.scope + leader.value not in robot.joints_by_name:
                phrase = f"mimics {leader.value!r}, which does not exist"
                yield misspelt(leader, f"joint {joint.name.value!r} {phrase}", suggestions)
            else:
                leaders.setdefault(joint.scoped_name, (joint, leader))
        yield from _zero_multiplier(joint)
    yield from _circles(leaders)


def _zero_multiplier(joint: Joint) -> Iterator[Finding]:
    """Report a multiplier of zero: an attribute in URDF, an element in SDF."""
    holders = (joint.element, *joint.element.all("axis"), *joint.element.all("axis2"))
    for mimic in (mimic for holder in holders for mimic in holder.all("mimic")):
        element = mimic.child("multiplier")
        written = element.text if element is not None else mimic.attribute("multiplier")
        if written is not None and parse_number(written.value) == 0.0:
            yield finding(
                written,
                f"joint {joint.name.value!r} mimics {mimic.get('joint')!r} with the multiplier 0: "
                "it does not move",
                severity=Severity.WARNING,
            )


def _circles(leaders: dict[str, tuple[Joint, Located[str]]]) -> Iterator[Finding]:
    """Yield a finding for each circle of joints that mimic one another."""
    done: set[str] = set()
    for start in leaders:
        path: dict[str, None] = {}
        at = start
        while at in leaders and at not in done and at not in path:
            path[at] = None
            joint, leader = leaders[at]
            at = joint.scope + leader.value
        done.update(path)
        if at in path:
            joint, leader = leaders[at]
            itself = "itself" if joint.scope + leader.value == at else "a joint that mimics it"
            yield finding(leader, f"joint {joint.name.value!r} mimics {itself}")


def _fingers(left: str, right: str = "") -> str:
    joints = "".join(
        f"""
<link name="{side}"/>
<joint name="{side}_joint" type="prismatic">
  <parent>base_link</parent>
  <child>{side}</child>
  <axis>
    <xyz>1 0 0</xyz>
    {mimic}
  </axis>
</joint>"""
        for side, mimic in (("left", left), ("right", right))
    )
    head = '<sdf version="1.11">\n<model name="acme_rover_sensor_config_1">\n'
    return f'{head}<link name="base_link"/>{joints}\n</model>\n</sdf>\n'


def _mimic(joint: str) -> str:
    return f'<mimic joint="{joint}" axis="axis"><multiplier>1</multiplier></mimic>'


_MARK = "  <!-- ^ KIN014 -->"
GOOD = [_fingers(""), _fingers(_mimic("right_joint"))]
BAD = [
    _fingers(_mimic("right_finger") + _MARK),
    _fingers(_mimic("left_joint") + _MARK),
    _fingers(_mimic("right_joint") + _MARK, _mimic("left_joint")),
    _fingers(_mimic("right_joint").replace(">1<", ">0<") + _MARK),
]
