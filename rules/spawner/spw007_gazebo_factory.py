"""A spawner that wraps the robot in the old gazebo-factory plugin.

The SubT launcher reads `<spawn>`. It does not spawn a robot in a plugin of the launch system. Other
rules read what is in the plugin as they read `<spawn>`.

Fix: put name, pose, world and SDF directly into `<spawn name="#{_name}">` and remove the plugin.
Source: Model Migration Guide, example spawner. No accepted package that we checked has this fault.
"""

from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("SPW007", "gazebo-factory", Severity.ERROR, Concern.INTERFACE)
def check(spawned: SpawnedXml) -> Findings:
    """Report the wrapper that Ignition Launch once used."""
    for plugin in spawned.gazebo_factories:
        yield finding(
            plugin,
            f"the robot is wrapped in {plugin.get('filename') or plugin.get('name')}, "
            "expected <spawn>",
        )


def _spawner(opening: str, closing: str) -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    {opening}
      <name>#{{_name}}</name>
    {closing}
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


_FACTORY = "ignition::launch::GazeboFactory"
_LIBRARY = "libignition-launch-gazebo-factory.so"
_MARK = "<!-- ^ SPW007 -->"

GOOD = [
    {"launch/spawner.rb": _spawner('<spawn name="#{_name}">', "</spawn>")},
    {
        "launch/spawner.rb": _spawner(
            '<spawn name="#{_name}"><sdf><include><plugin name="acme::Factory" filename="f"/>',
            "</include></sdf></spawn>",
        )
    },
]
BAD = [
    {
        "launch/spawner.rb": _spawner(
            f'<plugin name="{_FACTORY}" filename="{_LIBRARY}"> {_MARK}', "</plugin>"
        )
    },
    {
        "launch/spawner.rb": _spawner(
            f'<plugin name="{_FACTORY}" filename="factory"><spawn> {_MARK}', "</spawn></plugin>"
        )
    },
]
