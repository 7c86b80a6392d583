"""A robot without `base_link`, or whose canonical link does not exist.

Tools for SubT, and most of ROS, use `base_link` as the robot's own frame: transforms, bridges of
sensors and the wheels' odometry start there. What is fixed to the world, such as a camera on a
wall, needs none.

Fix: name the link that carries the others `base_link`; let `canonical_link` name a link.
Source: SubT model submission, static transforms from `base_link`; REP 105; SDFormat 1.7,
model/@canonical_link.
"""

from checker.base.words import Suggestions
from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, misspelt, rule, unchecked


@rule("KIN011", "no-base-link", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context, *, base: str = "base_link") -> Findings:
    """Report a robot without base link, and a canonical link that does not exist.

    Options:
        base: Name that a link of the robot must have; not required if the profile names no Gazebo
            release.
    """
    # A static model is placed as a whole: no link of it needs to exist.
    if not robot.is_static:
        yield from _canonical(robot)
    # A file for no simulator may not be a robot, but a barrel.
    is_prop = (robot.is_prop or robot.is_fixture) and not context.is_subt
    if not context.release or not robot.links or base in robot.links_by_name or is_prop:
        return
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    top = next(
        (link for link in robot.links if link.scoped_name not in robot.tree.ties_above), None
    )
    hint = f"; the root link is {top.scoped_name!r}" if top is not None else ""
    yield finding(robot.name, f"{robot.name.value!r} has no link {base!r}{hint}")


def _canonical(robot: Robot) -> Findings:
    """Report canonical links, of the robot and of the models in it, that do not exist."""
    names = Suggestions(robot.links_by_name)
    nested = ((f"{model.scoped_name}::", model.element) for model in robot.models)
    for scope, element in (("", robot.element), *nested):
        canonical = element.attribute("canonical_link")
        if canonical is None or not canonical.value.strip():
            continue
        name = scope + canonical.value
        if name not in robot.links_by_name and not robot.may_be_included(name):
            message = f"canonical link {canonical.value!r} does not exist"
            yield misspelt(canonical, message, names, severity=Severity.ERROR)


def _model(link: str, attribute: str = "", mark: str = "") -> str:
    return f"""
<sdf version="1.7">
<model name="acme_rover_sensor_config_1"{attribute}>{mark}
<link name="{link}"/>
</model>
</sdf>
"""


def _fixture(kind: str, mark: str = "") -> dict[str, object]:
    """Return a camera that a joint connects to the world."""
    urdf = f"""<robot name="camera">{mark}
  <link name="world"/>
  <link name="lens"/>
  <joint name="mount" type="{kind}"><parent link="world"/><child link="lens"/></joint>
  <gazebo reference="lens"><sensor type="camera" name="eye"/></gazebo>
</robot>
"""
    return {"@urdf": True, "@profile": "urdf", "urdf/arm.urdf": urdf}


_MARK = "  <!-- ^ KIN011 -->"
GOOD = [
    {"@fragment": _model("barrel"), "@profile": "ros2"},
    _model("base_link"),
    _model("base_link", ' canonical_link="base_link"'),
    _model("base_link", ' canonical_link=""'),
    _fixture("fixed"),
]
BAD = [
    _model("chassis", mark=_MARK),
    _model("base_link", ' canonical_link="chassis"', _MARK),
    _fixture("continuous", _MARK),
]
