"""CMakeLists.txt or setup.py builds or installs something that does not exist.

The build stops there with an error, and the rest is not installed. This holds for the files and
folders of `install()`, its targets, the sources of a target, the folder of
`ament_python_install_package()`, and the files of `data_files`, which takes no folders. No accepted
package that we checked has this fault.

Fix: remove the entry, or add the file or folder; a pattern, as in `glob("config/*")`, installs the
files that exist. git does not keep empty folders.
Source: CMake, tested: `cmake --install` ends with "cannot find" for a file or folder, `cmake` with
"Cannot find source file" or "does not exist" for a source or target; setuptools, tested: "can't
copy …: doesn't exist or not a regular file".
"""

import posixpath
import re
from collections.abc import Iterator, Sequence

from checker.finding import Fix
from checker.package.installed import GENERATES
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, replace_text, rule
from checker.source.cmake import CMakeFile, Install
from checker.source.cmake_calls import Call
from checker.source.text import Located
from checker.source.xml_insertion import with_blanks

_UNQUOTED = re.compile(r"[\w./+-]+")
_OPTIONAL = re.compile(r"\bOPTIONAL\b")
_BUILDS = ("add_executable", "add_library")
_SOURCE = re.compile(r"\.(?:c|cc|cpp|cxx)\Z", re.IGNORECASE)
_USES = re.compile(
    r"install|target_\w+|set_target_properties|set_property|add_dependencies|ament_target_\w+"
    r"|ament_export_\w+|message"
)
"""Commands that name a target and do not make it."""
_MADE_ELSEWHERE = re.compile(r"[$<*]|^/|^[A-Za-z]:")


@rule("PKG009", "installs-nothing", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Look up everything that is built or installed from the package's folder."""
    build = paperwork.build
    if build is None:
        yield from _of_setup(package)
        return
    yield from _unknown_targets(build)
    yield from _missing_sources(package, build)
    yield from _missing_modules(package, build)
    for install, item in _items(build):
        path = posixpath.normpath(item.value.rstrip("/") or ".")
        if package.exists(path):
            continue
        is_folder = install.kind == "DIRECTORY"
        alike = (
            []
            if is_folder
            else [name for name in package.index.similar_files(path) if name != path]
        )
        what = "folder" if is_folder else "file"
        yield finding(
            item,
            f"{what} {item.value} is installed, but does not exist"
            + (f"; did you mean {alike[0]}?" if alike else ""),
            fix=_fix(package, install, item, alike),
        )


def _of_setup(package: Package) -> Iterator[Finding]:
    """Report files of `data_files`; a name without file may still be made before the build."""
    for entry in package.setup.data_files if package.setup is not None else ():
        for item in entry.files:
            path = posixpath.normpath(item.value)
            found = package.resolve(path)
            if path.startswith(("/", "..")) or (found is not None and found.is_file):
                continue
            state = "does not exist" if found is None else "is a folder: data_files takes files"
            yield finding(item, f"{item.value} is installed, but {state}")


def _unknown_targets(build: CMakeFile) -> Iterator[Finding]:
    """Report installed targets that no command names that may make them."""
    made = {
        word.value
        for call in build.calls
        if not _USES.fullmatch(call.name)
        for word in call.arguments
    }
    computed = any("$" in library.arguments[0].value for library in _targets(build))
    if build.faults or computed or any(build.calls_of("include", "add_subdirectory")):
        return
    for install in build.installs:
        for item in install.items if install.kind == "TARGETS" and not install.conditional else ():
            if "$" not in item.value and item.value not in made:
                yield finding(item, f"target {item.value} is installed, but nothing builds it")


def _missing_sources(package: Package, build: CMakeFile) -> Iterator[Finding]:
    if GENERATES.search(build.source.text):
        return
    for call in _targets(build):
        for word in call.arguments[1:] if not call.conditional else ():
            is_source = _SOURCE.search(word.value) and not _MADE_ELSEWHERE.search(word.value)
            if is_source and not package.exists(posixpath.normpath(word.value)):
                target = call.arguments[0].value
                yield finding(word, f"{word.value} does not exist, but {target} is built from it")


def _targets(build: CMakeFile) -> Iterator[Call]:
    calls = build.calls_of(*_BUILDS, *(f"ament_auto_{name}" for name in _BUILDS))
    return (call for call in calls if call.arguments)


def _missing_modules(package: Package, build: CMakeFile) -> Iterator[Finding]:
    for call in build.calls_of("ament_python_install_package"):
        names = [word.value for word in call.arguments]
        if not names or call.conditional:
            continue
        where = names.index("PACKAGE_DIR") + 1 if "PACKAGE_DIR" in names[:-1] else 0
        folder = call.arguments[where]
        if not _MADE_ELSEWHERE.search(folder.value) and not package.exists(folder.value):
            yield finding(folder, f"folder {folder.value} is installed, but does not exist")


def _fix(
    package: Package, install: Install, item: Located[str], alike: Sequence[str]
) -> Fix | None:
    """Return the fix that corrects the name or removes it, with `install()` if nothing is left."""
    if not install.writes(item):
        return None
    same = [name for name in alike if name.lower() == posixpath.normpath(item.value).lower()]
    for meant in (same, alike):
        if len(meant) == 1:
            name = meant[0]
            return replace_text(item, name if _UNQUOTED.fullmatch(name) else f'"{name}"')
    there = any(package.exists(posixpath.normpath(source.value or ".")) for source in install.items)
    unsure = any(_MADE_ELSEWHERE.search(source.value) for source in install.items)
    return replace_text(with_blanks(item.span if there or unsure else install.span), "")


def _items(build: CMakeFile) -> Iterator[tuple[Install, Located[str]]]:
    """Yield what certainly comes from the source folder and must exist."""
    for install in build.installs:
        if install.kind == "TARGETS" or install.conditional:
            continue
        if _OPTIONAL.search(install.span.text) is None:
            for item in install.items:
                if item.value and _MADE_ELSEWHERE.search(item.value) is None:
                    yield install, item


_INSTALL = """project(acme_rover_sensor_config_1)
install(DIRECTORY launch/ urdf
  ./worlds
  ${CMAKE_CURRENT_SOURCE_DIR}/thumbnails
  DESTINATION share)
"""

_TARGETS = """project(acme_rover_sensor_config_1)
foreach(name bumper lamp)
  add_executable(${name} launch/spawner.rb)
endforeach()
rclcpp_components_register_node(parts EXECUTABLE horn)
install(TARGETS bumper lamp horn DESTINATION lib/${PROJECT_NAME})
"""
_SETUP = """from glob import glob
from setuptools import setup
setup(name="acme_arm", data_files=[
    ("share/acme_arm", ["package.xml"]),
    ("share/acme_arm/urdf", glob("none/*")),
    ("share/acme_arm/launch", ["launch/spawner.rb"]),
])
"""

GOOD = [
    {"CMakeLists.txt": _TARGETS},
    {"CMakeLists.txt": f"{_TARGETS}install(TARGETS other RUNTIME DESTINATION bin)\ninclude(x)\n"},
    {"CMakeLists.txt": None, "setup.py": _SETUP},
    # CMake builds it: setup.py is for catkin.
    {"setup.py": _SETUP.replace("spawner", "none")},
    {"CMakeLists.txt": f"{_INSTALL}install(FILES notes.md DESTINATION share OPTIONAL)\n"},
    {"CMakeLists.txt": f"{_INSTALL}install(FILES ${{CMAKE_BINARY_DIR}}/made.txt DESTINATION x)\n"},
]
BAD = [
    {"CMakeLists.txt": f"{_TARGETS}install(TARGETS other RUNTIME DESTINATION bin)  # ^ PKG009\n"},
    {"CMakeLists.txt": f"{_INSTALL}add_library(driver SHARED src/driver.cpp)  # ^ PKG009\n"},
    {"CMakeLists.txt": f"{_INSTALL}ament_python_install_package(driver)  # ^ PKG009\n"},
    {"CMakeLists.txt": None, "setup.py": _SETUP.replace('spawner.rb"]),', 'x.rb"]),  # ^ PKG009')},
    {"CMakeLists.txt": None, "setup.py": _SETUP.replace('/spawner.rb"]),', '"]),  # ^ PKG009')},
    {"CMakeLists.txt": _INSTALL.replace("urdf", "urdf meshes  # ^ PKG009")},
    {"CMakeLists.txt": f"{_INSTALL}install(FILES Model.sdf DESTINATION share)  # ^ PKG009\n"},
    # No file represents a folder.
    {"CMakeLists.txt": f"{_INSTALL}install(DIRECTORY model DESTINATION share)  # ^ PKG009\n"},
]
