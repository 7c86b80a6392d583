"""A drive limit that differs from another configuration of the same robot.

Configurations of one robot differ in their sensors, but they are the same vehicle and drive alike.
Authors often correct a limit in one package and forget the others. No accepted package that we
checked has this fault.

Fix: use the same limits in every configuration; if the sensors make a vehicle slower, say so in
specifications.md.
Source: SubT review practice.
"""

from collections.abc import Iterator

from checker.model.first_configuration import FirstConfiguration
from checker.model.locomotion.motion_limits import bounded_motions, is_unlimited
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located

_Name = tuple[str, str, str, str, int]


@rule("DRV006", "limits-differ-between-configurations", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, first: FirstConfiguration, *, tolerance: float = 0.001) -> Findings:
    """Compare the limits with those of the first available configuration.

    Options:
        tolerance: Share of the larger figure by which a limit may differ from that of the first
            configuration; more is reported.
    """
    reasons = (
        robot.unread_plugins,
        first.robot.unread_plugins and f"in {first.name}, {first.robot.unread_plugins}",
    )
    for reason in filter(None, reasons):
        yield unchecked(reason)
    before = dict(_limits(first.robot))
    for name, limit in _limits(robot):
        other = before.get(name)
        plugin, axis, end, quantity, _ = name
        if other is None or _close(limit, other, tolerance):
            continue
        yield finding(
            limit,
            f"{end} {axis} {quantity} of {plugin} is {limit.value:g}, but {first.name} has "
            f"{other.value:g}",
        )


def _limits(robot: Robot) -> Iterator[tuple[_Name, Located[float]]]:
    """Yield every limit by plugin, axis, end and quantity, and the number of the plugin."""
    plugins: dict[object, int] = {}
    for motion in bounded_motions(robot.locomotion):
        number = plugins.setdefault(motion.plugin, len(plugins))
        for quantity, unit, ends in () if motion.both_kinds else motion.quantities:
            # The minima of a multicopter are its maxima.
            for end, limit in zip(("minimum", "maximum"), ends, strict=True):
                if limit is not None and not (motion.flies and end == "minimum"):
                    what = f"{quantity} ({unit})"
                    yield (motion.plugin.class_name, motion.name, end, what, number), limit


def _close(one: Located[float], other: Located[float], tolerance: float) -> bool:
    if is_unlimited(one) or is_unlimited(other):
        return is_unlimited(one) and is_unlimited(other)
    size = max(abs(one.value), abs(other.value))
    return abs(one.value - other.value) <= tolerance * size


_NAME = "acme_rover_sensor_config_"
_FIRST = f"../{_NAME}1/"


def _drive(velocity: str, mark: str = "", name: str = "DiffDrive") -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::{name}">
  <max_velocity>{velocity}</max_velocity>{mark}
</plugin>
"""


def _model(drive: str) -> str:
    return f"""<sdf version="1.6">
<model name="acme_rover_sensor_config_1"><link name="base_link"/>{drive}</model>
</sdf>
"""


def _pair(own: str, other: str) -> dict[str, str]:
    return {
        "@name": f"{_NAME}2",
        "@fragment": own,
        f"{_FIRST}package.xml": "<package/>",
        f"{_FIRST}model.sdf": _model(other),
        f"{_FIRST}launch/spawner.rb": "def spawner(a, b, c, d, e, f, g, h, i)\n  ''\nend\n",
    }


_MARK = "  <!-- ^ DRV006 -->"

GOOD = [
    _pair(_drive("1"), _drive("1.0")),
    _pair(_drive("1"), _drive("2", name="AckermannSteering")),
    _pair(_drive("inf"), _drive("1e16")),
    _drive("1"),
]
BAD = [
    _pair(_drive("1", _MARK), _drive("2")),
    _pair(_drive("1", _MARK), _drive("inf")),
]
