"""A shape with a length of zero or less.

Physics engines refuse such a shape, drop it, or compute contacts that explode. A negative scale
mirrors a mesh: this is useful for a visual, but the surface of a collision becomes inside out. No
accepted package that we checked has this fault.

A visual whose size or scale is zero along one axis is shown flat, and may be meant so, as a picture
on the ground: this is a warning. A ball of radius 0 as a collision touches nothing, and the engines
take it: this is an info.

Fix: write the length in metres as a positive number; mirror a mesh in the mesh file.
Source: SDFormat specification, geometry: lengths are above 0.
"""

from collections.abc import Iterator, Sequence

from checker.formats.corrections import rewrite
from checker.model.geometry.shapes import Geometry
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located

_LENGTHS = ("height", "length", "radii", "radius", "scale", "size")
_ALONG_AXES = ("scale", "size")


@rule("GEO008", "non-positive-size", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report lengths that are not above 0; mirrored collisions, flat visuals are warnings.

    A collision that is a ball of radius 0 is an info.
    """
    for link in robot.links:
        for collision in link.collisions:
            whose = f"{collision.name.value!r} of {link.name.value!r}"
            yield from _lengths(collision.geometry, whose, touches=True)
        for visual in link.visuals:
            whose = f"{visual.name.value!r} of {link.name.value!r}"
            yield from _lengths(visual.geometry, whose, touches=False)


def _lengths(geometry: Geometry, whose: str, *, touches: bool) -> Iterator[Finding]:
    for name in _LENGTHS:
        numbers = geometry.sizes.get(name, ())
        flat = not touches and name in _ALONG_AXES and _is_flat(numbers)
        for number in numbers:
            mirrored = name == "scale" and number.value < 0
            if not number.value <= 0 or (mirrored and not touches):
                continue
            point = touches and geometry.shape == "sphere" and number.value == 0
            plain = Severity.INFO if point else Severity.ERROR
            yield finding(
                number,
                f"{name} of {geometry.shape} {whose} is {number.value:g}, expected more than 0"
                + (": the mesh is mirrored" if mirrored else "")
                + (": it touches nothing" if point else ""),
                severity=Severity.WARNING if mirrored or flat else plain,
                key="mirrored" if mirrored else "",
                fix=rewrite([(number, -number.value)]) if number.value and not mirrored else None,
            )


def _is_flat(numbers: Sequence[Located[float]]) -> bool:
    """Return whether a shape has no length along one axis alone."""
    lengths = [number.value for number in numbers]
    return lengths.count(0) == 1 and all(length > 0 for length in lengths if length)


def _box(size: str) -> str:
    return f"""
<visual name="v">
  <geometry>
    <box><size>{size}
  </geometry>
</visual>
"""


_END = "</size></box>"
_MIRRORED = """
<{0} name="c"><geometry><mesh>
  <uri>meshes/wheel.dae</uri>
  <scale>1 -1 1</scale>{1}
</mesh></geometry></{0}>
"""
GOOD = [_box(f"1 1 0.001{_END}"), "<visual name='v'/>", _MIRRORED.format("visual", "")]
BAD = [
    _box(f"0.3 0.2 0{_END}  <!-- ^ GEO008 -->"),
    _box(f"0.3 -0.2 0.1{_END}  <!-- ^ GEO008 -->"),
    """
<collision name="c"><geometry><cylinder>
  <radius>-0.02</radius>  <!-- ^ GEO008 -->
  <length>0.4</length>
</cylinder></geometry></collision>
""",
    _MIRRORED.format("collision", "  <!-- ^ GEO008 -->"),
    """
<collision name="c"><geometry><sphere>
  <radius>0</radius>  <!-- ^ GEO008 -->
</sphere></geometry></collision>
""",
]
