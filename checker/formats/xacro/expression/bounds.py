"""Limits of the computations of one expression, and of one file."""

from __future__ import annotations

STEPS_LIMIT = 100_000
"""Steps of one expression: nodes evaluated, items taken; the largest real one takes 430."""
FILE_STEPS_LIMIT = 3_000_000
"""Steps of all expressions of one file; the largest real file takes 3 200."""
BITS_LIMIT = 4_096
"""Bits of a whole number that is made; the largest float has 1 024 before its point."""
WIDTH_LIMIT = 1_000
"""Characters to which a format may widen a value, and digits that it may require."""
LEVELS_LIMIT = 80
"""Levels of lists within lists, and of expressions within expressions."""
_CHARACTERS_A_STEP = 64
_ITEMS_A_STEP = 16


class RefusedExpression(Exception):
    """An expression that uses what the language does not have; the construct, as a noun."""


class ExpressionLimit(Exception):
    """An expression that takes more than it may; a predicate whose subject is the expression."""


class Allowance:
    """Steps that are left to all expressions of a file."""

    def __init__(self, steps: int = FILE_STEPS_LIMIT) -> None:
        self.steps = steps


class Budget:
    """Steps that are left to one expression; a large result is counted before it is made."""

    def __init__(self, allowance: Allowance | None = None) -> None:
        self._allowance = allowance or Allowance()
        self._given = self._left = min(STEPS_LIMIT, self._allowance.steps)

    def spend(self, steps: int = 1) -> None:
        """Take steps.

        Raises:
            ExpressionLimit: No steps are left.
        """
        self._left -= steps
        if self._left < 0:
            whole = self._given < STEPS_LIMIT
            limit, of = (FILE_STEPS_LIMIT, " with those before it") if whole else (STEPS_LIMIT, "")
            raise ExpressionLimit(f"takes more than {limit} steps{of}")

    def close(self) -> None:
        """Take what was spent from what is left to the file."""
        self._allowance.steps -= self._given - max(self._left, 0)

    def spend_on_text(self, length: int) -> None:
        """Take the steps of reading or writing so many characters."""
        self.spend(1 + length // _CHARACTERS_A_STEP)

    def spend_on_copy(self, length: int) -> None:
        """Take the steps of copying so many items as they are."""
        self.spend(1 + length // _ITEMS_A_STEP)

    def spend_on_search(self, length: int, sought: int) -> None:
        """Take the steps of searching so many characters for so many others."""
        self.spend(1 + length // _CHARACTERS_A_STEP + length * sought // _CHARACTERS_A_STEP**2)


def check_bits(bits: int) -> None:
    """Refuse a whole number that is, or would be, too large.

    Raises:
        ExpressionLimit: It has more than `BITS_LIMIT` bits.
    """
    if bits > BITS_LIMIT:
        raise ExpressionLimit(f"makes a whole number of more than {BITS_LIMIT} bits")


def check_width(width: int) -> None:
    """Refuse a format that widens a value too far.

    Raises:
        ExpressionLimit: It requires more than `WIDTH_LIMIT` characters or digits.
    """
    if width > WIDTH_LIMIT:
        raise ExpressionLimit(f"formats a value with more than {WIDTH_LIMIT} characters")
