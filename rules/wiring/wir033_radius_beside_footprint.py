"""A costmap of Nav2 has a `robot_radius` and a `footprint`: only the footprint counts.

The costmap reads `robot_radius` only if `footprint` is empty. A later change of the radius has no
effect, and often the two describe different robots: one of them was left from a template.

It is a warning if the radius differs by more than 20 % from the distance of the farthest corner of
the footprint, else an info.

Fix: remove `robot_radius`, or `footprint` where the circle is meant.
Source: navigation2, nav2_costmap_2d, `Costmap2DROS::getParameters`: `use_radius_`.
"""

import math
import re

from checker.model.ros_parameters import Parameter
from checker.package.package import Package
from checker.ros.wiring.costmaps import costmap_blocks
from checker.rule import Concern, Findings, Severity, finding, rule

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@rule("WIR033", "radius-beside-footprint", Severity.INFO, Concern.INTERFACE)
def check(package: Package, *, part: float = 0.2) -> Findings:
    """Report the radius of a costmap that also has a footprint.

    Options:
        part: Part by which the radius may differ from the distance of the farthest corner.
    """
    for costmap in costmap_blocks(package):
        radius, footprint = costmap.get("robot_radius"), costmap.get("footprint")
        stated = radius.number if radius is not None else None
        corner = _farthest(footprint) if footprint is not None else 0.0
        if radius is None or stated is None or not corner:
            continue
        differs = not (1 - part) * corner <= stated.value <= (1 + part) * corner
        yield finding(
            stated,
            f"robot_radius {stated.value:g} m of {costmap.block.node} has no effect beside "
            f"footprint, whose corners are up to {corner:.3g} m from the base: remove one",
            severity=Severity.WARNING if differs else None,
        )


def _farthest(footprint: Parameter) -> float:
    """Return the greatest distance of a corner, m; 0 if the footprint is no polygon."""
    text = footprint.texts[0].value if footprint.texts else ""
    numbers = [float(it) for it in _NUMBER.findall(text)]
    corners = list(zip(numbers[::2], numbers[1::2], strict=False))
    is_polygon = len(numbers) % 2 == 0 and len(corners) > 2
    return max(math.hypot(*corner) for corner in corners) if is_polygon else 0.0


def _costmap(parameters: str) -> dict[str, object]:
    yaml = "local_costmap:\n  local_costmap:\n    ros__parameters:\n"
    return {"@bridge": True, "config/nav2.yaml": f"{yaml}{parameters}"}


_RADIUS = "      robot_radius: {}\n"
_FOOTPRINT = '      footprint: "[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]"\n'
GOOD = [
    _costmap(_FOOTPRINT),
    _costmap(_RADIUS.format("0.36")),
    _costmap(_RADIUS.format("0.36") + '      footprint: "[]"\n'),
]
BAD = [
    _costmap(_FOOTPRINT + _RADIUS.format("0.36  # ^ WIR033")),
    _costmap(_FOOTPRINT + _RADIUS.format("0.1  # ^ WIR033")),
]
