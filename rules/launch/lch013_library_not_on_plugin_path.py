"""A plugin library that is installed where Gazebo does not search for it.

Gazebo prints one line and continues without the plugin. It searches its own folder and those of
`GZ_SIM_SYSTEM_PLUGIN_PATH`; `gz_sim.launch.py` adds the folders of `LD_LIBRARY_PATH`, which include
`lib` but not `lib/<package>`.

The rule checks robots spawned by a launch file that also starts Gazebo. Hooks (`.dsv`) and
`<gazebo_ros plugin_path="…"/>` of package.xml are read. It reports nothing if a launch file, a
document or a script of the available packages names the plugin path.

Fix: install the library into `lib`, or register an environment hook with the line
`prepend-non-duplicate;GZ_SIM_SYSTEM_PLUGIN_PATH;lib/@PROJECT_NAME@`.
Source: gz-sim, SystemLoader.cc; ros_gz_sim, gz_sim.launch.py; ros_gz_project_template, hooks.
"""

from collections.abc import Iterator

from checker.model.components import Plugin
from checker.model.plugin_library import library_stem
from checker.package.package import Package
from checker.package.resource_path import plugin_folders
from checker.ros.simulation import Simulation, Simulations
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH013", "library-not-on-plugin-path", Severity.WARNING, Concern.INTERFACE)
def check(simulations: Simulations, package: Package) -> Findings:
    """Report each library once."""
    packages = (package, *package.other_packages)
    named = [
        (plugin, holder, folder)
        for simulation in simulations.launched
        for plugin in _plugins(simulation)
        for holder in packages
        for folder in _private_folder(holder, library_stem(plugin.filename.value))
    ]
    searched = [plugin_folders(each) for each in packages] if named else []
    known = [folders for folders in searched if folders is not None]
    if len(known) < len(searched):
        return
    others = frozenset().union(*known)
    there = f", which is {' and '.join(sorted(others))}" if others else ""
    for plugin, holder, folder in named:
        if folder not in others:
            yield finding(
                plugin.filename,
                f"{plugin.filename.value} is installed into {folder} of {holder.name}, which is "
                f"not on the plugin path of Gazebo{there}: write "
                f"`prepend-non-duplicate;GZ_SIM_SYSTEM_PLUGIN_PATH;{folder}` in a hook",
                key=plugin.filename.value,
            )


def _plugins(simulation: Simulation) -> Iterator[Plugin]:
    """Yield the plugins of what a launch file spawns into its own Gazebo."""
    if simulation.starts_gazebo and not simulation.unread:
        for spawned in simulation.robots:
            yield from (p for p in spawned.robot.all_plugins if "/" not in p.filename.value)


def _private_folder(package: Package, library: str) -> Iterator[str]:
    """Yield its own folder into which a package installs a library that it builds."""
    build = package.build
    if build is None or build.faults:
        return
    if any(each.name.value == library and not each.conditional for each in build.libraries):
        folders = {*build.library_destinations(library)}
        if folders == {f"lib/{package.declared_name}"}:
            yield from folders


_BUILD = """project(acme_rover_bringup)
find_package(ament_cmake REQUIRED)
add_library(acme_drive SHARED src/drive.cpp)
install(TARGETS acme_drive ARCHIVE DESTINATION lib LIBRARY DESTINATION lib/${PROJECT_NAME})
install(DIRECTORY config launch urdf DESTINATION share/${PROJECT_NAME})
ament_package()
"""
_URDF = """<robot name="rover">
  <link name="base_link"/>
  <gazebo>
    <plugin filename="acme_drive" name="acme::Drive"/>  <!-- ^ LCH013 -->
  </gazebo>
</robot>
"""
_PLAIN = _URDF.replace("  <!-- ^ LCH013 -->", "")
_FILES = {"@bridge": True, "urdf/rover.urdf": _PLAIN, "CMakeLists.txt": _BUILD}
_HOOK = "prepend-non-duplicate;GZ_SIM_SYSTEM_PLUGIN_PATH;lib/@PROJECT_NAME@\n"

_REGISTERED = _BUILD.replace(
    "ament_package()", 'ament_environment_hooks("hooks/rover.dsv.in")\nament_package()'
)
_EXPORT = """<package format="3">
  <name>acme_rover_bringup</name>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type><gazebo_ros plugin_path="{}"/></export>
</package>
"""

GOOD = [
    {"@bridge": True},
    {**_FILES, "CMakeLists.txt": _REGISTERED, "hooks/rover.dsv.in": _HOOK},
    {**_FILES, "package.xml": _EXPORT.format("${prefix}/../../lib/acme_rover_bringup")},
    {**_FILES, "hooks/rover.dsv.in": _HOOK},
    {**_FILES, "CMakeLists.txt": _BUILD.replace("lib/${PROJECT_NAME}", "lib")},
    {**_FILES, "CMakeLists.txt": _BUILD.replace("acme_drive SHARED", "other SHARED")},
]
BAD = [
    {**_FILES, "urdf/rover.urdf": _URDF},
    {
        **_FILES,
        "urdf/rover.urdf": _URDF,
        "CMakeLists.txt": _REGISTERED,
        "hooks/rover.dsv.in": _HOOK.replace("/@PROJECT_NAME@", ""),
    },
    {
        **_FILES,
        "urdf/rover.urdf": _URDF,
        "package.xml": _EXPORT.format("${prefix}/../../lib"),
    },
    {
        **_FILES,
        "urdf/rover.urdf": _URDF,
        "CMakeLists.txt": _BUILD.replace("ARCHIVE DESTINATION lib LIBRARY ", ""),
    },
]
