"""The turning radius in specifications.md is not that of the drive.

Teams plan paths through narrow galleries with the turning radius. Differential drives and tracks
turn on the spot, whatever specifications.md says. Ackermann steering never does: its radius
follows from wheel base and steering limit.

Fix: correct specifications.md, or the drive plugin's `<steering_limit>` and `<wheel_base>`.
Source: kinematics: radius = wheel base / tan(steering limit) at the middle of the rear axle; at the
wheels it is up to half the track width more or less.
"""

import math
import re
from collections.abc import Iterator

from checker.model.locomotion.locomotion import DriveKind, TrackedDrive, WheelDrive
from checker.model.robot import Robot
from checker.model.specification.quantities import Quantity
from checker.model.specification.sheet import Specification
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import Span

_ON_THE_SPOT = re.compile(
    r"\b(?:turns?|rotates?|turning|rotating|spins?)\s+(?:on\s+the\s+spot|in\s+place|on\s+spot)\b",
    re.IGNORECASE,
)
_NOT = re.compile(r"\b(?:not|cannot|can't|unable|never|no)\b[^.]{0,40}$", re.IGNORECASE)
_TURNS_ON_THE_SPOT = (DriveKind.DIFFERENTIAL, DriveKind.SKID_STEER, DriveKind.TRACKED)


@rule("DOC009", "turning-radius-differs-from-drive", Severity.WARNING, Concern.PAPERWORK)
def check(
    robot: Robot,
    specification: Specification,
    *,
    on_the_spot: float = 0.2,
    tolerance: float = 0.2,
) -> Findings:
    """Compare the turning radius of specifications.md with that of a robot with one drive plugin.

    Options:
        on_the_spot: Metres; a greater turning radius in specifications.md is reported if the drive
            turns the robot on the spot.
        tolerance: Share by which specifications.md may be below the turning radius of a steered
            robot's inner wheels, or above that of its outer ones.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    moved = robot.locomotion
    drives: tuple[WheelDrive | TrackedDrive, ...] = (*moved.wheel_drives, *moved.tracked_drives)
    # Several drives may be the halves of a jointed robot, which turns in its own way.
    if len(drives) != 1:
        return
    radii = [radius for radius in specification.turning_radii if not radius.configurations]
    if moved.kind in _TURNS_ON_THE_SPOT:
        for stated in radii:
            if stated.value > on_the_spot:
                yield finding(
                    stated,
                    f"specifications.md says a turning radius of {stated.value:g} m, but "
                    f"the robot turns on the spot ({moved.kind})",
                    related=[(drives[0].plugin, "the drive")],
                )
    elif moved.kind is DriveKind.ACKERMANN:
        yield from _steered_findings(moved.wheel_drives[0], specification, radii, tolerance)


def _steered_findings(
    drive: WheelDrive, sheet: Specification, radii: list[Quantity], tolerance: float
) -> Iterator[Finding]:
    """Report statements that a steered robot cannot meet."""
    if drive.wheel_base is None or drive.steering_limit is None:
        return
    slope = math.tan(drive.steering_limit.value) if 0 < drive.steering_limit.value < 1.5 else 0.0
    if slope <= 0.0 or drive.wheel_base.value <= 0.0:
        return
    radius = drive.wheel_base.value / slope
    half = abs(drive.wheel_separation.value) / 2
    low, high = (radius - half) * (1 - tolerance), (radius + half) * (1 + tolerance)
    places: list[tuple[Span, str]] = [
        (stated.span, f"a turning radius of {stated.value:g} m")
        for stated in radii
        if not low <= stated.value <= high
    ]
    places += [(span, "that the robot turns on the spot") for span in _turns_on_the_spot(sheet)]
    for place, words in places:
        yield finding(
            place,
            f"specifications.md says {words}, but the wheel base and steering limit give "
            f"{radius:.3g} m",
            related=[(drive.steering_limit, "the steering limit")],
        )


def _turns_on_the_spot(sheet: Specification) -> Iterator[Span]:
    """Yield the places where the section on motion states it."""
    section = sheet.section("motion")
    for passage in section.passages if section is not None else ():
        for match in _ON_THE_SPOT.finditer(passage.text):
            if not _NOT.search(passage.text[max(0, match.start() - 80) : match.start()]):
                yield passage.part(*match.span())


_WHEELS = """
<link name="l"/><link name="r"/>
<joint name="lj" type="revolute"><parent>base_link</parent><child>l</child></joint>
<joint name="rj" type="revolute"><parent>base_link</parent><child>r</child></joint>
"""
_DRIVE = """
<plugin filename="libp.so" name="ignition::gazebo::systems::{name}">
  <left_joint>lj</left_joint>
  <right_joint>rj</right_joint>
  <wheel_separation>0.4</wheel_separation>
  <wheel_base>0.42</wheel_base>
  <steering_limit>0.266</steering_limit>
</plugin>
"""
_HEAD = "# Rover\n### Motion Characteristics\n"
_MARK = " <!-- ^ DOC009 -->"


def _example(drive: str, line: str) -> dict[str, str]:
    return {
        "@fragment": _WHEELS + _DRIVE.format(name=drive),
        "specifications.md": f"{_HEAD}{line}\n",
    }


GOOD = [
    _example("DiffDrive", "* Turning radius of 0.0 m: turns on the spot"),
    _example("AckermannSteering", "* Turning radius of 1.60 m; it cannot turn on the spot"),
    _example("MulticopterVelocityControl", "* Turning radius of 2 m"),
    _example("DiffDrive", "* Turning radius of 2 m for config 3"),
]
BAD = [
    _example("DiffDrive", f"* Turning radius of 2.5 m{_MARK}"),
    _example("AckermannSteering", f"* Turning radius of 0.5 m{_MARK}"),
    _example("AckermannSteering", f"* It can turn on the spot.{_MARK}"),
]
