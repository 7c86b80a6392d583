"""Every relative link of every Markdown file leads to a file, and its anchor to a heading."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from urllib.parse import unquote

import pytest
from markdown_it import MarkdownIt
from markdown_it.token import Token

ROOT = Path(__file__).parent.parent
NOT_OURS = ("build", "demo", "dist", "node_modules")
GENERATED = (ROOT / "docs/rules", ROOT / "docs/checklist.md")
"""Written by `make docs`, which fails if one of their links is dead."""
_ELSEWHERE = re.compile(r"[a-z][a-z0-9+.-]*:|//")


def documents() -> Iterator[Path]:
    """Yield the Markdown files, but for those of packages: these are judged, and some are wrong."""
    for folder, inner, names in os.walk(ROOT):
        at = Path(folder)
        inner[:] = sorted(
            name
            for name in inner
            if name[0] != "." and name not in NOT_OURS and at / name not in GENERATED
        )
        if at == ROOT / "samples":
            inner.clear()
        pages = (at / name for name in sorted(names) if name.endswith(".md"))
        yield from (page for page in pages if page not in GENERATED)


@cache
def tokens(document: Path) -> list[Token]:
    blocks = MarkdownIt().enable("table").parse(document.read_text("utf-8"))
    return [each for block in blocks for each in (block, *(block.children or ()))]


def links(document: Path) -> list[str]:
    found = [token.attrGet("href") or token.attrGet("src") for token in tokens(document)]
    return [unquote(str(link)) for link in found if link]


def anchors(document: Path) -> set[str]:
    """Return what may stand behind `#`, as GitHub makes it of headings; repeats are numbered."""
    seen: Counter[str] = Counter()
    made = set()
    for token, inline in pairwise(tokens(document)):
        if token.type == "heading_open":
            inner = (each.content for each in inline.children or () if each.type != "link_open")
            slug = re.sub(r"[^\w -]", "", "".join(inner).lower()).replace(" ", "-")
            made.add(f"{slug}-{seen[slug]}" if seen[slug] else slug)
            seen[slug] += 1
    return made


def dead_links(document: Path) -> Iterator[str]:
    for link in links(document):
        if _ELSEWHERE.match(link):
            continue
        path, _, anchor = link.partition("#")
        target = (document.parent / path).resolve() if path else document
        leaves = not target.is_relative_to(ROOT)
        if leaves or not target.exists() or (anchor and anchor not in anchors(target)):
            yield link


@pytest.mark.parametrize(
    "document", list(documents()), ids=lambda path: str(path.relative_to(ROOT))
)
def test_links_lead_somewhere(document: Path) -> None:
    assert not list(dead_links(document))


def test_all_documents_are_looked_at() -> None:
    names = {str(path.relative_to(ROOT)) for path in documents()}
    assert {"README.md", "docs/README.md", "samples/README.md"} <= names


def test_every_page_of_the_documentation_is_reached_from_its_index() -> None:
    index = ROOT / "docs/README.md"
    reached, waiting = {index}, [index]
    while waiting:
        here = waiting.pop()
        for link in links(here):
            target = (here.parent / link.partition("#")[0]).resolve()
            if target.suffix == ".md" and target.is_file() and target not in reached:
                reached.add(target)
                waiting.append(target)
    ours = {page for page in documents() if page.is_relative_to(ROOT / "docs")}
    assert not ours - reached


@pytest.mark.parametrize(
    ("text", "dead"),
    [
        ("# A b\n[x](#a-b)", []),
        ("# A b\n# A b\n[x](#a-b-1)", []),
        ("```\n# A b\n```\n[x](#a-b)", ["#a-b"]),
        ("# `a` & [b](https://x)!\n[x](#a--b)", []),
        ("[x](gone.md)", ["gone.md"]),
        ("![x](gone.png) [y](https://gone) [z](mailto:a@b)", ["gone.png"]),
        ("[x][r]\n\n[r]: gone.md#here", ["gone.md#here"]),
        ("[x](../../../../../../../../../etc/hosts)", ["../../../../../../../../../etc/hosts"]),
    ],
)
def test_a_dead_link_is_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, dead: list[str]
) -> None:
    monkeypatch.setattr("tests.test_links.ROOT", tmp_path)
    page = tmp_path / "page.md"
    page.write_text(text)
    assert list(dead_links(page)) == dead
