"""Values in a sentence."""

from __future__ import annotations

from collections.abc import Iterable


def either(values: Iterable[float]) -> str:
    """Return numbers as a choice: `512, 1024 or 2048`."""
    words = [f"{value:g}" for value in values]
    return " or ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
