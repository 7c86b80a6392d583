"""The globals that a launcher sets before it loads a spawner, and their values."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from checker.launch.spawner.files import SpawnerFiles
from checker.launch.spawner.limits import MAX_FILE_LENGTH
from checker.launch.spawner.literals import computed_string
from checker.launch.spawner.values import RubyString, Value
from checker.source.text import SourceText

GROUND_TRUTH = "$enableGroundTruth"
WORLD = "$worldName"
SAMPLE_NAME = "robot_name"
SAMPLE_WORLD = "world_name"

_EXAMPLE = "example.ign"
_SET = re.compile(
    r"^[ \t]*(?:<%-?[ \t]*)?(?P<name>\$[A-Za-z]\w{0,80})[ \t]*=[ \t]*"
    r"(?:\"(?P<double>[^\"#\\\n]{0,200})\"|'(?P<single>[^'\\\n]{0,200})'"
    r"|(?P<number>-?\d{1,15}(?:\.\d{1,15})?)|(?P<word>true|false|nil))[ \t]*(?:%>|#.*)?$",
    re.MULTILINE,
)
_WORDS = {"true": True, "false": False, "nil": None}


def launcher_globals(files: SpawnerFiles, path: str, *, ground_truth: bool) -> dict[str, Value]:
    """Return what the launchers of the challenge set, and the example of a spawner.

    Args:
        files: The workspace.
        path: The path of the spawner.
        ground_truth: Value of `$enableGroundTruth`.
    """
    example = files.read(posixpath.join(posixpath.dirname(path), _EXAMPLE))
    given: dict[str, str | float | bool | None] = {WORLD: SAMPLE_WORLD}
    if isinstance(example, SourceText) and len(example.text) <= MAX_FILE_LENGTH:
        given = {**dict(_constants(example.text)), **given}
    given[GROUND_TRUTH] = ground_truth
    return {name: _value(data, name) for name, data in given.items()}


def _constants(text: str) -> Iterator[tuple[str, str | float | bool | None]]:
    """Yield the globals that an example sets to what is written there."""
    for match in _SET.finditer(text):
        name, word, number = match["name"], match["word"], match["number"]
        if word:
            yield name, _WORDS[word]
        elif number:
            yield name, float(number) if "." in number else int(number)
        else:
            yield name, match["double"] or match["single"] or ""


def _value(data: str | float | bool | None, name: str) -> Value:
    influences = frozenset({name})
    if isinstance(data, str):
        return Value(RubyString(computed_string(data, None, influences)), influences)
    return Value(data, influences)
