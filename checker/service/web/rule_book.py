"""The rule book as the site shows it: a list by groups, and a page for each rule."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from itertools import groupby
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.rulebook.discovery import all_rules
from checker.rulebook.pages import about, escaped, parse_page, told

if TYPE_CHECKING:
    from markdown_it import MarkdownIt
    from markupsafe import Markup


class RuleEntry(Record):
    """A rule in the list.

    Attributes:
        title: What is wrong, one line of HTML.
    """

    id: str
    name: str
    severity: str
    title: Markup


class RuleGroup(Record):
    """Rules of one group.

    Attributes:
        title: What they are about, one line of HTML.
    """

    letters: str
    title: Markup
    rules: tuple[RuleEntry, ...]


class RulePage(Record):
    """All that is told of a rule; `body` is HTML."""

    entry: RuleEntry
    body: Markup


@cache
def groups() -> tuple[RuleGroup, ...]:
    """Return all rules by group."""
    found = []
    for letters, members in groupby(all_rules(), lambda rule: rule.group):
        rules = list(members)
        entries = tuple(pages()[rule.id].entry for rule in rules)
        found.append(RuleGroup(letters, _line(about(rules)), entries))
    return tuple(found)


@cache
def pages() -> Mapping[str, RulePage]:
    """Return the page of each rule by its id."""
    from markupsafe import Markup

    made = {}
    for rule in all_rules():
        title = _line(escaped(parse_page(rule.page).title))
        entry = RuleEntry(rule.id, rule.name, str(rule.severity), title)
        # Markdown without HTML in it: what is rendered is safe, whoever wrote the rule.
        body = Markup(_markdown().render("\n\n".join(told(rule))))  # noqa: S704
        made[rule.id] = RulePage(entry, body)
    return made


def _line(markdown: str) -> Markup:
    from markupsafe import Markup

    return Markup(_markdown().renderInline(markdown))  # noqa: S704


@cache
def _markdown() -> MarkdownIt:
    from markdown_it import MarkdownIt

    return MarkdownIt("commonmark", {"html": False}).enable("table")
