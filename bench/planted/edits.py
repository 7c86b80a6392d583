"""Small edits of the files of a package, made at a place that chance picks.

No edit moves the lines below it: line numbers in a sheet stay correct.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from random import Random

from lxml import etree

Edit = Callable[[Path, Random], bool]
"""Edits a package in place; states whether there was anything to edit."""

Change = Callable[[etree._Element, Random], None]
"""Edits one element."""


@dataclass(frozen=True)
class Kind:
    """A kind of fault.

    Attributes:
        name: What is wrong, in a few words.
        edit: Plants it.
        rules: Any of which must find it. A finding of another rule is a cascade.
    """

    name: str
    edit: Edit
    rules: tuple[str, ...]


def kind(name: str, rules: str, *edits: Edit) -> Kind:
    """Return a kind of fault that one edit plants, or several together."""

    def plant(package: Path, random: Random) -> bool:
        return all(edit(package, random) for edit in edits)

    return Kind(name, plant, tuple(rules.split()))


def xml(file: str, path: str, *changes: Change) -> Edit:
    """Return an edit of one of the elements that an XPath finds.

    Args:
        file: Names of files, or patterns, with `|` between them; the first file that has such an
            element is taken.
        path: XPath of the elements, of which one is picked.
        changes: All made to that one.
    """

    def edit(package: Path, random: Random) -> bool:
        for found in _files(package, file):
            try:
                tree = etree.parse(found)
            except etree.XMLSyntaxError:  # real files have faults of their own
                continue
            elements = tree.xpath(path)
            if not elements:
                continue
            element = random.choice(elements)
            for change in changes:
                change(element, random)
            tree.write(found, encoding="utf-8", xml_declaration=True)
            return True
        return False

    return edit


def _files(package: Path, names: str) -> list[Path]:
    return [found for name in names.split("|") for found in sorted(package.glob(name))]


def text(file: str, pattern: str, replacement: str = "", *, everywhere: bool = False) -> Edit:
    r"""Return an edit of one of the matches of a pattern, or of all; `\1` is the first group."""

    def edit(package: Path, random: Random) -> bool:
        for found in _files(package, file):
            content = found.read_text("utf-8")
            if matches := [*re.finditer(pattern, content, re.MULTILINE)]:
                for match in reversed(matches if everywhere else [random.choice(matches)]):
                    new = match.expand(replacement)
                    new += "\n" * (match[0].count("\n") - new.count("\n"))
                    content = content[: match.start()] + new + content[match.end() :]
                found.write_text(content, "utf-8")
                return True
        return False

    return edit


def write(file: str, content: str | bytes) -> Edit:
    """Return an edit that adds a file, or replaces it."""

    def edit(package: Path, _: Random) -> bool:
        path = package / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return True

    return edit


def on_file(file: str, change: Callable[[Path], object]) -> Edit:
    """Return an edit of one of the files of a pattern as a whole."""

    def edit(package: Path, random: Random) -> bool:
        found = sorted(path for path in package.glob(file) if path.is_file())
        if found:
            change(random.choice(found))
        return bool(found)

    return edit


def delete(file: str) -> Edit:
    """Return an edit that deletes a file."""
    return on_file(file, Path.unlink)


def overwritten(file: str, content: str) -> Edit:
    """Return an edit that writes something else into a file."""
    return on_file(file, lambda path: path.write_text(content, "utf-8"))


def has(file: str, pattern: str) -> Edit:
    """Return no edit: it only states whether a file has a text."""

    def edit(package: Path, _: Random) -> bool:
        return any(re.search(pattern, found.read_text("utf-8")) for found in _files(package, file))

    return edit


def cut(file: str, share: float = 0.5) -> Edit:
    """Return an edit that cuts a file off."""
    return on_file(
        file, lambda path: path.write_bytes(path.read_bytes()[: int(path.stat().st_size * share)])
    )


def with_text(value: str) -> Change:
    """Return a change of an element's text."""

    def change(element: etree._Element, _: Random) -> None:
        element.text = value

    return change


def with_attribute(name: str, value: str | None) -> Change:
    """Return a change of an attribute; None takes it away."""

    def change(element: etree._Element, _: Random) -> None:
        if value is None:
            element.attrib.pop(name, None)
        else:
            element.set(name, value)

    return change


def with_tag(tag: str) -> Change:
    """Return a change of an element's tag."""

    def change(element: etree._Element, _: Random) -> None:
        element.tag = tag

    return change


def scaled(factor: float, *, of: str = "", fields: slice = slice(None)) -> Change:
    """Return a change of the numbers of an element's text, or of the attribute `of`."""
    return _numbers(lambda number: number * factor, of, fields)


def shifted(by: float, *, of: str = "", fields: slice = slice(None)) -> Change:
    """Return a change that adds to the numbers of an element's text, or of the attribute `of`."""
    return _numbers(lambda number: number + by, of, fields)


def _numbers(new: Callable[[float], float], of: str, fields: slice) -> Change:
    def change(element: etree._Element, _: Random) -> None:
        words = str((element.get(of, "0 0 0") if of else element.text) or "").split()
        words[fields] = [f"{new(float(word)):.9g}" for word in words[fields]]
        if of:
            element.set(of, " ".join(words))
        else:
            element.text = " ".join(words)

    return change


def below(path: str, *changes: Change) -> Change:
    """Return a change of the first element that an XPath finds below the picked one."""

    def change(element: etree._Element, random: Random) -> None:
        (first, *_) = element.xpath(path)
        for inner in changes:
            inner(first, random)

    return change


def removed(element: etree._Element, _: Random) -> None:
    """Take an element away."""
    parent = element.getparent()
    assert parent is not None
    lines = etree.tostring(element, with_tail=False).count(b"\n")
    tail, before = "\n" * lines + (element.tail or ""), element.getprevious()
    if before is None:
        parent.text = (parent.text or "") + tail
    else:
        before.tail = (before.tail or "") + tail
    parent.remove(element)


def repeated(element: etree._Element, _: Random) -> None:
    """Write an element twice, the second time on its last line."""
    parent = element.getparent()
    assert parent is not None
    copy = etree.fromstring(etree.tostring(element, with_tail=False).replace(b"\n", b" "))
    copy.tail, element.tail = element.tail, ""
    parent.insert(parent.index(element) + 1, copy)


def with_child(content: str) -> Change:
    """Return a change that adds elements, or text, to the end of an element."""

    def change(element: etree._Element, _: Random) -> None:
        holder = etree.fromstring(f"<x>{content}</x>")
        if holder.text:
            element.text = (element.text or "") + holder.text
        element.extend(holder)

    return change


def emptied(element: etree._Element, _: Random) -> None:
    """Take everything out of an element."""
    for inner in [*element]:
        element.remove(inner)


def copied(path: str, source: str, factor: float = 1.0) -> Change:
    """Return a change of an inner element's text to that of another one, times a factor."""

    def change(element: etree._Element, random: Random) -> None:
        text = str(element.xpath(f"string({source})"))
        with_text(text)(element.xpath(path)[0], random)
        if factor != 1.0:
            scaled(factor)(element.xpath(path)[0], random)

    return change
