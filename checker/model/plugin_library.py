"""The shared libraries that contain plugins: those of a Gazebo release, SubT's, and Classic's."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from typing import Any

from msgspec import field

from checker.base.record import Record
from checker.base.resources import table

SUBT_RELEASE = "dome"
"""The release that SubT and the plugins of its robots were built for."""

CLASSIC = "classic"
_OF_CLASSIC = re.compile(r"(?:gazebo_ros2?|hector_gazebo)_.*")
_OLDER_LIBRARY = re.compile(r"ignition-gazebo\d*-")
_OF_GAZEBO = re.compile(r"(?:ignition-gazebo|gz-sim)\d*-.*-system")
_INLINE_NAMESPACE = re.compile(r"::v\d+::")


class PluginLibrary(Record):
    """A shared library and the plugin classes in it.

    Attributes:
        filename: The filename as plugins usually name it:
            `libignition-gazebo-diff-drive-system.so`.
        classes: Full names of its classes; none in Gazebo Classic, where `name` is any name.
        parameters: Tags that its source reads; None if the source is not known.
        computed: Pattern of further tags, whose names its source computes; empty if it does not.
        rewrites: Words that the release replaces in a class before it looks for it.
    """

    filename: str
    classes: tuple[str, ...]
    parameters: frozenset[str] | None = None
    computed: str = ""
    rewrites: Mapping[str, str] = field(default_factory=dict)

    def has_class(self, name: str) -> bool:
        """Return whether a plugin of this library may have the name."""
        name = _INLINE_NAMESPACE.sub("::", name)
        return name in self.classes or _rewritten(name, self.rewrites) in self.classes

    def reads(self, tag: str) -> bool:
        """Return whether its source reads a tag; True if the source is not known."""
        known = self.parameters is None or tag in self.parameters
        return known or bool(self.computed and re.fullmatch(self.computed, tag))


def library_stem(filename: str) -> str:
    """Return what identifies a library: its name without folder, `lib` and `.so`."""
    return filename.rsplit("/", 1)[-1].removeprefix("lib").removesuffix(".so")


def newer_name(name: str) -> str:
    """Return the name of a library or class as releases from Garden on have it."""
    return _OLDER_LIBRARY.sub("gz-sim-", name).replace("ignition::gazebo::", "gz::sim::")


def is_of_gazebo(stem: str) -> bool:
    """Return whether a library has a name of Gazebo's own systems, of any release."""
    return _OF_GAZEBO.fullmatch(stem) is not None


@cache
def plugin_libraries(release: str) -> Mapping[str, PluginLibrary]:
    """Return the libraries available in a release by their stem; none for an unknown release."""
    of_subt = _subt_libraries() if release == SUBT_RELEASE else {}
    return {**gazebo_libraries(release), **of_subt}


@cache
def gazebo_libraries(release: str) -> Mapping[str, PluginLibrary]:
    """Return those of them that Gazebo has itself; of Classic, with those for ROS 2."""
    if release == CLASSIC:
        return _classic_libraries()
    libraries: dict[str, PluginLibrary] = {}
    entry = table("gazebo_plugins")["releases"].get(release, {"plugins": ()})
    rewrites = entry.get("rewrites", {})
    back = {new: old for old, new in rewrites.items()}
    computed = table("gazebo_plugins")["computed_params"]
    for system in entry["plugins"]:
        parameters = frozenset({*system["params"], *system.get("attrs", ())})
        classes = tuple(system["classes"])
        pattern = computed.get(system["name"], "")
        library = PluginLibrary(system["filenames"][1], classes, parameters, pattern, rewrites)
        stems = {library_stem(name) for name in system["filenames"]}
        stems |= {_rewritten(stem, back) for stem in stems}
        libraries.update(dict.fromkeys(sorted(stems), library))
    return libraries


def _classic_libraries() -> dict[str, PluginLibrary]:
    entry = table("gazebo_classic_ros2")
    libraries: dict[str, PluginLibrary] = {}
    for stem, known in entry["plugins"].items():
        own = known["params"]
        parameters = None if own is None else frozenset({*own, *entry["every_plugin"]})
        libraries[stem] = PluginLibrary(f"lib{stem}.so", (), parameters)
    return libraries


def _rewritten(name: str, rewrites: Mapping[str, str]) -> str:
    for old, new in rewrites.items():
        name = name.replace(old, new)
    return name


def _subt_libraries() -> dict[str, PluginLibrary]:
    """Return the libraries of SubT and of its robots, as far as they are not Gazebo's."""
    return {
        library_stem(filename): PluginLibrary(filename, tuple(entry["names"]))
        for entry in table("subt_plugins")["plugins"]
        if entry["stock"] is None
        for filename in entry["filenames"]
    }


def library_of_class(release: str, name: str) -> PluginLibrary | None:
    """Return the library of a release that contains a class."""
    return next((lib for lib in plugin_libraries(release).values() if lib.has_class(name)), None)


def package_of_library(stem: str) -> str:
    """Return the ROS package that contains a library; empty if none is known."""
    return str(table("gazebo_plugins")["ros_packages"].get(stem, ""))


def releases_with(stem: str) -> list[str]:
    """Return what messages call the releases that have a library, the oldest first."""
    releases = table("gazebo_plugins")["releases"]
    return [str(releases[name]["label"]) for name in releases if stem in gazebo_libraries(name)]


def release_label(release: str) -> str:
    """Return what a message calls a release, SubT's own plugins included: `… (Dome) and SubT`."""
    if release == CLASSIC:
        return "Gazebo Classic 11 with ROS 2"
    label = str(table("gazebo_plugins")["releases"][release]["label"])
    return f"{label} and SubT" if release == SUBT_RELEASE else label


def release_major(release: str) -> int | None:
    """Return the major version of a release's simulator: 4 for Dome."""
    entry = table("gazebo_plugins")["releases"].get(release)
    match = re.search(r"\d+\Z", entry["branch"]) if entry else None
    return int(match.group()) if match else None


def classic_plugin(filename: str) -> dict[str, Any] | None:
    """Return what is known of a Gazebo Classic plugin; None for any other library."""
    stem = library_stem(filename)
    for entry in table("gazebo_classic_plugins")["plugins"]:
        if re.fullmatch(entry["match"], stem):
            return dict(entry)
    return {} if _OF_CLASSIC.fullmatch(stem) else None
