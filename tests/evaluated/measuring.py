"""A process that reads hostile texts, each in a fork of its own: says what they take.

It is asked by lines of JSON, `["spawners", "words"]`, and answers by lines.
"""

from __future__ import annotations

import importlib
import json
import os
import resource
import sys
import time
from collections.abc import Callable, Mapping

from tests.effort import slowness

MEMORY = 1_500_000_000
"""Bytes of address space: more than what is allowed, so that the excess is measured."""
_NOT_MUCH = 0.5
SECONDS = 20
"""Of processor time; the fork is killed behind it."""


def _measured(attack: Callable[[], object], answer: int) -> None:
    """Run an attack, and write its seconds of a quiet machine, megabytes and what it returned."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    began = time.process_time()
    try:
        said = str(attack())
    except Exception as error:  # noqa: BLE001 - any is a fault that the test tells of
        said = f"raised {type(error).__name__}: {error}"
    seconds = time.process_time() - began
    if seconds > _NOT_MUCH:
        seconds /= slowness()
    more = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    os.write(answer, json.dumps([seconds, more, said[:300]]).encode())


def _forked(attack: Callable[[], object]) -> str:
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        _measured(attack, writing)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as answer:
        said = answer.read()
    os.waitpid(child, 0)
    return said or json.dumps([SECONDS, MEMORY / 1e6, "was killed"])


def main() -> None:
    """Answer until nobody asks any more."""
    attacks: Mapping[str, Mapping[str, Callable[[], object]]] = {
        name: importlib.import_module(f"tests.evaluated.{name}").ATTACKS
        for name in ("reading_spawners", "reading_files")
    }
    for line in sys.stdin:
        group, name = json.loads(line)
        sys.stdout.write(f"{_forked(attacks[group][name])}\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
