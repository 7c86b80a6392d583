"""The globals that a launcher sets before it loads a spawner, and the arguments that it passes."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping, Sequence

from checker.launch.spawner.files import SpawnerFiles
from checker.launch.spawner.limits import MAX_FILE_LENGTH
from checker.launch.spawner.literals import computed_string
from checker.launch.spawner.values import RubyString, Value
from checker.source.text import SourceText

Argument = str | int | float | bool | None

GROUND_TRUTH = "$enableGroundTruth"
WORLD = "$worldName"
SAMPLE_NAME = "robot_name"
SAMPLE_WORLD = "world_name"

SPAWNER_ARGUMENTS: tuple[str | float, ...] = (
    *(SAMPLE_NAME, "model://robot_model", SAMPLE_WORLD),
    *(1.25, 2.5, 3.75),
    *(0.125, 0.25, 0.5),
)
"""`_name _modelURI _worldName _x _y _z _roll _pitch _yaw`; exact in binary, in m and rad."""
EXECUTABLES_ARGUMENTS: tuple[Argument, ...] = (SAMPLE_NAME, SAMPLE_WORLD)
"""`_name _worldName`."""

NO_CHANGES: Mapping[str, Argument] = {}

_EXAMPLE = "example.ign"
_SET = re.compile(
    r"^[ \t]*(?:<%-?[ \t]*)?(?P<name>\$[A-Za-z]\w{0,80})[ \t]*=[ \t]*"
    r"(?:\"(?P<double>[^\"#\\\n]{0,200})\"|'(?P<single>[^'\\\n]{0,200})'"
    r"|(?P<number>-?\d{1,15}(?:\.\d{1,15})?)|(?P<word>true|false|nil))[ \t]*(?:%>|#.*)?$",
    re.MULTILINE,
)
_WORDS = {"true": True, "false": False, "nil": None}


def launcher_globals(
    files: SpawnerFiles, path: str, changed: Mapping[str, Argument]
) -> dict[str, Value]:
    """Return what the launchers of the challenge set, and the example of a spawner.

    Args:
        files: The workspace.
        path: The path of the spawner.
        changed: Globals to set to other values than usual.
    """
    example = files.read(posixpath.join(posixpath.dirname(path), _EXAMPLE))
    given: dict[str, Argument] = {}
    if isinstance(example, SourceText) and len(example.text) <= MAX_FILE_LENGTH:
        given.update(_constants(example.text))
    given |= {WORLD: SAMPLE_WORLD, GROUND_TRUTH: False, **changed}
    return {name: ruby_value(data) for name, data in given.items()}


def changes(
    parameters: Sequence[str],
) -> Iterator[tuple[str, Sequence[Argument], Mapping[str, Argument]]]:
    """Yield each parameter of `spawner` and global, with arguments and globals of another value.

    Numbers become larger and then smaller than usual, so that a limit hides one change only.
    """
    for position, (name, usual) in enumerate(zip(parameters, SPAWNER_ARGUMENTS, strict=False)):
        others = (f"other_{usual}_2",) if isinstance(usual, str) else (64 * usual, -64 * usual)
        for other in others:
            yield (
                name,
                [*SPAWNER_ARGUMENTS[:position], other, *SPAWNER_ARGUMENTS[position + 1 :]],
                {},
            )
    yield WORLD, SPAWNER_ARGUMENTS, {WORLD: f"other_{SAMPLE_WORLD}_2"}
    yield GROUND_TRUTH, SPAWNER_ARGUMENTS, {GROUND_TRUTH: True}


def _constants(text: str) -> Iterator[tuple[str, Argument]]:
    """Yield the globals that an example sets to what is written there."""
    for match in _SET.finditer(text):
        name, word, number = match["name"], match["word"], match["number"]
        if word:
            yield name, _WORDS[word]
        elif number:
            yield name, float(number) if "." in number else int(number)
        else:
            yield name, match["double"] or match["single"] or ""


def ruby_value(data: Argument) -> Value:
    """Return a value of a launcher as Ruby's."""
    return RubyString(computed_string(data, None)) if isinstance(data, str) else data
