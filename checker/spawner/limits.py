"""How much a spawner may ask for: real ones use a few per cent of each limit."""

from __future__ import annotations

from dataclasses import dataclass

MAX_FILE_LENGTH = 1_000_000
"""Characters of one Ruby or YAML file."""
MAX_STEPS = 200_000
"""Nodes evaluated in one call; long texts and long lists cost several steps."""
MAX_TEXT_LENGTH = 5_000_000
"""Characters of one string."""
MAX_DEPTH = 110
"""Nested evaluations, so that Python's own stack (1000 frames) is never used up."""
MAX_CALLS = 40
"""Ruby functions that may be waiting for each other."""
MAX_INTEGER_BITS = 1000
"""Below the largest exponent of a double, so that every integer has a float."""

CHARACTERS_PER_STEP = 250
ITEMS_PER_STEP = 50


class LimitReached(Exception):
    """A limit is used up; the text says which."""


@dataclass(slots=True)
class Budget:
    """The steps that are left."""

    steps: int = MAX_STEPS

    def spend(self, steps: int = 1) -> None:
        """Take steps off.

        Raises:
            LimitReached: None are left.
        """
        self.steps -= steps
        if self.steps < 0:
            raise LimitReached(f"takes more than {MAX_STEPS} steps")

    def spend_text(self, length: int, pieces: int = 0) -> None:
        """Take off what making a string costs.

        Raises:
            LimitReached: The string is too long, or no steps are left.
        """
        if length > MAX_TEXT_LENGTH:
            raise LimitReached(f"makes a text of more than {MAX_TEXT_LENGTH} characters")
        self.spend(length // CHARACTERS_PER_STEP + pieces // ITEMS_PER_STEP)

    def spend_items(self, count: int) -> None:
        """Take off what making a list costs.

        Raises:
            LimitReached: No steps are left.
        """
        self.spend(count // ITEMS_PER_STEP + 1)
