"""Content of a CMakeLists.txt: project, packages needed, libraries built, files installed."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile

from checker.base.record import Record
from checker.source.cmake_calls import Call, evaluate
from checker.source.cmake_tokens import CMakeFault, read_commands
from checker.source.text import Located, SourceText, Span

AUTO_PACKAGE = "ament_auto_package"
_TO_SHARE = "INSTALL_TO_SHARE"
_INSTALL_KINDS = ("DIRECTORY", "FILES", "PROGRAMS", "TARGETS")
_KEYWORDS = {
    *("DESTINATION", "TYPE", "PERMISSIONS", "FILE_PERMISSIONS", "DIRECTORY_PERMISSIONS"),
    *("USE_SOURCE_PERMISSIONS", "OPTIONAL", "CONFIGURATIONS", "COMPONENT", "EXCLUDE_FROM_ALL"),
    *("FILES_MATCHING", "PATTERN", "REGEX", "RENAME", "MESSAGE_NEVER", "ARCHIVE", "LIBRARY"),
    *("RUNTIME", "EXPORT", "INCLUDES", "PUBLIC_HEADER", "PRIVATE_HEADER", "RESOURCE"),
}


class Install(Record, eq=False):
    """An `install()`.

    Attributes:
        kind: `DIRECTORY`, `FILES`, `PROGRAMS` or `TARGETS`.
        items: What is installed; a directory ending in `/` is installed without its own name.
        destination: The first `DESTINATION`; empty if there is none.
        filtered: Whether patterns pick or leave out files of a directory.
        conditional: Whether it may not happen.
        span: The whole call.
    """

    kind: str
    items: tuple[Located[str], ...]
    destination: str
    filtered: bool
    conditional: bool
    span: Span

    def writes(self, item: Located[str]) -> bool:
        """Return whether an item is literally in the call, not in a variable or a loop."""
        inside = self.span.start <= item.span.start and item.span.end <= self.span.end
        same = item.span.text.strip('"') == item.value
        return same and inside and item.span.source is self.span.source


class Library(Record, eq=False):
    """An `add_library()`: the target builds `lib<name>.so`."""

    name: Located[str]
    sources: tuple[Located[str], ...]
    conditional: bool


class CMakeFile(Record, eq=False):
    """A CMakeLists.txt.

    Attributes:
        source: The file.
        calls: Every call in order, loops unrolled.
        faults: What is wrong with its syntax; CMake stops there, and what follows is not read.
    """

    source: SourceText
    calls: tuple[Call, ...]
    faults: tuple[CMakeFault, ...]

    def calls_of(self, *names: str) -> Iterator[Call]:
        """Yield the calls of some commands."""
        return (call for call in self.calls if call.name in names)

    @property
    def project(self) -> Located[str] | None:
        """Name in `project()`."""
        return next(
            (call.arguments[0] for call in self.calls_of("project") if call.arguments), None
        )

    @property
    def find_packages(self) -> tuple[Call, ...]:
        """Calls of `find_package` and `ign_find_package`; the first argument is the package."""
        wanted = ("find_package", "ign_find_package", "gz_find_package")
        return tuple(call for call in self.calls_of(*wanted) if call.arguments)

    @property
    def libraries(self) -> tuple[Library, ...]:
        """Targets of `add_library()`."""
        return tuple(
            Library(call.arguments[0], call.arguments[1:], call.conditional)
            for call in self.calls_of("add_library")
            if call.arguments
        )

    @property
    def installs(self) -> tuple[Install, ...]:
        """All `install()` and `catkin_install_python()` of files, directories and targets.

        The folders behind `INSTALL_TO_SHARE` of `ament_auto_package()` are among them.
        """
        calls = self.calls_of("install", "catkin_install_python", AUTO_PACKAGE)
        name = self.project.value if self.project is not None else ""
        return tuple(install for call in calls if (install := _install(call, name)))

    def library_destinations(self, name: str) -> Iterator[str]:
        """Yield where a library is installed, below the prefix: `lib`; may hold a variable."""
        for call in self.calls_of("install"):
            words = [word.value for word in call.arguments]
            items = list(takewhile(lambda word: word not in _KEYWORDS, words[1:]))
            if words[:1] == ["TARGETS"] and name in items:
                behind = words[words.index("LIBRARY") :] if "LIBRARY" in words else words
                of_others = behind is words and not {"ARCHIVE", "RUNTIME"}.isdisjoint(words)
                if "DESTINATION" in behind[:-1] and not of_others:
                    yield behind[behind.index("DESTINATION") + 1]


def read_cmake(source: SourceText) -> CMakeFile:
    """Read a CMakeLists.txt."""
    faults: list[CMakeFault] = []
    calls = evaluate(list(read_commands(source, faults)), faults)
    return CMakeFile(source, calls, tuple(faults))


def _install(call: Call, project: str) -> Install | None:
    words = call.arguments
    if call.name == AUTO_PACKAGE:
        return _to_share(call, project)
    if not words or words[0].value not in _INSTALL_KINDS:
        return None
    values = [word.value for word in words]
    items = []
    for word in words[1:]:
        if word.value in _KEYWORDS:
            break
        items.append(word)
    where = values.index("DESTINATION") + 1 if "DESTINATION" in values else len(values)
    destination = values[where] if where < len(values) else ""
    filtered = not {"FILES_MATCHING", "PATTERN", "REGEX"}.isdisjoint(values)
    return Install(values[0], tuple(items), destination, filtered, call.conditional, call.span)


def _to_share(call: Call, project: str) -> Install | None:
    """Return the folders that ament_auto installs under their own names."""
    values = [word.value for word in call.arguments]
    if _TO_SHARE not in values:
        return None
    items = []
    for word in call.arguments[values.index(_TO_SHARE) + 1 :]:
        if word.value.isupper():
            break
        items.append(word)
    where = f"share/{project}"
    return Install("DIRECTORY", tuple(items), where, False, call.conditional, call.span)
