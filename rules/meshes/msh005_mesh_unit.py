"""A mesh in millimetres, centimetres or inches that is read as metres, or the reverse.

The wheel is 200 m high, or too small to see; as a collision it throws the robot out of the world.

Fix: write `<scale>0.001 0.001 0.001</scale>` for a mesh in millimetres, correct `<unit meter>` in
the COLLADA file, or remove a scale that was applied twice.
Source: geometry; Gazebo uses the unit of a COLLADA file and reads STL and OBJ as metres.
"""

import math
from collections.abc import Iterable, Iterator

from checker.base.record import Record
from checker.model.components import Collision, Link, Visual
from checker.model.geometry.placed_shapes import placed, union
from checker.model.geometry.transform import Vector
from checker.model.mesh import MeshUse
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

UNITS = {"inches": 1 / 0.0254, "centimetres": 100.0, "millimetres": 1000.0}
"""How many of each unit make a metre."""

Shapes = Iterable[Collision | Visual]


@rule("MSH005", "mesh-unit", Severity.ERROR, Concern.ROBOT)
def check(
    robot: Robot,
    *,
    near: float = 1.5,
    beyond: float = 10.0,
    huge: float = 10.0,
    tiny: float = 0.01,
) -> Findings:
    """Compare the diagonal of each mesh, including its `<scale>`, with other known lengths.

    Too large: much longer than the robot without its meshes; or longer than it, and larger than the
    simple shapes of its link by the factor of a unit. Too small: smaller by such a factor than the
    link's shapes of the other kind (collisions for a visual, visuals for a collision).

    Options:
        near: Factor above 1 by which a ratio of lengths may differ from 39.4 (inches), 100 or 1000
            and still count as that unit.
        beyond: Ratio of a mesh to the robot without its meshes; more is too large. A third of it is
            too large if the link's simple shapes show the factor of a unit.
        huge: Metres; a shorter mesh is too large only if the simple shapes of its link show the
            factor of a unit.
        tiny: Metres; a mesh is too small only if all collisions, or all visuals, of its link
            together measure less.
    """
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    around = _size_without_meshes(robot)
    for extent, use, size in _meshes(robot):
        if 0.0 < beyond * around < size and size > huge:
            unit = next((u for u, f in UNITS.items() if size / f < near * around), "millimetres")
            yield _too_large(use, size, around, "robot without its meshes", unit)
        elif (unit := _unit(size, extent.simple, near)) and size > beyond / 3 * around:
            yield _too_large(use, size, extent.simple, "rest of its link", unit)
        elif 0.0 < extent.like(use) < tiny and (unit := _unit(extent.unlike(use), size, near)):
            yield finding(
                use.uri,
                f"{use.uri.value} measures {size:.3g} m, but the rest of its link measures "
                f"{extent.unlike(use):.3g} m: is it scaled from {unit} twice?",
            )


class _Extent(Record):
    """Diagonals of the boxes around a link's shapes, metres; 0 where one is not known.

    Attributes:
        simple: Around all shapes that are not meshes.
    """

    simple: float
    visuals: float
    collisions: float

    def like(self, use: MeshUse) -> float:
        """Return the diagonal for the shapes of a mesh's kind."""
        return self.collisions if use.is_collision else self.visuals

    def unlike(self, use: MeshUse) -> float:
        """Return the diagonal for the shapes of the other kind."""
        return self.visuals if use.is_collision else self.collisions


def _too_large(use: MeshUse, size: float, rest: float, whose: str, unit: str) -> Finding:
    return finding(
        use.uri,
        f"{use.uri.value} measures {size:.3g} m, but the {whose} measures {rest:.3g} m: is the "
        f"mesh in {unit} without a scale?",
    )


def _unit(large: float, small: float, near: float) -> str:
    """Return the unit whose factor lies between two lengths; empty when none does."""
    if not 0.0 < small < large < math.inf:
        return ""
    off = {unit: abs(math.log(large / small / factor)) for unit, factor in UNITS.items()}
    unit = min(off, key=lambda name: off[name])
    return unit if off[unit] < math.log(max(near, 1.0)) else ""


def _meshes(robot: Robot) -> Iterator[tuple[_Extent, MeshUse, float]]:
    """Yield each known mesh with the extent of its link and the length of its diagonal, metres."""
    uses = {use.shape: use for use in robot.mesh_uses}
    for link in robot.links:
        known = [(use, use.mesh) for shape in _shapes(link) if (use := uses.get(shape)) is not None]
        if not known:
            continue
        extent = _Extent(
            _size(robot, link, filter(_is_simple, _shapes(link))),
            _size(robot, link, link.visuals),
            _size(robot, link, link.collisions),
        )
        for use, mesh in known:
            if mesh is not None:
                sides = zip(mesh.low, mesh.high, use.scale, strict=True)
                yield extent, use, math.hypot(*((b - a) * scale for a, b, scale in sides))


def _shapes(link: Link) -> tuple[Collision | Visual, ...]:
    return (*link.collisions, *link.visuals)


def _is_simple(shape: Collision | Visual) -> bool:
    return shape.geometry.shape != "mesh"


def _size(robot: Robot, link: Link, shapes: Shapes) -> float:
    """Return the diagonal of the box around shapes of a link, metres; 0 where it is not known."""
    posed = [shape for shape in shapes if robot.pose_of_part(link, shape.pose) is not None]
    known = list(placed(robot, link, posed))
    box = union(piece.box for piece in known) if len(known) == len(posed) else None
    return box.diagonal if box is not None else 0.0


def _size_without_meshes(robot: Robot) -> float:
    """Return the diagonal of the box around all links' origins and simple shapes, metres."""
    points: list[Vector] = []
    for link in robot.links:
        pose = robot.pose_of(link.scoped_name)
        points += [pose.translation] if pose is not None else []
        for piece in placed(robot, link, filter(_is_simple, _shapes(link))):
            points += [piece.box.low, piece.box.high]
    spans = [max(values) - min(values) for values in zip(*points, strict=True)]
    return math.hypot(*spans)


def _rover(visual: str, collision: str = "<box><size>0.6 0.4 0.3</size></box>") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <visual name="v"><geometry>{visual}</geometry></visual>
  <collision name="c"><geometry>{collision}</geometry></collision>
</link>
<link name="mast">
  <pose>0 0 1 0 0 0</pose>
  <visual name="v"><geometry><sphere><radius>0.01</radius></sphere></geometry></visual>
</link>
</model>
</sdf>
"""


def _mesh(scale: float, mark: str = "") -> str:
    scales = " ".join([str(scale)] * 3)
    return f"""<mesh>
    <uri>meshes/body.obj</uri>{mark}
    <scale>{scales}</scale>
  </mesh>"""


def _body(unit: float) -> str:
    """Return a body of about 0.6 × 0.4 × 0.3 m in a unit of so many metres."""
    x, y, z = (side / unit for side in (0.6, 0.4, 0.3))
    return f"v 0 0 0\nv {x} 0 0\nv 0 {y} 0\nv 0 0 {z}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


_MARK = "  <!-- ^ MSH005 -->"
_POINT = "<sphere><radius>0.005</radius></sphere>"

GOOD = [
    {"@fragment": _rover(_mesh(1)), "meshes/body.obj": _body(1.0)},
    {"@fragment": _rover(_mesh(0.001)), "meshes/body.obj": _body(0.001)},
    {"@fragment": _rover(_mesh(1), _POINT), "meshes/body.obj": _body(1.0)},
    {"@fragment": _rover(_mesh(0.01), _POINT), "meshes/body.obj": _body(1.0)},
]
BAD = [
    {"@fragment": _rover(_mesh(1, _MARK)), "meshes/body.obj": _body(0.001)},
    {"@fragment": _rover(_mesh(1, _MARK)), "meshes/body.obj": _body(0.0254)},
    {"@fragment": _rover(_mesh(0.001, _MARK)), "meshes/body.obj": _body(1.0)},
]
