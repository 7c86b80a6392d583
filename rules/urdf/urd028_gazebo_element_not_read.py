"""An element in the `gazebo` tag of a link or joint that Gazebo does not read there.

The element has no effect, and Gazebo prints no message. Below `<gazebo reference="wheel">`, what is
not one of the elements for links is copied into the `<link>` of the SDF. `<surface>`, `<friction>`
and `<mu>` are not read there: the wheel keeps the default friction of 1, and the rollers of a
mecanum wheel do not slip.

Fix: write the element that the message names, such as `<mu1>` and `<mu2>` for friction, or remove
the one that nothing reads.
Source: sdformat, parser_urdf.cc, and SDFormat specification, link and joint; conversions of such
tags by libsdformat 12.
"""

from collections.abc import Iterator, Mapping
from functools import cache

from checker.base.words import Suggestions
from checker.formats.sdf.schema import sdf_root
from checker.formats.urdf.description import GazeboTag, UrdfDescription
from checker.formats.urdf.extensions import OF_JOINTS, OF_LINKS
from checker.model.robot import Robot
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule

_ADVICE: Mapping[str, str] = {
    "surface": "put it into a <collision> there, or write <mu1> and <mu2>",
    "friction": "write <mu1> and <mu2>",
    "mu": "write <mu1>",
    "static": "a <gazebo> without reference makes the whole model static",
    "damping": "write <dynamics damping=…/> in the joint",
    "initial_position": "give it to the controller, or to the hardware of ros2_control",
}
_WORLD = "world"
_VERSION = "1.7"
"""The version of SDF where none is stated; the content of a link has hardly changed."""


@rule("URD028", "gazebo-element-not-read", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription, context: Context) -> Findings:
    """Report elements that neither URDF's extensions nor SDF know at that place."""
    if description.for_rviz:
        return
    version = context.sdf_version or _VERSION
    for tag in description.gazebo:
        yield from _unread(tag, description.robot, version)


def _unread(tag: GazeboTag, robot: Robot, version: str) -> Iterator[Finding]:
    name = tag.reference.value
    is_link = name in robot.links_by_name
    if not name or is_link == (name in robot.joints_by_name):
        return
    kind = "link" if is_link else "joint"
    known = _known_elements(kind, version)
    checked_elsewhere = OF_LINKS | OF_JOINTS | {"plugin"}
    for child in tag.element.children:
        if child.tag in known or child.tag in checked_elsewhere or ":" in child.tag:
            continue
        advice = _ADVICE.get(child.tag, "")
        if child.tag == "static" and _WORLD in robot.links_by_name:
            advice = f"remove it: the link {_WORLD} holds the robot"
        hint = f": {advice}" if advice else Suggestions(sorted(known)).hint(child.tag)
        yield finding(
            child,
            f"Gazebo does not read <{child.tag}> in the <gazebo> tag of {kind} {name!r}{hint}",
            key=f"{kind}/{child.tag}",
        )


@cache
def _known_elements(kind: str, version: str) -> frozenset[str]:
    """Return the elements that a tag for a link or joint may hold."""
    of_sdf = sdf_root(version).children["model"].children[kind].children
    return frozenset(of_sdf) | (OF_LINKS if kind == "link" else OF_JOINTS)


def _tag(inside: str, reference: str = "upper_arm") -> dict[str, str]:
    return {"@urdf": f'<gazebo reference="{reference}">\n{inside}\n</gazebo>'}


_MARK = "  <!-- ^ URD028 -->"
_SURFACE = "<surface><friction><ode><mu>1</mu></ode></friction></surface>"
GOOD = [
    _tag("<mu1>1</mu1><mu2>1</mu2><kp>1e6</kp><enable_wind>true</enable_wind>"),
    _tag(f"<collision>{_SURFACE}</collision>"),
    _tag("<axis><dynamics><damping>1</damping></dynamics></axis>", "shoulder"),
    {"@urdf": "<gazebo><static>true</static></gazebo>"},
]
BAD = [
    _tag(f"{_SURFACE}{_MARK}"),
    _tag(f"<mu>0.5</mu>{_MARK}"),
    _tag(f"<static>true</static>{_MARK}"),
    _tag(f"<springStiffnes>3</springStiffnes>{_MARK}", "shoulder"),
]
