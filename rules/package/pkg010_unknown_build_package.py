"""CMake requires a package that the target does not have.

`find_package(… REQUIRED)` for a library that is not installed, or only in another version, stops
the build of the whole workspace. The rule assumes that declared dependencies in package.xml, and
packages in the package or its workspace, are available. No accepted package that we checked has
this fault.

Fix: remove the call if the package is not used; require the version that the release has; or
declare the dependency in package.xml, so that it is installed.
Source: general knowledge of Ignition Dome, Gazebo Harmonic and ROS Melodic, not compared with their
package lists; REP 149 for declared dependencies.
"""

import re
from collections.abc import Iterator

from checker.base.resources import table
from checker.base.words import Suggestions
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.cmake import CMakeFile
from checker.source.text import Located

_VERSION = re.compile(r"(?<!\d)\d+\Z")
_REQUIRED = {"REQUIRED", "COMPONENTS"}


@rule("PKG010", "unknown-build-package", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork, context: Context) -> Findings:
    """Look up required packages in the list of the release."""
    known = table("build_packages")["releases"].get(context.release)
    if paperwork.build is None or known is None:
        return
    available = {*table("build_packages")["any_release"], *known["packages"]}
    lower = {name.casefold() for name in available}
    for needed in _required_packages(paperwork.build):
        if needed.value.casefold() in lower or _brought(package, paperwork, needed.value):
            continue
        stem = _VERSION.sub("", needed.value)
        other = next((name for name in available if _VERSION.sub("", name) == stem != name), None)
        hint = f"; it has {other}" if other else ""
        yield finding(needed, f"{known['title']} has no package {needed.value}{hint}")
    suggestions = Suggestions(sorted(available))
    for component in _components(paperwork.build):
        if component.value.casefold() in lower or _brought(package, paperwork, component.value):
            continue
        # Few of the packages of ROS are in the list: what resembles none of them may exist.
        if meant := suggestions.closest(component.value):
            yield finding(
                component,
                f"catkin has no component {component.value}; did you mean {meant}?",
            )


def _required_packages(build: CMakeFile) -> Iterator[Located[str]]:
    for call in build.find_packages:
        values = [word.value for word in call.arguments]
        if not call.conditional and "$" not in values[0] and _REQUIRED.intersection(values):
            yield call.arguments[0]


def _components(build: CMakeFile) -> Iterator[Located[str]]:
    """Yield the components of catkin: each is a package."""
    for call in build.find_packages:
        if call.conditional or call.arguments[0].value != "catkin":
            continue
        names = [word.value for word in call.arguments]
        behind = names.index("COMPONENTS") + 1 if "COMPONENTS" in names else len(names)
        yield from (word for word in call.arguments[behind:] if word.value.islower())


def _brought(package: Package, paperwork: Paperwork, name: str) -> bool:
    manifest = paperwork.manifest
    if manifest is not None and manifest.depends_on(name):
        return True
    module = f"find{name}.cmake".casefold()
    files = package.index.with_suffix(".cmake")
    return any(file.path.rpartition("/")[2].casefold() == module for file in files) or (
        package.workspace.package(name) is not None
    )


_PROJECT = "project(acme_rover_sensor_config_1)\n"

GOOD = [
    {"CMakeLists.txt": f"{_PROJECT}find_package(catkin REQUIRED COMPONENTS roscpp)\n"},
    {"CMakeLists.txt": f"{_PROJECT}find_package(catkin REQUIRED COMPONENTS grid_map_core)\n"},
    {"CMakeLists.txt": f"{_PROJECT}find_package(ignition-gazebo4 REQUIRED)\n"},
    {"CMakeLists.txt": f"{_PROJECT}find_package(rover_magic QUIET)\n"},
]
BAD = [
    {"CMakeLists.txt": f"{_PROJECT}find_package(rover_magic REQUIRED)  # ^ PKG010\n"},
    {"CMakeLists.txt": f"{_PROJECT}find_package(ignition-gazebo3 REQUIRED)  # ^ PKG010\n"},
    {
        "CMakeLists.txt": _PROJECT
        + "find_package(catkin REQUIRED COMPONENTS roslanch)  # ^ PKG010\n"
    },
]
