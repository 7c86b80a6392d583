"""What the tests of suppressions share: packages with faults, and checks of them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.rule_testing import write_example
from checker.settings import find_settings

REASON = "it is so"
TYRE = "<child>tyre</child>"
"""Names a link that is not there: KIN001."""


def ignore(*rules: str, reason: str = REASON) -> str:
    return f"<!-- subt-check: ignore[{', '.join(rules)}] {reason} -->"


def axle(child: str = TYRE, name: str = "axle") -> str:
    return f"""
<joint name="{name}" type="revolute">
  <parent>base_link</parent>
  {child}
</joint>
"""


def checked(example: str | Mapping[str, Any], folder: Path, *select: str) -> PackageReport:
    """Check an example by some rules and those on suppressions."""
    return checked_again(write_example(example, folder), *select)


def checked_again(package: Path, *select: str, profile: str | None = None) -> PackageReport:
    settings = find_settings([package]).with_overrides(
        select=("CFG", *(select or ("KIN001",))),
        trial=False,
        thorough=True,
        cache=False,
        profile=profile,
    )
    (report,) = check_package(package, settings).packages
    return report


def found(report: PackageReport) -> list[str]:
    """Return what counts: rule, file and line."""
    return [
        f"{each.rule} {place.file}:{place.line}"
        for each in report.findings
        for place in each.places
        if not place.note
    ]


def set_aside(report: PackageReport) -> list[tuple[str, str, str]]:
    return [(each.finding.rule, str(each.by), each.reason) for each in report.suppressed]
