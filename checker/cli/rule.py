"""`subt-check rule`: explains a rule."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from textwrap import dedent, wrap
from typing import Any

from checker.base.errors import CheckerError
from checker.base.output import EXIT_CLEAN, show
from checker.cli.rules import rule_line
from checker.engine.options import no_such_rule
from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from checker.rulebook.options import Option, told_options
from checker.rulebook.pages import parse_page

_WIDTH = 96
"""Characters of a line that is wrapped here, without its indentation."""


def page_text(rule: Rule) -> str:
    """Return all that is known about a rule."""
    page = parse_page(rule.page)
    parts = [
        f"{rule.id} {rule.name} ({rule.severity}, about {rule.concern.words})",
        page.title + ".",
        page.why,
    ]
    parts += [f"Fix: {page.fix}", f"Source: {page.source}"]
    if rule.options:
        options = _indented("\n".join(map(_option, told_options(rule))))
        parts.append(f"Options, in subt-check.toml below [rules.{rule.id}]:\n{options}")
    if rule.bad:
        parts.append("Reported:\n" + _indented(_example(rule.bad[0])))
    if rule.good:
        parts.append("Right:\n" + _indented(_example(rule.good[0])))
    return "\n\n".join(parts)


def _option(option: Option) -> str:
    """Show an option as lines that a settings file can take, what it does above it."""
    lines = wrap(option.words, _WIDTH, initial_indent="# ", subsequent_indent="# ")
    return "\n".join([*lines, f"{option.name} = {option.default}"])


def _example(example: object) -> str:
    """Show an example: a fragment of model.sdf, or files by their paths."""
    if not isinstance(example, Mapping):
        return str(example).strip("\n")
    return "\n".join(line for path, text in example.items() for line in _lines(path, text))


_SHARED = {
    "@ros2": "launch/arm.launch.py starts an arm that urdf/arm.urdf.xacro describes",
    "@bridge": "a launch file starts Gazebo, spawns a rover with a lidar and bridges its topics",
    "@urdf": "urdf/arm.urdf contains an arm with a transmission for its joint",
}
"""What the packages hold that examples share."""
_SHARED_FILES = {
    "@fragment": "model.sdf:",
    "@urdf": "urdf/arm.urdf:",
    "@bridge": "config/bridge.yaml:",
    "@ros2": "launch/arm.launch.py starts:",
}
"""What the text of an example becomes in them."""


def _lines(path: str, text: Any) -> Iterator[str]:
    """Show one entry of an example (see `checker.rule_testing`)."""
    match path, text:
        case "@reported" | "@with" | "@profile", _:
            pass
        case _, str() if path in _SHARED_FILES:
            yield f"{_SHARED_FILES[path]}\n{_indented(dedent(text).strip())}"
        case _ if path in _SHARED:
            yield _SHARED[path]
        case "@robot", _:
            yield f"model.sdf is the robot {text!r} that examples share"
        case (("@change" | "@launch" | "@links"), _):
            words = "is a link to" if path == "@links" else "instead of"
            for first, second in text.items():
                pair = (first, second) if path == "@links" else (second, first)
                yield f"{pair[0]} {words} {pair[1]}"
        case "@name", _:
            yield f"folder {text}/"
        case _:
            yield f"{path} is missing" if text is None else f"{path}:\n{_indented(text.strip())}"


def _indented(text: str) -> str:
    return "\n".join(f"  {line}".rstrip() for line in text.splitlines())


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.add_argument(
        "id", help="id or name, such as SEN005 or lidar-scan-resolution; SEN lists a group"
    )


def run(options: argparse.Namespace) -> int:
    """Print a rule's page."""
    wanted, rules = options.id, all_rules()
    names = (wanted.upper(), wanted.lower())
    rule = next((rule for rule in rules if not set(rule.names).isdisjoint(names)), None)
    if rule is not None:
        show(page_text(rule) + "\n")
        return EXIT_CLEAN
    begun = [rule for rule in rules if wanted and rule.id.startswith(wanted.upper())]
    if not begun:
        known = [name for rule in rules for name in (rule.id, rule.name)]
        raise CheckerError(no_such_rule(wanted, known))
    show("".join(map(rule_line, begun)))
    return EXIT_CLEAN
