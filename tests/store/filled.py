"""Uploads and results that tests put into a store."""

from __future__ import annotations

from checker.service.store.store import Store

KEY, OTHER = "ab" * 32, "cd" * 32
"""Of results."""


def uploaded(store: Store, content: bytes) -> str:
    with store.incoming() as incoming:
        incoming.write(content)
        return incoming.finish()


def made(store: Store, files: dict[str, str], key: str = KEY) -> None:
    with store.workplace() as place:
        for name, text in files.items():
            path = place / "made" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        store.keep(key, place / "made")
