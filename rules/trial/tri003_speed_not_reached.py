"""A robot that drives slower or faster than commanded.

Odometry assumes the commanded speed, so the robot is in another place than its driver believes.
Usually `wheel_radius` is not the radius of the wheels, a wheel joint's limit of velocity or effort
is too low, or the wheels slip because they carry too little load. With a limit of 0 the robot does
not move. A part that is fixed to the body and slides on the ground, such as a ball for a caster,
needs friction near 0: the drag of one with `mu` 1 makes the robot hop in the trial; in Gazebo Sim
it may drive at full speed and not turn at all. This is a warning. Where all axles lie along x, the
robot drives along y, but its commands, odometry and navigation mean x as forward (REP 103).

Fix: mend the cause that the message names (in a URDF, `<mu>` and `<mu2>` are `<mu1>` and `<mu2>` in
`<gazebo reference>`). Where it names none, compare `wheel_radius` with the wheels' collisions, and
check their friction and loads.
Source: a prototype trial of 60 accepted ground robots: all reach 0.98 to 1.00 of the command.
Gazebo Sim's physics engine DART keeps joints within their velocity and effort limits.
"""

from checker.base.words import beyond
from checker.model.locomotion.balancing import NOT_RUN
from checker.model.locomotion.locomotion import DriveKind
from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked
from checker.rulebook.example_parts import rover
from checker.source.text import Located


@rule("TRI003", "speed-not-reached", Severity.ERROR, Concern.ROBOT, judges=("speed_ratio",))
def check(
    driven: SettledTrial, *, warning_beyond: float = 0.05, error_beyond: float = 0.15
) -> Findings:
    """Report a speed that differs too much from the command.

    For a robot that is not written for Gazebo it is a warning: URDF alone knows no friction. Where
    its ball for a caster slides, it is an info.

    Options:
        warning_beyond: Share of the commanded speed by which the robot may be slower or faster;
            more is a warning.
        error_beyond: Share of the commanded speed beyond which the difference is an error instead
            of a warning.
    """
    if driven.robot.unread_plugins and driven.trial.drive == DriveKind.NONE:
        yield unchecked(driven.robot.unread_plugins)
    if driven.others:
        yield unchecked(driven.others)
    if driven.trial.not_driven and driven.trial.drive not in _NOT_TRIED:
        yield unchecked(f"the robot was not driven: {driven.trial.not_driven}")
    ratio, leg = driven.trial.value("speed_ratio"), driven.leg("drive")
    if leg is None or driven.drives_backwards:
        return
    if ratio is None:
        yield finding(
            driven.drive,
            "a limit of its velocity or acceleration is 0, so the robot ignores commands",
            key="speed_ratio",
        )
        return
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    off = abs(ratio - 1.0)
    if off <= warning_beyond:
        return
    if abs(ratio) < _CREEPS and _axles_along_x(driven):
        yield _drives_along_y(driven, ratio * leg.linear, leg.linear)
        return
    reached = round(ratio * leg.linear, 3) + 0.0
    limited = _limited(driven) if ratio < 1.0 else None
    cause, place, fastest = limited or (*_cause(driven, ratio, warning_beyond), None)
    dragged = "" if cause or ratio > 1.0 else _dragged(driven)
    share = beyond(off * 100.0, warning_beyond * 100.0, digits=len(f"{off:.0%}") - 1)
    yield finding(
        place or driven.drive,
        f"the robot drives at {reached:g} m/s when commanded to drive at {leg.linear:.3g} m/s: a "
        f"difference of {share}%, expected at most {warning_beyond:.0%}{cause or dragged}",
        severity=_severity(driven, far=off > error_beyond, dragged=bool(dragged)),
        key="speed_ratio",
        related=[
            *([(fastest, "the drive's maximum speed")] if fastest else []),
            *((joint, "turns about an upright axis") for joint in driven.upright_wheels),
        ],
        covered_by=("GEO003", "GEO004"),
    )


_CREEPS = 0.2
"""Share of the command; a robot that drives along y is slower along x."""
_ALONG = 0.9
"""Part of an axis of length 1 along x."""


def _axles_along_x(driven: SettledTrial) -> bool:
    axes = [wheel.axis for wheel in driven.robot.locomotion.wheels]
    return bool(axes) and all(axis is not None and abs(axis[0]) > _ALONG for axis in axes)


def _drives_along_y(driven: SettledTrial, reached: float, commanded: float) -> Finding:
    return finding(
        driven.drive,
        f"the robot drives along y, not along x (REP 103), since the axles of its wheels lie along "
        f"x: it reaches {round(reached, 3) + 0.0:g} m/s along x when commanded to drive at "
        f"{commanded:.3g} m/s; turn the joints of the wheels, or the base, by 90°",
        severity=_severity(driven, far=True, dragged=False),
        key="speed_ratio path_sideways",
    )


def _severity(driven: SettledTrial, *, far: bool, dragged: bool) -> Severity:
    if not driven.robot.is_for_gazebo:
        return Severity.INFO if dragged else Severity.WARNING
    return Severity.ERROR if far and not dragged else Severity.WARNING


_NOT_TRIED = (DriveKind.NONE, DriveKind.LEGGED)
"""Drives that no trial knows; a robot without one may fly or swim."""


def _limited(
    driven: SettledTrial,
) -> tuple[str, Located[float], Located[float] | None] | None:
    """Return the limit of a wheel joint that keeps the robot slow.

    Returns:
        The end of a sentence, the limit, and the drive's maximum speed where the joint is below it.
    """
    leg = driven.leg("drive")
    if leg is None or not driven.enforces_limits:
        return None
    for drive in driven.robot.locomotion.drives:
        radius = drive.wheel_radius.value
        for wheel in drive.wheels:
            if not wheel.joint.axes:
                continue
            axis, said = wheel.joint.axes[0], f"; joint {wheel.joint.name.value!r}"
            needed = leg.linear / radius if radius else 0.0
            if axis.velocity.value < needed:
                said += f" turns at {axis.velocity.value:g} rad/s at most and needs {needed:.3g}"
                said += " rad/s: raise its velocity limit"
                return said, axis.velocity, drive.linear.max_velocity
            torque = driven.trial.value("torque", wheel.joint.scoped_name) or 0.0
            if axis.effort.value < torque:
                said += (
                    f" has {axis.effort.value:g} N·m at most and needs {torque:.3g} N·m: raise it"
                )
                return said, axis.effort, None
    return None


def _cause(
    driven: SettledTrial, ratio: float, tolerance: float
) -> tuple[str, Located[float] | None]:
    """Return the cause if the plugin's wheel radius or a wheel that cannot roll explains it.

    Returns:
        The end of a sentence, and the radius.
    """
    if dragged := driven.rigid_steering:
        return f"; {dragged!r} is steered, but no joint lets it roll", None
    for drive in driven.robot.locomotion.wheel_drives:
        stated = drive.wheel_radius.value
        for wheel in drive.wheels:
            if wheel.radius and stated > 0.0 and abs(wheel.radius / stated - ratio) <= tolerance:
                radius = f"the wheels have a radius of {wheel.radius:.3g} m"
                tag = f"half of {drive.diameter_tag}" if drive.diameter_tag else drive.radius_tag
                return f"; {tag} is {stated:g} m, but {radius}", drive.wheel_radius
    return "", None


_DRAG = 0.05
"""Share of the weight; less friction does not brake a robot noticeably."""


def _dragged(driven: SettledTrial) -> str:
    """Return what slides on the ground with the most friction, as the end of a sentence."""
    most = max(driven.trial.all("drag"), key=lambda found: found.value, default=None)
    if most is None or most.value < _DRAG:
        return ""
    return (
        f"; link {most.part!r} slides on the ground, and its friction is {most.value:.0%} of the "
        "robot's weight: give it <mu> and <mu2> of 0.001"
    )


def _rover(limit: str) -> str:
    text = rover(limit=f"<limit>{limit}</limit><!-- MARK -->")
    return text.replace("MARK", "^ TRI003", 1)


GOOD = [{"@robot": "rover"}]
BAD = [
    {
        "@robot": "rover",
        "@change": {
            "<wheel_radius>0.1</wheel_radius>": "<wheel_radius>0.15</wheel_radius>"
            "  <!-- ^ TRI003 -->",
        },
    },
    _rover("<velocity>2</velocity>"),
    _rover("<effort>0.01</effort>"),
]
