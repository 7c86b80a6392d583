"""How a hostile spawner is read, as one package of a workspace in memory."""

from __future__ import annotations

from functools import partial

from checker.launch.spawner.reader import read_spawner
from checker.launch.spawner.signals import Unread
from checker.source.ruby import parse_ruby
from checker.source.text import SourceText
from tests.evaluated.spawners import FILES, SPAWNERS

PATH = "robot/launch/spawner.rb"


class _Files:
    def read(self, path: str) -> SourceText | str:
        return SourceText(path, FILES[path]) if path in FILES else "is not there"

    def exists(self, path: str) -> bool:
        return path in FILES or path == "robot"

    def package_folder(self, name: str) -> str | None:
        return name if name == "robot" else None


def _read(text: str) -> str:
    spawner = read_spawner(_Files(), PATH, SourceText(PATH, text))
    return spawner.spawn.reason if isinstance(spawner.spawn, Unread) else "was read"


parse_ruby(SourceText(PATH, ""))  # loads the parser
ATTACKS = {name: partial(_read, text) for name, text in SPAWNERS.items()}
