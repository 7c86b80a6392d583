"""Which plugin libraries a package ships or builds, and which packages lend it theirs."""

from __future__ import annotations

from collections.abc import Iterator

from checker.package.package import Package
from checker.package.references import Reference, ReferenceKind
from checker.record import record
from checker.source.cmake import CMakeFile, read_cmake
from checker.source.text import SourceText

_OUTPUT_NAME = "OUTPUT_NAME"


@record()
class Lenders:
    """The packages whose libraries a package can load.

    Attributes:
        at_hand: The package itself first, then what it depends on, directly or not.
        missing: Names of packages that it depends on and that are not at hand.
    """

    at_hand: tuple[Package, ...]
    missing: tuple[str, ...]

    def libraries(self) -> frozenset[str]:
        """Return the names of all libraries, without `lib` and `.so`."""
        return frozenset(name for each in self.at_hand for name in libraries_of(each))


def lenders_of(package: Package) -> Lenders:
    """Follow dependencies and loaded Ruby files through the workspace."""
    at_hand = {package.name: package}
    missing: dict[str, None] = {}
    waiting = [package]
    while waiting:
        for other in _needs(waiting.pop()):
            found = package.workspace.package(other.package_name)
            if found is None:
                missing[other.package_name] = None
            elif found.name not in at_hand:
                at_hand[found.name] = found
                waiting.append(found)
    return Lenders(tuple(at_hand.values()), tuple(missing))


def _needs(package: Package) -> Iterator[Reference]:
    yield from (each for each in package.references if each.kind is not ReferenceKind.ROSLAUNCH)
    if package.base is not None:
        yield package.base


def libraries_of(package: Package) -> Iterator[str]:
    """Yield the libraries that a package ships or that its CMake files build."""
    for file in package.index.with_suffix(".so"):
        yield file.path.rsplit("/", 1)[-1].removeprefix("lib")[: -len(".so")]
    for file in package.index.with_suffix("cmakelists.txt"):
        source = package.read(file.path)
        if isinstance(source, SourceText):
            yield from _built(read_cmake(source))


def _built(build: CMakeFile) -> Iterator[str]:
    """Yield the names of targets, and those that properties give to their files."""
    for library in build.libraries:
        yield library.name.value
    for call in build.calls_of("set_target_properties"):
        words = [word.value for word in call.arguments]
        if _OUTPUT_NAME in words[:-1]:
            yield words[words.index(_OUTPUT_NAME) + 1]
