"""A plugin whose library does not exist.

Gazebo cannot load it: it prints one line and continues without the drive, the sensor or other
function of the plugin. A library counts as known if the target release or SubT has it, or if this
package or a dependency, outside of SubT any package beside it, ships or builds it. There the
simulator's paths may lead to more libraries: it is an info, unless the name is one of Gazebo's own.
It is a warning if the library is of a known package, on which package.xml does not depend (PKG007
reports it where the robot's <ros2_control> tags name that package, too), and an error if the ROS 2
distribution no longer has that package: `ign_ros2_control-system` from Jazzy on. For Gazebo
Classic, it is an error if the name is a misspelt library of gazebo_ros_pkgs. In a description that
launch files load and never spawn into Gazebo it weighs less.

Fix: write the library's name as the message suggests, or ship the library and declare the package
that contains it in package.xml.
Source: system plugins of the Gazebo releases (`gazebo_plugins.json`); plugins found in SubT
packages (`subt_plugins.json`); packages that distributions do not have (`removed_packages.json`).
No accepted package that we checked has this fault.
"""

from collections.abc import Mapping, Set

from checker.base.resources import table
from checker.base.words import Suggestions
from checker.launch.ros2.package_launch import built_by_ament
from checker.model.components import Plugin
from checker.model.plugin_host import PluginHost
from checker.model.plugin_library import (
    classic_plugin,
    is_of_gazebo,
    library_stem,
    newer_name,
    package_of_library,
    plugin_libraries,
    release_label,
    releases_with,
)
from checker.package.dependencies import (
    AvailablePackages,
    available_packages,
    libraries_of,
)
from checker.package.package import Package
from checker.ros.ros2_control.plugin_packages import plugin_uses
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    finding,
    lessened,
    rule,
    unchecked,
)

_NONE = "__default__"
"""Value that old releases of libsdformat wrote if a file names no library."""
_OF_CONTROL = frozenset({"gz_ros2_control", "ign_ros2_control", "gazebo_ros2_control"})


@rule("PLG002", "unknown-plugin-library", Severity.ERROR, Concern.INTERFACE)
def check(host: PluginHost, package: Package, context: Context, spawned: SpawnedFiles) -> Findings:
    """Report plugins whose library neither Gazebo nor any available package has.

    In a description that Gazebo never gets it weighs less.
    """
    found = [*_found(host, package, context)]
    robot = host.robot if any(isinstance(each, Finding) for each in found) else None
    in_classic = spawned.is_in_classic(robot) if robot is not None else None
    if in_classic is not None and in_classic is not context.is_classic:
        return
    clause = "" if robot is None or robot.never_simulated else spawned.without(robot)
    for each in found:
        yield lessened(each, clause) if clause and isinstance(each, Finding) else each


def _found(host: PluginHost, package: Package, context: Context) -> Findings:
    if host.unread:
        yield unchecked(host.unread)
    of_release = plugin_libraries(context.release)
    if not of_release:
        yield unchecked(f"the plugins of {context.release or 'no release'} are not known")
        return
    lenders = available_packages(package)
    known = lenders.libraries() | of_release.keys()
    suggestions = Suggestions(sorted(known))
    beside = _built_beside(host, package, known) if not context.is_subt else frozenset[str]()
    for plugin in host.plugins:
        stem = library_stem(plugin.filename.value)
        if stem in ("", _NONE) or stem in known or _is_reported_elsewhere(stem, context):
            continue
        if not context.is_subt and newer_name(stem) in known:
            continue  # PLG010 says so.
        if stem in beside:
            continue
        if lenders.unknown and context.is_subt:
            yield unchecked(
                f"{plugin.filename.value} may come from {', '.join(lenders.unknown)}, which is not "
                "available"
            )
            continue
        successor = _successor(stem, package, context)
        is_lent = _may_be_lent(stem, package, lenders) or _is_undeclared(stem, package, lenders)
        if not (context.is_subt or successor) and is_lent:
            continue
        yield finding(
            plugin.filename,
            _in_classic(plugin, context)
            or f"library {plugin.filename.value} is not in {release_label(context.release)}, and "
            "is neither shipped nor built by "
            f"{' or '.join(package.name for package in lenders.at_hand)}"
            f"{successor or _elsewhere(stem, context) or suggestions.hint(stem)}",
            severity=None if successor else _severity(stem, context, suggestions),
            key=stem,
        )


def _in_classic(plugin: Plugin, context: Context) -> str:
    """Return what Gazebo Classic does without a system of later Gazebos; empty for other cases."""
    stem = newer_name(library_stem(plugin.filename.value))
    if not context.is_classic or not is_of_gazebo(stem):
        return ""
    known: Mapping[str, str] = table("gazebo_classic_ros2")["systems_instead"]
    advice = "no plugin of Classic is known that does the same"
    if stem in known:
        advice = f"use {known[stem]}" if known[stem] else "remove it, Classic needs no such plugin"
    return (
        f"Gazebo Classic does not load {plugin.filename.value}, a system of later Gazebos, and the "
        f"robot is started without it: {advice}"
    )


def _built_beside(host: PluginHost, package: Package, known: Set[str]) -> frozenset[str]:
    """Return the libraries of the workspace, to which a path leads, if one is not known."""
    if all(library_stem(plugin.filename.value) in known for plugin in host.plugins):
        return frozenset()
    return frozenset(name for other in package.other_packages for name in libraries_of(other))


def _may_be_lent(stem: str, package: Package, lenders: AvailablePackages) -> bool:
    """Return whether the package may depend on the one that has a library."""
    is_silent = bool(package.only) or not package.exists("package.xml")
    return package_of_library(stem) in lenders.missing or (
        is_silent and bool(package_of_library(stem))
    )


def _is_undeclared(stem: str, package: Package, lenders: AvailablePackages) -> bool:
    """Return whether PKG007 looks for the package of a library: its hardware is used, too.

    A package that names another package of ros2_control for Gazebo has the wrong names.
    """
    lender = package_of_library(stem)
    named = any(use.package_name == lender for use in plugin_uses(package))
    return named and built_by_ament(package) and _OF_CONTROL.isdisjoint(lenders.missing)


def _successor(stem: str, package: Package, context: Context) -> str:
    """Return what took the place of a library whose package the distribution does not have."""
    lender = package_of_library(stem)
    removed = table("removed_packages")["names"].get(lender)
    if removed is None or context.distro not in removed["missing_in"]:
        return ""
    if package.workspace.package(lender) is not None:
        return ""
    expected = stem.replace(lender, removed["instead"])
    return f"; {context.distro.capitalize()} has no package {lender!r}: expected {expected}"


def _elsewhere(stem: str, context: Context) -> str:
    """Return which release or package has the library, as the end of a sentence."""
    if context.is_subt:
        return ""
    if lender := package_of_library(stem):
        return f"; add its package to package.xml: <exec_depend>{lender}</exec_depend>"
    return "".join(f"; {label} is the first that has it" for label in releases_with(stem)[:1])


def _is_reported_elsewhere(stem: str, context: Context) -> bool:
    """Return whether PLG001 reports the library, or PLG012 as one of ROS 1."""
    if context.is_classic:
        return stem in table("gazebo_classic_ros2")["ros_1"]["libraries"]
    return classic_plugin(stem) is not None


def _severity(stem: str, context: Context, suggestions: Suggestions) -> Severity | None:
    """Return the severity of an unavailable library.

    Submissions bring nothing along. Elsewhere, libraries of other packages are found by the
    simulator's paths; only those that bear Gazebo's own name are expected to be its own. Those of
    Gazebo Classic have no such name: one that is a misspelling of another is an error.
    """
    if context.is_subt or is_of_gazebo(stem):
        return None
    if context.is_classic and stem.startswith("gazebo_ros"):
        return None if suggestions.correction(stem) else Severity.INFO
    return Severity.WARNING if package_of_library(stem) else Severity.INFO


_CMAKE = """project(acme_rover_sensor_config_1)
add_library(RoverArm SHARED src/arm.cc)
"""


def _classic(library: str, mark: str = "") -> dict[str, str]:
    plugin = f'<plugin filename="{library}" name="p"/>{mark}'
    return {"@profile": "gazebo-classic", "@fragment": plugin}


_IGNITION = "ign_ros2_control"
_MANIFEST = f"<package><name>arm</name><depend>{_IGNITION}</depend></package>"


def _ignition(mark: str = "") -> dict[str, str]:
    plugin = f'<plugin filename="lib{_IGNITION}-system.so" name="p"/>{mark}'
    return {"@profile": "ros2", "@urdf": f"<gazebo>{plugin}</gazebo>", "package.xml": _MANIFEST}


_SYSTEM = """<gazebo><plugin filename="gz_ros2_control-system" name="p"/></gazebo>{}
{}"""
_HARDWARE = """<ros2_control name="arm" type="system">
  <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
</ros2_control>"""


def _undeclared(hardware: str, mark: str = "") -> dict[str, object]:
    return {
        "@ros2": True,
        "@profile": "ros2",
        "urdf/arm.urdf": f'<robot name="arm"><link name="base"/>{_SYSTEM.format(mark, hardware)}'
        "</robot>",
        "package.xml": "<package format='3'><name>acme_arm_bringup</name><export>"
        "<build_type>ament_cmake</build_type></export></package>",
    }


GOOD = [
    _undeclared(_HARDWARE),
    '<plugin filename="ignition-gazebo-diff-drive-system" name="drive"/>',
    '<plugin filename="libGasEmitterDetectorPlugin.so" name="subt::GasDetector"/>',
    {
        "@fragment": '<plugin filename="libRoverArm.so" name="rover::Arm"/>',
        "CMakeLists.txt": _CMAKE,
    },
    {
        "@fragment": '<plugin filename="libRoverArm.so" name="rover::Arm"/>',
        "plugins/libRoverArm.so": "",
    },
    _classic("libgazebo_ros_ray_sensor.so"),
    _classic("libgazebo_ros2_control.so"),
    {
        "@profile": "ros2",
        "@urdf": '<gazebo><plugin filename="gz_ros2_control-system" name="p"/></gazebo>',
        "package.xml": None,
    },
    {
        **_ignition(),
        f"../{_IGNITION}/package.xml": f"<package><name>{_IGNITION}</name></package>",
        f"../{_IGNITION}/CMakeLists.txt": f"add_library({_IGNITION}-system SHARED a.cc)",
    },
    {
        **_classic("libgazebo_acme_lidar.so"),
        "../acme_plugins/package.xml": "<package><name>acme_plugins</name></package>",
        "../acme_plugins/CMakeLists.txt": "add_library(gazebo_acme_lidar SHARED a.cc)",
    },
]
BAD = [
    '<plugin filename="libignition-gazebo-dif-drive-system.so" name="d"/>  <!-- ^ PLG002 -->',
    {
        "@fragment": '<plugin filename="libRoverLeg.so" name="r::Leg"/>  <!-- ^ PLG002 -->',
        "CMakeLists.txt": _CMAKE,
    },
    _classic("libgazebo_ros_dif_drive.so", "  <!-- ^ PLG002 -->"),
    _classic("gz-sim-diff-drive-system", "  <!-- ^ PLG002 -->"),
    _classic("libignition-gazebo-sensors-system.so", "  <!-- ^ PLG002 -->"),
    _ignition("  <!-- ^ PLG002 -->"),
    _undeclared("", "  <!-- ^ PLG002 -->"),
]
