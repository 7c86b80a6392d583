"""A link or joint with the robot's name as a prefix.

Gazebo 9 needed names such as `X1/base_link` to distinguish robots. Ignition Gazebo separates the
names of robots itself, and the simulator renames the robot when it spawns it. The old prefix is
then wrong in every frame and topic. Prefixes that differ from link to link are names of parts, such
as `front/left_wheel`, unless one is the model's own name. No accepted package that we checked has
this fault.

Fix: remove the prefix from links and joints, and wherever they are used: joints' ends, plugins,
launch files.
Source: Model Migration Guide, step 2: "Before converting to SDF, remove namespaces from link names.
Eg., X1/base_link becomes base_link."
"""

from collections import Counter
from collections.abc import Iterator

from checker.finding import Fix
from checker.formats.sdf.flattening.names import SUFFIXES, FlatNames, topic_mentions
from checker.formats.sdf.flattening.renames import Renaming
from checker.model.components import Joint, Link
from checker.model.robot import Robot
from checker.package.package import Package
from checker.package.renaming import is_mentioned_beside, leaves_mentions
from checker.rule import Concern, Findings, Safety, Severity, finding, rule
from checker.source.text import SourceText

_NAMED = {Link: "link", Joint: "joint"}


@rule("SDF011", "name-with-prefix", Severity.WARNING, Concern.PAPERWORK)
def check(robot: Robot, package: Package) -> Findings:
    """Report names with a slash in which the prefix represents the robot."""
    if not robot.conventions.read_by_gazebo:
        return  # RViz needs the prefix in URDF files.
    prefixes = _of_robot(robot)
    everywhere = {_prefix(link) for link in robot.links} == prefixes
    fix = _fix(robot, package, prefixes)
    for part in _parts(robot):
        if (prefix := _prefix(part)) in prefixes:
            yield finding(
                part.name,
                f"every link has the prefix {prefix + '/'!r}"
                if everywhere
                else f"{_NAMED[type(part)]} {part.name.value!r} has the prefix {prefix + '/'!r}",
                fix=fix,
            )


def _of_robot(robot: Robot) -> set[str]:
    """Return the prefix that represents the robot: the only one, or the model's name."""
    prefixes = {prefix for part in _parts(robot) if (prefix := _prefix(part))}
    if len(prefixes) <= 1:
        return prefixes
    return {prefix for prefix in prefixes if prefix.casefold() == robot.name.value.casefold()}


def _parts(robot: Robot) -> Iterator[Link | Joint]:
    yield from robot.links
    yield from robot.joints


def _fix(robot: Robot, package: Package, prefixes: set[str]) -> Fix | None:
    """Return the fix that removes these prefixes, in all files or in none.

    None if a name without prefix already exists, and if a text would still mention an old name.
    """
    changed = {
        part.scoped_name: part.name.value.partition("/")[2]
        for part in _parts(robot)
        if _prefix(part) in prefixes
    }
    if not changed or robot.models or robot.missing_parts:
        return None
    after = Counter(changed.get(link.scoped_name, link.scoped_name) for link in robot.links)
    after += Counter({frame.scoped_name: 1 for frame in robot.frames})
    after += Counter(changed.get(name, name) for name in robot.joints_by_name)
    if max(after.values()) > 1:
        return None
    names = FlatNames(changed)
    edits = list(Renaming(robot, names).edits)
    for file in package.index.with_suffix(*SUFFIXES):
        source = package.read(file.path)
        if isinstance(source, SourceText):
            edits += topic_mentions(source, names)
    sources = {edit.place.file: package.read(edit.place.file) for edit in edits}
    # A spawner may put a name together from pieces: then there is no text to write over.
    for edit in edits:
        source = sources[edit.place.file]
        if not isinstance(source, SourceText) or source.stretch_of(edit) is None:
            return None
    if leaves_mentions(package, changed, edits) or is_mentioned_beside(package, changed):
        return None
    return Fix(Safety.SAFE, tuple(edits))


def _prefix(part: Link | Joint) -> str:
    """Return the part of a name before its slash; `model/link/sensor` is the frame of a sensor."""
    before, slash, behind = part.name.value.partition("/")
    return before if slash and behind and "/" not in behind else ""


GOOD = [
    '<link name="arm"/>',
    '<link name="front/wheel"/><link name="rear/wheel"/>',
    '<link name="X1/base_link/lidar"/>',
]
BAD = [
    {
        "@fragment": """
<link name="X1/wheel">  <!-- ^ SDF011 -->
  <sensor name="imu" type="imu"><imu><enable_orientation>0</enable_orientation></imu></sensor>
</link>
<joint name="X1/axle" type="revolute">  <!-- ^ SDF011 -->
  <parent>base_link</parent>
  <child>X1/wheel</child>
</joint>
<plugin filename="libignition-gazebo-joint-state-publisher-system.so"
        name="ignition::gazebo::systems::JointStatePublisher">
  <joint_name>X1/axle</joint_name>
</plugin>
""",
        "launch/vehicle_topics.launch": """<launch>
<arg name="name"/>
<arg name="world_name"/>
<arg name="imu" value="/model/$(arg name)/link/X1/wheel/sensor/imu/imu"/>
</launch>
""",
    },
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
