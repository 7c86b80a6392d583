"""The name of the new package: `<organization>_<robot>_sensor_config_<#>`."""

from __future__ import annotations

import re

from lxml import etree

from checker.base.record import Record
from checker.convert.conversion import Conversion
from checker.convert.xml_writer import numbers
from checker.formats.sdf.poses import transform_of
from checker.migrate.options import MigrationOptions, NotMigrated
from checker.migrate.source import Source
from checker.migrate.xml_parts import put
from checker.model.geometry.transform import Transform
from checker.model.values import parse_number

# The link that carries all others gets the name that SubT's tools expect: `base_link`.


BASE = "base_link"
_POSED = ("inertial", "collision", "visual", "sensor", "light")
_ENDS = ("parent", "child")
_NUMBERS = 6


def call_base_link(conversion: Conversion) -> list[str]:
    """Rename the root of a model that has no `base_link`; return what was done.

    Where the source has a link of that name, merged into the root, the root takes its frame, so
    that the name means the same place as before.
    """
    links = {link.get("name") or "": link for link in conversion.tree.iter("link")}
    joints = list(conversion.tree.iter("joint"))
    below = {joint.findtext("child", "").strip() for joint in joints}
    roots = [name for name in links if name not in below]
    if BASE in links or len(roots) != 1:
        return []
    (old,) = roots
    merged = conversion.lumped.get(BASE)
    if merged is not None and merged.link == old:
        _shift(links[old], merged.pose)
    links[old].set("name", BASE)
    for end in (end for joint in joints for end in joint if end.tag in _ENDS):
        if (end.text or "").strip() == old:
            end.text = BASE
    return [f"link {old!r}, which carries the others, is called {BASE!r}"]


def _shift(link: etree._Element, new_frame: Transform) -> None:
    """Move a link's frame, and leave its parts where they are.

    Args:
        link: The link of the model.
        new_frame: Its new frame in its old one.
    """
    _pose(link, _pose_of(link) @ new_frame)
    for part in link:
        if part.tag in _POSED:
            _pose(part, new_frame.inverse @ _pose_of(part))


def _pose_of(element: etree._Element) -> Transform:
    pose = element.find("pose")
    words = (pose.text or "").split() if pose is not None else []
    if pose is None or len(words) != _NUMBERS:
        return Transform()
    return transform_of(pose, (parse_number(word) or 0.0 for word in words))


def _pose(element: etree._Element, pose: Transform) -> None:
    fresh = element.find("pose") is None
    written = put(element, "pose", f"{numbers(pose.translation)} {numbers(pose.rpy)}")
    written.attrib.pop("degrees", "")
    if fresh:
        element.insert(0, written)


# Names that may be written into Ruby, XML and launch files as they are.


_SAFE = re.compile(r"[\w.:+-]{1,200}")
_NAMED = ("link", "joint", "sensor")


def check_names(tree: etree._Element) -> None:
    """Look at the names of a model that go into other files.

    Ruby would run what is in `#{…}`, roslaunch replaces `$(…)` and parts `args` at blanks.

    Raises:
        NotMigrated: A name has other characters than letters, digits and `_ . : + -`.
    """
    for tag in _NAMED:
        for element in tree.iter(tag):
            name = element.get("name") or ""
            if _SAFE.fullmatch(name) is None:
                raise NotMigrated(
                    f"{tag} {name[:80]!r} is a name that launch files cannot contain; expected 1 "
                    "to 200 letters, digits and _ . : + -"
                )


NO_ORGANIZATION = "my_team"
"""Placeholder for the organization, if none is given."""
_LENGTH_LIMIT = 60
_UNFIT = re.compile(r"[^a-z0-9]+")
_ENDING = re.compile(r"(?:_(?:description|gazebo|urdf|model|sensor_config_\d+))+$", re.IGNORECASE)


class Names(Record):
    """Names in the new package.

    Attributes:
        organization: Lower case, `_` between words.
        robot: Lower case, `_` between words.
        config: Number of the sensor configuration.
    """

    organization: str
    robot: str
    config: int

    @property
    def package(self) -> str:
        """Name of the package, and of its folder."""
        return f"{self.organization}_{self.robot}_sensor_config_{self.config}"

    @property
    def short(self) -> str:
        """Name of the robot in examples."""
        return f"{self.organization}_{self.robot}"


def names_for(wishes: MigrationOptions, source: Source) -> Names:
    """Return the requested names; else those that the source suggests.

    Raises:
        NotMigrated: A name has no letter or digit, or the number is below 1.
    """
    if wishes.config < 1:
        raise NotMigrated(f"the configuration is {wishes.config}, expected 1 or more")
    organization = _word(wishes.organization or NO_ORGANIZATION, "--organization")
    own = source.description.robot.name.value or source.package.root.name
    robot = _word(wishes.robot or _ENDING.sub("", own), "--robot")
    return Names(organization, robot, wishes.config)


def _word(name: str, option: str) -> str:
    word = _UNFIT.sub("_", name.lower()).strip("_")[:_LENGTH_LIMIT].strip("_")
    if not word:
        raise NotMigrated(
            f"{name!r} is not a package name; give {option} with lower-case letters and digits"
        )
    return word
