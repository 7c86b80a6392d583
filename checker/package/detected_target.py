"""The distribution and the Gazebo that a ROS 2 package is made for, detected from its content."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.base.record import Record
from checker.base.resources import table
from checker.package.gazebo_sign import release_sign
from checker.package.mentions import has_word
from checker.package.simulator_signs import (
    CLASSIC,
    GZ,
    IGNITION,
    classic_beside_later,
    classic_start,
    gz_sim_start,
)

if TYPE_CHECKING:
    from checker.package.package import Package

_OLDEST = "humble"
"""The oldest distribution that is judged; it represents those before it."""
_SUPPORT = "whose support ended in January 2025"


class DetectedTarget(Record):
    """Target of a package, as far as its content shows it.

    Attributes:
        is_classic: Whether the simulator is Gazebo Classic.
        distro: ROS 2 distribution; empty if unknown.
        reason: The reason, for the report: `Gazebo Classic 11: a.launch.py:3 names gzserver`.
        gazebo: The release of Gazebo where it is another one than that of the distribution.
    """

    is_classic: bool = False
    distro: str = ""
    reason: str = ""
    gazebo: str = ""


def detect_target(package: Package, distro: str = "") -> DetectedTarget:
    """Read what a package is made for; else what launches it, or it launches, is made for.

    Where neither shows a target, what is beside it may, then the scripts around it, that it starts
    Gazebo Classic beside a later one, and last that those beside it are made for one target. A
    package that shows its distribution and no simulator is for Classic where those beside it are.

    Args:
        package: A package of ROS 2.
        distro: The distribution that the user names; it overrides the content.
    """
    own = _shown_target(package, distro)
    if own.reason:
        return own if own.is_classic else _classic_beside(package, own.distro) or own
    found = _targets_of(launching(package), distro, "which launches it")
    found = found or _targets_of(launched_by(package), distro, "which it launches")
    if not found and not own.distro:
        return _target_beside(package) or _target_around(package) or _common_target(package) or own
    if len(found) != 1:
        return own
    ((target, *_),) = found.values()
    # A description with plugins of a later Gazebo is not for Classic, whatever else launches it.
    return own if target.is_classic and {*package.simulator_signs} - {CLASSIC} else target


def _targets_of(
    packages: Iterable[Package], distro: str, how: str
) -> dict[tuple[bool, str], list[DetectedTarget]]:
    """Return the targets that the content of packages shows, each with a reason, alike ones."""
    found: dict[tuple[bool, str], list[DetectedTarget]] = {}
    for other in packages:
        target = _shown_target(other, distro)
        if target.reason:
            told = replace(target, reason=f"{target.reason} in {other.name}, {how}")
            found.setdefault((target.is_classic, target.distro), []).append(told)
    return found


def _target_beside(package: Package) -> DetectedTarget | None:
    """Return the distribution whose folder the packages beside it name, if they name one alone.

    Their containers do not count: packages of others bring theirs along. Nor do the paths of one
    whose own README, container or CI files name another distribution.
    """
    named = {}
    for other in () if package.only else package.other_packages:
        sign, stated = other.sign_of_paths, other.distribution_sign
        if sign and (stated is None or stated.distro == sign.distro):
            named[sign.distro] = (sign, other.name)
    if len(named) != 1:
        return None
    ((distro, (sign, name)),) = named.items()
    reason = f"ROS 2 {distro.capitalize()}: {sign.words} in {name}, beside it"
    return DetectedTarget(False, _known_distribution(distro), reason)


def _target_around(package: Package) -> DetectedTarget | None:
    """Return what scripts around a package name, else that it starts Classic beside a later Gazebo.

    Distributions after Humble do not have Classic. Fortress, which Humble comes with, has no
    command `gz sim`: a package that runs it there is for Harmonic, installed beside.
    """
    sign = package.sign_around
    words = sign.words if sign is not None else classic_beside_later(package)
    if not words:
        return None
    distro = sign.distro if sign is not None else _OLDEST
    known = _known_distribution(distro)
    if distro == _OLDEST and (start := gz_sim_start(package)):
        reason = f"ROS 2 {distro.capitalize()} and Gazebo Harmonic: {words}, {start}"
        return DetectedTarget(False, known, reason, "harmonic")
    return DetectedTarget(False, known, f"ROS 2 {distro.capitalize()}: {words}")


def _classic_beside(package: Package, distro: str) -> DetectedTarget | None:
    """Return Classic, where it is the one simulator of the packages beside one without any."""
    others = () if package.only or package.simulator_signs else package.other_packages
    if any({*other.simulator_signs} - {CLASSIC} for other in others):
        return None
    found = _targets_of(others, distro, "beside it")
    return next((it for alike in found.values() for it in alike if it.is_classic), None)


def _common_target(package: Package) -> DetectedTarget | None:
    """Return the target of the packages beside a package: two show one, and none another.

    One alone may be of others, and brought along, unless its name begins like the package's.
    """
    others = () if package.only else package.other_packages
    found = _targets_of(others, "", "beside it")
    alike = next(iter(found.values())) if len(found) == 1 else []
    family = f"{package.declared_name.partition('_')[0]}_"
    kin = (other for other in others if other.declared_name.startswith(family))
    counts = len(alike) > 1 or any(_shown_target(other, "").reason for other in kin)
    return alike[0] if alike and counts else None


def launching(package: Package) -> Iterator[Package]:
    """Yield the other packages whose launch files name a package, or the path of a folder."""
    named = any(package.exists(manifest) for manifest in ("package.xml", "model.config"))
    name = package.declared_name
    # The name of a folder is also that of models and nodes.
    end = "" if named else "/"
    for other in () if package.only else package.other_packages:
        texts = other.launch_texts.values()
        if any(has_word(text, name) and f"{name}{end}" in text for text in texts):
            yield other


def launched_by(package: Package) -> Iterator[Package]:
    """Yield the other packages that the launch files of a package name."""
    texts = () if package.only else package.launch_texts.values()
    for other in package.other_packages if texts else ():
        if any(has_word(text, other.declared_name) for text in texts):
            yield other


def _shown_target(package: Package, distro: str) -> DetectedTarget:
    """Return what the content of a package shows.

    Gazebo Classic is detected by a launch file, a plugin or a dependency that only Classic has,
    where nothing is of later ones, or by launch files of Classic alone that spawn the package's
    robot. Any other package for both is judged for the later one.
    """
    named = None if distro else package.distribution_sign
    distro = distro or (named.distro if named else "")
    signs = package.simulator_signs
    classic = signs[CLASSIC] if [*signs] == [CLASSIC] else _classic_start(package)
    if classic and distro in ("", *table("gazebo_classic_ros2")["distros"]):
        known = _known_distribution(distro or _OLDEST)
        return DetectedTarget(True, known, classic_reason(classic))
    if named is not None:
        gazebo, where = ("", "") if IGNITION in signs else _another_gazebo(package, distro)
        release = f" and Gazebo {gazebo.capitalize()}" if gazebo else ""
        words = f"{named.words}, {where}" if gazebo else named.words
        reason = f"ROS 2 {distro.capitalize()}{release}: {words}"
        return DetectedTarget(False, _known_distribution(distro), reason, gazebo)
    if IGNITION in signs and GZ not in signs and not distro:
        reason = f"ROS 2 Humble and Gazebo Fortress: {signs[IGNITION]}"
        return DetectedTarget(False, _OLDEST, reason)
    return DetectedTarget(False, distro)


def _another_gazebo(package: Package, distro: str) -> tuple[str, str]:
    """Return a release that README names and the distribution does not come with, and where.

    It is one for which the distribution has a bridge as well: Harmonic on Humble.
    """
    release, words = release_sign(package)
    pairs = {entry["release"]: entry["ros"] for entry in table("gazebo_releases")["releases"]}
    usual = pairs.get(release, {}).get(distro, "default")
    return ("", "") if usual == "default" else (release, words)


def _classic_start(package: Package) -> str:
    """Return where a robot for later Gazebos is started, in Classic alone; else empty."""
    start = classic_start(package) if CLASSIC in package.simulator_signs else ""
    others = launching(package) if start else ()
    return "" if any({*other.simulator_signs} - {CLASSIC} for other in others) else start


def classic_reason(sign: str) -> str:
    """Return why something is judged for Gazebo Classic, with what shows it."""
    return f"Gazebo Classic 11, {_SUPPORT}: {sign}"


def _known_distribution(distro: str) -> str:
    known = (entry["distro"] for entry in table("gazebo_releases")["ros"])
    return distro if distro in known else _OLDEST
