"""A resource that CMakeLists.txt does not install.

The robot is started from the installed packages: a folder or model file that is not installed is
there on the author's machine only.

Fix: add it to `install(DIRECTORY …)` or `install(FILES …)`.
Source: catkin documentation, "Installing resources": `roslaunch` and Gazebo look for them there.
"""

from collections.abc import Iterator
from fnmatch import fnmatch

from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.paperwork import Paperwork
from checker.rule import Finding, Findings, Severity, finding, rule, unchecked
from checker.source.cmake import CMakeFile

FOLDERS = {
    "launch": Severity.ERROR,
    "meshes": Severity.ERROR,
    "materials": Severity.ERROR,
    "urdf": Severity.WARNING,
    "config": Severity.WARNING,
    "worlds": Severity.WARNING,
    "thumbnails": Severity.WARNING,
}
MODEL_FILES = ("model.sdf", "model.config")


@rule("PKG008", "resource-not-installed", Severity.ERROR)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Compare what is there with what the build file installs."""
    build = paperwork.build
    if build is None or package.kind in (PackageKind.PLUGIN, PackageKind.UNKNOWN):
        return
    if build.faults:
        yield unchecked(f"CMakeLists.txt cannot be read to its end: {build.faults[0].message}")
        return
    installed = _installed(build)
    whole = "" in installed
    for folder, severity in FOLDERS.items():
        entry = package.index.find(folder)
        if entry is None or not entry.is_folder or whole or _covers(installed, folder):
            continue
        yield _finding(build, f"folder {folder}/ is not installed", severity)
    model_files = [path for path in MODEL_FILES if package.index.find(path)]
    if model_files and not whole and not any(_covers(installed, path) for path in model_files):
        yield _finding(build, f"neither of {' and '.join(model_files)} is installed", None)


def _finding(build: CMakeFile, message: str, severity: Severity | None) -> Finding:
    where = build.installs[0].span if build.installs else build.source.whole()
    return finding(where, message, severity=severity, key=message)


def _installed(build: CMakeFile) -> set[str]:
    """Return the paths that are installed, without slashes at the end; empty for all."""
    return set(_paths(build))


def _paths(build: CMakeFile) -> Iterator[str]:
    for install in build.installs:
        if install.kind in ("DIRECTORY", "FILES", "PROGRAMS"):
            for item in install.items:
                path = item.value.removeprefix("${CMAKE_CURRENT_SOURCE_DIR}").lstrip("/")
                yield path.removeprefix("./").rstrip("/").removesuffix(".")


def _covers(installed: set[str], path: str) -> bool:
    """Say whether a path, or anything in it, is installed; what a variable hides counts."""
    return any(
        fnmatch(path, item) or item.startswith(f"{path}/") or "$" in item for item in installed
    )


GOOD = [
    {"meshes/a.dae": "<COLLADA/>", "CMakeLists.txt": "install(DIRECTORY . DESTINATION share)\n"},
]
BAD = [
    {
        "meshes/a.dae": "<COLLADA/>",
        "CMakeLists.txt": """project(acme_rover_sensor_config_1)
install(DIRECTORY launch urdf worlds thumbnails DESTINATION share)  # ^ PKG008
install(FILES model.sdf model.config DESTINATION share)
""",
    },
    {
        "CMakeLists.txt": """project(acme_rover_sensor_config_1)
install(DIRECTORY launch urdf worlds thumbnails DESTINATION share)  # ^ PKG008
""",
    },
]
