"""The cylinder of a wheel does not turn about the wheel's axis.

The wheel tumbles like a coin instead of rolling. A cylinder's axis is its own z axis until a pose
turns it, and that pose is missing or turns it about the wrong axis. No accepted package that we
checked has this fault.

A URDF joint without `<axis>` turns about its x axis. Of a wheel that has no collision at all, the
one visual cylinder is compared, with a warning: the wheel is drawn across its axle.

Fix: turn the collision, usually with a `<pose>` of `0 0 0 1.5707963267948966 0 0`, in URDF with an
`<origin rpy="1.5707963267948966 0 0"/>`; or correct the `<axis>` of the joint.
Source: Model Migration Guide, step 3: orientations of the wheel collisions; the axis of a cylinder
is z in SDF and URDF; URDF specification, joint: "axis" is (1,0,0) by default.
"""

import math

from checker.finding import Fix
from checker.formats.corrections import along_z, reposed, rewrite
from checker.model.components import Joint
from checker.model.geometry.placed_shapes import Placed, place_shapes
from checker.model.geometry.transform import Transform, Vector
from checker.model.locomotion.locomotion import Wheel
from checker.model.locomotion.wheels import angle_to_axle, tread
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, rule
from checker.source.text import Located
from checker.source.xml_insertion import append_to

_ACROSS = 0.9
"""Share of a shape's axis across the robot from which the joint's axis is the wrong one."""

_STRAIGHT = 0.9998
"""Largest part of a direction, of length 1, within about a degree of x, y or z."""


@rule("GEO003", "misaligned-wheel-collision", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, *, degrees: float = 1.0) -> Findings:
    """Report driven wheels whose largest collision is round about another axis than the joint's.

    If no plugin drives the robot, links that are called wheels and turn without end are checked;
    then it is a warning. GEO001 reports angles that only have too few digits.

    Options:
        degrees: Degrees between the axis of a wheel's largest collision and that of its joint; more
            is an error.
    """
    moved = robot.locomotion
    judged = [(wheel, Severity.ERROR) for wheel in moved.wheels]
    judged += [(wheel, Severity.WARNING) for wheel in moved.undriven]
    for wheel, most in judged:
        touching = tread(robot, wheel)
        rolls = touching or _drawn(robot, wheel)
        severity = most if touching is not None else Severity.WARNING
        angle = angle_to_axle(wheel, rolls) if rolls is not None else None
        if rolls is None or angle is None or math.degrees(angle) <= degrees:
            continue
        if (along := _axle(robot, wheel, rolls)) is not None:
            yield _wrong_axis(robot, wheel, rolls, along, severity)
            continue
        yield finding(
            rolls.shape.pose,
            f"{rolls.shape.geometry.shape} {rolls.shape.name.value!r} of wheel "
            f"{wheel.link.name.value!r} is {math.degrees(angle):.3g}° off the axis of joint "
            f"{wheel.joint.name.value!r}, expected 0°",
            severity=severity,
            related=[(wheel.joint, "the joint")],
            fix=_aligned(robot, wheel, rolls),
        )


def _drawn(robot: Robot, wheel: Wheel) -> Placed | None:
    """Return the disc that is all there is of a wheel without collisions; else None."""
    visuals = [visual for link in wheel.body for visual in link.visuals]
    if len(visuals) != 1 or any(link.collisions for link in wheel.body):
        return None
    shape = visuals[0].geometry
    radius, length = ([it.value for it in shape.sizes.get(n, ())] for n in ("radius", "length"))
    if shape.shape != "cylinder" or not radius or not length or length[0] >= 2 * radius[0]:
        return None
    placed = (it for link in wheel.body for it in place_shapes(robot, link, link.visuals))
    return next(placed, None)


def _axle(robot: Robot, wheel: Wheel, rolls: Placed) -> Vector | None:
    """Return the axis that the joint needs, in its own frame; None if the shape is to be turned.

    The shape shows the axis where it alone lies across the robot, or where the joint states none.
    """
    along, joint = rolls.pose.rotate((0.0, 0.0, 1.0)), robot.pose_of_joint(wheel.joint)
    axis = wheel.joint.axes[0]
    if robot.conventions.has_default_axis and not axis.xyz[0].stated:
        return _line(joint.inverse.rotate(along) if joint is not None else along)
    lies_across = wheel.axis is not None and abs(along[1]) > _ACROSS > abs(wheel.axis[1])
    if lies_across and joint is not None and not axis.expressed_in:
        return _line(joint.inverse.rotate(along))
    return None


def _aligned(robot: Robot, wheel: Wheel, rolls: Placed) -> Fix | None:
    """Return the fix that turns the shape."""
    frame, shape = robot.pose_of(wheel.link.scoped_name), rolls.shape
    if frame is None or wheel.axis is None or shape.pose.relative_to:
        return None
    turn = along_z(frame.inverse.rotate(wheel.axis))
    new = Transform(turn.rotation, shape.pose.transform.translation)
    return reposed(robot, shape, new)


def _line(along: Vector) -> Vector:
    """Return the usual direction of a line: the positive one, without what rounding left."""
    main = max(along, key=abs)
    digits = 0 if abs(main) > _STRAIGHT else 4
    x, y, z = (round(math.copysign(1.0, main) * number, digits) + 0.0 for number in along)
    return x, y, z


def _wrong_axis(
    robot: Robot, wheel: Wheel, rolls: Placed, along: Vector, severity: Severity
) -> Finding:
    """Report a joint whose axis is not that of the shape, and the axis that its wheel needs."""
    joint, shape, axis = wheel.joint, rolls.shape, wheel.joint.axes[0]
    needed = " ".join(f"{number:g}" for number in along)
    element = f'<axis xyz="{needed}"/>' if robot.conventions.is_urdf else f"<xyz>{needed}</xyz>"
    if robot.conventions.has_default_axis and not axis.xyz[0].stated:
        place: Joint | Located[float] = joint
        turns = "has no <axis>, so it turns about x, URDF's default"
        fix: Fix | None = Fix(Safety.UNSAFE, (append_to(joint.element, [element]),))
    else:
        place = axis.xyz[0]
        fix = rewrite(zip(axis.xyz, along, strict=True))
        turns = f"turns about {' '.join(f'{number.value:g}' for number in axis.xyz)}"
    return finding(
        place,
        f"joint {joint.name.value!r} {turns}, across the {shape.geometry.shape} of wheel "
        f"{wheel.link.name.value!r}: expected {element}",
        severity=severity,
        related=[(shape.pose, f"the {shape.geometry.shape}"), (joint, "the joint")],
        fix=fix,
    )


def _wheel(collision: str, xyz: str = "0 1 0") -> str:
    return f"""
<link name="wheel">
  <pose>0 0.3 0 0 0 0.5</pose>
  {collision}
</link>
<joint name="axle" type="revolute">
  <parent>base_link</parent>
  <child>wheel</child>
  <axis><xyz>{xyz}</xyz></axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>axle</left_joint>
</plugin>
"""


def _cylinder(pose: str, radius: float = 0.1) -> str:
    return f"""
<collision name="c{radius}">{pose}
  <geometry><cylinder><radius>{radius}</radius><length>0.05</length></cylinder></geometry>
</collision>
"""


def _urdf(
    origin: str,
    plugin: str = "",
    kind: str = "continuous",
    axis: str = '<axis xyz="0 1 0"/>',
    mark: str = "",
    part: str = "collision",
) -> dict[str, str]:
    wheel = f"""
<link name="left_wheel">
  <{part}>
    {origin}
    <geometry><cylinder radius="0.1" length="0.05"/></geometry>
  </{part}>
</link>
<joint name="left_axle" type="{kind}">{mark}
  <origin xyz="0 0.3 0"/>
  <parent link="base_link"/>
  <child link="left_wheel"/>
  {axis}
</joint>
<gazebo>{plugin}</gazebo>
"""
    return {"@urdf": wheel}


_CLASSIC = """
<plugin name="drive" filename="libgazebo_ros_diff_drive.so">
  <leftJoint>left_axle</leftJoint>
</plugin>
"""
_LYING = '<origin rpy="1.5707963267948966 0 0"/>'
_TURNED = "<pose>0 0 0 1.5707963267948966 0 0</pose>"
GOOD = [
    _wheel(_cylinder(_TURNED)),
    _wheel(_cylinder("<pose>0 0 0 -1.5708 0 0</pose>")),
    _wheel(_cylinder(""), "0 0 1"),
    _wheel(_cylinder(_TURNED) + _cylinder("", 0.02)),
    _wheel("<collision name='c'><geometry><sphere/></geometry></collision>"),
    _urdf(_LYING),
    _urdf(_LYING, _CLASSIC),
    _urdf(_LYING, part="visual"),
    # URDF's default axis is x.
    _urdf('<origin rpy="0 1.5707963267948966 0"/>', axis=""),
    # No wheel that rolls.
    _urdf("<origin/>", kind="fixed"),
]
BAD = [
    _wheel(_cylinder("\n<pose>0 0 0 0 1.5707963267948966 0</pose>  <!-- ^ GEO003 -->")),
    _wheel(_cylinder("  <!-- ^ GEO003 -->")),
    _wheel(_cylinder("\n<pose>0 0 0 1.5 0 0</pose>  <!-- ^ GEO003 -->")),
    _urdf("<origin/>  <!-- ^ GEO003 -->"),
    _urdf(_LYING, axis="", mark="  <!-- ^ GEO003 -->"),
    _urdf('<origin rpy="1.5 0 0"/>  <!-- ^ GEO003 -->', _CLASSIC),
    _urdf(_LYING, axis='<axis xyz="1 0 0"/>  <!-- ^ GEO003 -->', part="visual"),
    _urdf(_LYING, _CLASSIC, axis='<axis xyz="0 0 1"/>  <!-- ^ GEO003 -->'),
]
