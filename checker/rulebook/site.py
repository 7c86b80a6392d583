"""The rule book as Markdown, for the site and the service: a page for each rule, and an index."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import groupby
from pathlib import PurePosixPath

from checker.rule import Rule
from checker.rulebook.options import options_of, work_of
from checker.rulebook.pages import escaped, group_description, parse_page
from checker.rulebook.profiles import Profile, profile, profile_names
from checker.rulebook.shown_examples import ShownFile, shown_examples

_LANGUAGES = {
    ".rb": "ruby",
    ".md": "markdown",
    ".yaml": "yaml",
    ".yml": "yaml",
    ".toml": "toml",
    ".json": "json",
    ".txt": "cmake",
    ".py": "python",
    ".cfg": "ini",
    ".obj": "text",
    ".mtl": "text",
}
"""Languages by the suffix of a file; the others contain XML."""
# Sphinx looks for each page in the menu, unless it is an orphan: the index leads to them.
_ORPHAN = "---\norphan: true\n---"


def site_pages(rules: Iterable[Rule]) -> dict[str, str]:
    """Return the Markdown of each page by its file name."""
    book = sorted(rules, key=lambda rule: rule.id)
    return {"index.md": _index(book)} | {f"{rule.id}.md": _page(rule) for rule in book}


def _index(book: Iterable[Rule]) -> str:
    lines = ["# Rules", ""]
    for group, members in groupby(book, lambda rule: rule.group):
        rules = list(members)
        lines += [f"## {group}: {group_description(rules)}", ""]
        lines += [f"- [{r.id}]({r.id}.md) {escaped(parse_page(r.page).title)}" for r in rules]
        lines.append("")
    return "\n".join(lines)


def _page(rule: Rule) -> str:
    top = [_ORPHAN, f"# {rule.name} ({rule.id})", *rule_blocks(rule)]
    return "\n\n".join([*top, "[All rules](index.md)"]) + "\n"


def rule_blocks(rule: Rule) -> Iterator[str]:
    """Yield the page of a rule below its heading, block by block."""
    page = parse_page(rule.page)
    judges = ", ".join(_profiles(rule))
    yield f"Usually **{rule.severity}**; about {rule.concern.label}; in the profiles {judges}."
    yield "## What it does"
    yield f"{escaped(page.title)}."
    yield escaped(work_of(rule))
    yield "## Why is this bad?"
    yield escaped(page.why)
    if (examples := shown_examples(rule)) is not None:
        yield "## Example"
        yield from map(_file, examples.bad)
        yield "Use instead:"
        yield from map(_file, examples.good)
    yield "## Options"
    yield from _options(rule)
    yield "## Fix"
    yield escaped(page.fix[:1].upper() + page.fix[1:])
    yield "## References"
    yield escaped(page.source)


def _profiles(rule: Rule) -> Iterator[str]:
    """Yield the profiles that a rule belongs to, each with its severity where it differs.

    Those of a family are one where they agree: `gazebo-*`.
    """
    judges = [*map(profile, profile_names())]
    for family, members in groupby(judges, lambda judge: judge.name.partition("-")[0]):
        said = {member.name: _judged(member, rule) for member in members}
        if len(said) > 1 and len({*said.values()}) == 1:
            said = {f"{family}-*": next(iter(said.values()))}
        yield from (f"`{name}`{words}" for name, words in said.items() if words is not None)


def _judged(judge: Profile, rule: Rule) -> str | None:
    """Return the severity of a rule in a profile where it differs; None if it does not count."""
    other = judge.severity.get(rule.id, rule.severity)
    different = f" ({other})" if other != rule.severity else ""
    return different if judge.includes(rule) else None


def _options(rule: Rule) -> Iterator[str]:
    if not rule.options:
        yield "None."
        return
    yield f"In `subt-check.toml`, below `[rules.{rule.id}]`:"
    rows = [f"| `{o.name}` | `{o.default}` | {escaped(o.words)} |" for o in options_of(rule)]
    yield "\n".join(["| option | default | meaning |", "|---|---|---|", *rows])


def _file(file: ShownFile) -> str:
    """Show a file of an example."""
    name = "The package" if file.path == "." else f"`{file.path}`"
    if not file.text:
        return f"{name} {escaped(file.note)}."
    language = _LANGUAGES.get(PurePosixPath(file.path).suffix, "xml")
    fence = max(["```", *(f"{ticks}`" for ticks in re.findall("`{3,}", file.text))], key=len)
    return f"{name}:\n\n{fence}{language}\n{file.text}\n{fence}"
