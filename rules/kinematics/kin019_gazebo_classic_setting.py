"""A setting of contacts, joints or links that Gazebo Sim does not read.

Gazebo Classic passed `<kp>`, `<kd>`, `<min_depth>` and `<max_vel>` to ODE. No physics engine of
Gazebo Sim reads them, nor `<physics><ode>` of a joint, nor `<self_collide>` of a link, which is a
setting of the model. Changing them has no effect.

Fix: remove them, or set what is read: friction, damping, and `<self_collide>` of the model.
Source: gz-physics, SDFFeatures.cc of each engine; gz-sim issue 1961 (`physics_engines.json`).
"""

from collections.abc import Iterator

from checker.base.resources import table
from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.xml import Element

_FALSE = ("0", "false")


@rule("KIN019", "gazebo-classic-setting", Severity.INFO, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report settings of one kind once, with the other places."""
    if not context.is_gazebo_sim or not robot.is_for_gazebo:
        return
    for kind, settings in table("physics_engines")["not_read"].items():
        found = list(_elements_at(robot, settings.get(robot.format, [])))
        if found:
            names = ", ".join(dict.fromkeys(f"<{element.tag}>" for element in found))
            yield finding(
                found[0],
                f"no physics engine of Gazebo Sim reads {names} of a {kind}: {settings['instead']}",
                related=[(element, "here too") for element in found[1:]],
                key=kind,
            )


def _elements_at(robot: Robot, paths: list[str]) -> Iterator[Element]:
    """Yield the elements at the paths, which start at `<model>` or `<robot>`."""
    for path in paths:
        for element in robot.element.at(path):
            holder = element.parent
            tagged = bool(robot.conventions.extension_tag)
            counts = not tagged or (holder is not None and holder.get("reference"))
            if counts and element.value.strip() not in _FALSE:
                yield element


def _arm(contact: str = "", joint: str = "", link: str = "") -> str:
    return f"""<link name="a">
{link}
<collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry>
<surface><friction><ode><mu>1</mu></ode></friction>{contact}</surface></collision>
</link>
<link name="b"/>
<joint name="j" type="revolute"><parent>a</parent><child>b</child>
<axis><xyz>0 0 1</xyz></axis>{joint}</joint>"""


def _example(profile: str, fragment: str) -> dict[str, str]:
    return {"@fragment": fragment, "@profile": profile}


def _spawned_example(inside: str) -> dict[str, object]:
    robot = f"""<robot name="rover">
  <link name="base_link"/>
  <gazebo reference="base_link">
    {inside}
  </gazebo>
</robot>
"""
    return {"@bridge": True, "@profile": "ros2", "urdf/rover.urdf": robot}


_MARK = "  <!-- ^ KIN019 -->"
_CONTACT = "<contact><ode>\n<kp>1e5</kp>@\n<kd>1</kd></ode></contact>"
_JOINT = "\n<physics><ode>\n<erp>0.2</erp>@\n</ode></physics>"
GOOD = [
    _example("gazebo-harmonic", _arm(link="<self_collide>false</self_collide>")),
    _example("gazebo-harmonic", "<self_collide>true</self_collide>" + _arm()),
    _example("gazebo-classic", _arm(_CONTACT.replace("@", ""))),
    _spawned_example("<mu1>0.5</mu1><selfCollide>0</selfCollide>"),
]
BAD = [
    _example("gazebo-harmonic", _arm(_CONTACT.replace("@", _MARK))),
    _example("gazebo-harmonic", _arm(joint=_JOINT.replace("@", _MARK))),
    _example("gazebo-fortress", _arm(link=f"<self_collide>true</self_collide>{_MARK}")),
    _spawned_example(f"<kp>1e6</kp>{_MARK}\n<minDepth>0.001</minDepth>"),
    _spawned_example(f"<selfCollide>true</selfCollide>{_MARK}"),
    _spawned_example(f"<implicitSpringDamper>1</implicitSpringDamper>{_MARK}"),
]
