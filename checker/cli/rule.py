"""`subt-check rule`: explains a rule."""

from __future__ import annotations

import argparse
from textwrap import wrap

from checker.base.errors import CheckerError
from checker.base.output import EXIT_CLEAN, show
from checker.cli.rules import rule_line
from checker.engine.options import no_such_rule
from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from checker.rulebook.options import Option, options_of
from checker.rulebook.pages import parse_page
from checker.rulebook.shown_examples import ShownFile, shown_examples

_WIDTH = 96
"""Characters of a line that is wrapped here, without its indentation."""


def page_text(rule: Rule) -> str:
    """Return all that is known about a rule."""
    page = parse_page(rule.page)
    parts = [
        f"{rule.id} {rule.name} ({rule.severity}, about {rule.concern.label})",
        page.title + ".",
        page.why,
    ]
    parts += [f"Fix: {page.fix}", f"Source: {page.source}"]
    if rule.options:
        options = _indented("\n".join(map(_option, options_of(rule))))
        parts.append(f"Options, in subt-check.toml below [rules.{rule.id}]:\n{options}")
    if (examples := shown_examples(rule)) is not None:
        for label, files in (("Example", examples.bad), ("Use instead", examples.good)):
            parts.append(f"{label}:\n" + _indented("\n".join(map(_file, files))))
    return "\n\n".join(parts)


def _option(option: Option) -> str:
    """Show an option as lines that a settings file can take, what it does above it."""
    lines = wrap(option.words, _WIDTH, initial_indent="# ", subsequent_indent="# ")
    return "\n".join([*lines, f"{option.name} = {option.default}"])


def _file(file: ShownFile) -> str:
    """Show a file of an example, or state what is the matter with it."""
    name = "the package" if file.path == "." else file.path
    return f"{name}:\n{_indented(file.text)}" if file.text else f"{name} {file.note}"


def _indented(text: str) -> str:
    return "\n".join(f"  {line}".rstrip() for line in text.splitlines())


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.add_argument(
        "id", help="id or name, such as SEN005 or lidar-scan-resolution; SEN lists a group"
    )


def explanation(wanted: str) -> str:
    """Return the page of a rule by its id or name, or the lines of a group.

    Raises:
        CheckerError: There is no such rule.
    """
    rules, names = all_rules(), (wanted.upper(), wanted.lower())
    rule = next((rule for rule in rules if not set(rule.names).isdisjoint(names)), None)
    if rule is not None:
        return page_text(rule) + "\n"
    begun = [rule for rule in rules if wanted and rule.id.startswith(wanted.upper())]
    if not begun:
        known = [name for rule in rules for name in (rule.id, rule.name)]
        raise CheckerError(no_such_rule(wanted, known))
    return "".join(map(rule_line, begun))


def run(options: argparse.Namespace) -> int:
    """Print a rule's page."""
    show(explanation(options.id))
    return EXIT_CLEAN
