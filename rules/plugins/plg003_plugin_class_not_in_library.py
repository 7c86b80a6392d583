"""A plugin class that its library does not have.

Gazebo opens the library, finds no class with that name, prints one line and continues without the
plugin.

Fix: write a class that the library has, or the library that has the class.
Source: classes that the systems of a Gazebo release register (`gazebo_plugins.json`). No accepted
package that we checked has this fault.
"""

from checker.model.components import Plugin
from checker.model.plugin_host import PluginHost
from checker.model.plugin_library import (
    PluginLibrary,
    library_of_class,
    library_stem,
    newer_name,
    plugin_libraries,
)
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)


@rule("PLG003", "plugin-class-not-in-library", Severity.ERROR, Concern.INTERFACE)
def check(host: PluginHost, context: Context) -> Findings:
    """Report plugins whose `name` is not a class in their `filename`."""
    if host.unread:
        yield unchecked(host.unread)
    libraries = plugin_libraries(context.release)
    for plugin in host.plugins:
        library = libraries.get(library_stem(plugin.filename.value))
        if library is None or not plugin.name.stated or library.has_class(plugin.name.value):
            continue
        if context.is_classic:
            continue  # There, a name is free to choose.
        if not plugin.name.value and not context.is_subt:
            continue  # Later releases take the first class of the library.
        if library.has_class(newer_name(plugin.name.value)):
            continue  # PLG010 says so.
        yield _mismatch(plugin, library, library_of_class(context.release, plugin.name.value))


def _mismatch(plugin: Plugin, library: PluginLibrary, other: PluginLibrary | None) -> Finding:
    """Report the library if another one has the class, else the class."""
    named = f"{plugin.filename.value} has no class {plugin.name.value!r}"
    if other is not None:
        return finding(
            plugin.filename,
            f"{named}, which belongs to {other.filename}",
            fix=replace_text(plugin.filename, other.filename, Safety.UNSAFE),
        )
    only = library.classes[0] if len(library.classes) == 1 else None
    return finding(
        plugin.name,
        f"{named}, expected {' or '.join(library.classes)}",
        fix=replace_text(plugin.name, only) if only else None,
    )


def _plugin(library: str, name: str, mark: str = "") -> str:
    return f'<plugin filename="{library}" name="{name}"/>{mark}'


_DRIVE = "libignition-gazebo-diff-drive-system.so"
_SYSTEMS = "ignition::gazebo::systems"
_MARK = "  <!-- ^ PLG003 -->"

GOOD = [
    {"@profile": "gazebo-classic", "@fragment": _plugin("libgazebo_ros_p3d.so", "truth")},
    _plugin(_DRIVE, f"{_SYSTEMS}::DiffDrive"),
    _plugin("ignition-gazebo-diff-drive-system", f"{_SYSTEMS}::v4::DiffDrive"),
    _plugin("libGasEmitterDetectorPlugin.so", "subt::GasDetector"),
    _plugin("libOfSomebody.so", "somebody::Else"),
]
BAD = [
    _plugin(_DRIVE, "DiffDrive", _MARK),
    _plugin(_DRIVE, f"{_SYSTEMS}::WheelSlip", _MARK),
    _plugin("libGasEmitterDetectorPlugin.so", "subt::GasDetektor", _MARK),
]
