"""A system of Gazebo under its name in Ignition Gazebo.

From Garden on the systems are called `gz-sim-…-system` and `gz::sim::systems::…`. Harmonic rewrites
the older names and warns; Ionic and Jetty do not: they find no library, and the robot has no drive,
no state publisher or no sensor. Fortress has the older names itself, so there it is an info: its
latest versions read the newer names too, which load in every release.

Fix: write `gz-sim-…-system` and `gz::sim::systems::…`.
Source: SystemLoader.cc of gz-sim, branches ign-gazebo6, gz-sim8, gz-sim9 and gz-sim10.
"""

from collections.abc import Iterator

from checker.model.components import Plugin
from checker.model.plugin_host import PluginHost
from checker.model.plugin_library import library_stem, newer_name, plugin_libraries
from checker.rule import (
    Concern,
    Context,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)
from checker.source.text import Located

_EFFECTS = {
    "fortress": (Severity.INFO, "which Ionic and later releases do not load"),
    "harmonic": (Severity.WARNING, "which Harmonic reads with a warning, and Ionic no longer"),
    "ionic": (Severity.ERROR, "which Ionic does not load"),
    "jetty": (Severity.ERROR, "which Jetty does not load"),
}


@rule("PLG010", "plugin-name-of-another-release", Severity.ERROR, Concern.PORTABILITY)
def check(host: PluginHost, context: Context) -> Findings:
    """Report systems of Gazebo with a library or class of the time of Ignition."""
    if context.release not in _EFFECTS:
        return
    if host.unread:
        yield unchecked(host.unread)
    severity, effect = _EFFECTS[context.release]
    for plugin in host.plugins:
        for old in _old_names(plugin, context.release):
            new = newer_name(old.value)
            yield finding(
                old,
                f"{old.value} is a name of Ignition Gazebo, {effect}: expected {new}",
                severity=severity,
                key="spelling",
                fix=replace_text(old, new, _safety(context)),
            )


def _old_names(plugin: Plugin, release: str) -> Iterator[Located[str]]:
    """Yield the library and the class of a system if they are spelled the older way."""
    libraries = plugin_libraries(release)
    library = libraries.get(library_stem(newer_name(plugin.filename.value)))
    if library is None:
        return
    for name in (plugin.filename, plugin.name):
        if newer_name(name.value) != name.value:
            yield name


def _safety(context: Context) -> Safety:
    """Early versions of Fortress do not know the newer names."""
    return Safety.UNSAFE if context.release == "fortress" else Safety.SAFE


def _drive(library: str, name: str, mark: str = "") -> str:
    return f'<plugin filename="{library}" name="{name}"/>{mark}'


_MARK = "  <!-- ^ PLG010 -->"
_OLD = ("ignition-gazebo-diff-drive-system", "ignition::gazebo::systems::DiffDrive")
_NEW = ("gz-sim-diff-drive-system", "gz::sim::systems::DiffDrive")
GOOD = [
    _drive(*_NEW),
    {"@profile": "gazebo-jetty", "@fragment": _drive(*_NEW)},
    _drive("ignition-gazebo-of-somebody-system", "ignition::gazebo::systems::Else"),
]
BAD = [
    _drive(*_OLD, _MARK),
    _drive(f"lib{_OLD[0]}.so", _NEW[1], _MARK),
    {"@profile": "gazebo-ionic", "@fragment": _drive(*_OLD, _MARK)},
    {"@profile": "gazebo-fortress", "@fragment": _drive(_NEW[0], _OLD[1], _MARK)},
]
