"""The simulators that the files of a package name: Gazebo Classic, Fortress, or a later one."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

from checker.package.mentions import has_file, has_word
from checker.source.text import SourceText, without_comments

if TYPE_CHECKING:
    from checker.package.package import Package

CLASSIC, IGNITION, GZ = "classic", "ignition", "gz"
LATER = "later"
"""Fortress or a later Gazebo."""
ROS_GZ = "ros_gz"
"""The packages that start either Fortress, on Humble, or a later Gazebo."""
_GZ_SIM = re.compile(r"""\bgz sim\b|["']gz["'],\s{0,8}["']sim["']""")
LAUNCH = {
    CLASSIC: re.compile(r"(?<![\w/])(?:gazebo_ros|gzserver|gzclient|spawn_entity\.py)(?!\w)"),
    IGNITION: re.compile(
        r"\bros_ign_(?:gazebo|bridge)\b|\bign gazebo\b|\bIGN_GAZEBO_\w+|\bignition\.msgs\.\w+"
    ),
    GZ: re.compile(r"\bgz sim\b|\bGZ_SIM_\w+"),
    ROS_GZ: re.compile(r"\bros_gz_(?:sim|bridge)\b"),
}
DESCRIPTION = {
    CLASSIC: re.compile(
        r"\blibgazebo_ros(?:2_control|_\w+)\.so\b|\bgazebo_ros2_control/GazeboSystem\b"
    ),
    IGNITION: re.compile(r"\bignition-gazebo\d*-[\w-]+-system\b|\bign_ros2_control\b"),
    GZ: re.compile(r"\bgz-sim\d*-[\w-]+-system\b|(?<!\w)gz_ros2_control\b"),
    LATER: re.compile(r"""\btype\s*=\s*["'](?:gpu_lidar|rgbd_camera|navsat|air_pressure)["']"""),
}
_CLASSIC_SPAWN = "spawn_entity"
_OF_ROS_2 = re.compile(
    rf"<ros2_control\b|gazebo_ros2_control\b"
    rf"|{DESCRIPTION[IGNITION].pattern}|{DESCRIPTION[GZ].pattern}|{DESCRIPTION[LATER].pattern}"
)
"""Elements that are only in a URDF for ROS 2 or for Gazebo after Classic."""
_OF_ROSLAUNCH = re.compile(r"\$\(find\s|<node\b[^<>]{0,400}?\stype\s{0,8}=")
_DEPENDENCY = r"(?<=depend>)\s*(?:{})\s*(?=</)"
_MANIFEST = {
    CLASSIC: re.compile(_DEPENDENCY.format("gazebo_(?:ros|plugins|ros_pkgs|ros2_control)")),
    IGNITION: re.compile(_DEPENDENCY.format(r"ros_ign\w*|ign_ros2_control|ignition-\w+")),
    GZ: re.compile(_DEPENDENCY.format(r"gz_ros2_control|gz[-_]\w+")),
    ROS_GZ: re.compile(_DEPENDENCY.format(r"ros_gz\w*")),
}
_NODE = {CLASSIC: re.compile(r"\b(?:from|import) gazebo_msgs\b")}


class _Kind(NamedTuple):
    """Files by their paths in lower case, and what in them names a simulator."""

    names: re.Pattern[str]
    patterns: Mapping[str, re.Pattern[str]]


_STARTING = _Kind(re.compile(r"launch.*\.(?:py|xml|launch|ya?ml)\Z"), LAUNCH)
_MODELS = _Kind(re.compile(r"\.(?:urdf|xacro|sdf|world|gazebo)\Z"), DESCRIPTION)
_ROBOTS = _Kind(re.compile(r"\.(?:urdf|xacro)\Z"), DESCRIPTION)
_DEPENDENCIES = _Kind(re.compile(r"\Apackage\.xml\Z"), _MANIFEST)
_PYTHON = _Kind(re.compile(r"\.py\Z"), _NODE)


def simulator_signs(package: Package) -> dict[str, str]:
    """Return which simulators the package names, each with the first place that does.

    Where launch files start one, the dependencies in package.xml do not count.
    """
    started = _first(_signs(package, _STARTING))
    kinds = (_MODELS, _PYTHON) if started else (_MODELS, _DEPENDENCIES, _PYTHON)
    return _first(chain(started.items(), *(_signs(package, kind) for kind in kinds)))


def classic_start(package: Package) -> str:
    """Return where launch files start Classic alone, with a robot of the package; else empty.

    Its description may be for a later Gazebo, as an example that was copied into it. One that
    names Classic as well is for both, and other packages may start a later one.
    """
    started = _first(_signs(package, _STARTING))
    described = _first(_signs(package, _MODELS))
    if [*started] != [CLASSIC] or CLASSIC in described:
        return ""
    names = [posixpath.basename(it.path) for it in package.index.with_suffix(".urdf", ".xacro")]
    texts = [without_comments(path, text) for path, text in package.launch_texts.items()]
    spawns = any(has_word(text, _CLASSIC_SPAWN) for text in texts)
    own = any(has_file(text, name) for text in texts for name in names)
    return started[CLASSIC] if spawns and own else ""


def classic_beside_later(package: Package) -> str:
    """Return where launch files start Classic, for robots that are for Classic alone; else empty.

    Other launch files may start a later Gazebo.
    """
    started = _first(_signs(package, _STARTING))
    is_for_classic = CLASSIC in started and [*_first(_signs(package, _ROBOTS))] == [CLASSIC]
    return started[CLASSIC] if is_for_classic else ""


def gz_sim_start(package: Package) -> str:
    """Return where a launch file runs `gz sim`, a command that Fortress does not have; else empty.

    Nothing does in a package that names Fortress as well.
    """
    commands = _Kind(_STARTING.names, {GZ: _GZ_SIM})
    starts = _first(_signs(package, commands)).get(GZ, "")
    return "" if IGNITION in package.simulator_signs else starts


def _first(named: Iterable[tuple[str, str]]) -> dict[str, str]:
    found: dict[str, str] = {}
    for target, words in named:
        found.setdefault(target, words)
    return found


def _signs(package: Package, kind: _Kind) -> Iterator[tuple[str, str]]:
    paths = (file.path for file in package.index.files if kind.names.search(file.path.lower()))
    return signs_in_files(package, paths, kind.patterns)


def signs_in_files(
    package: Package,
    paths: Iterable[str],
    patterns: Mapping[str, re.Pattern[str]],
    *,
    ros_1: bool = False,
) -> Iterator[tuple[str, str]]:
    """Yield for each file and pattern that it holds the simulator, and the first place in words.

    Args:
        package: The package.
        paths: Paths of its files.
        patterns: What names each simulator.
        ros_1: Whether launch files of ROS 1 count; ROS 2 does not read those that are left.
    """
    for path in paths:
        source = package.read(path)
        if not isinstance(source, SourceText):
            continue
        text = without_comments(source.file, source.text)
        if not ros_1 and path.endswith(".launch") and _OF_ROSLAUNCH.search(text):
            continue  # left by an exporter or a port
        for target, pattern in patterns.items():
            if match := pattern.search(text):
                yield target, f"{source.where(match.start())} names {match.group().strip()}"


def is_described_for_ros_2(package: Package) -> bool:
    """Return whether a URDF without a package has `<ros2_control>` or plugins of later Gazebos."""
    paths = (file.path for file in package.index.with_suffix(".urdf", ".xacro"))
    return any(signs_in_files(package, paths, {GZ: _OF_ROS_2}))
