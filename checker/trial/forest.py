"""The links of a robot as trees that MuJoCo can nest: each link hangs on one other at most."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from checker.dynamics.hanging import Hanging
from checker.model.tree import WORLD, Tie
from checker.record import record


@record(eq=False)
class Forest:
    """The links of a robot, from those that hang on nothing downwards."""

    hanging: Hanging

    @property
    def order(self) -> tuple[str, ...]:
        """Scoped names of the links, each behind the one that it hangs on."""
        return self.hanging.order

    @cached_property
    def below(self) -> dict[str, list[str]]:
        """Which links hang on each link, and on the world."""
        below: dict[str, list[str]] = {}
        for name in self.order:
            tie = self.tie(name)
            if tie is not None:
                below.setdefault(tie.parent, []).append(name)
        return below

    @cached_property
    def tops(self) -> list[str]:
        """Links that hang on nothing, or on the world."""
        return [name for name in self.order if self.base(name) is None]

    def tie(self, name: str) -> Tie | None:
        """Return the tie by which a link hangs; None for one that is free."""
        return self.hanging.by.get(name)

    def base(self, name: str) -> str | None:
        """Return the link that a link hangs on; None where that is the world or nothing."""
        tie = self.tie(name)
        return tie.parent if tie is not None and tie.parent != WORLD else None

    def under(self, start: str) -> Iterator[str]:
        """Yield a link and all that hangs on it, over others too."""
        waiting = [start]
        while waiting:
            name = waiting.pop()
            yield name
            waiting.extend(self.below.get(name, []))
