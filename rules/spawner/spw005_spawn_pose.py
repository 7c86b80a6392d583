"""A spawn pose that does not use the launcher's arguments.

The SubT launcher decides where each robot of a team starts. A spawner that leaves out a coordinate
puts the robot in another place, turned the wrong way, or on top of another robot.

No accepted package that we checked has this fault.

Fix: write `<pose>#{_x} #{_y} #{_z + 0.2} #{_roll} #{_pitch} #{_yaw}</pose>`.
Source: Model Migration Guide, example spawner.
"""

from collections.abc import Iterator

from checker.finding import Fix
from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.launch.spawner.reader import Spawner
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, rule
from checker.source.xml import Element

COORDINATES = ("x", "y", "z", "roll", "pitch", "yaw")
FIRST = 3
"""`spawner` takes the name, the model's URI and the world's name before the coordinates."""


@rule("SPW005", "spawn-pose", Severity.ERROR, Concern.INTERFACE)
def check(spawner: Spawner, spawned: SpawnedXml) -> Findings:
    """Report a `<pose>` directly below `<spawn>` that misses or mixes up coordinates."""
    function = spawner.functions.get("spawner")
    names = [p.name for p in function.parameters] if function else []
    wanted = names[FIRST : FIRST + len(COORDINATES)]
    if len(wanted) < len(COORDINATES):
        return
    for spawn in spawned.spawns:
        pose = spawn.child("pose")
        if pose is None:
            yield finding(spawn, "<spawn> has no <pose>, so the robot starts at the origin")
        else:
            yield from _judge(pose, wanted, spawned)


def _judge(pose: Element, wanted: list[str], spawned: SpawnedXml) -> Iterator[Finding]:
    used = spawned.parameters_of(pose.text_span)
    missing = [name for name in wanted if name not in used]
    if missing:
        yield finding(
            pose.text_span,
            f"the spawn pose does not use {', '.join(missing)}: add "
            + " ".join(f"#{{{name}}}" for name in missing),
            key="missing",
            fix=_completed(pose, wanted, spawned),
        )
        return
    words = [spawned.parameters_of(word) for word in spawned.words_of(pose.text_span)]
    for name, word in zip(wanted, words, strict=False):
        if name not in word:
            yield finding(
                pose.text_span,
                f"the spawn pose has {' and '.join(sorted(word)) or 'a constant'} in the place of "
                f"{name}",
                severity=Severity.WARNING,
                key="order",
            )
            return


def _completed(pose: Element, wanted: list[str], spawned: SpawnedXml) -> Fix | None:
    """Return the fix that writes coordinates over constants, the others being in their place."""
    words = spawned.words_of(pose.text_span)
    used = [spawned.parameters_of(word) for word in words]
    if len(words) != len(wanted) or any(
        word and name not in word for name, word in zip(wanted, used, strict=True)
    ):
        return None
    pairs = zip(wanted, words, used, strict=True)
    edits = [word.replacement(f"#{{{name}}}") for name, word, of in pairs if not of]
    return Fix(Safety.UNSAFE, tuple(edits))


def _spawner(pose: str) -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}">
    {pose}
    </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


_MARK = "  <!-- ^ SPW005 -->"

GOOD = [
    {
        "launch/spawner.rb": _spawner(
            "<pose>#{_x} #{_y} #{_z + 0.2} #{_roll} #{_pitch} #{_yaw}</pose>"
        )
    },
]
BAD = [
    {"launch/spawner.rb": _spawner("<pose>#{_x} #{_y} #{_z + 0.2} 0 0 0</pose>" + _MARK)},
    {
        "launch/spawner.rb": _spawner(
            "<pose>#{_y} #{_x} #{_z + 0.2} #{_roll} #{_pitch} #{_yaw}</pose>" + _MARK
        )
    },
]
