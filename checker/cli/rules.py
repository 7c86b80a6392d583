"""`subt-check rules`: lists all rules."""

from __future__ import annotations

import argparse
import json

from checker.base.output import (
    EXIT_CLEAN,
    show,
)
from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from checker.rulebook.pages import parse_page


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.add_argument("--format", choices=("text", "json"), default="text")


def run(options: argparse.Namespace) -> int:
    """List all rules, by group."""
    if options.format == "json":
        listed = [_as_dict(rule) for rule in all_rules()]
        show(json.dumps(listed, indent=2) + "\n")
        return EXIT_CLEAN
    show("".join(map(rule_line, all_rules())))
    return EXIT_CLEAN


def rule_line(rule: Rule) -> str:
    """Return what a list of rules says of one."""
    title = parse_page(rule.page).title
    return f"{rule.id}  {rule.severity:<7}  {rule.concern:<11}  {rule.name:<32}  {title}\n"


def _as_dict(rule: Rule) -> dict[str, object]:
    from checker.rulebook.options import words_of

    page = parse_page(rule.page)
    return {
        "id": rule.id,
        "name": rule.name,
        "severity": str(rule.severity),
        "concern": str(rule.concern),
        "title": page.title,
        "why": page.why,
        "fix": page.fix,
        "source": page.source,
        "options": rule.options,
        "option_words": words_of(rule),
    }
