"""Reads the Dockerfile as far as tests need it: its stages, and what each of them is told to do."""

from __future__ import annotations

import re
from dataclasses import dataclass

_CONTINUED = re.compile(r"\\\n")
_FROM = re.compile(r"(?P<image>\S+)(?: AS (?P<name>\S+))?")


@dataclass(frozen=True)
class Instruction:
    """One instruction, such as `RUN` with its command."""

    word: str
    text: str


@dataclass(frozen=True)
class DockerStage:
    """A stage: the image that it starts from, its name (empty for the last) and instructions."""

    image: str
    name: str
    instructions: tuple[Instruction, ...]

    def all(self, word: str) -> list[str]:
        """Return the texts of all instructions of a kind."""
        return [each.text for each in self.instructions if each.word == word]

    def only(self, word: str) -> str:
        """Return the text of the one instruction of a kind."""
        (text,) = self.all(word)
        return text


def stages(dockerfile: str) -> list[DockerStage]:
    """Return the stages of a Dockerfile in order."""
    found: list[DockerStage] = []
    for line in _lines(dockerfile):
        word, _, text = line.partition(" ")
        if word == "FROM":
            start = _FROM.fullmatch(text)
            assert start is not None, line
            found.append(DockerStage(start["image"], start["name"] or "", ()))
        else:
            last = found.pop()
            told = (*last.instructions, Instruction(word, text.strip()))
            found.append(DockerStage(last.image, last.name, told))
    return found


def _lines(dockerfile: str) -> list[str]:
    kept = (line for line in dockerfile.splitlines() if not line.startswith("#"))
    return [line for line in _CONTINUED.sub("", "\n".join(kept)).splitlines() if line.strip()]
