"""CMakeLists.txt or setup.py builds or installs something that does not exist.

The build stops there with an error, and nothing of the package can be started. This holds for the
files and folders of `install()`, its targets, the sources of a target, the folder of
`ament_python_install_package()`, and the files of `data_files`, which takes no folders: a pattern
such as `glob("launch/*")` must not match one. colcon builds an `ament_python` package by its
setup.py, so that must exist. In a package of ROS 1, a missing file or folder is a warning: only
`catkin_make install` needs it. So is a source that `.gitignore` excludes: a script may make it
before the build. No accepted package that we checked has this fault.

A pattern, as in `glob("config/*.yaml")`, installs the files that exist; a folder that it matches
needs an entry of its own. git does not keep empty folders; `git add -f FILE` adds a file that
`.gitignore` excludes. Do not remove the entry of `.setup_assistant`: MoveIt's launch files find the
robot by it.

Fix: remove the entry, or add the file or folder, as the message says.
Source: CMake, tested: `cmake --install` ends with "cannot find" for a file or folder, `cmake` with
"Cannot find source file" or "does not exist" for a source or target; setuptools, tested: "can't
copy …: doesn't exist or not a regular file".
"""

import posixpath
import re
from collections.abc import Iterator, Sequence

from checker.base.record import Record
from checker.base.words import and_list
from checker.finding import Fix, Safety
from checker.package.git_ignored import ignored_by
from checker.package.installed import GENERATES, matched_folders
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, replace_text, rule
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
_OF_MOVEIT = ".setup_assistant"
"""A hidden file, which uploads and patterns leave out."""
_PYTHON_BUILD = ("setup.py", "setup.cfg", "pyproject.toml")
_MADE_ELSEWHERE = re.compile(r"[$<*]|^/|^[A-Za-z]:")


class _Build(Record):
    """What stops, as messages name it, and the severity where only an installation stops."""

    name: str
    when_installed: Severity | None = None


@rule("PKG009", "installs-nothing", Severity.ERROR, Concern.ROBOT)
def check(package: Package, paperwork: Paperwork, context: Context) -> Findings:
    """Look up everything that is built or installed from the package's folder."""
    stops = _build_of(package, context)
    build = paperwork.build
    if build is None:
        yield from _without_setup(package, paperwork)
        yield from _of_setup(package, stops)
        return
    yield from _unknown_targets(build, stops)
    yield from _missing_sources(package, build, stops)
    yield from _missing_modules(package, build, stops)
    for install, items in _missing_items(package, build):
        yield _of_install(package, install, items, stops)


def _build_of(package: Package, context: Context) -> _Build:
    build_type = package.build_type or ""
    if context.distro or build_type.startswith(("ament_", "cmake")):
        return _Build("colcon build")
    # The challenge installs the packages; others of ROS 1 are run from the folder of the sources.
    return _Build("catkin_make", None if context.is_subt else Severity.WARNING)


def _of_install(
    package: Package, install: Install, items: Sequence[Located[str]], build: _Build
) -> Finding:
    """Return the finding about what one `install()` names and the package does not have."""
    hints, kept_out = [], False
    for item in items:
        alike = _alike(package, install, item)
        ignored = ignored_by(package, item.value) if install.kind != "DIRECTORY" else ""
        of_moveit = posixpath.basename(item.value) == _OF_MOVEIT
        kept_out = kept_out or bool(ignored) or of_moveit
        if of_moveit:
            hints.append(
                "without it MoveItConfigsBuilder looks for the URDF in config/ alone: make it with "
                f"MoveIt's setup assistant, or git add -f {item.value}"
            )
        elif ignored:
            hints.append(f"{ignored} keeps it out of the repository: git add -f {item.value}")
        elif alike:
            hints.append(f"did you mean {alike[0]}?")
        elif install.kind == "DIRECTORY" and not hints:
            hints.append("git keeps no empty folders")
    names = and_list([item.value for item in items])
    what = "folder" if install.kind == "DIRECTORY" else "file"
    what, verb = (f"{what}s", "do") if len(items) > 1 else (what, "does")
    step = "catkin_make install" if build.name == "catkin_make" else build.name
    return finding(
        items[0],
        "; ".join([f"{step} stops: {what} {names} {verb} not exist", *hints]),
        severity=build.when_installed,
        related=[(item, "does not exist either") for item in items[1:]],
        fix=None if kept_out else _fix(package, install, items),
    )


def _alike(package: Package, install: Install, item: Located[str]) -> list[str]:
    """Return files whose names resemble a missing one's, without those that are installed too.

    For a folder, return those of its name one level further down.
    """
    path = posixpath.normpath(item.value)
    others = {posixpath.normpath(each.value) for each in install.items}
    is_folder = install.kind == "DIRECTORY"
    names = _further_down(package, path) if is_folder else package.index.similar_files(path)
    return [name for name in names if name not in others]


def _further_down(package: Package, path: str) -> Iterator[str]:
    above, name = posixpath.split(path)
    for entry in package.index.entries.values():
        folder, own = posixpath.split(entry.path)
        if own == name and folder and posixpath.dirname(folder) == above and entry.is_folder:
            yield entry.path


def _without_setup(package: Package, paperwork: Paperwork) -> Iterator[Finding]:
    """Report a package that setup.py builds, and that has none."""
    build_type = paperwork.manifest.build_type if paperwork.manifest is not None else None
    if build_type is None or build_type.value != "ament_python":
        return
    if not any(map(package.exists, _PYTHON_BUILD)):
        yield finding(
            build_type,
            "colcon build stops: ament_python builds by setup.py, which does not exist: add it",
        )


def _of_setup(package: Package, build: _Build) -> Iterator[Finding]:
    """Report files of `data_files`; a name without file may still be made before the build."""
    for entry in package.setup.data_files if package.setup is not None else ():
        for item in entry.files:
            path = posixpath.normpath(item.value)
            found = package.resolve(path)
            if path.startswith(("/", "..")) or (found is not None and found.is_file):
                continue
            state = "does not exist" if found is None else "is a folder: data_files takes files"
            yield finding(item, f"{build.name} stops: {item.value} {state}")
        for pattern in entry.patterns:
            if folder := next(matched_folders(pattern, package.index), ""):
                yield finding(
                    entry,
                    f"{build.name} stops: glob({pattern.text!r}) matches the folder {folder}, and "
                    "data_files takes files: match their names, such as '*.py'",
                )


def _unknown_targets(build: CMakeFile, stops: _Build) -> Iterator[Finding]:
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
                message = f"{stops.name} stops: target {item.value} is installed, nothing builds it"
                yield finding(item, message)


def _missing_sources(package: Package, build: CMakeFile, stops: _Build) -> Iterator[Finding]:
    if GENERATES.search(build.source.text):
        return
    for call in _targets(build):
        for word in call.arguments[1:] if not call.conditional else ():
            is_source = _SOURCE.search(word.value) and not _MADE_ELSEWHERE.search(word.value)
            if is_source and not package.exists(posixpath.normpath(word.value)):
                target = call.arguments[0].value
                message = f"{stops.name} stops: {word.value}, a source of {target}, does not exist"
                if ignored := ignored_by(package, word.value):
                    made = f", unless it is made before the build: {ignored} keeps it out of git"
                    yield finding(word, message + made, severity=Severity.WARNING)
                else:
                    yield finding(word, message)


def _targets(build: CMakeFile) -> Iterator[Call]:
    calls = build.calls_of(*_BUILDS, *(f"ament_auto_{name}" for name in _BUILDS))
    return (call for call in calls if call.arguments)


def _missing_modules(package: Package, build: CMakeFile, stops: _Build) -> Iterator[Finding]:
    for call in build.calls_of("ament_python_install_package"):
        names = [word.value for word in call.arguments]
        if not names or call.conditional:
            continue
        where = names.index("PACKAGE_DIR") + 1 if "PACKAGE_DIR" in names[:-1] else 0
        folder = call.arguments[where]
        path = posixpath.normpath(folder.value)
        is_own = path == "." or package.exists(path)
        if not is_own and not _MADE_ELSEWHERE.search(folder.value):
            yield finding(folder, f"{stops.name} stops: folder {folder.value} does not exist")


def _fix(package: Package, install: Install, items: Sequence[Located[str]]) -> Fix | None:
    """Return the fix that corrects or removes names, with `install()` if nothing is left."""
    if not all(map(install.writes, items)):
        return None
    meant = [_meant(item, _alike(package, install, item)) for item in items]
    left = any(meant) or len(items) < len(install.items)
    if not left:
        return replace_text(with_blanks(install.span), "")
    edits = (
        item.span.replacement(name if _UNQUOTED.fullmatch(name) else f'"{name}"')
        if name
        else with_blanks(item.span).replacement("")
        for item, name in zip(items, meant, strict=True)
    )
    return Fix(Safety.SAFE, tuple(edits))


def _meant(item: Located[str], alike: Sequence[str]) -> str:
    """Return the one name that can be meant; empty without one."""
    same = [name for name in alike if name.lower() == posixpath.normpath(item.value).lower()]
    meant = next((names[0] for names in (same, alike) if len(names) == 1), "")
    # Behind a slash CMake installs what the folder contains.
    return f"{meant}/" if meant and item.value.endswith("/") else meant


def _missing_items(
    package: Package, build: CMakeFile
) -> Iterator[tuple[Install, list[Located[str]]]]:
    """Yield each `install()` with what certainly comes from the source folder and is missing."""
    for install in build.installs:
        if install.kind == "TARGETS" or install.conditional:
            continue
        if _OPTIONAL.search(install.span.text) is not None:
            continue
        missing = [
            item
            for item in install.items
            if item.value
            and _MADE_ELSEWHERE.search(item.value) is None
            and (path := posixpath.normpath(item.value.rstrip("/") or ".")) != "."
            and not package.exists(path)
        ]
        if missing:
            yield install, missing


_INSTALL = """project(acme_rover_sensor_config_1)
install(DIRECTORY launch/ urdf
  ./worlds
  ${CMAKE_CURRENT_SOURCE_DIR}/thumbnails
  DESTINATION share)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/ ./ DESTINATION share)
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
    {
        "CMakeLists.txt": _INSTALL
        + 'ament_python_install_package(acme PACKAGE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")\n',
        "__init__.py": "",
    },
    {"CMakeLists.txt": None, "setup.py": _SETUP},
    {
        "CMakeLists.txt": None,
        "setup.py": _SETUP.replace("none/*", "parts/*.urdf"),
        "parts/a.urdf": "",
        "parts/more/a.txt": "",
    },
    # CMake builds it: setup.py is for catkin.
    {"setup.py": _SETUP.replace("spawner", "none")},
    {"CMakeLists.txt": f"{_INSTALL}install(FILES notes.md DESTINATION share OPTIONAL)\n"},
    {"CMakeLists.txt": f"{_INSTALL}install(FILES ${{CMAKE_BINARY_DIR}}/made.txt DESTINATION x)\n"},
]
_AMENT = """<package format="3"><name>acme_arm</name><version>1.0.0</version>
<export><build_type>ament_cmake</build_type></export></package>
"""
_MAPS = """project(acme_arm)
install(FILES maps/hall.pgm  # ^ PKG009
  maps/hall.yaml DESTINATION share/acme_arm)
install(DIRECTORY foo bar DESTINATION share/acme_arm)  # ^ PKG009
"""

BAD = [
    {
        "package.xml": _AMENT,
        "CMakeLists.txt": _MAPS,
        "maps/hall.yaml": "image: hall.pgm",
        ".gitignore": "*.pgm",
    },
    {"CMakeLists.txt": f"{_TARGETS}install(TARGETS other RUNTIME DESTINATION bin)  # ^ PKG009\n"},
    {"CMakeLists.txt": f"{_INSTALL}add_library(driver SHARED src/driver.cpp)  # ^ PKG009\n"},
    {"CMakeLists.txt": f"{_INSTALL}ament_python_install_package(driver)  # ^ PKG009\n"},
    {"CMakeLists.txt": None, "setup.py": _SETUP.replace('spawner.rb"]),', 'x.rb"]),  # ^ PKG009')},
    {
        "CMakeLists.txt": None,
        "setup.py": _SETUP.replace('none/*")),', 'parts/*")),  # ^ PKG009'),
        "parts/a.urdf": "",
        "parts/more/a.txt": "",
    },
    {
        "CMakeLists.txt": None,
        "package.xml": _AMENT.replace("ament_cmake", "ament_python").replace(
            "</build_type>", "</build_type>  <!-- ^ PKG009 -->"
        ),
    },
    {"CMakeLists.txt": None, "setup.py": _SETUP.replace('/spawner.rb"]),', '"]),  # ^ PKG009')},
    {"CMakeLists.txt": _INSTALL.replace("urdf", "urdf meshes  # ^ PKG009")},
    {"CMakeLists.txt": f"{_INSTALL}install(FILES Model.sdf DESTINATION share)  # ^ PKG009\n"},
    {
        "CMakeLists.txt": f"{_INSTALL}install(FILES .setup_assistant DESTINATION x)  # ^ PKG009\n",
    },
    # No file represents a folder.
    {"CMakeLists.txt": f"{_INSTALL}install(DIRECTORY model DESTINATION share)  # ^ PKG009\n"},
]
