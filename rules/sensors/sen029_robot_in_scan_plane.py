"""A planar lidar sees a part of its own robot.

A post, a wheel or the bracket of a camera in the plane of the scan is an obstacle at the same angle
and distance wherever the robot goes: the costmap is never free there, and mapping draws a trail of
it. It takes few rays, so that SEN019 does not report it. Parts nearer than `<range><min>` give no
reading. No planar lidar of the accepted packages that we checked sees its own robot. Lidars of
several rows often do, and programs that use them filter these points.

The rule casts up to 576 rays over the scan at the robot's visuals, with all joints in their initial
position; those of a lidar of Gazebo Classic without GPU (`type="ray"`) at its collisions.

Fix: move the lidar above or below the part, narrow `<horizontal>` so that the scan leaves it out,
or set `<range><min>` beyond it.
Source: Gazebo renders a GPU lidar from the robot's visuals, and Classic's `RaySensor` asks the
physics engine; costmap_2d, obstacle layer: each reading within its range marks an obstacle.
"""

import math
from collections.abc import Iterator

from checker.model.sensing.lidar import Lidar
from checker.model.sensing.view import Hit, SensorViews, View
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

_SINGLE = 1
"""Horizontal samples of a range finder, such as a cliff sensor."""


@rule("SEN029", "robot-in-scan-plane", Severity.WARNING, Concern.INTERFACE)
def check(seen: SensorViews, *, most: float = 0.3) -> Findings:
    """Report lidars of one row with rays that end at the robot.

    Options:
        most: Share of the rays that may end at the robot before SEN019 reports the lidar instead.
    """
    planar = [view for view in seen.views if _is_planar(view.mounted.sensor.lidar)]
    for view in planar:
        if view.filled and view.hidden_share <= most:
            yield _finding(view)
    if planar and seen.unseen:
        yield unchecked(seen.unseen[0])


def _is_planar(lidar: Lidar | None) -> bool:
    if lidar is None:
        return False
    return lidar.vertical.samples.value <= 1 and lidar.horizontal.samples.value > _SINGLE


def _finding(view: View) -> Finding:
    sensor = view.mounted.sensor
    nearest = min(view.filled, key=lambda hit: hit.metres)
    parts = "; ".join(_parts(view))
    return finding(
        sensor.pose,
        f"lidar {sensor.name.value!r} sees the robot itself in {view.hidden_share:.1%} "
        f"of its rays, expected none: {parts}",
        related=[(nearest.by[1], f"this {nearest.by[1].element.tag}")],
    )


def _parts(view: View) -> Iterator[str]:
    """Yield each link that is seen, with the angle and distance of what is nearest of it."""
    nearest: dict[str, Hit] = {}
    for hit in sorted(view.filled, key=lambda hit: hit.metres):
        nearest.setdefault(hit.by[0].name.value, hit)
    for name, hit in nearest.items():
        yield f"{name!r} at {math.degrees(hit.azimuth):.0f}°, {hit.metres:.3g} m away"


def _robot(post: str, minimum: float = 0.1, rows: int = 1, mark: str = "") -> str:
    return f"""
<link name="post">
  <pose>{post} 0 0 0</pose>
  <visual name="v">
    <geometry><cylinder><radius>0.008</radius><length>0.3</length></cylinder></geometry>
  </visual>
</link>
<link name="head">
  <sensor name="scan" type="gpu_lidar">
    <pose>0 0 0.2 0 0 0</pose>{mark}
    <lidar>
      <scan>
        <horizontal>
          <samples>720</samples><min_angle>-3.14159</min_angle><max_angle>3.14159</max_angle>
        </horizontal>
        <vertical>
          <samples>{rows}</samples><min_angle>0</min_angle><max_angle>{0.01 * rows}</max_angle>
        </vertical>
      </scan>
      <range><min>{minimum}</min><max>10</max></range>
    </lidar>
  </sensor>
</link>
"""


_MARK = "  <!-- ^ SEN029 -->"


def _classic(shape: str, mark: str = "") -> object:
    robot = _robot("0.2 0.1 0.2", mark=mark).replace("visual", shape)
    ray = (
        robot.replace("gpu_lidar", "ray").replace("<lidar>", "<ray>").replace("</lidar>", "</ray>")
    )
    return {"@profile": "gazebo-classic", "@fragment": ray}


GOOD = [
    _classic("visual"),
    # Below the plane, nearer than the range, and a lidar of many rows.
    _robot("0.2 0.1 -0.2"),
    _robot("0.2 0.1 0.2", minimum=0.3),
    _robot("0.2 0.1 0.2", rows=16),
]
BAD = [
    _robot("0.2 0.1 0.2", mark=_MARK),
    _robot("-0.3 0 0.2", mark=_MARK),
    _classic("collision", _MARK),
]
