"""A pull request comment: the verdict first, bounded, and what a package says stays text."""

from __future__ import annotations

import re
from html import unescape

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt
from msgspec.structs import replace

from checker.base.words import plain
from checker.finding import Place, Severity
from checker.report.markdown import SIZE_LIMIT, to_markdown
from checker.report.markdown_text import code, escaped, fitting, with_code
from checker.report.report import (
    Cause,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    Suppressed,
    SuppressedBy,
)
from tests.report.any_report import REPORTS, TEXT, many

PARSER = MarkdownIt("commonmark", {"html": True}).enable(["table", "strikethrough"])
(PACKAGE,) = many(1).packages
FAULT = replace(PACKAGE.findings[0], message="<b>bold</b> @all #1 a|b `c` [d](e) *f*")
OURS = {"code", "/code", "details", "/details", "summary", "/summary"}
"""Tags that the report itself writes."""


def rendered(markdown: str) -> str:
    return str(PARSER.render(markdown))


def text_in(html: str) -> str:
    """Return the text that a reader sees."""
    return unescape(re.sub(r"<[^>]*>", "", html)).replace("\N{ZERO WIDTH SPACE}", "")


def test_one_package_has_its_verdict_findings_and_the_rest_folded() -> None:
    unseen = NotChecked("SEN001", "the model is not available", Cause.NOT_AT_HAND)
    aside = Suppressed(FAULT, SuppressedBy.COMMENT, "it is so")
    package = replace(
        PACKAGE,
        findings=(replace(FAULT, message="it is red"),),
        not_checked=(unseen,),
        facts={"mass_kg": 18.5},
        suppressed=(aside,),
    )
    written = to_markdown(Report((package,), {}))
    assert written.startswith(
        "## rover: Not ready\n\n"
        "1 error of portability to fix (1 suppressed, 1 of them an error)\n\n"
    )
    assert (
        "| error | SDF004 unknown-element | <code>models/rover/model.sdf</code> line 1 | "
        "it is red (and 1 more place) |\n"
    ) in written
    assert "- **SDF004** It is ignored. **Fix:** take it out.\n" in written
    assert "- SEN001: the model is not available\n" in written
    assert "- mass 18.5 kg\n" in written
    assert "(comment: it is so)\n" in written
    assert written.count("<details>") == written.count("</details>") == 4


def test_several_packages_begin_with_a_table() -> None:
    good = PackageReport("good", "models/good", "robot", (), facts={"links": 2})
    written = to_markdown(Report((good, PACKAGE), {}))
    assert written.splitlines()[:6] == [
        "## 2 packages, 1 ready",
        "",
        "| package | verdict | errors | warnings | infos |",
        "|---|---|---:|---:|---:|",
        "| good | ready | 0 | 0 | 0 |",
        "| rover | not ready | 1 | 0 | 0 |",
    ]
    assert "- **good**: 2 links\n" in written


def test_nothing_to_say_is_said_shortly() -> None:
    good = PackageReport("good", "good", "robot", ())
    assert to_markdown(Report((good,), {})) == "## good: Ready\n\nnothing to fix\n"


def test_what_was_not_opened_is_listed() -> None:
    missing = NotOpened("nowhere", "does not exist", failed=True)
    assert "- <code>nowhere</code>: does not exist\n" in to_markdown(Report((), {}, (missing,)))


def test_ten_thousand_findings_fit_into_a_comment() -> None:
    report = many(10_000)
    (package,) = report.packages
    unseen = tuple(
        NotChecked("SEN001", f"{n} " + "\N{ROBOT FACE}" * 500, Cause.NOT_AT_HAND)
        for n in range(1000)
    )
    aside = tuple(Suppressed(each, SuppressedBy.SETTINGS, "|" * 900) for each in package.findings)
    long = replace(package, name="<" * 900, not_checked=unseen, suppressed=aside)
    for packages in ((long,), (long,) * 5):
        written = to_markdown(Report(packages, {}))
        assert len(written.encode()) < SIZE_LIMIT
        assert re.search(r"and \d+ more findings; `--format json` lists all", written)


def test_mentions_issues_and_addresses_become_no_links() -> None:
    said = escaped("@all #1 https://a.b www.a.b")
    assert said == (
        "&#64;\N{ZERO WIDTH SPACE}all &#35;\N{ZERO WIDTH SPACE}1 https&#58;//a.b www&#46;a.b"
    )
    assert escaped("base_link of model.sdf: 0.1 (a) __init__") == (
        "base_link of model.sdf: 0.1 (a) &#95;&#95;init&#95;&#95;"
    )


def test_what_pages_hold_in_backticks_is_code() -> None:
    assert with_code("write `<a|b>` there") == "write <code>&#60;a&#124;b&#62;</code> there"
    assert with_code("a ` b") == "a &#96; b"


def test_a_message_is_shown_as_it_is() -> None:
    written = to_markdown(Report((replace(PACKAGE, findings=(FAULT,)),), {}))
    html = rendered(written)
    assert FAULT.message in text_in(html)
    for tag in ("<b>", "<em>", "<a ", "<code>c"):
        assert tag not in html


@pytest.mark.parametrize("form", [escaped, code])
@given(text=TEXT)
def test_any_text_in_a_table_cell_is_that_text(form: object, text: str) -> None:
    assert callable(form)
    html = rendered(f"| a |\n|---|\n| x{form(text)}x |\n")
    shown = plain(text).replace("\N{ZERO WIDTH SPACE}", "")
    assert html.count("<td>") == 1
    assert f"x{shown}x" in text_in(html)


@given(REPORTS)
def test_any_report_has_the_tags_of_the_report_alone(report: Report) -> None:
    written = to_markdown(report)
    assert len(written.encode()) < SIZE_LIMIT
    for token in PARSER.parse(written):
        for each in (token, *(token.children or ())):
            assert each.type not in ("link_open", "image", "fence", "code_block")
            if each.type in ("html_inline", "html_block"):
                assert set(re.findall(r"<([^>]*)>", each.content)) <= OURS
    assert not re.search(r"[@#]\w", seen_by_github(written))


def seen_by_github(markdown: str) -> str:
    """Return what GitHub looks for mentions in: all text but code."""
    return unescape(re.sub(r"<code>.*?</code>|<[^>]*>", "", rendered(markdown)))


@given(st.lists(st.text(max_size=30)), st.integers(0, 200))
def test_lines_fit_or_are_counted(lines: list[str], room: int) -> None:
    kept, left = fitting(lines, str, room)
    assert kept == lines[: len(kept)]
    assert len(kept) + left == len(lines)
    assert sum(len(each.encode()) + 1 for each in kept) <= room


def test_samples_and_corpus_fit(of_samples: Report) -> None:
    written = to_markdown(of_samples)
    assert len(written.encode()) < SIZE_LIMIT
    assert re.match(r"## \d+ packages, \d+ worlds and \d+ file, \d+ ready\n", written)
    assert f"| {Severity.ERROR} |" in written
    assert rendered(written).count("<table>") == 2


def test_a_very_long_path_keeps_its_end() -> None:
    place = Place("a/" * 500 + "model.sdf", 3)
    package = replace(PACKAGE, findings=(replace(FAULT, places=(place,)),))
    assert "a/model.sdf</code> line 3" in to_markdown(Report((package,), {}))
