"""Parts that no joint connects start inside each other.

By default Gazebo does not let a robot collide with itself, but other simulators do: there the parts
jam or burst apart at the start. Real parts cannot be in the same place. No accepted package that we
checked has this fault. Links of a static model, such as walls that meet, never collide.

Fix: correct the pose of one of the parts, or make its collision smaller.
Source: geometry of collisions in the robot's initial pose; depth along separating directions.
"""

from checker.model.geometry.boxes import TooManyPairs
from checker.model.geometry.interpenetration import Inside, interpenetrations
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked


@rule(
    "GEO015", "overlapping-collisions", Severity.WARNING, Concern.ROBOT, judges=("start_overlap",)
)
def check(robot: Robot, *, depth: float = 0.01) -> Findings:
    """Report pairs of parts whose collisions are inside each other by more than `depth`.

    Parts that a joint connects may overlap. Concave meshes are skipped.

    Options:
        depth: Metres that two collisions may be inside each other, along the shortest way that
            separates them; more is reported.
    """
    if robot.is_static:
        return
    if robot.unplaced_part:
        yield unchecked(robot.unplaced_part)
        return
    try:
        for inside in interpenetrations(robot, depth):
            yield _finding(inside)
    except TooManyPairs:
        yield unchecked("too many collisions are close together to compare all pairs")


def _finding(inside: Inside) -> Finding:
    one, other = inside.one, inside.other
    return finding(
        other.link,
        f"{other.link.name.value!r} starts {inside.depth * 1e3:.3g} mm inside "
        f"{one.link.name.value!r}, but no joint connects them",
        key=one.link.scoped_name,
        related=[
            (one.shape, f"collision of {one.link.name.value!r}"),
            (other.shape, f"collision of {other.link.name.value!r}"),
        ],
    )


def _arm(y: float, mark: str = "", parent: str = "shoulder", turn: float = 0.0) -> str:
    box = "<collision name='c'><geometry><box><size>{}</size></box></geometry></collision>"
    return f"""
<link name="body">{box.format("1 0.4 0.2")}</link>
<link name="shoulder">
  <pose>0 0 0.2 0 0 0</pose>
  {box.format("0.1 0.1 0.1")}
</link>
<link name="hand">{mark}
  <pose>0 {y} 0 0 0 {turn}</pose>
  {box.format("0.2 0.2 0.2")}
</link>
<joint name="j0" type="fixed"><parent>base_link</parent><child>body</child></joint>
<joint name="j1" type="revolute"><parent>body</parent><child>shoulder</child></joint>
<joint name="j2" type="revolute"><parent>{parent}</parent><child>hand</child></joint>
"""


_MARK = "  <!-- ^ GEO015 -->"
GOOD = [
    _arm(0.31),
    _arm(0.295),
    _arm(0.345, turn=0.78539816),
    _arm(0.2, parent="body"),
    f"<static>true</static>{_arm(0.28)}",
]
BAD = [_arm(0.28, _MARK), _arm(0.0, _MARK), _arm(0.32, _MARK, turn=0.78539816)]
