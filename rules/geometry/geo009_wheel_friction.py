"""A wheel, track or foot without friction, or with impossibly high friction.

Without friction a wheel spins in place. Rubber on rock reaches about 1; with a coefficient of 150
the robot climbs walls that no real robot climbs, and some engines jitter. In Gazebo Classic, whose
engine takes any high friction as one that does not slip, that is an info, except in a robot that
turns by skidding. Engines use different defaults for friction that is not stated.

A part that does not roll, such as a ball in place of a caster that is fixed to the robot or turns
about an upright axis, slides: it may be without friction, and brakes the robot with that of a tyre.

Fix: state `<surface><friction><ode>` with `<mu>` and `<mu2>` for each collision of each wheel:
about 0.5 to 1.5 for one that rolls, 0.001 for a part that slides. In URDF write
`<gazebo reference="WHEEL"><mu1>1</mu1><mu2>1</mu2></gazebo>`, for what slides with 0.001.
Source: SDFormat specification, surface/friction: coefficients of Coulomb friction, 1 by default.
"""

import enum
from collections.abc import Iterator

from checker.formats.friction import Friction, FrictionReader
from checker.model.components import Collision, Link
from checker.model.geometry.placed_shapes import place_shapes
from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule

_UPRIGHT = 0.9
"""Part along z of an axis about which a wheel swivels, and does not roll."""
_SKIDDING = (DriveKind.SKID_STEER, DriveKind.TRACKED)
"""They turn by slipping sideways, which a high friction prevents."""


@rule("GEO009", "wheel-friction", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot, context: Context, *, most: float = 10.0, foot_height: float = 0.02
) -> Findings:
    """Report coefficients of 0 or less and above `most`, and single wheels that state none.

    If no other part states friction, or of the driven wheels none does, this is an info.

    Options:
        most: Greatest coefficient of friction; more is reported, except across a track.
        foot_height: Metres above a legged robot's lowest point; collisions of moving links that
            reach below this height count as feet.
    """
    is_held = context.release == "classic" and robot.locomotion.kind not in _SKIDDING
    too_high = Severity.INFO if is_held else None
    reader = FrictionReader(robot)
    across = _mu2_meanings(robot)
    touching = [
        (link, shape, reader.friction_of(link, shape))
        for link, shape in _ground(robot, foot_height)
    ]
    driven = {it.scoped_name for wheel in robot.locomotion.wheels for it in wheel.body}
    driven |= {track.link.scoped_name for track in robot.locomotion.tracks}
    stating = {
        link.scoped_name in driven for link, _, friction in touching if friction.first is not None
    }
    for link, shape, friction in touching:
        of_drive = link.scoped_name in driven
        if of_drive or link.scoped_name not in robot.tree.base or not _slides(friction):
            sideways = across.get(link.scoped_name, _Across.AS_ALONG)
            yield from _absurd(link, friction, most, sideways, too_high)
        if friction.first is None:
            some_state = of_drive in stating or (not of_drive and bool(stating))
            yield _missing(link, shape, some_state, not of_drive and not _rolls(robot, link))


def _slides(friction: Friction) -> bool:
    """Return whether the coefficients that are stated are 0."""
    stated = [it.value for it in (friction.first, friction.second) if it is not None]
    return bool(stated) and not any(stated)


class _Across(enum.Enum):
    AS_ALONG = enum.auto()
    FREE = enum.auto()
    """Least `mu2` of a Mecanum wheel, which rolls sideways on its rollers: 0 on purpose."""
    HELD = enum.auto()
    """Greatest `mu2` of a track, which must not slip sideways: Gazebo's own examples have 150."""


_ON_ROLLERS = ("MecanumDrive", "MecanumDriveController", "OmniWheelDriveController")


def _mu2_meanings(robot: Robot) -> dict[str, _Across]:
    """Return the special meaning of `mu2` for the link, judged by its name."""
    known = {track.link.scoped_name: _Across.HELD for track in robot.locomotion.tracks}
    for drive in robot.locomotion.wheel_drives:
        if drive.plugin.class_name in _ON_ROLLERS:
            links = (link for wheel in drive.wheels for link in wheel.body)
            known.update((link.scoped_name, _Across.FREE) for link in links)
    return known


def _absurd(
    link: Link, friction: Friction, most: float, across: _Across, too_high: Severity | None
) -> Iterator[Finding]:
    """Report impossible coefficients, those above `most` with the severity `too_high`."""
    first, second = friction.first, friction.second
    if first is not None and second is not None and first.value == second.value:
        second = None  # one mistake, reported once
    for number in (first, second):
        if number is None or 0 < number.value <= most:
            continue
        free = across is _Across.FREE and number.value == 0
        held = across is _Across.HELD and number.value > most
        if number is first or not (free or held):
            yield finding(
                number,
                f"the friction of {link.name.value!r} is {number.value:g}, expected more than 0 "
                f"and at most {most:g}",
                severity=too_high if number.value > most else None,
                key=f"{'mu' if number is first else 'mu2'} {number.value:g}",
            )


def _missing(link: Link, shape: Collision, some_state: bool, slides: bool) -> Finding:
    others = ", but other parts that the robot stands on do" if some_state else ""
    low = "; it slides, as it does not roll: expected a low one such as 0.001" if slides else ""
    return finding(
        shape,
        f"collision {shape.name.value!r} of {link.name.value!r} states no friction{others}{low}",
        severity=Severity.WARNING if some_state else Severity.INFO,
        key="missing, slides" if slides else "missing",
    )


def _rolls(robot: Robot, link: Link) -> bool:
    """Return whether a link turns about an axis that is not upright."""
    if link.scoped_name in robot.tree.base:
        return False
    joints = (tie.joint for tie in robot.tree.ties_above.get(link.scoped_name, ()))
    axes = [robot.axis_in_model(joint, axis) for joint in joints for axis in joint.axes]
    return not axes or any(axis is None or abs(axis[2]) < _UPRIGHT for axis in axes)


def _ground(robot: Robot, foot_height: float) -> Iterator[tuple[Link, Collision]]:
    """Yield what the robot stands on: collisions of wheels, tracks and feet."""
    links: dict[str, Link] = {}
    for wheel in robot.locomotion.wheels:
        links.update((link.scoped_name, link) for link in wheel.body)
    links.update((track.link.scoped_name, track.link) for track in robot.locomotion.tracks)
    if robot.locomotion.wheel_drives:
        links.update((link.scoped_name, link) for link in robot.wheels)
    yield from ((link, shape) for link in links.values() for shape in link.collisions)
    if robot.locomotion.leg_joints:
        yield from _feet(robot, foot_height)


def _feet(robot: Robot, foot_height: float) -> Iterator[tuple[Link, Collision]]:
    shapes = [
        (shape, piece)
        for link in robot.links
        for shape in link.collisions
        for piece in place_shapes(robot, link, (shape,))
    ]
    ground = min((piece.box.low[2] for _, piece in shapes), default=0.0)
    for shape, piece in shapes:
        moves = piece.link.scoped_name in robot.tree.ties_above
        if moves and piece.box.low[2] <= ground + foot_height:
            yield piece.link, shape


def _rover(left: str, right: str, plugin: str = "DiffDrive", mark: str = "") -> str:
    return f"""
{_wheel("left", left)}
{_wheel("right", right, mark)}
<plugin filename="libp.so" name="ignition::gazebo::systems::{plugin}">
  <left_joint>left_axle</left_joint>
  <right_joint>right_axle</right_joint>
  <front_left_joint>left_axle</front_left_joint>
</plugin>
"""


def _wheel(name: str, friction: str, mark: str = "") -> str:
    surface = f"<surface><friction><ode>{friction}\n</ode></friction></surface>"
    return f"""
<link name="{name}">
  <collision name="c">{mark}
    <geometry><sphere/></geometry>
    {surface if friction else ""}
  </collision>
</link>
<joint name="{name}_axle" type="revolute">
  <parent>base_link</parent>
  <child>{name}</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
"""


def _track(friction: str) -> str:
    return f"""
{_wheel("track", friction)}
<plugin filename="libp.so" name="ignition::gazebo::systems::TrackController">
  <link>track</link>
</plugin>
"""


def _wagon(in_link: str, tags: str, mark: str = "") -> dict[str, str]:
    """Return a URDF robot on two wheels, of which one has `in_link` in its collision."""
    links = "".join(
        f"""<link name="{side}">
<collision name="c">{extra}
<geometry><sphere radius="0.1"/></geometry>
</collision>
</link>
<joint name="{side}_axle" type="continuous">
<parent link="upper_arm"/><child link="{side}"/><axis xyz="0 1 0"/>
</joint>
"""
        for side, extra in (("left", f"{mark}{in_link}"), ("right", ""))
    )
    plugin = """<gazebo><plugin filename="libgazebo_ros_diff_drive.so" name="drive">
<leftJoint>left_axle</leftJoint><rightJoint>right_axle</rightJoint>
</plugin></gazebo>
"""
    return {"@urdf": f"{links}{plugin}{tags}"}


def _tag(side: str) -> str:
    return f'<gazebo reference="{side}"><mu1>1</mu1><mu2>1</mu2></gazebo>\n'


_SLICK = "<surface><friction><ode><mu>0</mu></ode></friction></surface>"
_ONE = "<mu>1</mu><mu2>1</mu2>"
_BALL = _wheel("ball_wheel", "<mu>0</mu><mu2>0</mu2>").replace('"revolute"', '"fixed"')
_MARK = "  <!-- ^ GEO009 -->"
GOOD = [
    _rover(_ONE, _ONE),
    _rover("<mu>0.5</mu>", "<mu>10</mu>"),
    _rover("<mu>1</mu><mu2>0</mu2>", _ONE, "MecanumDrive"),
    _rover("", "", "TrackedVehicle"),
    _track("<mu>1</mu><mu2>150</mu2>"),
    _rover(_ONE, _ONE) + _BALL,
    _wagon(_SLICK, _tag("left") + _tag("right")),
]
BAD = [
    _rover(_ONE, f"<mu>0</mu>{_MARK}"),
    _rover(_ONE, f"<mu>1</mu><mu2>150</mu2>{_MARK}"),
    _rover(_ONE, f"<mu>-1</mu>{_MARK}"),
    _rover(_ONE, "", mark=_MARK),
    _rover(_ONE, _ONE) + _wheel("ball_wheel", "", _MARK).replace('"revolute"', '"fixed"'),
    _track(f"<mu>150</mu>{_MARK}"),
    _wagon(_SLICK.replace(">0<", ">1<"), _tag("right"), _MARK),
]
