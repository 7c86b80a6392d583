"""The distribution and the Gazebo that a ROS 2 package is made for, detected from its content."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.base.record import Record
from checker.base.resources import table
from checker.package.distribution_sign import sign_of_paths
from checker.package.mentions import has_word
from checker.source.text import SourceText, blank_markup

if TYPE_CHECKING:
    from checker.package.package import Package

CLASSIC, IGNITION, GZ = "classic", "ignition", "gz"
_ROS_GZ = "ros_gz"
"""The packages that start either Fortress, on Humble, or a later Gazebo."""
_OLDEST = "humble"
"""The oldest distribution that is judged; it represents those before it."""
_SUPPORT = "whose support ended in January 2025"

_LAUNCH = {
    CLASSIC: re.compile(r"(?<![\w/])(?:gazebo_ros|gzserver|gzclient|spawn_entity\.py)(?!\w)"),
    IGNITION: re.compile(r"\bros_ign_(?:gazebo|bridge)\b|\bign gazebo\b|\bIGN_GAZEBO_\w+"),
    GZ: re.compile(r"\bgz sim\b|\bGZ_SIM_\w+"),
    _ROS_GZ: re.compile(r"\bros_gz_(?:sim|bridge)\b"),
}
_DESCRIPTION = {
    CLASSIC: re.compile(
        r"\blibgazebo_ros(?:2_control|_\w+)\.so\b|\bgazebo_ros2_control/GazeboSystem\b"
    ),
    IGNITION: re.compile(r"\bignition-gazebo\d*-[\w-]+-system\b|\bign_ros2_control\b"),
    GZ: re.compile(
        r"\bgz-sim\d*-[\w-]+-system\b|(?<!\w)gz_ros2_control\b"
        r"""|\btype\s*=\s*["'](?:gpu_lidar|rgbd_camera|navsat|air_pressure)["']"""
    ),
}
_OF_ROS_2 = re.compile(
    rf"<ros2_control\b|gazebo_ros2_control\b"
    rf"|{_DESCRIPTION[IGNITION].pattern}|{_DESCRIPTION[GZ].pattern}"
)
"""Elements that are only in a URDF for ROS 2 or for Gazebo after Classic."""
_OF_IGNITION = re.compile(r"\blibignition-gazebo\d*-[\w-]+-system\.so\b")
_OF_ROSLAUNCH = re.compile(r"\$\(find\s|<node\b[^<>]{0,400}?\stype\s{0,8}=")
_DEPENDENCY = r"(?<=depend>)\s*(?:{})\s*(?=</)"
_MANIFEST = {
    CLASSIC: re.compile(_DEPENDENCY.format("gazebo_(?:ros|plugins|ros_pkgs|ros2_control)")),
    IGNITION: re.compile(_DEPENDENCY.format(r"ros_ign\w*|ign_ros2_control|ignition-\w+")),
    GZ: re.compile(_DEPENDENCY.format(r"gz_ros2_control|gz[-_]\w+")),
    _ROS_GZ: re.compile(_DEPENDENCY.format(r"ros_gz\w*")),
}
_SIGNS = (
    (re.compile(r"launch.*\.(?:py|xml|launch|ya?ml)\Z"), _LAUNCH),
    (re.compile(r"\.(?:urdf|xacro|sdf|world|gazebo)\Z"), _DESCRIPTION),
    (re.compile(r"\Apackage\.xml\Z"), _MANIFEST),
)


class DetectedTarget(Record):
    """Target of a package, as far as its content shows it.

    Attributes:
        is_classic: Whether the simulator is Gazebo Classic.
        distro: ROS 2 distribution; empty if unknown.
        reason: The reason, for the report: `Gazebo Classic 11: a.launch.py:3 names gzserver`.
    """

    is_classic: bool = False
    distro: str = ""
    reason: str = ""


def detect_target(package: Package, distro: str = "") -> DetectedTarget:
    """Read what a package is made for; else what launches it, and what is beside it, is made for.

    Args:
        package: A package of ROS 2.
        distro: The distribution that the user names; it overrides the content.
    """
    own = _shown_target(package, distro)
    if own.reason:
        return own
    found: dict[tuple[bool, str], DetectedTarget] = {}
    for other in _launching(package):
        target = _shown_target(other, distro)
        if target.reason:
            reason = f"{target.reason} in {other.name}, which launches it"
            found.setdefault((target.is_classic, target.distro), replace(target, reason=reason))
    if not found and not own.distro:
        return _target_beside(package) or own
    if len(found) != 1:
        return own
    (target,) = found.values()
    # A description with plugins of a later Gazebo is not for Classic, whatever else launches it.
    return own if target.is_classic and {*package.simulator_signs} - {CLASSIC} else target


def _target_beside(package: Package) -> DetectedTarget | None:
    """Return the distribution whose folder the packages beside it name, if they name one alone.

    Their containers do not count: packages of others bring theirs along.
    """
    others = () if package.only else package.other_packages
    named = {sign.distro: (sign, it.name) for it in others if (sign := sign_of_paths(it))}
    if len(named) != 1:
        return None
    ((distro, (sign, name)),) = named.items()
    reason = f"ROS 2 {distro.capitalize()}: {sign.words} in {name}, beside it"
    return DetectedTarget(False, _known_distribution(distro), reason)


def _launching(package: Package) -> Iterator[Package]:
    """Yield the other packages whose launch files name a package."""
    name = package.declared_name
    for other in () if package.only else package.other_packages:
        if any(has_word(text, name) for text in other.launch_texts.values()):
            yield other


def _shown_target(package: Package, distro: str) -> DetectedTarget:
    """Return what the content of a package shows.

    Gazebo Classic is detected by a launch file, a plugin or a dependency that only Classic has,
    where nothing is of later ones: a package for both is judged for the later one.
    """
    named = None if distro else package.distribution_sign
    distro = distro or (named.distro if named else "")
    signs = package.simulator_signs
    if [*signs] == [CLASSIC] and distro in ("", *table("gazebo_classic_ros2")["distros"]):
        known = _known_distribution(distro or _OLDEST)
        return DetectedTarget(True, known, classic_reason(signs[CLASSIC]))
    if named is not None:
        return DetectedTarget(
            False, _known_distribution(distro), f"ROS 2 {distro.capitalize()}: {named.words}"
        )
    if IGNITION in signs and {*signs} <= {IGNITION, _ROS_GZ} and not distro:
        reason = f"ROS 2 Humble and Gazebo Fortress: {signs[IGNITION]}"
        return DetectedTarget(False, _OLDEST, reason)
    return DetectedTarget(False, distro)


def classic_reason(sign: str) -> str:
    """Return why something is judged for Gazebo Classic, with what shows it."""
    return f"Gazebo Classic 11, {_SUPPORT}: {sign}"


def ignition_sign(package: Package) -> str:
    """Return what shows that a model or world in a package for Classic is for Ignition; else empty.

    Nothing does where it has its own package.xml, or a launch file names it.
    """
    launch = package.workspace.launch_texts.values()
    if package.exists("package.xml") or any(package.name in text for text in launch):
        return ""
    paths = (file.path for file in package.index.with_suffix(".sdf", ".world"))
    found = _in_files(package, paths, {IGNITION: _OF_IGNITION})
    return next((f"Gazebo Fortress: {words}" for _, words in found), "")


def is_described_for_ros_2(package: Package) -> bool:
    """Return whether a URDF without a package has `<ros2_control>` or plugins of later Gazebos."""
    paths = (file.path for file in package.index.with_suffix(".urdf", ".xacro"))
    return any(_in_files(package, paths, {GZ: _OF_ROS_2}))


def _known_distribution(distro: str) -> str:
    known = (entry["distro"] for entry in table("gazebo_releases")["ros"])
    return distro if distro in known else _OLDEST


def simulator_signs(package: Package) -> dict[str, str]:
    """Return which simulators the package names, each with the first place that does."""
    found: dict[str, str] = {}
    for names, patterns in _SIGNS:
        paths = (file.path for file in package.index.files if names.search(file.path.lower()))
        for target, words in _in_files(package, paths, patterns):
            found.setdefault(target, words)
    return found


def _in_files(
    package: Package, paths: Iterable[str], patterns: dict[str, re.Pattern[str]]
) -> Iterator[tuple[str, str]]:
    for path in paths:
        source = package.read(path)
        if not isinstance(source, SourceText):
            continue
        text = _without_comments(source)
        if path.endswith(".launch") and _OF_ROSLAUNCH.search(text):
            continue  # left by an exporter or a port: nothing of ROS 2 reads it
        for target, pattern in patterns.items():
            if match := pattern.search(text):
                yield target, f"{source.where(match.start())} names {match.group().strip()}"


_LINE_COMMENT = re.compile(r"^[ \t]*#.*$", re.MULTILINE)


def _without_comments(source: SourceText) -> str:
    if source.file.lower().endswith((".py", ".yaml", ".yml")):
        return _LINE_COMMENT.sub(lambda match: " " * len(match.group()), source.text)
    return blank_markup(source.text)
