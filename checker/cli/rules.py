"""`subt-check rules`: lists all rules, or writes the schema of settings that names them."""

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
    parser.add_argument(
        "--format",
        choices=("text", "json", "settings-schema"),
        default="text",
        help="settings-schema: the JSON schema of subt-check.toml, for editors",
    )


def run(options: argparse.Namespace) -> int:
    """List all rules, by group."""
    match options.format:
        case "json":
            show(json.dumps([_as_dict(rule) for rule in all_rules()], indent=2) + "\n")
        case "settings-schema":
            from checker.engine.settings_schema import settings_schema

            show(json.dumps(settings_schema(), indent=1, ensure_ascii=False) + "\n")
        case _:
            show("".join(map(rule_line, all_rules())))
    return EXIT_CLEAN


def rule_line(rule: Rule) -> str:
    """Return what a list of rules states about one."""
    title = parse_page(rule.page).title
    return f"{rule.id}  {rule.severity:<7}  {rule.concern:<11}  {rule.name:<32}  {title}\n"


def _as_dict(rule: Rule) -> dict[str, object]:
    from checker.rulebook.options import option_texts

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
        "option_words": option_texts(rule),
    }
