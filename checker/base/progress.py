"""Progress of a check: what begins is said, and stages are timed for the report."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter

from msgspec import field

from checker.base.record import Record

Say = Callable[[str], None]
"""Told in a few words what begins."""


def say_nothing(_: str) -> None:
    """Keep progress to oneself, as where nobody looks on."""


class Stages(Record, eq=False):
    """The stages of one check.

    Attributes:
        say: Told what begins, in a few words.
        seconds: That each stage took, without the stages inside it.
    """

    say: Say = say_nothing
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, words: str = "") -> Iterator[None]:
        """Time what is done inside; a stage that is entered again goes on.

        Args:
            name: In the report.
            words: For the person who waits; empty for what is not worth a line.
        """
        if words:
            self.say(words)
        inside = sum(self.seconds.values())
        started = perf_counter()
        try:
            yield
        finally:
            took = perf_counter() - started
            others = sum(self.seconds.values()) - inside
            self.seconds[name] = self.seconds.get(name, 0.0) + max(took - others, 0.0)
