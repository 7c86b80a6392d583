"""A configuration number is missing.

The configurations of a robot are numbered from 1. A gap suggests that a configuration is missing.
Only available packages are counted; a robot with only one configuration is not judged. No accepted
package that we checked has this fault.

Fix: give the configuration the next free number.
Source: Model Migration Guide, step 4: names end in `_sensor_config_<#>`; numbering without gaps is
common practice.
"""

from checker.package.configuration import configurations
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("PKG017", "configuration-number-gap", Severity.INFO, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report the configuration after a gap."""
    known = configurations(package)
    if known is None:
        return
    number, numbers = known
    before = max((smaller for smaller in numbers if smaller < number), default=0)
    if len(numbers) > 1 and before + 1 < number:
        last = number - 1
        gap = f"{before + 1}" if before + 1 == last else f"{before + 1} to {last}"
        yield finding(
            package.folder_place(), f"this is configuration {number}, but there is no {gap}"
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
