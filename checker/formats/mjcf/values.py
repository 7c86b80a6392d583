"""Numbers in attributes of MJCF."""

from __future__ import annotations

from checker.source.xml import Element


def numbers(element: Element, name: str) -> tuple[float, ...] | None:
    """Return the numbers of an attribute; None if it is absent or not all of them are numbers."""
    try:
        return tuple(map(float, (element.get(name) or "").split())) or None
    except ValueError:
        return None
