"""docs/rules: the pages are those of the rules as they are, and Markdown shows them as meant.

`pytest tests/test_rule_pages.py --update-golden` writes them anew.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from checker.finding import Place
from checker.report.report import ReportedFinding
from checker.report.sarif import help_uri
from checker.rulebook.discovery import all_rules
from checker.rulebook.options import told_options
from checker.rulebook.pages import anchor, escaped, pages, parse_page
from tests.each import of_each

FOLDER = Path(__file__).parent.parent / "docs/rules"
RULES = [rule for rule in all_rules() if rule.check.__module__.startswith("rules.")]
PAGES = pages(RULES)


def shown(markdown: str) -> str:
    """Return the text that a reader sees, with single spaces; HTML and emphasis leave marks."""
    return " ".join("".join(_pieces(markdown)).split())


def _pieces(markdown: str) -> Iterator[str]:
    for block in MarkdownIt().parse(markdown):
        for token in block.children or ():
            match token.type:
                case "text" | "code_inline":
                    yield token.content
                case "softbreak" | "hardbreak":
                    yield " "
                case _:
                    yield f"<{token.type}>"
        if block.type in ("html_block", "fence", "code_block"):
            yield f"<{block.type}>"
        yield " "


def test_the_pages_are_fresh(pytestconfig: pytest.Config) -> None:
    if pytestconfig.getoption("--update-golden"):
        FOLDER.mkdir(exist_ok=True)
        for stale in {path.name for path in FOLDER.iterdir()} - PAGES.keys():
            (FOLDER / stale).unlink()
        for name, text in PAGES.items():
            (FOLDER / name).write_text(text, "utf-8")
    written = {path.name: path.read_text("utf-8") for path in FOLDER.iterdir()}
    stale = [name for name in PAGES | written if PAGES.get(name) != written.get(name)]
    assert not stale, "pytest tests/test_rule_pages.py --update-golden"


@of_each("rule", RULES, ids=lambda rule: rule.id)
def test_a_rule_is_told_in_full(rule: object) -> None:
    (wanted,) = (each for each in RULES if each is rule)
    text = PAGES[f"{wanted.group}.md"]
    heading = f"## {wanted.id} {wanted.name}\n"
    _, found, rest = text.partition(heading)
    section = rest.partition("\n## ")[0]
    assert found
    assert anchor(wanted) == re.sub(r"[^\w -]", "", heading[3:-1].lower()).replace(" ", "-")
    page = parse_page(wanted.page)
    reported = ReportedFinding(
        wanted.id, wanted.name, wanted.severity, wanted.concern, "x", "0", (Place("a"),)
    )
    assert help_uri(reported).endswith(f"/{wanted.group}.md#{anchor(wanted)}")
    prose = shown(re.sub(r"(?s)```.*?```", "", section).replace("**", ""))
    for part in (page.title, page.why, page.fix, page.source):
        for paragraph in part.split("\n\n"):
            assert " ".join(paragraph.replace("`", "").split()) in prose.replace("`", "")
    for option in told_options(wanted):
        assert f"| `{option.name}` | `{option.default}` | {escaped(option.words)} |" in section


def test_defaults_are_written_as_a_settings_file_has_them() -> None:
    rows = [
        row
        for text in PAGES.values()
        for row in re.findall(r"^\| `(.+?)` \| `(.+?)` \| .* \|$", text, re.M)
    ]
    read = tomllib.loads(
        "\n".join(f"{number}.{name} = {value}" for number, (name, value) in enumerate(rows))
    )
    defaults = [default for rule in RULES for default in rule.options.values()]
    assert len(read) == len(defaults) > 100
    for table, default in zip(read.values(), defaults, strict=True):
        (value,) = table.values()
        assert (tuple(value) if isinstance(value, list) else value) == default


_LINE = st.text("ab <>*_[]()!#-+1.&;\\~|=:/`", min_size=1, max_size=12).map(str.strip)
_PROSE = st.lists(_LINE.filter(bool), min_size=1, max_size=4).map("\n".join)


@given(_PROSE.filter(lambda text: "`" not in text))
def test_whatever_stands_in_a_docstring_is_shown_as_it_stands(text: str) -> None:
    assert shown(escaped(text)) == " ".join(text.split())


def test_a_backtick_without_a_partner_begins_nothing() -> None:
    assert shown(escaped("one ``` and *two* ``<three>``")) == "one ``` and *two* <three>"


@given(_LINE.filter(lambda text: text and "`" not in text))
def test_code_stays_code(text: str) -> None:
    assert escaped(f"`{text}`") == f"`{text}`"
