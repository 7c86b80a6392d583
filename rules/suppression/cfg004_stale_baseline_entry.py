"""A finding of the baseline that no longer occurs.

The fault is corrected: while the baseline contains it, the same fault may return without being
reported. Only rules that ran count, and those that do not exist.

Fix: write the baseline again with `--write-baseline`, or remove the entry from its file.
Source: README, section "Suppress".
"""

from collections.abc import Sequence

from checker.finding import Place
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.suppression.parts import BaselineUse


@rule("CFG004", "stale-baseline-entry", Severity.INFO, Concern.PAPERWORK)
def check(baseline: BaselineUse) -> Findings:
    """Report entries without a finding, one finding per rule."""
    for entry in baseline.stale:
        if entry.known:
            phrase = f"findings of {entry.rules[0]} that no longer occur: {_some(entry.messages)}"
        else:
            phrase = f"findings of rules that do not exist: {_some(entry.rules)}"
        yield finding(Place(""), f"{entry.file} contains {phrase}")


def _some(texts: Sequence[str]) -> str:
    more = f" and {len(texts) - 1} more" if len(texts) > 1 else ""
    return f"{texts[0]!r}{more}"


def _baseline(rule: str, message: str) -> str:
    return f"""{{
  "version": 2,
  "packages": {{
    "acme_rover_sensor_config_1": [
      {{
        "rule": "{rule}",
        "severity": "error",
        "message": "{message}",
        "places": {{"model.sdf#sdf/model[acme_rover_sensor_config_1]/joint[axle]/child": 1}}
      }}
    ]
  }}
}}
"""


_SETTINGS = 'baseline = "baseline.json"\n'
_GONE = "joint 'axle' has child 'tyre', which does not exist"
_AXLE = """
<joint name="axle" type="revolute">
  <parent>base_link</parent>
  <child>tyre</child>
</joint>
"""

GOOD = [
    {
        "@with": ["KIN001"],
        "@fragment": _AXLE,
        "subt-check.toml": _SETTINGS,
        "baseline.json": _baseline("KIN001", _GONE),
    },
    {"subt-check.toml": _SETTINGS, "baseline.json": _baseline("KIN001", _GONE)},
]
BAD = [
    {
        "@with": ["KIN001"],
        "subt-check.toml": _SETTINGS,
        "baseline.json": _baseline("KIN001", _GONE),
        "@reported": [".:1"],
    },
    {
        "subt-check.toml": _SETTINGS,
        "baseline.json": _baseline("OLD001", _GONE),
        "@reported": [".:1"],
    },
]
