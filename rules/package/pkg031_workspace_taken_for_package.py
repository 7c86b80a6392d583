"""A CMakeLists.txt around packages, by which colcon takes their folder for one package.

colcon looks for packages from the folder where it is called. A folder with a CMakeLists.txt and
without package.xml is a plain CMake package for it, and it looks no further below: `colcon build`
builds this one alone, and `ros2 launch` finds none of the packages inside.

The file of a catkin workspace is not reported, nor one that adds folders itself, nor a workspace
where a README or a script calls colcon with `--base-paths` or `--paths`.

Fix: remove the file, or move it and the programs that it builds into a folder of their own.
Source: colcon-recursive-crawl, which ends at a package; `colcon list`, tried.
"""

import os
import posixpath
import re

from checker.launch.ros2.package_launch import built_by_ament
from checker.package.files_above import files_above
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.cmake import read_cmake

_FILES = re.compile(
    r"\A(?:\.\./)+(?:cmakelists\.txt|package\.xml|colcon_ignore|[\w-]{1,80}\.(?:md|sh|ya?ml))\Z"
)
_TELLS_PATHS = re.compile(r"\bcolcon\b[^\n]{0,200}\s--(?:base-)?paths\b")
_ADDING = ("add_subdirectory", "catkin_workspace", "externalproject_add")
_CATKIN = "CATKIN_TOPLEVEL"


@rule("PKG031", "workspace-taken-for-package", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report the file once, for the first package that colcon does not find."""
    packages = [it for it in (package, *package.other_packages) if built_by_ament(it)]
    if not packages or package.root != min(it.root for it in packages):
        return
    above = files_above(package, _FILES)
    if any(_TELLS_PATHS.search(source.text) for sources in above for source in sources):
        return
    for sources in above:
        by_name = {posixpath.basename(source.file).lower(): source for source in sources}
        source = by_name.get("cmakelists.txt")
        if source is None or by_name.keys() & {"package.xml", "colcon_ignore"}:
            continue
        build = read_cmake(source)
        if build.project is None or _CATKIN in source.text or any(build.calls_of(*_ADDING)):
            continue
        folder = os.path.normpath(package.root / posixpath.dirname(source.file))
        below = sorted(it.declared_name for it in packages if it.root.is_relative_to(folder))
        more = f" and {len(below) - 1} more" if below[1:] else ""
        yield finding(
            build.project,
            f"colcon takes this folder for one package, {build.project.value}, and does not "
            f"find {below[0]}{more} below: remove this CMakeLists.txt, or move it into a folder of "
            "its own",
        )


_TOOL = """cmake_minimum_required(VERSION 3.16)
project(acme_tools)
add_executable(tool tool.cpp)
"""


def _above(text: str, **more: str) -> dict[str, object]:
    return {"@ros2": True, "../CMakeLists.txt": text, **more}


GOOD = [
    {"@ros2": True, "CMakeLists.txt": _TOOL},
    _above(_TOOL + "add_subdirectory(acme_arm_bringup)\n"),
    _above(_TOOL + "set(CATKIN_TOPLEVEL TRUE)\n"),
    _above("cmake_minimum_required(VERSION 3.16)\n"),
    _above(_TOOL, **{"../package.xml": "<package><name>acme_tools</name></package>"}),
    _above(_TOOL, **{"../README.md": "`colcon build --symlink-install --base-paths .`\n"}),
]
BAD = [{**_above(_TOOL), "@reported": ["../CMakeLists.txt:2"]}]
