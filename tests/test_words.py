"""Messages, pages, help, docstrings and documents keep to the words of docs/glossary.md.

A word or phrase in italics in its column "not" occurs in none of them, with any ending of its
first word: `*work out*` is also "worked out". Code in Markdown may hold what it likes.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
GLOSSARY = ROOT / "docs/glossary.md"
CODE = (ROOT / "checker", ROOT / "rules")
PAGES = [
    page
    for page in (*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"))
    if page not in (GLOSSARY, ROOT / "docs/checklist.md") and page.parent.name != "rules"
]
"""The documents, without pages that `make docs` writes from the docstrings of rules."""


def avoided(glossary: str) -> list[str]:
    """Return the words in italics in the last column of each table."""
    last = (line.removesuffix("|").rpartition("|")[2] for line in glossary.splitlines())
    return [word for cell in last for word in re.findall(r"(?<!\*)\*([^*|]+)\*(?!\*)", cell)]


def pattern(words: list[str]) -> re.Pattern[str]:
    """Return what finds one of some words or phrases."""
    ended = (re.sub(r"^(\w+?)e?\b", r"\1(?:e|s|es|d|ed|ing)?", word) for word in words)
    return re.compile(rf"\b(?:{'|'.join(ended)})\b", re.IGNORECASE)


def texts(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the prose of a file, each with its line: strings of Python, paragraphs of Markdown."""
    text = path.read_text("utf-8")
    if path.suffix == ".py":
        for node in ast.walk(ast.parse(text)):
            value = node.value if isinstance(node, ast.Constant) else None
            # A backslash is that of a regular expression.
            if isinstance(value, str) and "\\" not in value:
                yield node.lineno, value
        return
    prose = re.sub(r"```.*?```|`[^`]*`", lambda code: "\n" * code[0].count("\n"), text, flags=re.S)
    line = 1
    for paragraph in re.split(r"(?<=\n)\n+", prose):
        yield line, paragraph
        line += paragraph.count("\n") + 1


def found(path: Path, avoid: re.Pattern[str]) -> Iterator[str]:
    for line, text in texts(path):
        for match in avoid.finditer(" ".join(text.split())):
            yield f"{path.relative_to(ROOT)}:{line}: {match[0]!r}; see docs/glossary.md"


def test_prose_keeps_to_the_glossary() -> None:
    avoid = pattern(avoided(GLOSSARY.read_text("utf-8")))
    files = [*PAGES, *(file for folder in CODE for file in folder.rglob("*.py"))]
    assert len(files) > 800
    wrong = [place for file in sorted(files) for place in found(file, avoid)]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize(
    "text",
    ["It works out the mass.", "He worked\nout all.", "Work out x", "working out"],
)
def test_a_phrase_is_found_with_endings_and_over_lines(text: str) -> None:
    assert pattern(["work out"]).search(" ".join(text.split()))


def test_other_words_are_no_false_alarm() -> None:
    assert not pattern(["work out", "at hand"]).search("a workout; what handles it")


def test_the_last_column_holds_what_is_avoided() -> None:
    table = "| write | not |\n|---|---|\n| *em* **compute** | *work out*, output |\n| *a* | |\n"
    assert avoided(table) == ["work out"]
