"""A suppression of a rule that finds nothing there.

The fault is corrected or has moved, and the suppression would hide the next one. A comment applies
to one line: its own or, if alone on its line, also the next one. Only rules that ran count;
comments on CFG rules are not checked.

Fix: remove the comment or the entry of the settings, or move it to the line that the finding names.
Source: README, section "Suppress".
"""

from collections.abc import Iterator

from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.rulebook.suppression.parts import Suppressions, UnusedEntries


@rule("CFG002", "unused-suppression", Severity.WARNING, Concern.PAPERWORK)
def check(suppressions: Suppressions) -> Findings:
    """Report comments and entries of the settings without a finding."""
    for entry in suppressions.unused:
        message = f"ignore[{entry.rule}] is unused: {entry.rule} has no finding on its line"
        yield finding(entry.comment.place, message)
    yield from _entries(suppressions.unused_entries)


def _entries(unused: UnusedEntries) -> Iterator[Finding]:
    """Report entries one by one; entries of shared settings may apply to other packages."""
    if unused.own:
        for entry in unused.entries:
            yield _finding(unused, str(entry), Severity.WARNING)
    elif unused.entries:
        yield _finding(unused, "; ".join(map(str, unused.entries)), Severity.INFO)


def _finding(unused: UnusedEntries, what: str, severity: Severity) -> Finding:
    message = f"suppress in {unused.file} is unused here: there is no finding of {what}"
    return finding(unused.place, message, severity=severity)


def _axle(child: str, comment: str) -> str:
    return f"""
<link name="wheel"/>
<joint name="axle" type="revolute">
  <parent>base_link</parent>
  {comment}
  <child>{child}</child>
</joint>
"""


_COMMENT = "<!-- subt-check: ignore[KIN001] the launcher adds the wheel -->"
_SETTINGS = """
[[suppress]]
rule = "unknown-joint-link"
reason = "the launcher adds the wheel"
"""

GOOD = [
    {"@with": ["KIN001"], "@fragment": _axle("tyre", _COMMENT)},
    {"@with": ["KIN001"], "@fragment": _axle("tyre", ""), "subt-check.toml": _SETTINGS},
    {"@with": [], "@fragment": _axle("wheel", _COMMENT)},
]
BAD = [
    {"@with": ["KIN001"], "@fragment": _axle("wheel", _COMMENT + "  <!-- ^ CFG002 -->")},
    {
        "@with": ["KIN001"],
        "@fragment": _axle("wheel", ""),
        "subt-check.toml": _SETTINGS,
        "@reported": ["subt-check.toml:1"],
    },
]
