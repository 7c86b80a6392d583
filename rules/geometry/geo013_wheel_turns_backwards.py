"""A wheel turns backwards, or left and right are swapped in the drive plugin.

A joint turns about its axis by the right-hand rule: wheels roll forward, to +x, if their axes point
to the left, to +y. With one axis reversed, the wheels work against each other. With all axes
reversed, the robot drives backwards when commanded forwards. With swapped sides it turns the wrong
way: where all are swapped and roll forward, no axis is wrong. If the names of the joints agree with
the lists, the joints are in the wrong places: hardware that maps joints by their names turns the
right way, so this is a warning where a controller drives them and nothing starts Gazebo. No
accepted package that we checked has this fault.

Wheels that are called left and right and that no plugin or controller lists are compared with their
places: what drives them relies on their names.

In ROS 1, `libgazebo_ros_diff_drive.so` takes `<leftJoint>` for the right wheel, unless it has
`<legacyMode>false</legacyMode>`.

Fix: reverse the joint's axis, or swap the left and the right joint of the drive. Where a macro
makes all wheels, turn the origin of the joint instead. Change the sign of y in the joints where
their names agree with the lists. In ROS 1 write `<legacyMode>false</legacyMode>`.
Source: REP 103: x forward, y left; Gazebo's DiffDrive drives forward with positive rates on both
sides; gazebo_ros_diff_drive.cpp: `legacyMode` is true by default.
"""

import re
from collections.abc import Iterator, Sequence

from checker.base.words import and_list
from checker.finding import Fix
from checker.formats.corrections import is_shared, rewrite
from checker.model.components import Joint
from checker.model.controllers import Controller
from checker.model.geometry.transform import Vector, dot
from checker.model.locomotion.locomotion import Side, Wheel, WheelDrive
from checker.model.locomotion.undriven import undriven_wheels
from checker.model.robot import Robot
from checker.package.package import Package
from checker.rule import (
    Concern,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    rename,
    rule,
    unchecked,
)
from checker.source.xml_insertion import append_to

_LEFT: Vector = (0.0, 1.0, 0.0)
_UP: Vector = (0.0, 0.0, 1.0)
_OPPOSED = -0.9
"""Cosine of the angle between two axes up to which they point against each other."""
_OPPOSITE = {"left": "right", "Left": "Right", "LEFT": "RIGHT"}
_LEFT_WORD = re.compile(r"(?<![A-Za-z])left(?![a-z])|(?<![A-Z])L(?:eft(?![a-z])|EFT(?![A-Z]))")
_RIGHT_WORD = re.compile(r"(?<![A-Za-z])right(?![a-z])|(?<![A-Z])R(?:ight(?![a-z])|IGHT(?![A-Z]))")
_ENDS = ("front", "rear")
_MODERN = "<legacyMode>false</legacyMode>"


@rule("GEO013", "wheel-turns-backwards", Severity.ERROR, Concern.ROBOT)
def check(
    robot: Robot, package: Package, *, least_cosine: float = 0.5, least_share: float = 0.25
) -> Findings:
    """Report axes that point the wrong way, and wheels that are not on the side of their entry.

    If no plugin drives the robot, links that are called wheels and turn without end are checked
    against the others of their side: a warning where one turns against them, or where a wheel that
    is called left is right of its counterpart.

    Options:
        least_cosine: Cosine of the angle to the wrong direction from which a wheel's axis is an
            error, and of the angle to straight up below which a steering axis is an error.
        least_share: Share of half the distance of the outermost wheels; a wheel closer to the
            middle is never on the wrong side.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    for drive in robot.locomotion.wheel_drives:
        left = _left_of(drive, least_cosine)
        turned = [*_reversed_axes(robot, drive, left, least_cosine)]
        swapped = [*_swapped_sides(drive, left, least_share)]
        if turned and len(turned) == len(swapped) == len(drive.wheels):
            yield _faces_backwards(drive)
        elif swapped and len(swapped) == len(drive.wheels) and _rolls_forward(drive, least_cosine):
            yield from _swapped(drive, in_gazebo=package.workspace.may_start_gazebo)
        else:
            yield from (*turned, *swapped)
        yield from _on_both_sides(drive)
        yield from _steering_findings(robot, drive, least_cosine)
    yield from _against_its_side(robot, least_cosine, least_share)
    # A wheel that follows another one is on the side of its place.
    listed = {
        wheel.joint
        for drive in robot.locomotion.drives
        for wheel in drive.wheels
        if wheel.name.span.source is drive.plugin.span.source
    }
    unlisted = [wheel for wheel in undriven_wheels(robot) if wheel.joint not in listed]
    yield from _misnamed_wheels(unlisted)


def _steering_findings(robot: Robot, drive: WheelDrive, least_cosine: float) -> Iterator[Finding]:
    places = {joint: robot.pose_of_joint(joint) for joint, _ in drive.steering}
    across = {joint: pose.translation[1] for joint, pose in places.items() if pose is not None}
    middle = (min(across.values()) + max(across.values())) / 2 if across else 0.0
    for joint, side in drive.steering:
        name = joint.name.value
        axis = robot.axis_in_model(joint, joint.axes[0]) if joint.axes else None
        upwards = 1.0 if axis is None else dot(axis, _UP)
        if upwards < least_cosine:
            down = "points down, so it steers to the other side: expected 0 0 1"
            lies = "does not point up, so it tilts its wheel: expected 0 0 1"
            yield finding(
                joint.axes[0].xyz[0],
                f"axis {_axis_text(joint)} of steering joint {name!r} "
                f"{down if upwards <= -least_cosine else lies}",
                key=f"steering {upwards <= -least_cosine}",
            )
        is_on = Side.LEFT if across.get(joint, middle) > middle else Side.RIGHT
        if across.get(joint, middle) != middle and is_on is not side:
            yield finding(
                drive.plugin,
                f"{drive.plugin.label} lists steering joint {name!r} as {side}, but it is on "
                f"the {is_on}",
                key=f"{drive.path} steering",
                related=[(joint, "the joint")],
            )


def _left_of(drive: WheelDrive, least_cosine: float) -> Vector:
    """Return the direction of left: +y, or the direction of most axes if wheels turn otherwise."""
    axes = [wheel.forward_axis for wheel in drive.wheels if wheel.forward_axis is not None]
    if not axes or any(abs(dot(axis, _LEFT)) >= least_cosine for axis in axes):
        return _LEFT
    first = axes[0]
    backwards = sum(dot(axis, first) < 0 for axis in axes)
    return first if backwards * 2 <= len(axes) else (-first[0], -first[1], -first[2])


def _reversed_axes(
    robot: Robot, drive: WheelDrive, left: Vector, least_cosine: float
) -> Iterator[Finding]:
    known = [wheel for wheel in drive.wheels if wheel.forward_axis is not None]
    wrong = [w for w in known if w.forward_axis and dot(w.forward_axis, left) <= -least_cosine]
    every = len(wrong) == len(known) > 1
    joints: dict[Joint, Wheel] = {wheel.joint: wheel for wheel in wrong}
    for joint in joints:
        what = (
            "like all others: the robot drives backwards"
            if every
            else "so the other wheels turn against it"
        )
        yield finding(
            joint.axes[0].xyz[0],
            f"axis {_axis_text(joint)} of wheel joint {joint.name.value!r} points to the right, "
            f"{what}",
            key="all" if every else "",
            fix=_turned_round(robot, joint),
        )


def _faces_backwards(drive: WheelDrive) -> Finding:
    """Report a drive whose wheels are all on the other side and all turn the other way."""
    return finding(
        drive.plugin,
        f"{drive.plugin.label} drives towards -x: all of its axes point to the right, and all of "
        "its wheels are on the other side than it lists: swap left and right, and turn the axes",
        key=f"{drive.path} backwards",
        related=[(wheel.joint, "this joint") for wheel in drive.wheels],
    )


def _rolls_forward(drive: WheelDrive, least_cosine: float) -> bool:
    """Return whether all axes point to +y, so that only the names are in the wrong places.

    Of a robot that faces elsewhere the axes may be wrong, and where `<legacyMode>` swaps the sides,
    that tag may be what is missing.
    """
    axes = [wheel.forward_axis for wheel in drive.wheels]
    return not drive.swaps and all(axis and dot(axis, _LEFT) >= least_cosine for axis in axes)


def _swapped(drive: WheelDrive, *, in_gazebo: bool) -> Iterator[Finding]:
    """Report a drive whose wheels are all on the other side than it lists, in each of its lists."""
    if all(_is_named_for_its_side(wheel) for wheel in drive.wheels):
        yield _misplaced(drive, in_gazebo=in_gazebo)
        return
    sides = {side: [w.name for w in drive.wheels if w.side is side] for side in Side}
    pairs = zip(sides[Side.LEFT], sides[Side.RIGHT], strict=False)
    fixes = [
        rename(here, there.value)
        for left, right in pairs
        for here, there in ((left, right), (right, left))
    ]
    edits = [edit for fix in fixes if fix is not None for edit in fix.edits]
    left, right = (and_list([name.value for name in sides[side]]) for side in Side)
    fix = Fix(Safety.UNSAFE, tuple(edits)) if len(edits) == len(drive.wheels) else None
    for wheel in drive.wheels:
        yield finding(
            wheel.name,
            f"{drive.plugin.label} lists {left} as left and {right} as right, but each is on the "
            "other side, and the robot turns the wrong way: swap the left and the right joints",
            key=f"{drive.path} swapped",
            related=[(wheel.joint, "the joint")],
            fix=fix if wheel is drive.wheels[0] else None,
        )


def _is_named_for_its_side(wheel: Wheel) -> bool:
    word = _LEFT_WORD if wheel.side is Side.LEFT else _RIGHT_WORD
    return word.search(wheel.name.value) is not None


def _misplaced(drive: WheelDrive, *, in_gazebo: bool) -> Finding:
    """Report wheels that are listed by their names, and whose joints have y of the wrong sign.

    Hardware maps the joints by their names: it turns the right way, and would not if the lists
    were swapped.
    """
    placed = [(wheel, wheel.centre[1]) for wheel in drive.wheels if wheel.centre is not None]
    where = and_list([f"{wheel.name.value} is at y = {y:.3g} m" for wheel, y in placed])
    is_of_hardware = isinstance(drive.plugin, Controller) and not in_gazebo
    return finding(
        drive.wheels[0].joint,
        f"{where}, so left and right are swapped, and the robot turns the wrong way in a "
        "simulation: change the sign of y in the <origin> of these joints",
        severity=Severity.WARNING if is_of_hardware else None,
        key=f"{drive.path} swapped",
        related=[
            (drive.wheels[0].name, f"{drive.plugin.label} lists them as their names say"),
            *((wheel.joint, "this joint") for wheel, _ in placed[1:]),
        ],
    )


def _turned_round(robot: Robot, joint: Joint) -> Fix | None:
    """Return the fix that turns an axis round, unless a macro gives it to other joints too."""
    own = joint.axes[0].xyz[0].span
    spans = [axis.xyz[0].span for other in robot.joints for axis in other.axes]
    if sum(is_shared(own, span) for span in spans) > 1:
        return None
    return rewrite([(number, -number.value) for number in joint.axes[0].xyz])


def _against_its_side(robot: Robot, least_cosine: float, least_share: float) -> Iterator[Finding]:
    """Report wheels that no plugin drives and that turn against most others of their side.

    Which way the axis of a caster or of a swerve drive points states nothing.
    """
    offsets = {
        wheel: abs(wheel.centre[1])
        for wheel in robot.locomotion.undriven
        if wheel.centre is not None
    }
    nearest = least_share * max(offsets.values(), default=0.0)
    for side in Side:
        along = [
            (dot(wheel.axis, _LEFT), wheel)
            for wheel, offset in offsets.items()
            if wheel.side is side and wheel.axis is not None
            if wheel.steering is None and offset > nearest
        ]
        leftward = [wheel for cosine, wheel in along if cosine >= least_cosine]
        rightward = [wheel for cosine, wheel in along if cosine <= -least_cosine]
        fewer, more = sorted((rightward, leftward), key=len)
        # The axes of three omnidirectional wheels point to the middle, none against another.
        opposed = [w for w in fewer if w.axis and dot(w.axis, more[0].axis or _UP) <= _OPPOSED]
        for wheel in opposed:
            yield finding(
                wheel.joint.axes[0].xyz[0],
                f"axis {_axis_text(wheel.joint)} of wheel joint {wheel.joint.name.value!r} points "
                f"against that of {more[0].joint.name.value!r} on the same side: expected one "
                "direction for all",
                severity=Severity.WARNING,
                related=[(more[0].joint, "the other joint")],
                fix=_turned_round(robot, wheel.joint),
            )


def _misnamed_wheels(wheels: Sequence[Wheel]) -> Iterator[Finding]:
    """Report wheels called left and right that are on the other sides.

    Where those called front are behind those called rear, the robot faces the other way.
    """
    places = {wheel.link.scoped_name: wheel.centre for wheel in wheels if wheel.centre is not None}
    front, rear = ([at[0] for name, at in places.items() if end in name] for end in _ENDS)
    if front and rear and min(front) < max(rear):
        return
    for wheel in wheels:
        name = wheel.link.scoped_name
        other = _LEFT_WORD.sub(lambda word: _OPPOSITE[word.group()], name)
        if other == name or name not in places or other not in places:
            continue
        here, there = places[name], places[other]
        if there[1] - here[1] > abs(there[0] - here[0]):
            yield finding(
                wheel.joint,
                f"wheel {name!r} is at y = {here[1]:.3g} m, right of {other!r} at "
                f"{there[1]:.3g} m: expected +y for the left side",
                severity=Severity.WARNING,
                related=[
                    (it.joint, "the other wheel") for it in wheels if it.link.scoped_name == other
                ],
            )


def _swapped_sides(drive: WheelDrive, left: Vector, least_share: float) -> Iterator[Finding]:
    placed = [(dot(w.centre, left), w) for w in drive.wheels if w.centre is not None]
    if len({wheel.side for _, wheel in placed}) < 2:
        return
    lowest, highest = min(at for at, _ in placed), max(at for at, _ in placed)
    middle, half = (lowest + highest) / 2, (highest - lowest) / 2
    for at, wheel in placed:
        side = Side.LEFT if at > middle else Side.RIGHT
        if side is not wheel.side and abs(at - middle) > least_share * half > 0:
            how, cure = f"lists {wheel.name.value!r} as {wheel.side}", ""
            if drive.swaps:
                how = f"takes {wheel.name.value!r} for {wheel.side}, unless <legacyMode> is false"
                cure = f": write {_MODERN}"
            yield finding(
                wheel.name,
                f"{drive.plugin.label} {how}, but its wheel is {abs(at - middle):.3g} m {side} of "
                f"the middle{cure}",
                key=f"{drive.path} {wheel.side}",
                related=[(wheel.joint, "the joint")],
                fix=_made_modern(drive) if drive.swaps else None,
            )


def _made_modern(drive: WheelDrive) -> Fix | None:
    """Return the fix that has a plugin of ROS 1 take the left joint for left, if nothing does."""
    plugin = drive.plugin
    if isinstance(plugin, Controller) or plugin.element.child("legacyMode") is not None:
        return None
    return Fix(Safety.UNSAFE, (append_to(plugin.element, [_MODERN]),))


def _on_both_sides(drive: WheelDrive) -> Iterator[Finding]:
    sides: dict[str, Side] = {}
    for wheel in drive.wheels:
        if sides.setdefault(wheel.joint.scoped_name, wheel.side) is not wheel.side:
            yield finding(
                wheel.name,
                f"{drive.plugin.label} lists {wheel.name.value!r} as left and as right",
                key=f"{drive.path} both",
                related=[(wheel.joint, "the joint")],
            )


def _axis_text(joint: Joint) -> str:
    xyz = joint.axes[0].xyz
    default = "" if xyz[0].stated else " (the default, as none is stated)"
    return " ".join(f"{number.value:g}" for number in xyz) + default


def _rover(left: str, right: str, plugin: str = "", steering: str = "") -> str:
    plugin = plugin or "<left_joint>left_axle</left_joint><right_joint>right_axle</right_joint>"
    return f"""
{_wheel("left", 0.2, left)}
{_wheel("right", -0.2, right)}
{steering}
<plugin filename="libp.so" name="ignition::gazebo::systems::AckermannSteering">
  {plugin}
  <left_steering_joint>kingpin</left_steering_joint>
</plugin>
"""


def _wheel(name: str, y: float, axis: str) -> str:
    return f"""
<link name="{name}"><pose>0 {y} 0 0.3 0 0</pose></link>
<joint name="{name}_axle" type="revolute">
  <pose>0 0 0 -0.3 0 0</pose>
  <parent>base_link</parent>
  <child>{name}</child>
  <axis>
    <xyz>{axis}
  </axis>
</joint>
"""


def _kingpin(axis: str) -> str:
    return f"""
<link name="knuckle"/>
<joint name="kingpin" type="revolute">
  <parent>base_link</parent>
  <child>knuckle</child>
  <axis>
    <xyz>{axis}
  </axis>
</joint>
"""


def _urdf(front: str, rear: str, drive: str = "", right: str = '0 1 0"/>') -> dict[str, str]:
    """Return a robot with two wheels on the left and two on the right."""
    ends = (("front", 0.3, front), ("rear", -0.3, rear))
    wheels = [_urdf_wheel(f"{end}_left", f"{x} 0.2 0", axis) for end, x, axis in ends]
    wheels += [_urdf_wheel(f"{end}_right", f"{x} -0.2 0", right) for end, x, _ in ends]
    return {"@urdf": f"{''.join(wheels)}<gazebo>{drive}</gazebo>"}


def _pair(left: str, right: str, mark: str = "") -> dict[str, str]:
    """Return a robot whose two wheels no plugin drives."""
    wheels = (("left", left), ("right", right))
    text = "".join(_urdf_wheel(name, f"0 {y} 0", _Y) for name, y in wheels)
    return {"@urdf": text.replace('"continuous">', f'"continuous">{mark}', 1)}


def _mirrored() -> dict[str, str]:
    """Return a robot whose drive lists joints as they are called, on the wrong sides."""
    wheels = _urdf_wheel("left", "0 -0.2 0", _Y) + _urdf_wheel("right", "0 0.2 0", _Y)
    wheels = wheels.replace('"continuous">', f'"continuous">{_MARK}', 1)
    drive = _classic(_DIFF, "left_joint=left right_joint=right")
    return {"@urdf": f"{wheels}<gazebo>{drive}</gazebo>"}


def _urdf_wheel(name: str, at: str, axis: str) -> str:
    return f"""
<link name="{name}_wheel"/>
<joint name="{name}" type="continuous">
  <origin xyz="{at}"/>
  <parent link="base_link"/>
  <child link="{name}_wheel"/>
  <axis xyz="{axis}
</joint>
"""


def _classic(library: str, names: str, more: str = "") -> str:
    """Return a plugin of Gazebo Classic with tags, each followed by the joint that it names."""
    pairs = (pair.partition("=") for pair in names.split())
    joints = "".join(f"<{tag}>{joint}</{tag}>\n" for tag, _, joint in pairs)
    return f'<plugin name="drive" filename="{library}">\n{joints}{more}</plugin>'


_DIFF, _SKID = "libgazebo_ros_diff_drive.so", "libgazebo_ros_skid_steer_drive.so"
_STRAIGHT = "leftJoint=front_left rightJoint=front_right"
_CROSSED = "leftJoint=front_right rightJoint=front_left"
_ROS_2 = "left_joint=front_left right_joint=front_right"
_FOUR = (
    "leftFrontJoint=front_left rightFrontJoint=front_right leftRearJoint=rear_left "
    "rightRearJoint=rear_right"
)
_Y, _BACK = '0 1 0"/>', '0 -1 0"/>'


def _marked(drive: str) -> str:
    """Mark the first two lines of a plugin that name joints."""
    return drive.replace("oint>\n", f"oint>{_MARK}\n", 2)


def _omni(*wheels: tuple[str, str]) -> dict[str, str]:
    """Return a robot with omnidirectional wheels, whose axes point to its middle."""
    named = zip(("first", "second", "third"), wheels, strict=True)
    return {"@urdf": "".join(_urdf_wheel(name, at, axis) for name, (at, axis) in named)}


_END = "</xyz>"
_MARK = "  <!-- ^ GEO013 -->"
_LEFTWARD, _RIGHTWARD = f"0 1 0{_END}", f"0 -1 0{_END}"
GOOD = [
    _rover(_LEFTWARD, _LEFTWARD, steering=_kingpin(f"0 0 1{_END}")),
    _rover(f"1 0 0{_END}", f"1 0 0{_END}"),
    _rover(_RIGHTWARD, "0 1 0</xyz>", "<topic>/cmd_vel</topic>"),
    _urdf(_Y, _Y, _classic(_DIFF, _STRAIGHT, _MODERN)),
    _urdf(_Y, _Y, _classic(_DIFF, _CROSSED)),
    _urdf(_Y, _Y, _classic(_DIFF, _ROS_2)),
    _urdf(_Y, _Y, _classic(_SKID, _FOUR)),
    # Without a plugin, the two sides may turn against each other.
    _urdf(_Y, _Y),
    _urdf(_Y, _Y, right=_BACK),
    _pair("0.2", "-0.2"),
    _omni(
        ("0 -0.2 0", '0 -1 0"/>'),
        ("0.17 -0.4 0", '-0.866 0.5 0"/>'),
        ("-0.17 -0.4 0", '0.866 0.5 0"/>'),
    ),
]
BAD = [
    _rover(_LEFTWARD, f"{_RIGHTWARD}{_MARK}"),
    _rover(f"{_RIGHTWARD}{_MARK}", f"{_RIGHTWARD}{_MARK}"),
    _rover(_LEFTWARD, _LEFTWARD, steering=_kingpin(f"0 0 -1{_END}{_MARK}")),
    _rover(_LEFTWARD, _LEFTWARD, steering=_kingpin(f"1 0 0{_END}{_MARK}")),
    _rover(
        _LEFTWARD,
        _LEFTWARD,
        f"""<left_joint>right_axle</left_joint>{_MARK}
  <right_joint>left_axle</right_joint>{_MARK}""",
    ),
    _rover(
        _LEFTWARD,
        _LEFTWARD,
        f"""<left_joint>left_axle</left_joint>
  <right_joint>left_axle</right_joint>{_MARK}""",
    ),
    _urdf(_Y, _Y, _marked(_classic(_DIFF, _CROSSED, _MODERN))),
    _urdf(_Y, _Y, _marked(_classic(_DIFF, _STRAIGHT))),
    _urdf(
        _BACK,
        _BACK,
        _classic(_DIFF, _CROSSED, _MODERN).replace('.so">', f'.so">{_MARK}'),
        right=_BACK,
    ),
    _urdf(_BACK + _MARK, _Y, _classic(_DIFF, _ROS_2)),
    _urdf(_Y, _BACK + _MARK, _classic(_SKID, _FOUR)),
    _urdf(_Y, _BACK + _MARK),
    _pair("-0.2", "0.2", _MARK),
    _mirrored(),
]
