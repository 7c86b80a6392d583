"""A link or joint with the robot's name before its own.

Gazebo 9 needed names such as `X1/base_link` to tell robots apart. Ignition Gazebo keeps the names
of one robot apart from those of another by itself, and the simulator renames the robot when it
spawns it, so the old prefix is wrong in every frame and topic that is made of it.
No accepted package at hand shows it.

Fix: remove the prefix from links and joints, and wherever they are named: joints' ends, plugins,
launch files.
Source: Model Migration Guide, step 2: "Before converting to SDF, remove namespaces from link names.
Eg., X1/base_link becomes base_link."
"""

from collections.abc import Iterator

from checker.model.components import Joint, Link
from checker.model.robot import Robot
from checker.rule import Findings, Severity, finding, rule

_NAMED = {Link: "link", Joint: "joint"}


@rule("SDF011", "name-with-prefix", Severity.WARNING)
def check(robot: Robot) -> Findings:
    """Report names with a slash: as errors when all links have one and the same prefix."""
    if robot.format != "sdf":
        return  # In URDF files for RViz the prefix is asked for.
    prefixes = {_prefix(link) for link in robot.links}
    everywhere = len(prefixes) == 1 and "" not in prefixes
    for part in _parts(robot):
        if prefix := _prefix(part):
            of_all = everywhere and prefix in prefixes
            yield finding(
                part.name,
                f"every link has the prefix {prefix + '/'!r}"
                if of_all
                else f"{_NAMED[type(part)]} {part.name.value!r} has the prefix {prefix + '/'!r}",
                severity=Severity.ERROR if of_all else None,
            )


def _parts(robot: Robot) -> Iterator[Link | Joint]:
    yield from robot.links
    yield from robot.joints


def _prefix(part: Link | Joint) -> str:
    """Return what stands before the first slash of a name."""
    before, slash, behind = part.name.value.partition("/")
    return before if slash and behind else ""


GOOD = ['<link name="arm"/>']
BAD = [
    '<link name="X1/arm"/>  <!-- ^ SDF011 -->',
    """
<sdf version="1.6">
  <model name="x1">
    <link name="X1/base_link"/>  <!-- ^ SDF011 -->
    <link name="X1/arm"/>  <!-- ^ SDF011 -->
    <joint name="X1/hinge" type="fixed">  <!-- ^ SDF011 -->
      <parent>X1/base_link</parent>
      <child>X1/arm</child>
    </joint>
  </model>
</sdf>
""",
]
