"""A link that leads to no file, or a sensor without a link to its datasheet.

Reviewers compare each sensor with its datasheet; a link saves them the search and shows which
version of a device is meant. A relative link to a missing file is useless: a missing licence file
grants no rights.

Fix: correct the path or add the file; add a link to the datasheet next to the sensor or in the
section "Validation and Specification Links".
Source: the SubT template requires links to the specifications of all instruments.
"""

import posixpath
from collections.abc import Iterator

from checker.model.specification.links import relative_links, without_datasheet
from checker.model.specification.sheet import Specification
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked

NOTED = 30


@rule("DOC008", "missing-link", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package, specification: Specification) -> Findings:
    """Follow the relative links, and look for links that name the listed devices."""
    yield from _relative(package, specification)
    items = without_datasheet(specification.markdown, specification.sensors)
    if items:
        number = "1 sensor is" if len(items) == 1 else f"{len(items)} sensors are"
        yield finding(
            items[0],
            f"{number} listed without a link to the datasheet",
            severity=Severity.INFO,
            related=[(item, "this one has no link either") for item in items[1:NOTED]],
        )


def _relative(package: Package, sheet: Specification) -> Iterator[Finding | Unchecked]:
    folder = posixpath.dirname(sheet.source.file)
    for link in relative_links(sheet.markdown):
        path = posixpath.normpath(posixpath.join(folder, link.value))
        if package.exists(path):
            continue
        other = path.split("/")[1] if path.startswith("../") else ""
        if other and package.workspace.package(other) is None:
            yield unchecked(f"{link.value} is linked, but {other} is not available")
        else:
            yield finding(link, f"{link.value} is linked, but does not exist", key=path)


_MARK = " <!-- ^ DOC008 -->"
_SENSORS = "# Rover\n### Sensors\n"


def _sheet(text: str) -> dict[str, str]:
    return {"specifications.md": f"{_SENSORS}{text}\n"}


GOOD = [
    _sheet("See [topics](launch/spawner.rb#L3), [links](#links) and [us](https://example.org)."),
    _sheet("* IMU: Xsens MTi-30 ([datasheet](https://example.org/imu))"),
    _sheet("* 2 x D435, modeled by rgbd_camera\n## Links\n* D435 - https://example.org/a"),
    _sheet("* LIDAR: Velodyne VLP-16\n## Links\n* https://velodynelidar.com/products/puck/"),
    _sheet("* 1x IMU\n* 12 communication breadcrumbs from Acme"),
]
BAD = [
    _sheet(f"Released under a [licence](LICENSE).{_MARK}"),
    _sheet(f"See [the manual](docs/manual.md#start).{_MARK}"),
    _sheet(f"* IMU: Xsens MTi-30{_MARK}\n* LIDAR: Velodyne VLP-16\n"),
]
