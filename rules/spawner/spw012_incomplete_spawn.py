"""A spawn element without an entry that the competition needs.

Without `<is_performer>true</is_performer>` the robot does not count as a member of the team. If
renaming is allowed, its topics may have another name than the robot: this is a warning. Without
`<world>`, or with an `<include>` that is not in an `<sdf>`, the robot is not spawned.

Fix: write `<world>#{_worldName}</world>`, `<is_performer>true</is_performer>` and
`<allow_renaming>false</allow_renaming>` below `<spawn>`, and `<sdf version="1.6">` around the
`<include>`.
Source: Model Migration Guide, example spawner. No accepted package that we checked has this fault.
"""

from collections.abc import Iterator

from checker.finding import Fix
from checker.launch.spawner.emitted_xml import SpawnedXml, models_of
from checker.launch.spawner.launcher import WORLD as LAUNCHED_WORLD
from checker.launch.spawner.reader import Spawner
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.xml import Element
from checker.source.xml_insertion import insert_behind, insert_into

FLAGS = {"is_performer": True, "allow_renaming": False}
SEVERITY = {"is_performer": Severity.ERROR, "allow_renaming": Severity.WARNING}
ORDER = ("name", "allow_renaming", "pose", "world", "is_performer")
"""The entries of `<spawn>` in front of the robot, as the guide orders them."""
WORLD = 2
"""Position of the world's name among the parameters of `spawner`."""

_TRUTH = {"true": True, "1": True, "false": False, "0": False}


@rule("SPW012", "incomplete-spawn", Severity.ERROR, Concern.INTERFACE)
def check(spawner: Spawner, spawned: SpawnedXml) -> Findings:
    """Report `<spawn>` elements without world or with wrong flags."""
    function = spawner.functions.get("spawner")
    names = [parameter.name for parameter in function.parameters] if function else []
    if not spawned.spawns:
        yield finding(function or spawner.entry.whole(), "the spawner emits no <spawn>")
    for spawn in spawned.spawns:
        yield from _judge_flags(spawn)
        if spawn.child("sdf") is None:
            for model in models_of(spawn):
                yield finding(model, f"<{model.tag}> is not inside <sdf>, so nothing is spawned")
        world = spawn.child("world")
        if world is None or not world.text.stated:
            entry = f"#{{{names[WORLD]}}}" if len(names) > WORLD and world is None else ""
            yield finding(
                world or spawn,
                "<spawn> names no <world>",
                fix=_with_entry(spawn, "world", entry) if entry else None,
            )
        elif len(names) > WORLD and spawned.parameters_of(world.text.span).isdisjoint(
            {names[WORLD], LAUNCHED_WORLD}
        ):
            yield finding(
                world.text,
                f"<world> is {world.text.value!r}, expected #{{{names[WORLD]}}}",
                fix=replace_text(world.text, f"#{{{names[WORLD]}}}", Safety.UNSAFE),
            )


def _judge_flags(spawn: Element) -> Iterator[Finding]:
    for tag, wanted in FLAGS.items():
        expected = str(wanted).lower()
        flag = spawn.child(tag)
        if flag is None:
            message = f"<spawn> has no <{tag}>{expected}</{tag}>"
            fix = _with_entry(spawn, tag, expected)
            yield finding(spawn, message, severity=SEVERITY[tag], fix=fix)
        elif _TRUTH.get(flag.text.value.lower()) is not wanted:
            yield finding(
                flag.text,
                f"<{tag}> is {flag.text.value!r}, expected {expected}",
                severity=SEVERITY[tag],
                fix=replace_text(flag.text, expected, Safety.UNSAFE) if flag.text.stated else None,
            )


def _with_entry(spawn: Element, tag: str, value: str) -> Fix:
    """Return the fix that adds an entry behind those that come before it."""
    line = f"<{tag}>{value}</{tag}>"
    earlier = [child for child in spawn.children if child.tag in ORDER[: ORDER.index(tag)]]
    edit = insert_behind(earlier[-1], [line]) if earlier else insert_into(spawn, [line])
    return Fix(Safety.UNSAFE, (edit,))


def _spawner(inside: str, mark: str = "") -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}"> {mark}
      {inside}
    </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


_WORLD = "<world>#{_worldName}</world>"
_PERFORMER = "<is_performer>true</is_performer>"
_RENAMING = "<allow_renaming>false</allow_renaming>"
_MARK = "<!-- ^ SPW012 -->"

_INCLUDE = "<include><uri>#{_modelURI}</uri></include>"

GOOD = [
    {"launch/spawner.rb": _spawner(_WORLD + _PERFORMER + _RENAMING)},
    {"launch/spawner.rb": _spawner(f"{_WORLD}{_PERFORMER}{_RENAMING}<sdf>{_INCLUDE}</sdf>")},
]
BAD = [
    {"launch/spawner.rb": _spawner(_WORLD + _RENAMING, _MARK)},
    {"launch/spawner.rb": _spawner(_PERFORMER + _RENAMING, _MARK)},
    {"launch/spawner.rb": _spawner(f"{_WORLD}{_PERFORMER}{_RENAMING}{_INCLUDE}{_MARK}")},
    {
        "launch/spawner.rb": _spawner(
            f"<world>tunnel</world>{_PERFORMER}<allow_renaming>1</allow_renaming>{_MARK}"
        )
    },
]
