"""A planar lidar sees a part of its own robot.

A post, a wheel or the bracket of a camera in the plane of the scan is an obstacle at the same angle
and distance wherever the robot goes: the costmap is never free there, and mapping draws a trail of
it. It takes few rays, so that SEN019 does not report it. Parts nearer than `<range><min>` give no
reading. No planar lidar of the accepted packages that we checked sees its own robot. Lidars of
several rows often do, and programs that use them filter these points.

What the plane only touches, such as the edge of a post that ends there, is not reported. A level
lidar in the plane of the ground, where the wheels touch it, is: it sees the ground at every bump.

It is an info where a launch file starts a node that filters scans, such as those of laser_filters.

The rule casts up to 576 rays over the scan at the robot's visuals, with all joints in their initial
position; those of a lidar of Gazebo Classic without GPU (`type="ray"`) at its collisions.

Fix: move the lidar above or below the part, and off the ground; narrow `<horizontal>` so that the
scan leaves the part out, or set `<range><min>` beyond it.
Source: Gazebo renders a GPU lidar from the robot's visuals, and Classic's `RaySensor` asks the
physics engine; costmap_2d, obstacle layer: each reading within its range marks an obstacle.
"""

import math
import re
from collections.abc import Iterator, Sequence

from checker.launch.ros2.graph import Node, Ros2Launch
from checker.model.locomotion.rolling_parts import rolling_parts
from checker.model.robot import Robot
from checker.model.sensing.lidar import Lidar
from checker.model.sensing.mounts import Mounted
from checker.model.sensing.view import Hit, SensorViews
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.rulebook.example_parts import ball_wheel

_DEEP = 0.002
"""Metres that a shape reaches beyond the plane of the scan, at least, to both sides."""
_ON_GROUND = 0.01
"""Metres between a level scan and the ground, at most."""
_LEVEL = 0.99
"""Part along z of the axis of a level lidar, at least."""
_FLAT = 0.01
"""Elevation of the rays, radians, below which the scan is a plane."""
_FILTER = re.compile(r"(?:laser|scan)_?filter")
"""Names of packages and programs that take readings out of scans."""
_SINGLE = 1
"""Horizontal samples of a range finder, such as a cliff sensor."""


@rule("SEN029", "robot-in-scan-plane", Severity.WARNING, Concern.INTERFACE)
def check(seen: SensorViews, launch: Ros2Launch | None, *, most: float = 0.3) -> Findings:
    """Report lidars of one row with rays that end at the robot.

    Options:
        most: Share of the rays that may end at the robot before SEN019 reports the lidar instead.
    """
    planar = [view for view in seen.views if _is_planar(view.mounted.sensor.lidar)]
    ground = min((part.box.low[2] for part in rolling_parts(seen.robot)), default=None)
    for view in planar:
        cut = [hit for hit in view.filled if _is_cut(seen.robot, view.mounted, hit)]
        if ground is not None and _is_on_ground(view.mounted, ground):
            yield _on_ground(view.mounted)
        elif cut and view.hidden_share <= most:
            yield _finding(view.mounted, cut, _scan_filter(launch))
    if planar and seen.unseen:
        yield unchecked(seen.unseen[0])


def _is_cut(robot: Robot, mounted: Mounted, hit: Hit) -> bool:
    """Return whether a shape is on both sides of a scan's plane, not at its edge."""
    link, shape = hit.by
    pose = robot.pose_of_part(link, shape.pose)
    if pose is None or not _is_flat(mounted):
        return True
    up = mounted.pose.rotate((0.0, 0.0, 1.0))
    height = sum(a * b for a, b in zip(up, mounted.pose.translation, strict=True))
    above = robot.support_of(shape.geometry, pose, up)
    below = robot.support_of(shape.geometry, pose, (-up[0], -up[1], -up[2]))
    if above is None or below is None:
        return True
    return min(above - height, below + height) > _DEEP


def _is_flat(mounted: Mounted) -> bool:
    """Return whether the scan is a plane, not a cone."""
    lidar = mounted.sensor.lidar
    return lidar is not None and abs(lidar.vertical.middle) < _FLAT


def _is_on_ground(mounted: Mounted, ground: float) -> bool:
    is_level = abs(mounted.pose.rotate((0.0, 0.0, 1.0))[2]) >= _LEVEL
    height = mounted.pose.translation[2] - ground
    return is_level and _is_flat(mounted) and abs(height) <= _ON_GROUND


def _on_ground(mounted: Mounted) -> Finding:
    return finding(
        mounted.sensor.pose,
        f"the scan of lidar {mounted.sensor.name.value!r} is in the plane of the ground, where the "
        f"wheels touch it, and sees the ground as an obstacle: mount the lidar higher",
    )


def _is_planar(lidar: Lidar | None) -> bool:
    if lidar is None:
        return False
    return lidar.vertical.samples.value <= 1 and lidar.horizontal.samples.value > _SINGLE


def _scan_filter(launch: Ros2Launch | None) -> Node | None:
    """Return a node of the launch files that filters scans, if there is one."""
    nodes = launch.nodes if launch is not None else ()
    return next((it for it in nodes if any(map(_FILTER.search, it.program))), None)


def _finding(mounted: Mounted, hits: Sequence[Hit], filtering: Node | None) -> Finding:
    sensor = mounted.sensor
    nearest = min(hits, key=lambda hit: hit.metres)
    share, parts = sum(hit.share for hit in hits), "; ".join(_parts(hits))
    name = filtering.executable.value if filtering is not None else ""
    removed = f" ({name} has to remove them)" if name else ""
    return finding(
        sensor.pose,
        f"lidar {sensor.name.value!r} sees the robot itself in {share:.1%} "
        f"of its rays, expected none: {parts}{removed}",
        severity=Severity.INFO if filtering is not None else None,
        related=[(nearest.by[1], f"this {nearest.by[1].element.tag}")],
    )


def _parts(hits: Sequence[Hit]) -> Iterator[str]:
    """Yield each link that is seen, with the angle and distance of what is nearest of it."""
    nearest: dict[str, Hit] = {}
    for hit in sorted(hits, key=lambda hit: hit.metres):
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


def _on_wheels(z: float, mark: str = "") -> str:
    """Return a robot on two wheels whose lidar is at a height."""
    wheels = "".join(
        ball_wheel(f"{side}_wheel", 0.0, y) for side, y in (("left", 0.3), ("right", -0.3))
    )
    return _robot("0.2 0.1 2", mark=mark).replace("0 0 0.2 0 0 0", f"0 0 {z} 0 0 0") + wheels


GOOD = [
    _on_wheels(0.2),
    # The post ends in the plane.
    _robot("0.2 0.1 0.0505"),
    _classic("visual"),
    # Below the plane, nearer than the range, and a lidar of many rows.
    _robot("0.2 0.1 -0.2"),
    _robot("0.2 0.1 0.2", minimum=0.3),
    _robot("0.2 0.1 0.2", rows=16),
]
BAD = [
    _robot("0.2 0.1 0.2", mark=_MARK),
    _robot("-0.3 0 0.2", mark=_MARK),
    _on_wheels(-0.1, _MARK),
    _classic("collision", _MARK),
]
