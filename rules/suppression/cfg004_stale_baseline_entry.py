"""A finding of the baseline that is gone.

It is mended: as long as the baseline holds it, the same fault may come back unseen. Only rules
that looked count, and those that exist no more.

Fix: write the baseline anew with `--write-baseline`, or remove the entry from its file.
Source: README, section "Suppress".
"""

from checker.finding import Place
from checker.rule import Findings, Severity, finding, rule
from checker.suppression.parts import BaselineUse


@rule("CFG004", "stale-baseline-entry", Severity.INFO)
def check(baseline: BaselineUse) -> Findings:
    """Report entries without a finding, rule by rule."""
    for each in baseline.stale:
        first, *others = each.messages
        more = f" and {len(others)} more" if others else ""
        yield finding(
            Place(""), f"{each.file} holds what {each.rule} finds no more: {first!r}{more}"
        )


def _baseline(rule: str, message: str) -> str:
    return f"""{{
  "version": 1,
  "packages": {{
    "acme_rover_sensor_config_1": [
      {{"fingerprint": "{"0" * 16}", "rule": "{rule}", "message": "{message}"}}
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
]
