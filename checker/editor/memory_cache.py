"""Results of unsaved texts: kept in memory, and never on disk."""

from __future__ import annotations

from collections import OrderedDict
from typing import Any

from msgspec import field

from checker.base.cache import Cache

_ENTRIES = 300
"""Greatest number of results; the least recently used are removed."""
_OF_TEXTS = frozenset({"xacro"})
"""Kinds of results that depend on texts; others, such as those of meshes, last."""


class MemoryCache(Cache):
    """A cache that reads the disk once for each result."""

    _recent: OrderedDict[tuple[str, str], Any] = field(default_factory=OrderedDict)

    def get(self, kind: str, key: str) -> Any:
        """Return a result as the JSON that was put; None if it is not known."""
        if (kind, key) not in self._recent:
            self._note(kind, key, super().get(kind, key))
        self._recent.move_to_end((kind, key))
        return self._recent[kind, key]

    def put(self, kind: str, key: str, result: Any) -> None:
        """Keep a result that JSON can express."""
        self._note(kind, key, result)
        if kind not in _OF_TEXTS:
            super().put(kind, key, result)

    def _note(self, kind: str, key: str, result: Any) -> None:
        self._recent[kind, key] = result
        while len(self._recent) > _ENTRIES:
            self._recent.popitem(last=False)
