"""ROS 2 distribution in container files, CI files and README of a package, else in its paths."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.package.files_above import README, files_above, own_files
from checker.package.index import is_of_tests
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

_DISTROS = "foxy|galactic|humble|iron|jazzy|kilted|lyrical|rolling"
_BEFORE_HUMBLE = ("foxy", "galactic")
_BEFORE_NOETIC = "indigo|jade|kinetic|lunar|melodic"
_BEFORE = (
    r"(?:\bros(?:[ -]|%20)?2?[ :_/-]{1,3}|\b(?:\w{0,40}_)?ros_distro\W{1,4}"
    r"|\bros_distribution\W{1,4}|\$\{\w{1,60}:?-)"
)
_NAMED = re.compile(rf"{_BEFORE}\(?({_DISTROS})\b(?!%)\}}?", re.IGNORECASE)
_NAMED_OF_ROS_1 = re.compile(rf"{_BEFORE}\(?({_BEFORE_NOETIC}|noetic)\b\}}?", re.IGNORECASE)
"""`ros:humble-perception`, `ROS_DISTRO=humble`, `/opt/ros/humble`, `${TAG:-humble}`, and a badge,
`badge/ROS%202-Humble-blue`, but not one of several, `Humble%20|%20Jazzy`."""
_OF_PACKAGES = re.compile(rf"\bros-({_DISTROS})-[a-z*<]")
"""`ros-humble-xacro`, as a command installs it."""
_INSTALLED = re.compile(rf"/opt/ros/({_DISTROS})\b")
_WITH_PATHS = re.compile(r"\.(?:urdf|xacro|sdf|world|launch|py|xml|ya?ml|sh)\Z")
_SCRIPTS = re.compile(r"(?:\A|/)\.vscode/[^/]+\.json\Z|\.(?:ba)?sh\Z")
"""Settings of an editor and scripts, colcon's `install/setup.bash` among them."""
_CONTAINER = re.compile(
    r"(?:\A|/)(?:dockerfile[^/]*|[^/]+\.dockerfile|devcontainer\.json"
    r"|(?:docker-)?compose[\w.-]{0,40}\.ya?ml)\Z"
)
_CI = re.compile(r"(?:\A|/)(?:\.github/workflows/[^/]+\.ya?ml|\.gitlab-ci\.yml)\Z")
NAMES = re.compile("|".join(pattern.pattern for pattern in (_CONTAINER, _CI, README)))


class DistributionSign(Record):
    """A distribution, and its source: `Dockerfile:1 names ros:humble`."""

    distro: str
    words: str


def distribution_sign(package: Package) -> DistributionSign | None:
    """Return the distribution that a package is made for; None if there is no sign, or several.

    A container file counts before CI, and both before the README. Files at the top of the folder
    with the package's siblings count like its own; those of the folders around it, as far as the
    user gave them, only where these name none, or name one of several that these name. Of several
    in a text, the one counts whose packages it installs. Where nothing else names one, paths do,
    as in `file:///opt/ros/humble/share`.
    """
    nearest, *further = files_above(package, NAMES) or [()]
    several: set[str] = set()
    for sources in ((*own_files(package, NAMES), *nearest), *further):
        signs = _signs(sources, _NAMED)
        one = _only(signs) or _only(_signs(sources, _OF_PACKAGES))
        if one is not None:
            return one if not several or one.distro in several else None
        several |= {sign.distro for sign in signs}
    return None if several else package.sign_of_paths


def former_distribution(package: Package) -> str:
    """Return the clause that a package is for a distribution before Humble; else empty."""
    sign = _former_sign(package)
    return f"{sign.words}, whose packages are not known" if sign is not None else ""


def former_name(package: Package) -> str:
    """Return the distribution before Humble that a package is for: `foxy`; else empty."""
    sign = _former_sign(package)
    return sign.distro if sign is not None else ""


def _former_sign(package: Package) -> DistributionSign | None:
    sign = package.distribution_sign or package.sign_around
    return sign if sign is not None and sign.distro in _BEFORE_HUMBLE else None


def sign_of_paths(package: Package) -> DistributionSign | None:
    """Return the distribution whose folder the descriptions and scripts of a package name."""
    every = own_files(package, _WITH_PATHS)
    files = (it for it in every if not (is_of_tests(it.file) or _CI.search(it.file.lower())))
    return _only([*_found(files, _INSTALLED)])


def sign_around(package: Package) -> DistributionSign | None:
    """Return the distribution that scripts and settings in and around a package name in paths.

    The nearest folder that names one counts, and only if README, container and CI files around the
    package name no other.
    """
    for scripts in (own_files(package, _SCRIPTS), *files_above(package, _SCRIPTS)):
        if found := [*_found(scripts, _INSTALLED)]:
            others = [*own_files(package, NAMES), *chain(*files_above(package, NAMES))]
            return _only([*found, *_found(others, _NAMED)])
    return None


def _only(signs: Sequence[DistributionSign]) -> DistributionSign | None:
    return signs[0] if len({sign.distro for sign in signs}) == 1 else None


def ros_1_sign(package: Package) -> DistributionSign | None:
    """Return the release of ROS 1 that a package is made for; None if no file names one alone."""
    for sources in files_above(package, NAMES) or [()]:
        if signs := _signs((*own_files(package, NAMES), *sources), _NAMED_OF_ROS_1):
            return _only(signs)
    return None


def before_noetic(package: Package) -> str:
    """Return why a package is made for a release of ROS 1 before Noetic, as a clause.

    Empty if nothing shows it. `--inorder` is an option that xacro needed from Indigo to Lunar.
    """
    for sources in files_above(package, NAMES):
        signs = _signs((*own_files(package, NAMES), *sources), _NAMED_OF_ROS_1)
        if signs:
            return "" if any(sign.distro == "noetic" for sign in signs) else signs[0].words
    if "inorder" in package.workspace.launch_words:
        return "launch files run xacro --inorder, as before ROS Melodic"
    return ""


def _signs(sources: Sequence[SourceText], named: re.Pattern[str]) -> list[DistributionSign]:
    """Return what the files of the kind that counts most name, in their order."""
    for pattern in (_CONTAINER, _CI, README):
        chosen = (source for source in sources if pattern.search(source.file.lower()))
        if found := [*_found(chosen, named)]:
            return found
    return []


def _found(sources: Iterable[SourceText], named: re.Pattern[str]) -> Iterator[DistributionSign]:
    for source in sources:
        for match in named.finditer(source.text):
            words = " ".join(match.group().split())
            yield DistributionSign(match[1].lower(), f"{source.where(match.start())} names {words}")
