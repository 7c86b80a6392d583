"""A light inside a body, without a lamp or without a range, or too many lights.

A light with shadows inside a visual lights up only that visual: the robot drives in the dark. In a
concave mesh, the light is reported if the mesh blocks its beam and nearly all directions. A light
without shadows shines through the body, and a light without a lamp has no visible source. The cause
of both is usually a pose with a wrong sign or frame. Without a stated range, a lamp ends at 10 m.
Gazebo computes every light for every pixel of every camera, so a team of robots with many lights
slows down the whole run; their number is an info.

Fix: put the light just in front of its lamp's visual, state `<attenuation><range>`, and use at most
six lights.
Source: SDFormat specification, light (attenuation/range: 10 by default); the robots of 18 accepted
packages have up to six lights, each within 8 cm of a visual.
"""

from collections.abc import Iterator
from itertools import islice

from checker.model.components import Light, Visual
from checker.model.geometry.boxes import Box
from checker.model.geometry.convex import face_directions, overlap_depth
from checker.model.geometry.interpenetration import is_convex
from checker.model.geometry.placed_shapes import Placed, place_shapes
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.model.sensing.view import CoveredLight, SensorViews
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked

_PLACED = 60
"""Greatest number of lights whose places are checked; more are reported as too many."""


@rule("SEN020", "light-placement", Severity.WARNING, Concern.ROBOT)
def check(
    seen: SensorViews,
    *,
    most: int = 6,
    nearest: float = 0.1,
    deepest: float = 0.05,
    deepest_with_shadows: float = 0.01,
    covered: float = 0.9,
) -> Findings:
    """Count the lights, and check their distance to visuals and depth inside them.

    Options:
        most: Number of lights that a robot may have; more are reported as too many.
        nearest: Metres from a light to the box around the nearest visual; a light farther away has
            no lamp and is reported.
        deepest: Metres that a light without shadows may be inside an opaque, convex visual; more is
            reported.
        deepest_with_shadows: Metres that a light with shadows may be inside an opaque, convex
            visual; more is reported.
        covered: Share of all directions, and of its beam, in which an opaque, concave mesh may
            stand in the way of a light with shadows; more is reported.
    """
    robot = seen.robot
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    lights = [(link, light) for link in robot.links for light in link.lights]
    if not lights:
        return
    if len(lights) > most:
        yield finding(
            lights[most][1],
            f"the robot has {len(lights)} lights, expected {most} or fewer",
            severity=Severity.INFO,
            related=[(light, "another light") for _, light in lights[most + 1 :]],
        )
    yield from _without_range(light for _, light in lights)
    visuals = [piece for link in robot.links for piece in place_shapes(robot, link, link.visuals)]
    enclosed = {at.light: at for at in seen.covered if min(at.around, at.ahead) > covered}
    for link, light in islice(lights, _PLACED):
        pose = robot.pose_of_part(link, light.pose)
        if pose is None or light.type == "directional":
            continue
        place = pose.translation
        limit = deepest_with_shadows if light.casts_shadows else deepest
        deep = [visual for visual in visuals if _is_inside(robot, visual, place, limit)]
        if deep:
            yield _light_in_visual(light, deep[0], limit)
        elif light in enclosed:
            yield _covered_light(enclosed[light])
        else:
            yield from _light_without_lamp(robot, light, place, visuals, nearest)


def _without_range(lights: Iterator[Light]) -> Iterator[Finding]:
    for light in lights:
        attenuation = light.attenuation
        if light.type == "directional" or (attenuation is not None and attenuation.range.stated):
            continue
        yield finding(
            light if attenuation is None else attenuation,
            f"light {light.name.value!r} states no <attenuation><range>, so it ends at 10 m",
            key="no range",
        )


def _is_inside(robot: Robot, visual: Placed, place: Vector, limit: float) -> bool:
    """Return whether a point is deeper than a limit in a visual; concave ones do not count."""
    if visual.box.gap(Box(place, place)) > 0.0 or not is_convex(robot, visual):
        return False
    if isinstance(visual.shape, Visual) and visual.shape.is_see_through:
        return False

    def point(direction: Vector) -> float:
        return sum(a * b for a, b in zip(direction, place, strict=True))

    def reach(direction: Vector) -> float:
        return visual.support(robot, direction)

    start = list(face_directions(visual.pose.rotation, visual.pose.rotation))
    return overlap_depth(reach, point, start, limit) > limit


def _light_in_visual(light: Light, visual: Placed, limit: float) -> Finding:
    position = (
        "which blocks its light, because it casts shadows"
        if light.casts_shadows
        else "where it is not visible"
    )
    return finding(
        light,
        f"light {light.name.value!r} is more than {limit:g} m inside visual "
        f"{visual.shape.name.value!r}, {position}; expected it in front of its lamp",
        related=[(visual.shape, "the visual around it")],
    )


def _covered_light(at: CoveredLight) -> Finding:
    return finding(
        at.light,
        f"light {at.light.name.value!r} is inside visual {at.visual.name.value!r}, which blocks "
        f"{at.ahead:.0%} of its beam and {at.around:.0%} of all directions, because it casts "
        "shadows; expected it in front of its lamp",
        related=[(at.visual, "the visual around it")],
    )


def _light_without_lamp(
    robot: Robot, light: Light, place: Vector, visuals: list[Placed], nearest: float
) -> Iterator[Finding | Unchecked]:
    here = Box(place, place)
    gap = min((visual.box.gap(here) for visual in visuals), default=None)
    if gap is not None and gap <= nearest:
        return
    unknown = next((use for use in robot.mesh_uses if not use.is_collision and not use.mesh), None)
    if unknown is not None:
        # A mesh that is missing will stand there again once its path is mended.
        yield unchecked(f"the size of {unknown.uri.value} is not known")
        return
    away = "the robot has no visual" if gap is None else f"the nearest visual is {gap:.3g} m away"
    yield finding(
        light,
        f"light {light.name.value!r} has no lamp: {away}, expected one within {nearest:g} m",
    )


def _light(
    pose: str, more: str = "<attenuation><range>20</range></attenuation>", mark: str = ""
) -> str:
    return f"""
  <light name="lamp" type="spot">{mark}
    <pose>{pose}</pose>
    {more}
  </light>
"""


def _link(lights: str, visual: str = "") -> str:
    return f"""
<link name="mast">
  <visual name="hull">
    {visual}
    <geometry><box><size>0.4 0.4 0.4</size></box></geometry>
  </visual>{lights}
</link>
"""


def _elbow() -> str:
    """Return an OBJ file: an L of three cubes with sides of 0.2 m, without the sides they share."""
    outline = [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 1)]
    points = [(x, y, z) for z in (0, 1) for x, y in outline]
    number = {point: n for n, point in enumerate(points, 1)}
    faces = []
    for (x, y), (u, v) in zip(outline, [*outline[1:], outline[0]], strict=True):
        faces.append([(x, y, 0), (u, v, 0), (u, v, 1), (x, y, 1)])
    for x, y in ((0, 0), (1, 0), (0, 1)):
        square = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
        faces.append([(*corner, 1) for corner in square])
        faces.append([(*corner, 0) for corner in reversed(square)])
    lines = [f"v {x / 5} {y / 5} {z / 5}" for x, y, z in points]
    lines += [f"f {' '.join(str(number[corner]) for corner in face)}" for face in faces]
    return "\n".join(lines) + "\n"


def _in_elbow(pose: str, more: str, mark: str = "", visual: str = "") -> dict[str, str]:
    mesh = "<geometry><mesh><uri>meshes/elbow.obj</uri></mesh></geometry>"
    beam = "<direction>1 0 0</direction><spot><outer_angle>1</outer_angle></spot>"
    light = _light(pose, more + beam, mark)
    body = f'<link name="mast"><visual name="elbow">{visual}{mesh}</visual>{light}</link>'
    return {"@fragment": body, "meshes/elbow.obj": _elbow()}


_MARK = "  <!-- ^ SEN020 -->"
_RANGE = "<attenuation><range>20</range></attenuation>"
_SHADOWS = f"{_RANGE}<cast_shadows>1</cast_shadows>"
_OTHERS = "\n".join(
    f'<light name="{number}" type="point"><pose>0.2 0 0 0 0 0</pose>'
    "<attenuation><range>9</range></attenuation></light>"
    for number in range(6)
)
GOOD = [
    _link(_light("0.21 0 0 0 0 0")),
    _link(_light("0.18 0 0 0 0 0")),
    _link(_light("0.21 0 0 0 0 0", _SHADOWS)),
    _link(_light("0 0 0 0 0 0"), "<transparency>0.8</transparency>"),
    _link(_OTHERS),
    _link('<light name="sun" type="directional"><pose>0 0 9 0 0 0</pose></light>'),
    # Between the legs of an L, and in one of them with nothing to stop the light.
    _in_elbow("0.3 0.3 0.1 0 0 0", _SHADOWS),
    _in_elbow("0.3 0.1 0.1 0 0 0", _RANGE),
    _in_elbow("0.3 0.1 0.1 0 0 0", _SHADOWS, visual="<transparency>0.8</transparency>"),
]
BAD = [
    _link(_light("0.1 0 0 0 0 0", mark=_MARK)),
    _link(_light("0.18 0 0 0 0 0", _SHADOWS, _MARK)),
    _link(_light("0.5 0 0 0 0 0", mark=_MARK)),
    _light("0 0 0 0 0 0", mark=_MARK),
    _link(f'<light name="lamp" type="spot">{_MARK}<pose>0.2 0 0 0 0 0</pose></light>'),
    _link(_light("0.2 0 0 0 0 0", f"<attenuation>{_MARK}</attenuation>")),
    _link(_OTHERS + _light("0.2 0 0 0 0 0", mark=_MARK)),
    _in_elbow("0.3 0.1 0.1 0 0 0", _SHADOWS, _MARK),
]
