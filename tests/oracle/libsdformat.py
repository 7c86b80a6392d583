"""What libsdformat makes of SDF files: Debian's library in a small program of ours."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

LIBRARIES = ("sdformat12",)
SOURCE = Path(__file__).parent / "load_sdf.cpp"


@dataclass(frozen=True)
class Loaded:
    """A file as libsdformat reads it.

    Attributes:
        errors: Why it refuses the file; empty when it loads it.
        robots: The models at the top of the file and in its worlds, as the program prints them.
        elements: All that the file holds, as SDF of the library's newest version, if asked for.
    """

    errors: tuple[str, ...]
    robots: tuple[dict[str, Any], ...]
    elements: str = ""

    @property
    def reason(self) -> str:
        """The first thing that it says against the file."""
        return self.errors[0] if self.errors else ""


def load(program: Path, files: Sequence[Path], elements: bool = False) -> list[Loaded]:
    """Load files, in their order; one that ends the library itself counts as refused."""
    command = [program, "--elements"] if elements else [program]
    return list(_answers(command, list(files)))


def _answers(command: Sequence[str | Path], rest: list[Path]) -> Iterator[Loaded]:
    while rest:
        names = "".join(f"{file}\n" for file in rest)
        done = subprocess.run(command, input=names, capture_output=True, text=True, check=False)
        lines = done.stdout.splitlines()
        yield from map(_loaded, lines)
        rest = rest[len(lines) :]
        if rest:
            yield Loaded((f"libsdformat ends with {done.returncode}",), ())
            rest = rest[1:]


def _loaded(line: str) -> Loaded:
    answer = json.loads(line)
    errors = tuple(error["message"] for error in answer["errors"])
    return Loaded(errors, tuple(answer["robots"]), answer["elements"])
