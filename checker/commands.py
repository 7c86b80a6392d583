"""What the commands of `subt-check` do."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from checker.check import check_paths
from checker.cli import EXIT_CLEAN, EXIT_CRASH, EXIT_FINDINGS, EXIT_USAGE
from checker.discovery import all_rules
from checker.errors import CheckerError
from checker.finding import Severity
from checker.page import parse_page
from checker.report.json_report import to_json
from checker.report.palette import palette_for
from checker.report.report import Report
from checker.report.text_report import to_text
from checker.rule import Rule


def check(options: argparse.Namespace) -> int:
    """Check packages and print the report."""
    wishes = {
        "profile": options.profile,
        "select": options.select,
        "ignore": options.ignore,
        "fail_on": Severity(options.fail_on) if options.fail_on else None,
    }
    report, fail_on = check_paths([Path(path) for path in options.paths], wishes, options.jobs)
    if options.format == "json":
        text = to_json(report)
    else:
        text = to_text(report, palette_for(options.color, sys.stdout))
    if options.output:
        _write(Path(options.output), text)
    else:
        sys.stdout.write(text)
        sys.stdout.flush()
    if options.report:
        _write(Path(options.report) / "report.json", to_json(report))
    return exit_code(report, fail_on)


def _write(path: Path, text: str) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
    except OSError as error:
        raise CheckerError(f"{path} cannot be written: {error.strerror}") from None


def exit_code(report: Report, fail_on: Severity) -> int:
    """Return 3 when a rule crashed, else 1 when something is at or above `fail_on`, else 0."""
    if any(package.crashed for package in report.packages):
        return EXIT_CRASH
    severities = (each.severity for package in report.packages for each in package.findings)
    return EXIT_FINDINGS if any(s.rank <= fail_on.rank for s in severities) else EXIT_CLEAN


def explain_rule(wanted: str) -> int:
    """Print a rule's page."""
    rule = next((r for r in all_rules() if wanted.upper() == r.id or wanted == r.name), None)
    if rule is None:
        from difflib import get_close_matches

        names = [name for r in all_rules() for name in (r.id, r.name)]
        near = get_close_matches(wanted.upper(), names, 1) or get_close_matches(wanted, names, 1)
        hint = f"did you mean {near[0]}?" if near else "`subt-check rules` lists them"
        print(f"subt-check: there is no rule {wanted!r}; {hint}", file=sys.stderr)
        return EXIT_USAGE
    print(_page_text(rule))
    return EXIT_CLEAN


def _page_text(rule: Rule) -> str:
    page = parse_page(rule.page)
    parts = [f"{rule.id} {rule.name} ({rule.severity})", page.title + ".", page.why]
    parts += [f"Fix: {page.fix}", f"Source: {page.source}"]
    if rule.options:
        options = "\n".join(f"  {name} = {value!r}" for name, value in rule.options.items())
        parts.append(f"Options, in subt-check.toml below [rules.{rule.id}]:\n{options}")
    if rule.bad:
        parts.append("Reported:\n" + _indented(_example(rule.bad[0])))
    if rule.good:
        parts.append("Right:\n" + _indented(_example(rule.good[0])))
    return "\n\n".join(parts)


def _example(example: object) -> str:
    if isinstance(example, dict):
        return "\n".join(f"{path}:\n{_indented(text.strip())}" for path, text in example.items())
    return str(example).strip("\n")


def _indented(text: str) -> str:
    return "\n".join(f"  {line}".rstrip() for line in text.splitlines())


def list_rules(form: str) -> int:
    """List all rules, by group."""
    if form == "json":
        print(json.dumps([_as_dict(rule) for rule in all_rules()], indent=2, ensure_ascii=False))
        return EXIT_CLEAN
    for rule in all_rules():
        title = parse_page(rule.page).title
        print(f"{rule.id}  {rule.severity:<7}  {rule.name:<32}  {title}")
    return EXIT_CLEAN


def _as_dict(rule: Rule) -> dict[str, object]:
    page = parse_page(rule.page)
    return {
        "id": rule.id,
        "name": rule.name,
        "severity": str(rule.severity),
        "title": page.title,
        "why": page.why,
        "fix": page.fix,
        "source": page.source,
        "options": rule.options,
    }
