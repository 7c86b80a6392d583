"""A placeholder or struck-through text in specifications.md.

What the author wanted to fill in later is missing, and struck-through text is still shown: readers
cannot tell which of the two counts. TODO is an error: `subt-check migrate` writes it where only the
author knows the figure, and a robot without its figures is not ready.

Fix: fill in the placeholder, or remove it; delete struck-through text.
Source: SubT reviews ask authors to remove struck-through text and the template's links such as
`https://youtu.be/xxxx` (`subt_standards.json`).
"""

import re

from checker.model.specification.sheet import Specification
from checker.model.specification.sheet_text import (
    links_without_target,
    placeholders,
    struck_through,
)
from checker.rule import Concern, Findings, Severity, finding, rule

SHOWN = 60
_ESCAPED = re.compile(r"\\([!-/:-@\[-`{-~])")


@rule("DOC002", "placeholder-left", Severity.WARNING, Concern.PAPERWORK)
def check(specification: Specification) -> Findings:
    """Report placeholders, links without target and struck-through text."""
    for left in placeholders(specification.markdown):
        message = f"{_short(left.words)!r} is a placeholder: fill it in or remove it"
        severity = Severity.ERROR if left.words == "TODO" else None
        yield finding(left, message, severity=severity, key=left.words.casefold()[:SHOWN])
    for left in links_without_target(specification.markdown):
        message = f"link {_short(left.words)!r} has no address: add one or remove the link"
        yield finding(left, message, key="no address")
    for left in struck_through(specification.markdown):
        yield finding(left, f"{_short(left.words)!r} is struck through: delete it")


def _short(words: str) -> str:
    """Return the words as a reader sees them, shortened when they are long."""
    words = _ESCAPED.sub(r"\1", words)
    return words if len(words) <= SHOWN else f"{words[: SHOWN - 3]}..."


_HEAD = "# Rover\n"
_MARK = " <!-- ^ DOC002 -->"

GOOD = [
    {
        "specifications.md": f"""{_HEAD}
<!-- TODO: ask for the mass -->
Commands go to `/<robot name>/cmd_vel` and `/<Robot Name>/odom`, about ~5 kg, ~6 W.
```
echo TODO > ~~list~~
```
[Video](https://youtu.be/xxkAt3xxx) <https://example.org/xx> \\<Test Link, https://youtu.be/abc/\\>
<maximumLinearVelocity>5 5 2</maximumLinearVelocity>
"""
    },
]
BAD = [
    {"specifications.md": f"{_HEAD}* Endurance test: TBD (May){_MARK}\n"},
    {"specifications.md": f"{_HEAD}* [Video](https://youtu.be/xxxxxxxxx/){_MARK}\n"},
    {"specifications.md": f"{_HEAD}See [Guide](https://example.com/\\<fix_me\\>).{_MARK}\n"},
    {"specifications.md": f"{_HEAD}### Diversions of \\<Robot Name\\>{_MARK}\n"},
    {"specifications.md": f"{_HEAD}* \\<Video Link(s), e.g.,https://youtu.be/abc/\\>{_MARK}\n"},
    {"specifications.md": f"{_HEAD}* [Datasheet](){_MARK}\n"},
    {"specifications.md": f"{_HEAD}Battery life of ~~5400~~ 3600 s{_MARK}\n"},
    {"specifications.md": f"{_HEAD}Battery life of <del>5400 s{_MARK}\n\nand more</del> 1 h\n"},
]
