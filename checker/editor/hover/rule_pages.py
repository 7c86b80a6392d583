"""The page of a rule, as the hover of one of its findings."""

from __future__ import annotations

from collections.abc import Iterator

from checker.report.sarif import help_uri
from checker.rule import Rule
from checker.rulebook.options import options_of
from checker.rulebook.pages import escaped, parse_page


def rule_page_markdown(rule: Rule) -> str:
    """Return a rule's page: what is wrong, why, what to do, its source and its options."""
    return "\n\n".join(_blocks(rule))


def _blocks(rule: Rule) -> Iterator[str]:
    page = parse_page(rule.page)
    yield f"**{rule.id} {rule.name}**: {escaped(page.title)}."
    for label, text in (("", page.why), ("Fix: ", page.fix), ("Source: ", page.source)):
        if text:
            paragraphs = "\n\n".join(map(_paragraph, text.split("\n\n")))
            yield f"**{label.strip()}** {paragraphs}" if label else paragraphs
    options = options_of(rule)
    if options:
        lines = (f"- `{it.name}` = `{it.default}`: {escaped(it.words)}" for it in options)
        yield "\n".join((f"**Options**, below `[rules.{rule.id}]`:", "", *lines))
    yield f"[{rule.id} in the rule book]({help_uri(rule.id)})"


def _paragraph(text: str) -> str:
    """Return a paragraph on one line, which an editor breaks at its own width."""
    lines = [line.strip() for line in escaped(text).splitlines()]
    is_list = any(line.startswith(("- ", "* ", "|")) for line in lines)
    return "\n".join(lines) if is_list else " ".join(lines)
