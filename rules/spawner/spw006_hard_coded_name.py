"""A spawner with a fixed name or model instead of the launcher's arguments.

The SubT launcher chooses the robot's name and the place of its model. With a fixed name two robots
of a team collide; with a fixed URI another model may start than the one under test.

Fix: write `#{_name}` and `#{_modelURI}`; `${_name}` is not Ruby.
Source: Model Migration Guide, example spawner. No accepted package that we checked has this fault.
"""

from collections.abc import Iterator

from checker.launch.spawner.emitted_xml import SpawnedXml, models_of
from checker.launch.spawner.reader import Spawner
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.text import Located
from checker.source.xml import Element

NAME, MODEL = 0, 1
"""Positions of the parameters of `spawner`."""


@rule("SPW006", "hard-coded-name", Severity.ERROR, Concern.INTERFACE)
def check(spawner: Spawner, spawned: SpawnedXml) -> Findings:
    """Report names and URIs below `<spawn>` that are constants."""
    function = spawner.functions.get("spawner")
    parameters = [parameter.name for parameter in function.parameters] if function else []
    for spawn in spawned.spawns:
        written = [*_names(spawn), *_uris(spawn)]
        for what, position, text in written:
            wanted = parameters[position] if position < len(parameters) else ""
            if wanted and wanted not in spawned.parameters_of(text.span):
                yield finding(
                    text,
                    f"{what} is {text.value!r}, expected #{{{wanted}}}",
                    fix=replace_text(text, f"#{{{wanted}}}", Safety.UNSAFE),
                )


def _names(spawn: Element) -> Iterator[tuple[str, int, Located[str]]]:
    # The plugin of older spawners has a name of its own.
    attribute = spawn.attribute("name") if spawn.tag == "spawn" else None
    if attribute is not None:
        yield "the attribute name of <spawn>", NAME, attribute
    for parent in (spawn, *_includes(spawn)[:1]):
        for name in parent.all("name"):
            if name.text.stated:
                what = "include" if parent.tag == "include" else "spawn"
                yield f"<name> of <{what}>", NAME, name.text


def _uris(spawn: Element) -> Iterator[tuple[str, int, Located[str]]]:
    for include in _includes(spawn)[:1]:
        for uri in include.all("uri"):
            yield "<uri>", MODEL, uri.text


def _includes(spawn: Element) -> list[Element]:
    """Return the included models; the first is the robot, others may be its payload."""
    return [model for model in models_of(spawn) if model.tag == "include"]


def _spawner(name: str, uri: str) -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}">
      {name}
      <sdf version="1.6">
        <include>
          <name>#{{_name}}</name>
          {uri}
        </include>
      </sdf>
    </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


_NAME, _URI = "<name>#{_name}</name>", "<uri>#{_modelURI}</uri>"
_MARK = "  <!-- ^ SPW006 -->"

GOOD = [{"launch/spawner.rb": _spawner(_NAME, _URI)}]
BAD = [
    {"launch/spawner.rb": _spawner("<name>${_name}</name>" + _MARK, _URI)},
    {"launch/spawner.rb": _spawner(_NAME, "<uri>model://rover</uri>" + _MARK)},
]
