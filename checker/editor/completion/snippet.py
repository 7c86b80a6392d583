"""Elements as snippets: the required parts, with places to fill in."""

from __future__ import annotations

from collections.abc import Sequence

from checker.formats.sdf.schema import ElementType

_INDENT = "  "
_NO_VALUE = "__"
"""Beginning of defaults that no file states, such as `__default_topic__`."""


class Snippet:
    """Writes a snippet of LSP: its places are numbered in the order of the calls."""

    def __init__(self) -> None:
        self._places = 0

    def place(self, default: str = "") -> str:
        """Return the next place to fill in."""
        self._places += 1
        return f"${{{self._places}:{escaped(default)}}}" if default else f"${self._places}"

    def attributes(self, stated: Sequence[tuple[str, str]]) -> str:
        """Return attributes, each with a place for its value."""
        return "".join(f' {name}="{self.place(default)}"' for name, default in stated)


def escaped(text: str) -> str:
    """Return text that a snippet takes as it is."""
    return text.replace("\\", "\\\\").replace("$", "\\$").replace("}", "\\}")


def writable_default(default: str) -> str:
    """Return a default that an author could write; nothing for one that represents another."""
    return "" if default.startswith(_NO_VALUE) else default


def sdf_element(kind: ElementType) -> str:
    """Return an element of SDF without its first `<`: what it has to state, and a place inside."""
    return _sdf_element(kind, Snippet(), "", nested=False)


def _sdf_element(kind: ElementType, snippet: Snippet, indent: str, *, nested: bool) -> str:
    required = [
        (name, writable_default(default))
        for name, (_, default, needed) in kind.attributes.items()
        if needed == "1"
    ]
    start = f"{kind.name}{snippet.attributes(required)}"
    if kind.value_type:
        return f"{start}>{snippet.place(writable_default(kind.default or ''))}</{kind.name}>"
    if not kind.children and not kind.free:
        return f"{start}/>"
    inner = indent + _INDENT
    needed = [] if nested else [it for it in kind.required_children if it.value_type]
    lines = [f"\n{inner}<{_sdf_element(it, snippet, inner, nested=True)}" for it in needed]
    lines.append(f"\n{inner}{'' if nested else '$0'}")
    return f"{start}>{''.join(lines)}\n{indent}</{kind.name}>"


def plain_element(tag: str, attributes: Sequence[tuple[str, str]], *, holds: bool) -> str:
    """Return an element without its first `<`.

    Args:
        tag: Its name.
        attributes: Names and defaults of those to state.
        holds: Whether there may be something inside.
    """
    start = f"{tag}{Snippet().attributes(attributes)}"
    return f"{start}>\n{_INDENT}$0\n</{tag}>" if holds else f"{start}/>"
