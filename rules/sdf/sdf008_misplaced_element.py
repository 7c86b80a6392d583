"""A known element in a place where it has no meaning.

Simulators look for an element only where the specification puts it, so here it is skipped:
`<enable_orientation>` directly below `<sensor>` does not reach the IMU. Elements that no place
knows are SDF003.

Fix: move it to where the message says.
Source: SDFormat specification, the version that the file states.
"""

from collections.abc import Mapping

from checker.model.schema import all_tags, parents_of
from checker.model.sdf.document import SdfDocument
from checker.rule import Findings, Severity, finding, rule

HARMLESS = {("air_pressure", "noise"), ("camera", "aspect_ratio")}
"""Parents and elements that accepted robots have: nothing is lost with them."""
_LISTED = 3


@rule("SDF008", "misplaced-element", Severity.ERROR)
def check(sdf: SdfDocument) -> Findings:
    """Report elements that this SDF version knows, but not below this parent."""
    belonging: dict[tuple[str, ...], str] = {}
    for element, kind in sdf.typed_elements:
        parent = element.parent
        if kind is not None or parent is None or element.tag not in all_tags(sdf.version):
            continue
        around = parent.parent.tag if parent.parent is not None else ""
        path = (around, parent.tag, element.tag)
        if path not in belonging:
            belonging[path] = _belongs(*path, parents_of(sdf.version))
        yield finding(
            element,
            f"<{element.tag}> means nothing in <{parent.tag}>{belonging[path]}",
            severity=Severity.WARNING if (parent.tag, element.tag) in HARMLESS else None,
            key=f"{parent.tag}/{element.tag}",
        )


def _belongs(around: str, parent: str, tag: str, parents: Mapping[str, tuple[str, ...]]) -> str:
    """Say where an element may stand: beside its place or around it, when it may."""
    places = parents.get(tag, ())
    near = [each for each in places if each == around or parent in parents.get(each, ())]
    listed = near or places
    if not listed or len(listed) > _LISTED:
        return ""
    named = (f"another <{each}>" if each == parent else f"<{each}>" for each in listed)
    return "; it belongs in " + " or ".join(named)


GOOD = [
    """
<sensor name="imu" type="imu">
  <imu>
    <enable_orientation>0</enable_orientation>
  </imu>
</sensor>
"""
]
BAD = [
    """
<sensor name="imu" type="imu">
  <enable_orientation>0</enable_orientation>  <!-- ^ SDF008 -->
</sensor>
""",
    """
<link name="arm">
  <mass>3</mass>  <!-- ^ SDF008 -->
</link>
""",
    """
<sensor name="barometer" type="air_pressure">
  <air_pressure>
    <noise type="gaussian"/>  <!-- ^ SDF008 -->
  </air_pressure>
</sensor>
""",
]
