"""A configuration number that was left out.

The configurations of a robot are counted from 1. A gap makes teams look for the missing one. Only
packages at hand are counted; a robot of which there is one configuration alone is not judged.
No accepted package at hand shows it.

Fix: give the configuration the next number that is free.
Source: Model Migration Guide, step 4: names end in `_sensor_config_<#>`; that numbers follow each
other is common practice.
"""

from checker.package.configuration import configurations
from checker.package.package import Package
from checker.rule import Findings, Severity, finding, rule


@rule("PKG017", "number-left-out", Severity.INFO)
def check(package: Package) -> Findings:
    """Report the configuration that stands behind a gap."""
    known = configurations(package)
    if known is None:
        return
    number, numbers = known
    before = max((each for each in numbers if each < number), default=0)
    if len(numbers) > 1 and before + 1 < number:
        last = number - 1
        gap = f"{before + 1}" if before + 1 == last else f"{before + 1} to {last}"
        yield finding(
            package.folder_place(), f"this is configuration {number}, and there is no {gap}"
        )


GOOD = [
    {"@name": "acme_rover_sensor_config_4"},
    {
        "@name": "acme_rover_sensor_config_2",
        "../acme_rover_sensor_config_1/package.xml": "<package/>",
        "../x1_sensor_config_6/package.xml": "<package/>",
    },
]
BAD = [
    {
        "@name": "acme_rover_sensor_config_4",
        "../acme_rover_sensor_config_1/package.xml": "<package/>",
        "@reported": [".:1"],
    },
]
