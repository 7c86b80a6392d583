"""The shared libraries that hold plugins: those of a Gazebo release, SubT's, and Classic's."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from typing import Any

from checker.base.record import Record
from checker.base.resources import table

SUBT_RELEASE = "dome"
"""The release that SubT and the plugins of its robots were built for."""

_CLASSIC = re.compile(r"(?:gazebo_ros|hector_gazebo)_.*")
_INLINE_NAMESPACE = re.compile(r"::v\d+::")


class PluginLibrary(Record):
    """A shared library and the plugin classes in it.

    Attributes:
        filename: As plugins usually name it: `libignition-gazebo-diff-drive-system.so`.
        classes: Full names of its classes.
        parameters: Tags that its source asks for; None where the source is not known.
    """

    filename: str
    classes: tuple[str, ...]
    parameters: frozenset[str] | None = None

    def has_class(self, name: str) -> bool:
        """Say whether a plugin of this library may have the name.

        Later releases read `ignition::gazebo` as `gz::sim`.
        """
        name = _INLINE_NAMESPACE.sub("::", name)
        return name in self.classes or name.replace("ignition::gazebo", "gz::sim") in self.classes


def library_stem(filename: str) -> str:
    """Return what identifies a library: its name without folder, `lib` and `.so`."""
    return filename.rsplit("/", 1)[-1].removeprefix("lib").removesuffix(".so")


@cache
def plugin_libraries(release: str) -> Mapping[str, PluginLibrary]:
    """Return the libraries available in a release by their stem; none for an unknown release."""
    of_subt = _subt_libraries() if release == SUBT_RELEASE else {}
    return {**gazebo_libraries(release), **of_subt}


@cache
def gazebo_libraries(release: str) -> Mapping[str, PluginLibrary]:
    """Return those of them that Gazebo has itself."""
    libraries: dict[str, PluginLibrary] = {}
    systems = table("gazebo_plugins")["releases"].get(release, {"plugins": ()})["plugins"]
    for system in systems:
        parameters = frozenset({*system["params"], *system.get("attrs", ())})
        library = PluginLibrary(system["filenames"][1], tuple(system["classes"]), parameters)
        libraries.update(dict.fromkeys(map(library_stem, system["filenames"]), library))
    return libraries


def _subt_libraries() -> dict[str, PluginLibrary]:
    """Return the libraries of SubT and of its robots, as far as they are not Gazebo's."""
    return {
        library_stem(filename): PluginLibrary(filename, tuple(entry["names"]))
        for entry in table("subt_plugins")["plugins"]
        if entry["stock"] is None
        for filename in entry["filenames"]
    }


def library_of_class(release: str, name: str) -> PluginLibrary | None:
    """Return the library of a release that holds a class."""
    return next((lib for lib in plugin_libraries(release).values() if lib.has_class(name)), None)


def release_label(release: str) -> str:
    """Return what a message calls a release, SubT's own plugins included: `… (Dome) and SubT`."""
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
    return {} if _CLASSIC.fullmatch(stem) else None
