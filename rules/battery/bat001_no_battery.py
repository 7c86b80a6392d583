"""A robot without a battery.

In the challenge every robot runs out of power after some time; a robot without a battery never
stops, and its package is not accepted. A battery inside a comment does not count.

Fix: add the LinearBatteryPlugin to what the spawner emits, as the last of the plugins that make
the robot move.
Source: SubT maintainers require it in their reviews; all accepted packages have one.
"""

from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.model.battery import BATTERY_CLASS, batteries, commented_out
from checker.model.robot import Robot
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("BAT001", "no-battery", Severity.ERROR, Concern.ROBOT)
def check(package: Package, robot: Robot, spawned: SpawnedXml) -> Findings:
    """Look for the plugin in the model and in what the spawner emits, also within comments."""
    if package.kind is PackageKind.BASE_MODEL or batteries(robot):
        return
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    hidden = next(commented_out((spawned.document, robot.document), BATTERY_CLASS), None)
    if hidden is not None:
        yield finding(
            hidden,
            f"{BATTERY_CLASS} is inside a comment, so the robot has no battery: remove the "
            "comment marks",
        )
        return
    place = spawned.spawns[0] if spawned.spawns else robot
    yield finding(
        place, f"the robot has no battery: add a {BATTERY_CLASS} to what the spawner emits"
    )


_PLUGIN = """<plugin filename="libignition-gazebo-linearbatteryplugin-system.so"
        name="ignition::gazebo::systems::LinearBatteryPlugin">
</plugin>"""


def _spawner(plugin: str, mark: str = "") -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}"> {mark}
      <sdf version="1.6">
        <include>
          <name>#{{_name}}</name>
          <uri>#{{_modelURI}}</uri>
          {plugin}
        </include>
      </sdf>
    </spawn>
  HEREDOC
end
"""


_MARK = "<!-- ^ BAT001 -->"
_COMMENTED = """<!--
          <plugin filename="libignition-gazebo-linearbatteryplugin-system.so"
            name="ignition::gazebo::systems::LinearBatteryPlugin"> ^ BAT001
          </plugin> -->"""

GOOD = [
    _PLUGIN,
    {"launch/spawner.rb": _spawner(_PLUGIN)},
    {"launch/spawner.rb": _spawner(_PLUGIN.replace("ignition::gazebo", "gz::sim"))},
]
BAD = [
    {"launch/spawner.rb": _spawner("", _MARK)},
    {"launch/spawner.rb": _spawner(_COMMENTED)},
    {"launch/spawner.rb": _spawner(""), "@fragment": f"<link name='mast'/>\n{_COMMENTED}"},
]
