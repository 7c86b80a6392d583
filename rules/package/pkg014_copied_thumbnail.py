"""A thumbnail that is the picture of another package.

The catalogue then shows another robot. This happens when a new robot starts as a copy of an old
one. Only available packages are compared; configurations of one robot may share pictures. No
accepted package that we checked has this fault.

Fix: make pictures of this robot.
Source: common practice.
"""

from functools import cache

from checker.base.files import NotReadable
from checker.package.package import Package
from checker.package.submissions import robot_of
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("PKG014", "copied-thumbnail", Severity.INFO, Concern.PAPERWORK)
def check(package: Package, *, most_compared: int = 50) -> Findings:
    """Report thumbnails with the same bytes as one of another available robot.

    Options:
        most_compared: Greatest number of other robots' pictures, of the same size in bytes, with
            which a thumbnail is compared.
    """
    if package.only:
        return
    robot = robot_of(package.name)

    @cache
    def others(size: int) -> list[tuple[Package, str]]:
        alike = package.workspace.thumbnails_by_size.get(size, ())
        return [pair for pair in alike if robot_of(pair[0].name) != robot][:most_compared]

    for file in package.index.with_suffix(".png", ".jpg", ".jpeg"):
        if not file.path.startswith("thumbnails/") or not file.size:
            continue
        picture = package.read_bytes(file.path)
        if isinstance(picture, NotReadable):
            continue
        for other, path in others(file.size):
            if other.read_bytes(path) == picture:
                yield finding(
                    package.place(file.path),
                    f"{file.path} is the same picture as {path} of {other.name}: show this robot",
                    key=other.name,
                )
                break


_OTHER = {"../x1_sensor_config_6/package.xml": "<package/>"}

GOOD = [
    {**_OTHER, "thumbnails/1.png": "a robot", "../x1_sensor_config_6/thumbnails/1.png": "another"},
    {
        "../acme_rover_sensor_config_2/package.xml": "<package/>",
        "../acme_rover_sensor_config_2/thumbnails/1.png": "a robot",
        "thumbnails/1.png": "a robot",
    },
]
BAD = [
    {
        **_OTHER,
        "thumbnails/3.png": "a robot",
        "../x1_sensor_config_6/thumbnails/1.png": "a robot",
        "@reported": ["thumbnails/3.png:1"],
    },
]
