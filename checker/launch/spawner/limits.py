"""Limits of what a spawner may use: real ones use a few per cent of each."""

from __future__ import annotations

from dataclasses import dataclass

MAX_FILE_LENGTH = 60_000
"""Characters of one Ruby or YAML file."""
MAX_STEPS = 100_000
"""Nodes evaluated in one call; what makes, reads or compares much costs several steps."""
MAX_STEPS_OF_VARIANTS = 2 * MAX_STEPS
"""The same in all calls with other arguments, of which there are about 20."""
MAX_TEXT_LENGTH = 500_000
"""Characters of one string."""
MAX_DEPTH = 110
"""Nested evaluations, so that Python's own stack (1000 frames) is never used up."""
MAX_CALLS = 40
"""Ruby functions that may be waiting for each other."""
MAX_INTEGER_BITS = 1000
"""Less than the largest exponent of a double, so that every integer has a float."""

MAX_NUMBER_LENGTH = 400
"""Characters of a number in YAML: reading one takes the square of its length."""
MAX_PATH_LENGTH = 4096
"""Characters of a path; Linux opens no longer one."""

CHARACTERS_PER_STEP = 100
CHARACTERS_PARSED_PER_STEP = 2
ITEMS_PER_STEP = 5


class LimitReached(Exception):
    """A limit is used up; the text states which."""


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
            raise LimitReached(f"makes a string of more than {MAX_TEXT_LENGTH} characters")
        self.spend(length // CHARACTERS_PER_STEP + pieces // ITEMS_PER_STEP)

    def spend_parsing(self, length: int) -> None:
        """Take off what parsing a text costs.

        Raises:
            LimitReached: No steps are left.
        """
        self.spend(length // CHARACTERS_PARSED_PER_STEP)

    def spend_items(self, count: int) -> None:
        """Take off what making a list, or walking through one, costs.

        Raises:
            LimitReached: No steps are left.
        """
        self.spend(count // ITEMS_PER_STEP + 1)
