"""A value in the spawner that is still TODO.

`subt-check migrate` writes TODO where only the author knows the value, such as the figures of the
battery. Gazebo reads such a figure as 0: the battery is then empty at the start.

Fix: write the value of the real robot, and the same in specifications.md.
Source: sdformat, `sdf::Element::Get`: a text that is not a number gives the default value.
"""

import re

from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.rule import Concern, Findings, Severity, finding, rule

_TO_DO = re.compile(r"\s*TODO\b")


@rule("SPW014", "todo-in-spawner", Severity.ERROR, Concern.ROBOT)
def check(spawned: SpawnedXml) -> Findings:
    """Report elements of the emitted XML whose text begins with TODO."""
    for element in spawned.document.elements:
        if element.text.stated and _TO_DO.match(element.text.value):
            yield finding(
                element.text,
                f"<{element.tag}> is {element.text.value.strip()[:60]!r}: write the value of the "
                "real robot",
                key="todo",
            )


def _spawner(load: str) -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}">
      <sdf version="1.6">
        <include>
          <name>#{{_name}}</name>
          <uri>#{{_modelURI}}</uri>
          <plugin filename="libignition-gazebo-linearbatteryplugin-system.so"
                  name="ignition::gazebo::systems::LinearBatteryPlugin">
            <!-- TODO: measure -->
            <power_load>{load}
          </plugin>
        </include>
      </sdf>
    </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


GOOD = [{"launch/spawner.rb": _spawner("9.9</power_load>")}]
BAD = [{"launch/spawner.rb": _spawner("TODO</power_load>  <!-- ^ SPW014 -->")}]
