"""A wing, rudder or blade whose lift has no direction or no area.

LiftDrag and AdvancedLiftDrag work in the plane of `<forward>` and `<upward>`. Where one of them is
zero, or both point along one line, there is no such plane: the surface has no lift and no drag, and
Gazebo prints no message. A surface without area has neither, too. A centre of pressure far outside
the vehicle gives the force a lever that the vehicle does not have: usually the numbers are in
millimetres.

Fix: write the direction of flight in `<forward>` and that of the lift in `<upward>`, at right
angles, in the link's frame; the area in m², and `<cp>` in metres from the link's origin.
Source: LiftDrag.cc and AdvancedLiftDrag.cc of gz-sim, branches ign-gazebo6 to gz-sim10.
"""

import math
from collections.abc import Iterator

from checker.model.components import Plugin
from checker.model.geometry.transform import Vector
from checker.model.locomotion.drive import WING_CLASSES
from checker.model.robot import Robot
from checker.model.values import parse_number
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

_AXES = 3


@rule("DRV012", "invalid-lift-surface", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, *, least_sine: float = 0.01, reach: float = 2.0) -> Findings:
    """Check directions, area and centre of pressure of each surface.

    Options:
        least_sine: Sine of the angle between `<forward>` and `<upward>`; less is an error.
        reach: Distance of the centre of pressure from the link's origin, in multiples of the
            robot's greatest extent; more is a warning.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    size = _size(robot)
    for plugin in robot.plugins:
        if plugin.class_name in WING_CLASSES:
            yield from _no_plane(plugin, least_sine)
            yield from _no_area(plugin)
            yield from _far_away(plugin, reach * size)


def _no_plane(plugin: Plugin, least: float) -> Iterator[Finding]:
    forward = _vector(plugin, "forward", (1.0, 0.0, 0.0))
    upward = _vector(plugin, "upward", (0.0, 0.0, 1.0))
    if forward is None or upward is None:
        return
    where = next(plugin.at("upward"), next(plugin.at("forward"), plugin))
    for tag, vector in (("forward", forward), ("upward", upward)):
        if math.hypot(*vector) == 0.0:
            message = f"{plugin.class_name} has <{tag}> of length 0: it gives no lift"
            yield finding(next(plugin.at(tag), plugin), message)
            return
    lengths = math.hypot(*forward) * math.hypot(*upward)
    if math.hypot(*_cross(forward, upward)) < least * lengths:
        yield finding(
            where,
            f"{plugin.class_name} has <forward> and <upward> along one line: it gives no lift",
        )


def _no_area(plugin: Plugin) -> Iterator[Finding]:
    area = plugin.number("area")
    if area is not None and not area.value > 0.0:
        yield finding(area, f"{plugin.class_name} has <area> {area.value:g} m²: it gives no lift")


def _far_away(plugin: Plugin, most: float) -> Iterator[Finding]:
    centre = _vector(plugin, "cp", (0.0, 0.0, 0.0))
    if centre is None or not 0.0 < most < math.hypot(*centre):
        return
    yield finding(
        next(plugin.at("cp"), plugin),
        f"{plugin.class_name} has its centre of pressure {math.hypot(*centre):.3g} m from its "
        f"link, expected at most {most:.3g} m",
        severity=Severity.WARNING,
    )


def _size(robot: Robot) -> float:
    """Return the diagonal of the box around all shapes, metres; 0 if one is unknown."""
    boxes = [robot.box_of(link) for link in robot.links if link.collisions or link.visuals]
    known = [box for box in boxes if box is not None]
    if len(known) < len(boxes) or not known:
        return 0.0
    low = [min(box.low[axis] for box in known) for axis in range(_AXES)]
    high = [max(box.high[axis] for box in known) for axis in range(_AXES)]
    return math.dist(low, high)


def _vector(plugin: Plugin, tag: str, default: Vector) -> Vector | None:
    """Return three numbers; None if there are others."""
    text = next(plugin.at(tag), None)
    if text is None:
        return default
    x, y, z, *more = (*(parse_number(word) for word in text.value.split()), None, None, None)
    if x is None or y is None or z is None or len(more) > _AXES:
        return None
    return x, y, z


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _wing(inside: str) -> str:
    return f"""
<link name="wing">
  <collision name="c"><geometry><box><size>0.2 1 0.01</size></box></geometry></collision>
</link>
<plugin filename="gz-sim-lift-drag-system" name="gz::sim::systems::LiftDrag">
  <link_name>wing</link_name>
  {inside}
</plugin>
"""


_MARK = "  <!-- ^ DRV012 -->"
GOOD = [
    _wing(""),
    _wing("<forward>0 1 0</forward><upward>0 0.2 1</upward><area>0.2</area><cp>0 0.3 0</cp>"),
]
BAD = [
    _wing(f"<upward>1 0 0</upward>{_MARK}"),
    _wing(f"<forward>0 0 0</forward>{_MARK}"),
    _wing(f"<area>0</area>{_MARK}"),
    _wing(f"<cp>0 300 0</cp>{_MARK}"),
]
