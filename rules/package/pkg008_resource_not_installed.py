"""A resource that CMakeLists.txt or setup.py does not install.

The robot starts from the installed packages: a folder or model file that is not installed exists
only on the author's machine. Of `config/`, `urdf/` and `worlds/` that is a warning, unless what a
launch file starts by default needs a file there. A folder with launch files of ROS 1 alone in a
package of ROS 2 is an info, and so is a `launch/` whose files are all Python without
`generate_launch_description`. Thumbnails are not needed there: they are infos. So are meshes that
no file names, such as backups in a folder `meshes/old` of those that are named. A setup.py that
computes its `data_files` is not checked; if it names each folder, that is only an info.

Fix: add it to `install(DIRECTORY …)` or `install(FILES …)`; in setup.py, to `data_files`, one entry
for each folder with the files in it: `glob("launch/*")` does not include files in subfolders.
Source: catkin documentation, "Installing resources": `roslaunch` and Gazebo look for them there;
ROS 2 documentation, "Developing a ROS 2 package": `ros2 launch` looks into the share folder.
"""

import posixpath
import re
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatch
from itertools import islice

from msgspec.structs import replace

from checker.finding import Fix
from checker.launch.ros2.graph import Ros2Launch
from checker.launch.ros2.named_paths import NamedPath, named_paths
from checker.launch.ros2.package_launch import is_left_from_ros1
from checker.package.installed import USUAL_FOLDERS, installed_as
from checker.package.kind import PackageKind
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)
from checker.source.cmake import CMakeFile, Install
from checker.source.text import SourceText, Span
from checker.source.xml_insertion import newline_of

_LESS = {
    "urdf": Severity.WARNING,
    "config": Severity.WARNING,
    "worlds": Severity.WARNING,
    "thumbnails": Severity.INFO,
}
"""Lower severities for folders without which the robot starts, unless a launch file needs one."""
_MESHES = (".dae", ".stl", ".obj", ".glb", ".gltf")
_NAMING = (".urdf", ".xacro", ".sdf", ".world", ".py", ".xml", ".launch", ".yaml", ".yml")
_CATKIN = "${CATKIN_PACKAGE_SHARE_DESTINATION}"
_PATTERN = re.compile(r"[*?\[]")
_PATTERN_LIMIT, _PATTERNS_LIMIT = 100, 100
"""Greatest length of a pattern, and greatest number of patterns: each is compiled."""
MODEL_FILES = ("model.sdf", "model.config")


@rule("PKG008", "resource-not-installed", Severity.ERROR, Concern.PAPERWORK)
def check(
    package: Package, paperwork: Paperwork, context: Context, launch: Ros2Launch | None
) -> Findings:
    """Compare the package's files with what the build file installs."""
    uses = _needed_folders(package, launch)
    if not context.distro and package.kind in (PackageKind.PLUGIN, PackageKind.UNKNOWN):
        return
    build = paperwork.build
    if build is None:
        yield from _by_setup(package, uses)
        return
    if build.faults:
        yield unchecked(f"CMakeLists.txt cannot be read completely: {build.faults[0].message}")
        return
    installed = _installed_paths(build)
    whole = "" in installed
    for folder in _filled_folders(package):
        if whole or _covers(installed, folder):
            continue
        message = f"folder {folder}/ is not installed"
        severity = None if folder in uses else _LESS.get(folder)
        fix = _install_fix(build, "DIRECTORY", [folder])
        if is_left_from_ros1(package, folder):
            message += ": it has only launch files of ROS 1; delete them, or write those of ROS 2"
            severity, fix = Severity.INFO, None
        elif reason := _needless(package, folder):
            message += reason
            severity, fix = Severity.INFO, None
        yield _finding(build, message, severity, fix, uses.get(folder))
    model_files = [path for path in MODEL_FILES if package.index.find(path)]
    if model_files and not whole and not any(_covers(installed, path) for path in model_files):
        message = f"neither of {' and '.join(model_files)} is installed"
        yield _finding(build, message, None, _install_fix(build, "FILES", model_files))
    elif MODEL_FILES[0] in model_files and not whole and not _covers(installed, MODEL_FILES[0]):
        message = f"{MODEL_FILES[0]} is not installed"
        yield _finding(build, message, None, _install_fix(build, "FILES", [MODEL_FILES[0]]))


def _filled_folders(package: Package) -> Iterator[str]:
    """Yield the usual folders with files in them: git keeps no other, and no clone installs it."""
    for folder in USUAL_FOLDERS:
        if any(file.path.startswith(f"{folder}/") for file in package.index.files):
            yield folder


def _needed_folders(package: Package, launch: Ros2Launch | None) -> dict[str, NamedPath]:
    """Return folders of which launch files need a file by default, each with the first use."""
    graphs = launch.entries if launch is not None else ()
    every = (named for graph in graphs for named in named_paths(graph) if named.needed)
    own = [it for it in every if it.path.package == package.declared_name]
    return {it.path.path.partition("/")[0]: it for it in reversed(own)}


def _by_setup(package: Package, uses: Mapping[str, NamedPath]) -> Findings:
    """Compare the package's files with `data_files` of setup.py."""
    setup = package.setup
    if setup is None:
        return
    if not setup.complete:
        text = setup.span.source.text
        named = all(folder in text for folder in _filled_folders(package))
        reason = "data_files of setup.py is computed, so what is installed is not known"
        yield replace(unchecked(reason), severity=Severity.INFO if named else None)
        return
    origins = {origin for _, origin in package.installed}
    for folder in _filled_folders(package):
        if not _covers(origins, folder):
            message = f"folder {folder}/ is not installed: data_files names no file of it"
            severity = None if folder in uses else _LESS.get(folder)
            if reason := _needless(package, folder):
                message += reason
                severity = Severity.INFO
            related = _need(uses.get(folder))
            yield finding(setup, message, severity=severity, key=message, related=related)
            continue
        left = [*_left_meshes(package, folder)]
        copies = [path for path in left if _is_unused_copy(package, path)]
        needed = [path for path in left if path not in copies]
        reason = f": data_files names other files of {folder}/"
        for paths, why, severity in (
            (needed, reason, None),
            (copies, ", and files of the same name elsewhere are used", Severity.INFO),
        ):
            if paths:
                verb = "is" if len(paths) == 1 else f"and {len(paths) - 1} more are"
                message = f"{paths[0]} {verb} not installed{why}"
                yield finding(setup, message, severity=severity, key=f"meshes of {folder}{why}")


def _left_meshes(package: Package, folder: str) -> Iterator[str]:
    """Yield the meshes of a folder whose name is in a file of the package and nothing installs."""
    for file in package.index.with_suffix(*_MESHES):
        name = posixpath.basename(file.path).casefold()
        is_used = file.path.startswith(f"{folder}/") and name in package.mentioned_names
        if is_used and not installed_as(package, file.path):
            yield file.path


def _needless(package: Package, folder: str) -> str:
    """Return why nothing needs a folder, as the end of a sentence; empty if something may."""
    if _is_unnamed(package, folder):
        return ", and no file names a mesh of it"
    if _starts_nothing(package, folder):
        return ", and no file of it has generate_launch_description"
    return ""


def _is_unnamed(package: Package, folder: str) -> bool:
    """Return whether a folder has only meshes of which no file, of any package, names one."""
    if folder != "meshes":
        return False
    paths = (file.path for file in package.index.with_suffix(*_MESHES))
    names = {posixpath.basename(it).casefold() for it in paths if it.startswith("meshes/")}
    # ".stl" alone is the end of a name that a file puts together.
    names |= {posixpath.splitext(name)[1] for name in names}
    every = (package, *package.other_packages)
    return bool(names) and all(names.isdisjoint(it.mentioned_names) for it in every)


def _starts_nothing(package: Package, folder: str) -> bool:
    """Return whether launch/ has only Python files that are not those of a launch."""
    files = [it.path for it in package.index.files if it.path.startswith(f"{folder}/")]
    sources = [package.read(path) for path in files if path.endswith(".py")]
    return (folder == "launch" and len(sources) == len(files)) and all(
        isinstance(it, SourceText) and "generate_launch_description" not in it.text
        for it in sources
    )


def _is_unused_copy(package: Package, path: str) -> bool:
    """Return whether an installed mesh has the same name, and no file names this one's folder."""
    *_, folder, name = path.split("/")
    if not any(installed_as(package, other) for other in package.index.ending(name)):
        return False
    written = [f"{before}{folder}{after}" for before in "/\"'" for after in "/\"'"]
    texts = map(package.read, (file.path for file in package.index.with_suffix(*_NAMING)))
    return not any(
        end in source.text for source in texts if isinstance(source, SourceText) for end in written
    )


def _finding(
    build: CMakeFile,
    message: str,
    severity: Severity | None,
    fix: Fix | None,
    use: NamedPath | None = None,
) -> Finding:
    where = build.installs[0].span if build.installs else build.source.whole()
    return finding(where, message, severity=severity, key=message, fix=fix, related=_need(use))


def _need(use: NamedPath | None) -> list[tuple[NamedPath, str]]:
    return [(use, "a launch file needs it here")] if use is not None else []


def _install_fix(build: CMakeFile, kind: str, paths: Sequence[str]) -> Fix | None:
    """Return the fix that installs more; None if no file is in the share folder."""
    fitting = [install for install in build.installs if _goes_to_share(install, build)]
    for install in fitting:
        last = install.items[-1]
        if install.kind == kind and not install.filtered and install.writes(last):
            before = build.source.text[install.span.start : last.span.start]
            gap = before[len(before.rstrip()) :]
            between = gap if "\n" in gap else " "
            behind = Span(build.source, last.span.end, last.span.end)
            return replace_text(behind, "".join(between + path for path in paths))
    if not fitting:
        return None
    end = fitting[-1].span.end
    end += len(build.source.text[end:].partition("\n")[0].rstrip("\r"))
    newline = newline_of(build.source, end)
    call = f"install({kind} {' '.join(paths)} DESTINATION {_destination(fitting[-1])})"
    return replace_text(Span(build.source, end, end), newline + call)


def _goes_to_share(install: Install, build: CMakeFile) -> bool:
    if install.conditional or not install.items or install.kind == "TARGETS":
        return False
    name = build.project.value if build.project is not None else ""
    return _destination(install) == _CATKIN or install.destination == f"share/{name}"


def _destination(install: Install) -> str:
    return _CATKIN if install.destination == _CATKIN else "share/${PROJECT_NAME}"


def _installed_paths(build: CMakeFile) -> set[str]:
    """Return the paths that are installed, without slashes at the end; empty for all.

    What another CMakeLists.txt in a folder installs is not known: the folder counts.
    """
    added = (call.arguments[:1] for call in build.calls_of("add_subdirectory"))
    return {*_paths(build), *(name.value.rstrip("/") for names in added for name in names)}


def _paths(build: CMakeFile) -> Iterator[str]:
    for install in build.installs:
        if install.kind in ("DIRECTORY", "FILES", "PROGRAMS"):
            for item in install.items:
                path = item.value.removeprefix("${CMAKE_CURRENT_SOURCE_DIR}").lstrip("/")
                yield path.removeprefix("./").rstrip("/").removesuffix(".")


def _covers(installed: set[str], path: str) -> bool:
    """Return whether a path, or anything in it, is installed; one in a variable counts."""
    if path in installed or any(i.startswith(f"{path}/") or "$" in i for i in installed):
        return True
    patterns = (item for item in installed if len(item) < _PATTERN_LIMIT and _PATTERN.search(item))
    return any(fnmatch(path, item) for item in islice(patterns, _PATTERNS_LIMIT))


_SETUP = """from glob import glob
from setuptools import setup
setup(name="acme_arm", data_files=[  # ^ PKG008
    ("share/acme_arm", ["package.xml"]),
    ("share/acme_arm/files", glob("*/*.none")),
])
"""
_PYTHON = """<package format="3">
  <name>acme_arm</name>
  <export><build_type>ament_python</build_type></export>
</package>
"""
GOOD = [
    {
        "CMakeLists.txt": None,
        "setup.py": _SETUP.replace("  # ^ PKG008", "").replace("*/*.none", "*/*"),
    },
    {"meshes/a.dae": "<COLLADA/>", "CMakeLists.txt": "install(DIRECTORY . DESTINATION share)\n"},
    {
        "meshes/a.dae": "<COLLADA/>",
        "meshes/CMakeLists.txt": "install(FILES a.dae DESTINATION share/${PROJECT_NAME}/meshes)\n",
        "CMakeLists.txt": "add_subdirectory(meshes)\n"
        "install(DIRECTORY launch urdf worlds thumbnails DESTINATION share)\n"
        "install(FILES model.sdf model.config DESTINATION share)\n",
    },
    # An empty folder.
    {
        "worlds/example.sdf": None,
        "CMakeLists.txt": "install(DIRECTORY launch urdf thumbnails DESTINATION share)\n"
        "install(FILES model.sdf model.config DESTINATION share)\n",
    },
    {
        # CMakeLists.txt is left from ROS 1: ament_python does not read it.
        "package.xml": _PYTHON,
        "CMakeLists.txt": "project(acme_arm)\ncatkin_package()\n",
        "setup.py": _SETUP.replace("  # ^ PKG008", "").replace("*/*.none", "*/*"),
    },
]
BAD = [
    {"CMakeLists.txt": None, "setup.py": _SETUP},
    {
        "CMakeLists.txt": None,
        "setup.py": _SETUP.replace("*/*.none", "*/*.[a-z]*"),
        "meshes/base.stl": "solid a",
        "meshes/arm.STL": "solid a",
        "README.md": "Meshes: base.stl, arm.STL",
    },
    {
        "meshes/a.dae": "<COLLADA/>",
        "CMakeLists.txt": """project(acme_rover_sensor_config_1)
install(DIRECTORY  # ^ PKG008
    launch
    urdf worlds
    thumbnails
  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(FILES model.sdf model.config DESTINATION share)
""",
    },
    {
        "CMakeLists.txt": """project(acme_rover_sensor_config_1)
install(DIRECTORY launch urdf worlds thumbnails DESTINATION share/${PROJECT_NAME})  # ^ PKG008
""",
    },
    {
        "CMakeLists.txt": """project(acme_rover_sensor_config_1)
install(DIRECTORY launch urdf worlds thumbnails DESTINATION share/${PROJECT_NAME})  # ^ PKG008
install(FILES model.config DESTINATION share/${PROJECT_NAME})
""",
    },
]
