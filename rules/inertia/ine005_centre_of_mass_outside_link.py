"""A centre of mass outside the link's own shapes.

The link swings about a point outside itself, and the robot leans to one side. Usually the pose of
`<inertial>` refers to another frame, or is in millimetres. The centre of mass of a body cannot be
outside the box around it. But shapes may leave out a part, such as a nut at the end of a rod or the
battery above a skirt: among published robots, centres of mass up to 0.1 of the diagonal outside are
of this kind, and those from 0.2 on are wrong. A distance larger than the robot, such as `00064528`
for `0.0064528`, is an error for any link: joints have to hold the weight at that distance. Boxes,
balls and cylinders of up to 2 mm are placeholders, and do not count as shapes.

Fix: give the pose of `<inertial>` relative to the link's own frame, in metres; check that shapes
and inertia belong to the same part.
Source: definition of the centre of mass; SDFormat specification, inertial/pose.
"""

import math

from checker.model.geometry.boxes import Box
from checker.model.geometry.placed_shapes import union
from checker.physics.mass.even_inertia import centre_fix
from checker.physics.mass.link_geometry import known_box, unknown_mesh
from checker.physics.mass.mass_properties import MassProperties
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked


@rule("INE005", "centre-of-mass-outside-link", Severity.ERROR, Concern.ROBOT)
def check(
    masses: MassProperties,
    context: Context,
    *,
    error_above: float = 0.5,
    warning_above: float = 0.15,
    share: float = 0.02,
    shift: float = 0.05,
) -> Findings:
    """Report centres of mass outside the box around a link's shapes, relative to its diagonal.

    Options:
        error_above: Distance from the box as a share of its diagonal; a centre of mass that is
            farther outside is an error.
        warning_above: Distance from the box as a share of its diagonal; a centre of mass farther
            outside is a warning, a closer one is skipped.
        share: Share of the robot's mass; a link with no more may be a placeholder and is skipped,
            unless its centre of mass is farther away than the robot is large.
        shift: Share of the diagonal around the robot; a link is a warning if it moves the robot's
            centre of mass no farther. In a robot for SubT this holds for links of its base.
    """
    if masses.robot.is_static:
        return
    for reason in masses.robot.unknown_masses.values():
        yield unchecked(reason)
    boxes = {link.scoped_name: known_box(masses.robot, link) for link in masses.robot.links}
    whole = union(box for box in boxes.values() if box is not None)
    for name, inertia in masses.weighed.items():
        inertial, centre, box = inertia.link.inertial, inertia.centre, boxes[name]
        if inertial is None or centre is None or masses.robot.is_still(inertia.link):
            continue
        outside = math.inf if box is None else box.gap(Box(centre, centre))
        far = box is not None and whole is not None and outside > whole.diagonal
        if not far and not masses.share(name) > share:
            continue
        if box is not None and outside <= warning_above * box.diagonal:
            continue
        unknown = unknown_mesh(masses.robot, inertia.link)
        if unknown:
            yield unchecked(unknown)
        elif box is not None and box.diagonal > 0.0:
            of_base = name in masses.robot.tree.base or not context.is_subt
            moved = masses.share(name) * outside
            slight = of_base and whole is not None and moved <= shift * whole.diagonal
            harmless = slight or masses.robot.is_mounted(name)
            grave = far or (outside > error_above * box.diagonal and not harmless)
            yield finding(
                inertial.pose,
                f"the centre of mass of link {inertia.link.name.value!r} is {outside:.3g} m "
                f"outside its shapes, which measure {box.diagonal:.3g} m from corner to corner",
                severity=Severity.ERROR if grave else Severity.WARNING,
                fix=centre_fix(masses.robot, inertia.link),
            )


def _body(x: float, mark: str = "") -> str:
    return f"""
<inertial>
  <pose>{x} 0 0 0 0 0</pose>{mark}
  <mass>2</mass>
  <inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia>
</inertial>
<collision name="c"><geometry><box><size>0.6 0.4 0.2</size></box></geometry></collision>
"""


_MARK = "  <!-- ^ INE005 -->"
_FINGER = """
<link name="finger">
  <inertial>
    <origin xyz="{} 0 0"/>{}
    <mass value="0.001"/>
    <inertia ixx="1e-7" ixy="0" ixz="0" iyy="1e-7" iyz="0" izz="1e-7"/>
  </inertial>
  <collision><geometry><box size="0.02 0.01 0.01"/></geometry></collision>
</link>
<joint name="grip" type="fixed"><parent link="upper_arm"/><child link="finger"/></joint>
"""
_LAMP = f"""
<model name="lamp">
  <static>true</static>
  <link name="bulb">{_body(9)}</link>
</model>
"""
GOOD = [
    *map(_body, (0, 0.29, 0.31, 0.37)),
    _body(0.1).replace("0.6 0.4 0.2", "0.001 0.001 0.001"),
    {"@urdf": _FINGER.format("0.0064528", "")},
    _LAMP,
]
BAD = [
    _body(0.43, _MARK),
    _body(0.9, _MARK),
    {"@urdf": _FINGER.format("00064528", _MARK)},
]
