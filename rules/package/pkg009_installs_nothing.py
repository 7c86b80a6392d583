"""CMakeLists.txt installs a file or folder that does not exist.

The installation stops there with an error, and what follows is not installed. None of the accepted
packages that we checked shows this.

Fix: remove the entry from `install()`, or add the file or folder.
Source: CMake, tested: `cmake --install` ends with "cannot find" for a file or folder.
"""

import posixpath
import re
from collections.abc import Iterator, Sequence

from checker.finding import Fix
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule
from checker.source.cmake import CMakeFile, Install
from checker.source.text import Located
from checker.source.xml_insertion import with_blanks

_UNQUOTED = re.compile(r"[\w./+-]+")
_OPTIONAL = re.compile(r"\bOPTIONAL\b")
_MADE_ELSEWHERE = re.compile(r"[$<*]|^/|^[A-Za-z]:")


@rule("PKG009", "installs-nothing", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Look up everything that is installed from the package's folder."""
    build = paperwork.build
    if build is None:
        return
    for install, item in _items(build):
        path = posixpath.normpath(item.value.rstrip("/") or ".")
        if package.exists(path):
            continue
        is_folder = install.kind == "DIRECTORY"
        alike = [] if is_folder else [name for name in package.index.similar(path) if name != path]
        what = "folder" if is_folder else "file"
        yield finding(
            item,
            f"{what} {item.value} is installed, but does not exist"
            + (f"; did you mean {alike[0]}?" if alike else ""),
            fix=_fix(package, install, item, alike),
        )


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

GOOD = [
    {"CMakeLists.txt": f"{_INSTALL}install(FILES notes.md DESTINATION share OPTIONAL)\n"},
    {"CMakeLists.txt": f"{_INSTALL}install(FILES ${{CMAKE_BINARY_DIR}}/made.txt DESTINATION x)\n"},
]
BAD = [
    {"CMakeLists.txt": _INSTALL.replace("urdf", "urdf meshes  # ^ PKG009")},
    {"CMakeLists.txt": f"{_INSTALL}install(FILES Model.sdf DESTINATION share)  # ^ PKG009\n"},
    # No file stands for a folder.
    {"CMakeLists.txt": f"{_INSTALL}install(DIRECTORY model DESTINATION share)  # ^ PKG009\n"},
]
