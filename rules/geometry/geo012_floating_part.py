"""A part floats: no other part is near it.

A camera or an antenna in the air next to the robot usually has a wrong pose: a decimal point, a
sign, a unit, or the pose of another configuration. A box of a centimetre that marks a frame, such
as `base_footprint`, is not a part, nor is a link that is only a small ball without mass and
collision: it marks a point, such as the centre of a tool. In published robots, intended gaps
measure up to 16 mm, and mistakes 38 mm or more. In scenery, with no moving joint, sensor or plugin,
it is an info: two tables in one file stand apart by intent. Two arms may stand apart as well, each
with a base that is fixed to the world or to a root link without shapes, directly or through links
without shapes. So may a part that is fixed to the world, such as a camera that looks at the robot.
A part that is fixed straight above another, such as a lidar over a plate, has a mount that the
model leaves out: an info, but for SubT, up to a gap of `mount`.

Fix: correct the pose of the shape or of its link; if the real robot has a bracket, model it. Where
the message names a visual and a collision that differ, give both one pose.
Source: geometry: boxes along the robot's axes around each collision and visual.
"""

import math
from collections.abc import Sequence

from checker.model.geometry.boxes import Box, TooManyPairs, clusters
from checker.model.geometry.placed_shapes import Placed, all_shapes, union
from checker.model.robot import Robot
from checker.model.tree import WORLD, LinkTree
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked

_EQUAL = 1e-6
"""Metres by which computed distances may be off: 20.0 mm are not more than 20 mm."""


@rule("GEO012", "floating-part", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot,
    context: Context,
    *,
    gap: float = 0.02,
    gap_of_wheels: float = 0.06,
    marker: float = 0.02,
    ball: float = 0.025,
    mount: float = 0.15,
) -> Findings:
    """Report groups of shapes that are more than `gap` from all other shapes.

    Options:
        gap: Metres between the boxes of two shapes, along each axis of the robot, up to which they
            count as connected.
        gap_of_wheels: The same for a wheel: many models leave out its axle.
        marker: Diagonal in metres of a box that only marks a frame; a group that is not larger is
            not reported.
        ball: Radius in metres of a ball up to which it marks a point, if its link has nothing else.
        mount: Metres of a gap below a fixed part up to which a mount is left out.
    """
    if robot.is_static:
        return
    shapes, unknown = all_shapes(robot)
    try:
        boxes = _boxes_with_axles(robot, shapes, max(gap_of_wheels - gap, 0.0))
        groups = clusters(boxes, gap + _EQUAL)
    except TooManyPairs:
        yield unchecked("too many shapes are close together to look for a floating one")
        return
    if len(groups) < 2:
        return
    reason = robot.missing_parts or robot.unplaced_part
    if unknown or reason:
        reason = reason or f"the size of {unknown[0].name.value!r} is not known"
        yield unchecked(f"{reason}; parts that seem to float may be attached to it")
        return
    outside_subt = not context.is_subt
    is_scenery = robot.is_prop and outside_subt
    members = [[shapes[number] for number in group] for group in groups]
    body = max(members, key=_diagonal)
    for group in members:
        if group is body or (_stands_alone(robot, group) and _stands_alone(robot, body)):
            continue
        if _marks_point(group, ball) or _is_on_world(robot, group):
            continue
        if _diagonal(group) > marker and not (is_scenery and _shows_frames(group)):
            own = {*group}
            others = [piece for piece in shapes if piece not in own]
            distance = _distance(group, [piece.box for piece in others])
            is_info = is_scenery or (outside_subt and _lacks_mount(robot, group, others, mount))
            severity = Severity.INFO if is_info else None
            yield _floating_part(group, distance, gap, severity, _twin(group, others))


def _boxes_with_axles(robot: Robot, shapes: Sequence[Placed], reach: float) -> list[Box]:
    """Return the boxes of shapes, those of wheels longer by the axle that is not modelled.

    What turns without end is a wheel, whatever its name.
    """
    turning = (tie.child for tie in robot.tree.ties if tie.joint.type.value == "continuous")
    wheels = {*turning, *(link.scoped_name for link in robot.wheels)}
    return [
        shape.box.grown(reach) if shape.link.scoped_name in wheels else shape.box
        for shape in shapes
    ]


def _stands_alone(robot: Robot, group: Sequence[Placed]) -> bool:
    """Return whether a group is a mechanism on a base of its own, such as one of two arms."""
    tree, links = robot.tree, {piece.link.scoped_name for piece in group}
    wheels = {wheel.scoped_name for wheel in robot.wheels}
    roots = _roots_without_shapes(tree)
    ties = [tie for tie in tree.ties if tie.child in links]
    based = any(tie.parent in roots and tie.joint.type.value == "fixed" for tie in ties)
    moving = (tie for tie in ties if tie.joint.type.value != "fixed" and tie.parent in links)
    return based and any(tie.child not in wheels for tie in moving)


def _is_on_world(robot: Robot, group: Sequence[Placed]) -> bool:
    """Return whether a group is fixed to the world, and carries no other part.

    Links without shapes may be between it and the world.
    """
    tree = robot.tree
    at = {piece.link.scoped_name for piece in group}
    others = (tree.links[it.child] for it in tree.ties if it.parent in at and it.child not in at)
    if any(link.collisions or link.visuals for link in others):
        return False
    seen: set[str] = set()
    while at - seen:
        seen |= at
        ties = [tie for name in at for tie in tree.ties_above.get(name, ())]
        above = {tie.parent for tie in ties if tie.joint.type.value == "fixed"}
        if WORLD in above:
            return True
        at = {it for it in above if not (tree.links[it].collisions or tree.links[it].visuals)}
    return False


def _lacks_mount(
    robot: Robot, group: Sequence[Placed], others: Sequence[Placed], reach: float
) -> bool:
    """Return whether a group is fixed straight above another part, with at most a gap."""
    box, links = union(piece.box for piece in group), {piece.link.scoped_name for piece in group}
    ties = (tie for name in links for tie in robot.tree.ties_above.get(name, ()))
    if box is None or any(it.joint.type.value != "fixed" and it.parent not in links for it in ties):
        return False
    x, y, _ = box.centre
    below = (
        it.box.high[2]
        for it in others
        if it.box.low[0] <= x <= it.box.high[0] and it.box.low[1] <= y <= it.box.high[1]
    )
    return any(0.0 <= box.low[2] - top <= reach for top in below)


def _roots_without_shapes(tree: LinkTree) -> set[str]:
    """Return the world, roots without shapes, and links without shapes that are fixed to them."""
    empty = {name for name, link in tree.links.items() if not (link.collisions or link.visuals)}
    roots = {WORLD, *(empty - tree.ties_above.keys())}
    below: dict[str, list[str]] = {}
    for tie in tree.ties:
        if tie.child in empty and tie.joint.type.value == "fixed":
            below.setdefault(tie.parent, []).append(tie.child)
    waiting = [*roots]
    while waiting:
        found = set(below.get(waiting.pop(), ())) - roots
        roots |= found
        waiting += found
    return roots


def _shows_frames(group: Sequence[Placed]) -> bool:
    """Return whether a group only marks frames: nothing of it has a mass or collides."""
    links = (piece.link for piece in group)
    return not any(link.collisions or link.inertial for link in links)


def _marks_point(group: Sequence[Placed], radius: float) -> bool:
    """Return whether a group is one ball of at most a radius, and all that its link has."""
    link, geometry = group[0].link, group[0].shape.geometry
    if len(group) > 1 or len(link.visuals) > 1 or not _shows_frames(group):
        return False
    return geometry.shape == "sphere" and geometry.sizes["radius"][0].value <= radius


def _length(metres: float) -> str:
    return f"{metres:.3g} m" if metres >= 1.0 else f"{metres * 1e3:.3g} mm"


def _diagonal(group: Sequence[Placed]) -> float:
    box = union(piece.box for piece in group)
    return box.diagonal if box is not None else 0.0


def _distance(group: Sequence[Placed], others: Sequence[Box]) -> float:
    """Return the distance of a group from other boxes, along the axis of the gap, metres."""
    return min(
        max(
            max(low - other_high, other_low - high)
            for low, high, other_low, other_high in zip(
                piece.box.low, piece.box.high, other.low, other.high, strict=True
            )
        )
        for piece in group
        for other in others
    )


def _twin(group: Sequence[Placed], others: Sequence[Placed]) -> Placed | None:
    """Return the visual of a collision, or the collision of a visual, that is elsewhere.

    It is of the same link, and its box has the same size.
    """
    first = group[0]
    if len(group) > 1:
        return None
    kind, sides = type(first.shape), _sides(first.box)
    alike = (it for it in others if it.link is first.link and not isinstance(it.shape, kind))
    return next((it for it in alike if math.dist(_sides(it.box), sides) <= _EQUAL), None)


def _sides(box: Box) -> list[float]:
    return [high - low for low, high in zip(box.low, box.high, strict=True)]


def _floating_part(
    group: Sequence[Placed],
    distance: float,
    gap: float,
    severity: Severity | None,
    twin: Placed | None,
) -> Finding:
    first = group[0]
    if twin is not None:
        apart = math.dist(first.box.centre, twin.box.centre)
        return finding(
            first.shape,
            f"{first.shape.name.value!r} of {first.link.name.value!r} is {_length(apart)} from "
            f"{twin.shape.name.value!r}, the other shape of the same part: give both one pose",
            severity=severity,
            related=[(twin.shape, "the other shape")],
        )
    more = f" and {len(group) - 1} more" if len(group) > 1 else ""
    x, y, z = first.box.centre
    return finding(
        first.shape,
        f"{first.shape.name.value!r}{more} of {first.link.name.value!r} at ({x:.3g}, {y:.3g}, "
        f"{z:.3g}) m: the nearest other part is {_length(distance)} away, expected at most "
        f"{gap * 1e3:g} mm",
        severity=severity,
    )


def _camera(pose: str, mark: str = "", bracket: str = "") -> str:
    return f"""
<link name="body">
  <visual name="v"><geometry><box><size>1 0.5 0.2</size></box></geometry></visual>
  {bracket}
</link>
<link name="camera">
  <pose>{pose} 0 0 0</pose>
  <visual name="case">{mark}
    <geometry><box><size>0.1 0.1 0.1</size></box></geometry>
  </visual>
</link>
<joint name="j1" type="fixed"><parent>base_link</parent><child>body</child></joint>
<joint name="j2" type="fixed"><parent>body</parent><child>camera</child></joint>
"""


_MARK = "  <!-- ^ GEO012 -->"
_BRACKET = """
<collision name="c"><pose>0 0 0.25 0 0 0</pose>
  <geometry><box><size>0.02 0.02 0.3</size></box></geometry>
</collision>
"""
_BALL = (
    "<box><size>0.1 0.1 0.1</size></box>",
    "<sphere><radius>0.02</radius></sphere>",
)
_UNKNOWN = """
<visual name="m"><geometry><mesh><uri>meshes/wheel.dae</uri></mesh></geometry></visual>
"""
_WHEEL = """
<link name="body">
  <pose>0 0 0.2 0 0 0</pose>
  <visual name="v"><geometry><box><size>1 0.4 0.2</size></box></geometry></visual>
</link>
<link name="left_wheel">
  <pose>0 0.27 0.1 0 0 0</pose>
  <visual name="v"><geometry><box><size>0.2 0.04 0.2</size></box></geometry></visual>
</link>
<joint name="j" type="fixed"><parent>base_link</parent><child>body</child></joint>
<joint name="axle" type="continuous">
  <parent>body</parent><child>left_wheel</child><axis><xyz>0 1 0</xyz></axis>
</joint>
"""


def _arms(mount: str, mark: str = "", between: str = "fixed") -> object:
    box = '<geometry>\n<box size="0.1 0.1 0.1"/>\n</geometry>'

    def arm(name: str, y: float, mark: str = "") -> str:
        return f"""
<link name="{name}_base">
  <visual>{mark}{box}</visual>
</link>
<link name="{name}_arm"><visual>{box}</visual></link>
<link name="{name}_foot"/>
<joint name="{name}_place" type="{between}">
  <parent link="base_link"/><child link="{name}_foot"/><origin xyz="0 {y} 0"/>
</joint>
<joint name="{name}_mount" type="{mount}">
  <parent link="{name}_foot"/><child link="{name}_base"/>
</joint>
<joint name="{name}_turn" type="continuous">
  <parent link="{name}_base"/><child link="{name}_arm"/><origin xyz="0 0 0.1"/>
</joint>
"""

    return {"@urdf": arm("left", -1.0) + arm("right", 1.0, mark)}


_WATCH = """
<link name="world"/>
<link name="watch">
  <visual><geometry>
    <box size="0.1 0.1 0.1"/>
  </geometry></visual>
</link>
<joint name="hold" type="fixed"><parent link="world"/><child link="base_link"/></joint>
<joint name="stand" type="fixed"><parent link="world"/><child link="post"/></joint>
<link name="post"/>
<joint name="post_top" type="fixed">
  <parent link="post"/><child link="watch"/><origin xyz="2 0 1"/>
</joint>
"""
_CASTER = """
<collision name="caster_collision"><pose>0.4 0 0.05 0 0 0</pose>{}
  <geometry><sphere><radius>0.05</radius></sphere></geometry>
</collision>
<visual name="caster_visual"><pose>0.2 0 0.05 0 0 0</pose>
  <geometry><sphere><radius>0.05</radius></sphere></geometry>
</visual>
<visual name="body_visual"><geometry><box><size>0.6 0.4 0.1</size></box></geometry></visual>
"""


def _on_world() -> dict[str, object]:
    body = '<visual><geometry><box size="1 0.5 0.2"/></geometry></visual>'
    tie = '<parent link="base_link"/><child link="body"/>'
    joint = f'<joint name="j" type="fixed">{tie}</joint>'
    return {"@urdf": f'<link name="body">{body}</link>{joint}{_WATCH}'}


GOOD = [
    _on_world(),
    _arms("fixed"),
    _WHEEL,
    _WHEEL.replace("left_wheel", "left_front_link"),
    _camera("0.4 0 0.17"),
    _camera("0.4 0 0.15"),
    _camera("0.4 0 0.165"),
    _camera("0 0 0.45", bracket=_BRACKET),
    _camera("0 0 0.45").replace("0.1 0.1 0.1", "0.01 0.01 0.01"),
    _camera("0 0 0.45").replace(*_BALL),
]
BAD = [
    _camera("0 0 0.45", _MARK),
    _camera("1.5 0 0", _MARK),
    _CASTER.format(_MARK).replace("0.4 0 0.05", "0.5 0 0.05"),
    _arms("floating", _MARK),
    _arms("fixed", _MARK, between="floating"),
]
