"""Facts about a plugin: its library, the releases that have it, its parameters."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

from checker.base.record import Record
from checker.base.resources import table
from checker.editor.target import plugin_releases
from checker.model.plugin_library import (
    SUBT_RELEASE,
    classic_plugin,
    library_of_class,
    library_stem,
    plugin_libraries,
    release_label,
    releases_with,
)
from checker.rule import Context

_NAME_AND_TYPE = re.compile(r"([\w/]+) \((.+)\)")
_ROS2_CONTROL = ("gz_ros2_control-system", "ign_ros2_control-system", "gazebo_ros2_control")


class Parameter(Record):
    """A parameter of a plugin.

    Attributes:
        path: The path below `<plugin>`: `a/b` nested, `@x` an attribute.
        words: Its type, and its default where one is known; empty if neither is.
        usual: What packages set most often.
    """

    path: str
    words: str = ""
    usual: str = ""

    @property
    def tag(self) -> str:
        """The first element of the path."""
        return self.path.split("/")[0].split("@")[0]


class PluginFacts(Record):
    """Facts about a plugin.

    Attributes:
        library: File name as plugins usually write it.
        classes: Names that `name` may have.
        title: The project it belongs to: `Gazebo Harmonic`.
        releases: The releases that have it, as in messages.
        parameters: The parameters by path; none if they are not known.
        note: Further information.
    """

    library: str
    classes: tuple[str, ...]
    title: str
    releases: tuple[str, ...]
    parameters: Mapping[str, Parameter]
    note: str = ""


def plugin_facts(filename: str, name: str, target: Context) -> PluginFacts | None:
    """Return what is known of a plugin; None if nothing is.

    Args:
        filename: The filename of its library, as written; empty if none is.
        name: The name of its class, as written.
        target: The newest release counts if it has none.
    """
    stem = library_stem(filename)
    if stem in _ROS2_CONTROL:
        return _ros2_control(stem, target)
    for release in plugin_releases(target):
        library = plugin_libraries(release).get(stem)
        if library is None and not stem:
            library = library_of_class(release, name)
        if library is not None:
            return _of_release(release, library_stem(library.filename))
    if (known := classic_plugin(filename)) is not None and stem:
        return _of_classic(filename, known)
    elsewhere = _anywhere(stem)
    return elsewhere or _of_subt(stem, name)


def known_plugins(target: Context) -> Iterator[PluginFacts]:
    """Yield the plugins that a target has, each once."""
    release = plugin_releases(target)[0]
    stems = {library_stem(it.filename) for it in plugin_libraries(release).values()}
    for stem in sorted(stems):
        if (facts := _of_release(release, stem)) is not None:
            yield facts
    if release != SUBT_RELEASE:
        stem = _ROS2_CONTROL[1 if release == "fortress" else 0]
        yield _ros2_control(stem, target)


@cache
def _of_release(release: str, stem: str) -> PluginFacts | None:
    library = plugin_libraries(release).get(stem)
    if library is None:
        return None
    entry = _entries(release).get(stem)
    if entry is None:
        return _of_subt(stem, "")
    typed = {**entry["params"], **dict.fromkeys(f"@{it}" for it in entry.get("attrs", ()))}
    usual = _usual(stem) if release == SUBT_RELEASE else {}
    parameters = {
        path: Parameter(path, kind or "", usual.get(path, "")) for path, kind in typed.items()
    }
    parameters |= {path: Parameter(path, "", it) for path, it in usual.items() if "/" in path}
    releases = tuple(releases_with(stem))
    return PluginFacts(
        library.filename, library.classes, release_label(release), releases, parameters
    )


@cache
def _entries(release: str) -> Mapping[str, Any]:
    plugins = table("gazebo_plugins")["releases"].get(release, {"plugins": ()})["plugins"]
    return {library_stem(name): entry for entry in plugins for name in entry["filenames"]}


def _subt_entries(stem: str) -> Iterator[Any]:
    for entry in table("subt_plugins")["plugins"]:
        if stem in map(library_stem, entry["filenames"]):
            yield entry


def _usual(stem: str) -> dict[str, str]:
    """Return what SubT packages set most often, by path."""
    entries = _subt_entries(stem)
    params = (param for entry in entries for param in entry["params"])
    return {param["name"]: param["common"][0] for param in params if param["common"]}


def _of_subt(stem: str, name: str) -> PluginFacts | None:
    """Return what is known of a plugin that packages of SubT bring along."""
    entry = next(_subt_entries(stem), None)
    if entry is None and not stem:
        every = table("subt_plugins")["plugins"]
        entry = next((it for it in every if name in it["names"]), None)
    if entry is None:
        return None
    parameters = {
        param["name"]: Parameter(param["name"], param["type"], next(iter(param["common"]), ""))
        for param in entry["params"]
    }
    filename, classes = entry["filenames"][0], tuple(entry["names"])
    return PluginFacts(filename, classes, "SubT packages", (), parameters)


def _anywhere(stem: str) -> PluginFacts | None:
    """Return a plugin of other releases than the target's."""
    releases = tuple(table("gazebo_plugins")["releases"])
    with_it = [name for name in releases if stem in plugin_libraries(name)]
    return _of_release(with_it[-1], stem) if with_it else None


def _of_classic(filename: str, known: Mapping[str, Any]) -> PluginFacts:
    parameters = {it.path: it for it in _classic_parameters(library_stem(filename))}
    replacement = known.get("replacement", {}).get("filename", "")
    notes = [f"later releases have {replacement}"] if replacement else []
    notes += [known["note"]] if "note" in known else []
    name = "Gazebo Classic"
    return PluginFacts(filename, (), name, (name,), parameters, "; ".join(notes))


def _classic_parameters(stem: str) -> Iterator[Parameter]:
    """Yield the parameters of a plugin that turns wheels."""
    for drive in table("gazebo_classic_plugins")["drives"]:
        if not re.fullmatch(drive["match"], stem):
            continue
        yield from (Parameter(tag, "joint") for tag in (*drive["left"], *drive["right"]))
        for name in ("separation", "diameter"):
            if drive[name]:
                yield Parameter(drive[name], f"metres, default {drive[f'default_{name}']}")


def _ros2_control(stem: str, target: Context) -> PluginFacts:
    """Return the plugin that runs ros2_control's controller manager inside Gazebo."""
    entries = table("ros2_control_hardware")["_"]["gazebo_plugin"]
    fitting = [it for it in entries if stem in map(library_stem, it["filename"])]
    of_release = [it for it in fitting if target.release in it["release"].lower()]
    entry = (of_release or fitting)[-1]
    classes = tuple(name.split(" ")[0] for name in entry["name"] if name != "any")
    parameters = {it.path: it for it in map(_parameter, entry["params"])}
    note = f"hardware: {entry['hardware']}"
    return PluginFacts(
        entry["filename"][0], classes, "ros2_control", (entry["release"],), parameters, note
    )


def _parameter(text: str) -> Parameter:
    match = _NAME_AND_TYPE.fullmatch(text)
    return Parameter(match[1], match[2]) if match else Parameter(text)
