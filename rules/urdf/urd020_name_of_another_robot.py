"""A robot with the name of another robot of the same package.

The file was copied, but the name of the robot was not changed: topics, windows and messages then
show the wrong robot. It is reported where the file with that name contains another robot.

Fix: name the robot after its file.
Source: what authors of public packages corrected.
"""

import posixpath
import re
from collections.abc import Iterator

from checker.formats.urdf.description import UrdfDescription
from checker.robots.urdf_files import UrdfFiles
from checker.rule import Concern, Findings, Severity, finding, rule

_NOT_WORDS = re.compile(r"[^a-z0-9]+")
_SHORTEST = 4
"""Letters of a name that states something."""


@rule("URD020", "name-of-another-robot", Severity.INFO, Concern.ROBOT)
def check(files: UrdfFiles) -> Findings:
    """Compare the names of robots with those of their files."""
    for description in files.descriptions:
        name = description.robot.name
        if _bears(description, name.value) or len(_plain(name.value)) < _SHORTEST:
            continue
        for other in _owners(files, description):
            yield finding(
                name,
                f"the robots of {description.file} and {other.file} are both named {name.value!r}, "
                "but have different links",
                related=[(other.robot.name, "the other robot")],
            )
            break


def _owners(files: UrdfFiles, description: UrdfDescription) -> Iterator[UrdfDescription]:
    """Yield other robots of the same name whose files bear it."""
    name, links = description.robot.name.value, {*description.robot.links_by_name}
    for other in files.descriptions:
        robot = other.robot
        if robot.name.value == name and _bears(other, name) and {*robot.links_by_name} != links:
            yield other


def _bears(description: UrdfDescription, name: str) -> bool:
    return _plain(name) in _plain(posixpath.basename(description.file))


def _plain(text: str) -> str:
    return _NOT_WORDS.sub("", text.lower())


def _robot(name: str, link: str, mark: str = "") -> str:
    return f'<robot name="{name}">{mark}\n<link name="{link}"/>\n</robot>\n'


_MARK = "  <!-- ^ URD020 -->"
_CART = {"@urdf": True, "urdf/arm.urdf": None, "launch/arm.launch": None}
GOOD = [
    {**_CART, "urdf/cart.urdf": _robot("cart", "a"), "urdf/tricycle.urdf": _robot("tricycle", "b")},
    {**_CART, "urdf/cart.urdf": _robot("robot", "a"), "urdf/tricycle.urdf": _robot("robot", "b")},
]
BAD = [
    {
        **_CART,
        "urdf/cart.urdf": _robot("tricycle", "a", _MARK),
        "urdf/tricycle.urdf": _robot("tricycle", "b"),
    },
]
