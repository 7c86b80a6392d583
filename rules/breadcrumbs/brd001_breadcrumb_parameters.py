"""Breadcrumbs whose parameters differ from those of the challenge's robots.

Teams plan their network with the number in specifications.md, and robots carry 6 or 12.
Without `<disable_physics_time>` Gazebo simulates every dropped relay until the end, which slows the
run down. Without `<topic>` the plugin listens to a topic that no launch file bridges.

Fix: write `<topic>/model/#{_name}/breadcrumb/deploy</topic>`,
`<disable_physics_time>3.0</disable_physics_time>` and the `<max_deployments>` that
specifications.md gives.
Source: SubT reviews of breadcrumbs; all accepted robots with breadcrumbs carry 6 or 12
(`subt_standards.json`).
"""

from collections.abc import Iterator

from checker.model.breadcrumbs import Breadcrumbs, breadcrumbs
from checker.model.robot import Robot
from checker.model.specification.sensor_kinds import SensorKind
from checker.model.specification.sensors import ListedSensor
from checker.model.specification.sheet import Specification
from checker.package.package import Package
from checker.package.submissions import configuration_number
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

COUNTS = (6, 12)


@rule("BRD001", "breadcrumb-parameters", Severity.WARNING, Concern.INTERFACE)
def check(
    package: Package,
    robot: Robot,
    specification: Specification | None,
    *,
    counts: tuple[int, ...] = COUNTS,
) -> Findings:
    """Check the parameters of each Breadcrumbs plugin, and compare it with specifications.md.

    Options:
        counts: Numbers of breadcrumbs that a robot may carry, summed over all its plugins; any
            other number is reported.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    plugins = breadcrumbs(robot)
    expected = " or ".join(map(str, counts)) or "0"
    for plugin in plugins:
        yield from _missing_parameters(plugin, expected)
    numbers = [plugin.max_deployments for plugin in plugins if plugin.max_deployments is not None]
    if not numbers or len(numbers) < len(plugins):
        return
    total = sum(number.value for number in numbers)
    if total not in counts:
        yield finding(numbers[0], f"the robot carries {total:g} breadcrumbs, expected {expected}")
    for item in (
        [] if specification is None else _items(specification, configuration_number(package.name))
    ):
        if item.count != total:
            yield finding(
                item,
                f"specifications.md lists {item.count} breadcrumbs, but the robot carries "
                f"{total:g}",
                related=[(number, "stated here") for number in numbers],
            )


def _missing_parameters(plugin: Breadcrumbs, counts: str) -> Iterator[Finding]:
    """Report what a plugin does not state."""
    expected = {
        "topic": (plugin.topic, "the topic that drops a breadcrumb"),
        "max_deployments": (plugin.max_deployments, f"{counts}; without it there is no limit"),
        "disable_physics_time": (plugin.disable_physics_time, "3.0 (seconds)"),
    }
    for tag, (value, meaning) in expected.items():
        if value is None:
            message = f"Breadcrumbs has no <{tag}>: expected {meaning}"
            yield finding(plugin, message, key=f"no {tag}")


def _items(sheet: Specification, number: int | None) -> list[ListedSensor]:
    """Return what the sheet lists for a configuration, when all of it states one number."""
    items = [
        item
        for item in sheet.sensors
        if item.kind is SensorKind.BREADCRUMBS
        and item.count is not None
        and (not item.configurations or number in item.configurations)
    ]
    return items[:1] if len({item.count for item in items}) == 1 else []


def _crumbs(number: str, mark: str = "", more: str = "", start: str = "") -> str:
    return f"""
<plugin filename="libignition-gazebo-breadcrumbs-system.so"
        name="ignition::gazebo::systems::Breadcrumbs">{start}
  <topic>/model/r/breadcrumb/deploy</topic>
  <max_deployments>{number}</max_deployments>{mark}{more}
</plugin>
"""


_TIME = "<disable_physics_time>3.0</disable_physics_time>"
_SHEET = "# Rover\n### Sensors\n"
_MARK = " <!-- ^ BRD001 -->"

GOOD = [
    _crumbs("12", more=_TIME),
    {
        "@fragment": _crumbs("6", more=_TIME),
        "specifications.md": f"{_SHEET}* 12 communication breadcrumbs in sensor configuration 2\n",
    },
    _crumbs("6", more=_TIME) + _crumbs("6", more=_TIME),
]
BAD = [
    _crumbs("7", _MARK, _TIME),
    f'<plugin filename="libp.so" name="ignition::gazebo::systems::Breadcrumbs"/>{_MARK}',
    {
        "@fragment": _crumbs("6", more=_TIME),
        "specifications.md": f"{_SHEET}* 12 communication breadcrumbs.{_MARK}\n",
    },
]
