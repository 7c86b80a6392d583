"""The pages of rules: each has all its headings, and Markdown shows it as meant."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator

from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from checker.cli.rule import page_text
from checker.report.sarif import help_uri
from checker.rule import Concern, Findings, Rule, Severity, rule
from checker.rulebook.discovery import all_rules
from checker.rulebook.options import options_of
from checker.rulebook.pages import escaped, parse_page
from checker.rulebook.shown_examples import ShownFile, shown_examples
from checker.rulebook.site import site_pages
from tests.each import of_each

RULES = [rule for rule in all_rules() if rule.check.__module__.startswith("rules.")]
PAGES = site_pages(RULES)
HEADINGS = [
    "What it does",
    "Why is this bad?",
    "Example",
    "Options",
    "Fix",
    "References",
]


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


@of_each("rule", RULES, ids=lambda rule: rule.id)
def test_a_page_has_all_its_parts(rule: Rule) -> None:
    text = PAGES[f"{rule.id}.md"]
    assert help_uri(rule.id).endswith(f"/rules/{rule.id}.html")
    code = re.compile(r"(?ms)^(`{3,}).*?^\1$")
    prose = code.sub("", text)
    assert re.findall(r"^# (.+)$", prose, re.M) == [f"{rule.name} ({rule.id})"]
    assert re.findall(r"^## (.+)$", prose, re.M) == HEADINGS
    assert "\nUse instead:\n" in prose
    seen = shown(prose).lower().replace("`", "")
    page = parse_page(rule.page)
    for part in (page.title, page.why, page.fix, page.source):
        for paragraph in part.split("\n\n"):
            assert " ".join(paragraph.replace("`", "").split()).lower() in seen
    for option in options_of(rule):
        assert f"| `{option.name}` | `{option.default}` | {escaped(option.words)} |" in text


@of_each("rule", RULES, ids=lambda rule: rule.id)
def test_a_page_and_the_command_show_the_same_examples(rule: Rule) -> None:
    page, command = PAGES[f"{rule.id}.md"], page_text(rule)
    examples = shown_examples(rule)
    assert examples is not None
    assert examples.bad
    assert examples.good
    assert examples.bad != examples.good
    for file in (*examples.bad, *examples.good):
        assert file.text or file.note
        assert f"^ {rule.id}" not in file.text
        assert len(file.text.splitlines()) <= 25
        assert file.text in page
        for line in filter(str.strip, file.text.splitlines()):
            assert line.rstrip() in command


def test_the_index_leads_to_every_page_by_group() -> None:
    index = PAGES["index.md"]
    assert re.findall(r"^- \[(\w+)\]\(\1\.md\) \S", index, re.M) == [r.id for r in RULES]
    groups = re.findall(r"^## (\w+): \S", index, re.M)
    assert groups == list(dict.fromkeys(r.group for r in RULES))


def _example_rule(good: object, bad: object) -> Rule:
    @rule("KIN901", "some-rule", Severity.ERROR, Concern.ROBOT)
    def check() -> Findings:
        yield from ()

    return Rule(check.id, check.name, check.severity, check.concern, check.check, "", [good], [bad])


def test_a_long_file_is_cut_to_the_lines_around_the_marked_one() -> None:
    lines = [f'<link name="l{number}"/>' for number in range(60)]
    good = "\n".join(lines)
    lines[40] = '<link name="wrong"/>  <!-- ^ KIN901 -->'
    examples = shown_examples(_example_rule(good, "\n".join(lines)))
    assert examples is not None
    (bad,), (good_file,) = examples.bad, examples.good
    around = [*range(37, 40), "wrong", *range(41, 44)]
    names = re.findall(r'name="(\w+)"', bad.text)
    assert names == [f"l{it}" if isinstance(it, int) else it for it in around]
    assert re.findall(r'name="l(\d+)"', good_file.text) == [str(n) for n in range(37, 44)]


def test_of_a_file_that_is_no_text_its_size_is_shown() -> None:
    examples = shown_examples(_example_rule({"a.stl": b"12345"}, {"README.md": "a\n"}))
    assert examples is not None
    assert examples.good == (
        ShownFile("README.md", "", "does not exist"),
        ShownFile("a.stl", "", "is a file of 5 bytes"),
    )


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
