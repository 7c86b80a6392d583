"""A fault that is put into a sample: edits of its files, and what must be said about it."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path

from tests.conftest import SAMPLES

MODEL = "model.sdf"
SPAWNER = "launch/spawner.rb"


@dataclass(frozen=True)
class Swap:
    """Puts other text where the old one first stands.

    Attributes:
        old: As the file has it.
        new: Instead of it.
        after: Text that stands once in the file: the old one is looked for behind it.
        file: Of the sample.
        everywhere: Whether all places count, not the first.
    """

    old: str
    new: str
    after: str = ""
    file: str = MODEL
    everywhere: bool = False

    def __call__(self, package: Path) -> None:
        path = package / self.file
        text = path.read_text("utf-8")
        assert not self.after or text.count(self.after) == 1, f"{self.after} is not there once"
        start = text.index(self.after)
        assert self.old != self.new
        assert self.old in text[start:], f"{self.old} is not in {self.file}"
        count = -1 if self.everywhere else 1
        path.write_text(text[:start] + text[start:].replace(self.old, self.new, count), "utf-8")


@dataclass(frozen=True)
class Cut:
    """Takes text out, from one piece of it to another.

    Attributes:
        start: Stands once in the file, and goes.
        end: The first behind it, and goes too where `inclusive`.
        file: Of the sample.
        inclusive: Whether the end goes.
    """

    start: str
    end: str
    file: str = MODEL
    inclusive: bool = True

    def __call__(self, package: Path) -> None:
        path = package / self.file
        text = path.read_text("utf-8")
        assert text.count(self.start) == 1, f"{self.start} is not there once"
        first = text.index(self.start)
        last = text.index(self.end, first) + (len(self.end) if self.inclusive else 0)
        path.write_text(text[:first] + text[last:], "utf-8")


@dataclass(frozen=True)
class Broken:
    """Cuts a file off.

    Attributes:
        file: Of the sample.
        keep: Share of its bytes that stay.
    """

    file: str
    keep: float = 0.0

    def __call__(self, package: Path) -> None:
        path = package / self.file
        content = path.read_bytes()
        path.write_bytes(content[: int(self.keep * len(content))])


Change = Swap | Cut | Broken


@dataclass(frozen=True)
class Fault:
    """A fault in a sample.

    Attributes:
        name: What is wrong.
        changes: That put it there.
        rules: Any of them must find it, as error or warning.
        part: Words that the finding must have, in its message or in the path of its element.
    """

    name: str
    changes: tuple[Change, ...]
    rules: tuple[str, ...]
    part: str


def put_into(sample: str, fault: Fault, folder: Path) -> Path:
    """Copy a sample with the fault in it, and return where it is."""
    package = folder / sample
    shutil.copytree(SAMPLES / sample, package)
    for change in fault.changes:
        change(package)
    return package
