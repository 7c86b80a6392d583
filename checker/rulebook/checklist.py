"""The robot model checklist, each item with the rules that judge it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from checker.base.resources import table
from checker.rule import Rule
from checker.rulebook.pages import escaped, parse_page

_TOP = """# The robot model checklist

What reviewers ask of a robot model, in their words, and the rules that judge it.
"""


def items(rules: Iterable[Rule]) -> Iterator[tuple[str, list[Rule]]]:
    """Yield each item of the checklist with those of its rules that exist."""
    known = tuple(rules)
    for entry in table("checklist")["items"]:
        wanted = entry["rules"]
        yield entry["item"], [r for r in known if any(_covers(pattern, r) for pattern in wanted)]


def _covers(pattern: str, rule: Rule) -> bool:
    """Return whether a group, an id, or a range such as `SEN001-003` means a rule."""
    first, dash, last = pattern.partition("-")
    if not dash:
        return pattern in (rule.id, rule.group)
    number = rule.id.removeprefix(rule.group)
    return first.startswith(rule.group) and first.removeprefix(rule.group) <= number <= last


def to_markdown(rules: Iterable[Rule]) -> str:
    """Return the checklist as a page of the site."""
    blocks = [_TOP]
    for item, judged_by in items(rules):
        lines = [
            f"- [{r.id}](rules/{r.id}.md) {escaped(parse_page(r.page).title)} ({r.severity})"
            for r in judged_by
        ]
        blocks.append("\n".join([f"## {item[0].upper()}{item[1:]}", "", *lines, ""]))
    return "\n".join(blocks)
