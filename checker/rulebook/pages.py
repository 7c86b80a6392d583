"""The rule book as Markdown (`docs/rules`): a page for each group, written from the rules."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache as once
from itertools import groupby
from pathlib import PurePosixPath
from textwrap import dedent
from typing import Any

from checker.base.record import Record
from checker.rule import Rule
from checker.rulebook.options import told_options, work_of
from checker.rulebook.profiles import Profile, profile, profile_names

# The page of a rule, from the docstring of its module.
#
# A page has a title line that says what is wrong, a body that says why it matters, and two marked
# paragraphs: `Fix:` and `Source:`.


class Page(Record):
    """The parts of a rule's page.

    Attributes:
        title: What is wrong, one line.
        why: What goes wrong because of it, and notes.
        fix: What to do.
        source: Where the rule comes from.
    """

    title: str
    why: str
    fix: str
    source: str

    @property
    def reason(self) -> str:
        """First sentence of the body."""
        sentence, dot, _ = " ".join(self.why.split("\n\n")[0].split()).partition(". ")
        return sentence + ("." if dot else "")


@once
def parse_page(docstring: str) -> Page:
    """Split a docstring into the parts of a page."""
    title, *paragraphs = [part.strip() for part in docstring.strip().split("\n\n")]
    parts: dict[str, list[str]] = {"why": [], "fix": [], "source": []}
    for block in paragraphs:
        rest = block
        for label in ("Source:", "Fix:"):
            before, found, after = _cut(rest, label)
            if found:
                parts[label[:-1].lower()].append(after)
                rest = before
        if rest:
            parts["why"].append(rest)
    return Page(
        title.rstrip("."),
        "\n\n".join(parts["why"]),
        "\n\n".join(parts["fix"]),
        "\n\n".join(parts["source"]),
    )


def _cut(block: str, label: str) -> tuple[str, bool, str]:
    """Split a block at the line that begins with a label."""
    lines = block.splitlines() if label in block else []
    for index, line in enumerate(lines):
        if line.startswith(label):
            after = "\n".join([line.removeprefix(label).strip(), *lines[index + 1 :]]).strip()
            return "\n".join(lines[:index]).strip(), True, after
    return block, False, ""


_GENERATED = "This page is generated from the rules: `make golden`."
_SHORT = 16
"""Lines of an example that is shown."""
_CODE = re.compile(r"(?<!`)(`+)(?!`).*?(?<!`)\1(?!`)", re.DOTALL)
_LANGUAGES = {
    ".rb": "ruby",
    ".md": "markdown",
    ".yaml": "yaml",
    ".yml": "yaml",
    ".txt": "cmake",
    ".py": "python",
}
"""By the suffix of a file; the others hold XML."""


def pages(rules: Iterable[Rule]) -> dict[str, str]:
    """Return the text of each page by its file name."""
    groups = [
        (group, list(members))
        for group, members in groupby(sorted(rules, key=lambda r: r.id), lambda r: r.group)
    ]
    texts = {f"{group}.md": _group_page(group, members) for group, members in groups}
    return {"README.md": _index(groups), **texts}


def anchor(rule: Rule) -> str:
    """Return the part of a link behind `#` that leads to a rule on its group's page."""
    return f"{rule.id.lower()}-{rule.name}"


def _index(groups: Sequence[tuple[str, Sequence[Rule]]]) -> str:
    count = sum(len(members) for _, members in groups)
    lines = ["# The rule book", "", f"{count} rules in {len(groups)} groups. {_GENERATED}", ""]
    for group, members in groups:
        lines += [f"## [{group}]({group}.md): {about(members)}", ""]
        lines += [f"- [{r.id}]({group}.md#{anchor(r)}) {_title(r)}" for r in members]
        lines.append("")
    return "\n".join(lines)


def _group_page(group: str, members: Sequence[Rule]) -> str:
    top = [f"# {group}: {about(members)}", f"{_GENERATED} [All rules](README.md)"]
    return "\n\n".join([*top, *(block for rule in members for block in _rule(rule))]) + "\n"


def about(members: Sequence[Rule]) -> str:
    """Return what a group is about: the docstring of its folder, without its letters."""
    folder = sys.modules[members[0].check.__module__.rpartition(".")[0]]
    docstring = inspect.getdoc(folder) or ""
    return escaped(docstring.partition("\n")[0].partition(": ")[2].rstrip("."))


def _title(rule: Rule) -> str:
    return escaped(parse_page(rule.page).title)


def _rule(rule: Rule) -> Iterator[str]:
    yield f"## {rule.id} {rule.name}"
    yield from told(rule)


def told(rule: Rule) -> Iterator[str]:
    """Yield what is told of a rule below its heading, block by block."""
    page = parse_page(rule.page)
    yield f"{escaped(page.title)}."
    judges = ", ".join(_profiles(rule))
    yield f"Usually **{rule.severity}**; about {rule.concern.words}; in the profiles {judges}."
    yield escaped(page.why)
    yield f"**Fix:** {escaped(page.fix)}"
    yield f"**Source:** {escaped(page.source)}"
    if rule.options:
        yield from _options(rule)
    for words, examples in (("Reported", rule.bad), ("Right", rule.good)):
        shown = next(filter(None, map(_example, examples)), "")
        if shown:
            yield f"{words}:"
            yield shown


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
    """Return the severity of a rule in a profile where it differs; None where it does not count."""
    other = judge.severity.get(rule.id, rule.severity)
    different = f" ({other})" if other != rule.severity else ""
    return different if judge.includes(rule) else None


def _options(rule: Rule) -> Iterator[str]:
    """Yield what the rule does, and its options."""
    yield f"**Options**, below `[rules.{rule.id}]`. {escaped(work_of(rule))}"
    rows = [f"| `{o.name}` | `{o.default}` | {escaped(o.words)} |" for o in told_options(rule)]
    yield "\n".join(["| option | default | meaning |", "|---|---|---|", *rows])


def _example(example: object) -> str:
    """Show an example that is short and all in one text; else nothing."""
    match example:
        case str():
            return _fenced(example, "model.sdf")
        case Mapping() if len(example) == 1:
            ((path, text),) = example.items()
            return _example_block(path, text)
        case _:
            return ""


def _example_block(path: str, text: Any) -> str:
    if path == "@ros2" and isinstance(text, str):
        return _fenced(dedent(text), "arm.launch.py")
    if path == "@bridge" and isinstance(text, str):
        return _fenced(text, "bridge.yaml")
    if not isinstance(text, str) or (path.startswith("@") and path not in ("@fragment", "@urdf")):
        return ""
    block = _fenced(text, "model.sdf" if path.startswith("@") else path)
    return block if path.startswith("@") or not block else f"`{path}`\n\n{block}"


def _fenced(text: str, path: str) -> str:
    code = dedent(text.strip("\n")).rstrip()
    if not code or len(code.splitlines()) > _SHORT or "```" in code:
        return ""
    language = _LANGUAGES.get(PurePosixPath(path).suffix, "xml")
    return f"```{language}\n{code}\n```"


def escaped(text: str) -> str:
    """Return a docstring's text so that Markdown shows it as it stands; code in backticks stays."""
    parts, end = [], 0
    for code in _CODE.finditer(text):
        parts += [_escaped(text[end : code.start()]), code[0]]
        end = code.end()
    return "".join([*parts, _escaped(text[end:])])


def _escaped(text: str) -> str:
    text = re.sub(r"([\\`<&*~\[\]|]|(?<!\w)_|_(?!\w))", r"\\\1", text)
    text = re.sub(r"(?m)^(\s*)([-+#>=])", r"\1\\\2", text)
    return re.sub(r"(?m)^(\s*\d+)([.)])", r"\1\\\2", text)
