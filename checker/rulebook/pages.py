"""The page of a rule, from the docstring of its module.

A page has a title line with the fault, a body with the reason why it matters, and two marked
paragraphs: `Fix:` and `Source:`.
"""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Sequence
from functools import cache as once

from checker.base.record import Record
from checker.rule import Rule


class Page(Record):
    """The parts of a rule's page.

    Attributes:
        title: What is wrong, one line.
        why: What goes wrong because of it, and notes.
        fix: What to do.
        source: The source of the rule.
    """

    title: str
    why: str
    fix: str
    source: str

    @property
    def reason(self) -> str:
        """First sentence of the body."""
        sentence, dot, _ = " ".join(self.why.split("\n\n")[0].split()).partition(". ")
        return sentence + ("." if dot else "")


@once
def parse_page(docstring: str) -> Page:
    """Split a docstring into the parts of a page."""
    title, *paragraphs = [part.strip() for part in docstring.strip().split("\n\n")]
    parts: dict[str, list[str]] = {"why": [], "fix": [], "source": []}
    for block in paragraphs:
        rest = block
        for label in ("Source:", "Fix:"):
            before, found, after = _cut(rest, label)
            if found:
                parts[label[:-1].lower()].append(after)
                rest = before
        if rest:
            parts["why"].append(rest)
    return Page(
        title.rstrip("."),
        "\n\n".join(parts["why"]),
        "\n\n".join(parts["fix"]),
        "\n\n".join(parts["source"]),
    )


def _cut(block: str, label: str) -> tuple[str, bool, str]:
    """Split a block at the line that begins with a label."""
    lines = block.splitlines() if label in block else []
    for index, line in enumerate(lines):
        if line.startswith(label):
            after = "\n".join([line.removeprefix(label).strip(), *lines[index + 1 :]]).strip()
            return "\n".join(lines[:index]).strip(), True, after
    return block, False, ""


_CODE = re.compile(r"(?<!`)(`+)(?!`).*?(?<!`)\1(?!`)", re.DOTALL)


def group_description(members: Sequence[Rule]) -> str:
    """Return what a group is about: the docstring of its folder, without its letters."""
    folder = sys.modules[members[0].check.__module__.rpartition(".")[0]]
    docstring = inspect.getdoc(folder) or ""
    return escaped(docstring.partition("\n")[0].partition(": ")[2].rstrip("."))


def escaped(text: str) -> str:
    """Return a docstring's text so that Markdown shows it as it is; code in backticks stays."""
    parts, end = [], 0
    for code in _CODE.finditer(text):
        parts += [_escaped(text[end : code.start()]), code[0]]
        end = code.end()
    return "".join([*parts, _escaped(text[end:])])


def _escaped(text: str) -> str:
    text = re.sub(r"([\\`<&*~\[\]|]|(?<!\w)_|_(?!\w))", r"\\\1", text)
    text = re.sub(r"(?m)^(\s*)([-+#>=])", r"\1\\\2", text)
    return re.sub(r"(?m)^(\s*\d+)([.)])", r"\1\\\2", text)
