"""The robot to judge where launch files make several of one xacro file.

One may show it in RViz and another one start it in Gazebo, with a plugin that only then is there.
Rules about drives, wheels and controllers need the latter, whatever the launch files are called.
"""

from __future__ import annotations

from collections.abc import Sequence

from checker.formats.xacro.expansion import Expander, Expansions, Wanted
from checker.package.package import Package
from checker.source.xml import XmlDocument


def fullest(
    package: Package,
    expander: Expander,
    made: tuple[Wanted, XmlDocument],
    wishes: Sequence[Wanted],
) -> tuple[Wanted, XmlDocument]:
    """Return the robot with most plugins, those of ros2_control among them; else the first.

    Args:
        package: The package of the file.
        expander: Expands it.
        made: What is expanded, and the result.
        wishes: What other launch files make of the file.
    """
    outcomes = Expansions(package, wishes, expander).outcomes()
    others = [
        (wish, outcome)
        for wish, outcome in zip(wishes, outcomes, strict=True)
        if isinstance(outcome, XmlDocument)
    ]
    return max((made, *others), key=_plugins)


def _plugins(made: tuple[Wanted, XmlDocument]) -> int:
    return sum(1 for _ in made[1].root.descendants("plugin"))
