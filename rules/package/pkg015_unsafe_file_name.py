"""A file name that other machines may not find.

URIs, CMake lists and shell commands break at spaces. Systems encode letters outside ASCII
differently. Of two names that differ only in case, Windows and macOS keep one. No accepted package
that we checked has this fault. GIF files, films and documents are not judged: no simulator reads
them. A picture is an info, unless it is in a folder of models or maps: it is a screenshot. In a
folder such as `third_party/asio`, with a licence or a manifest of its own, this is an info; so it
is in a package of a released repository, copied beside the user's own packages, that none of these
uses. REF002, PKG004 or PKG009 report a reference that differs from its file only in case.

Fix: use only ASCII letters, digits, `_`, `-` and `.` in the name, and correct the references to it.
Source: common practice with CMake lists, URIs and archives made on Windows and macOS.
"""

import posixpath
import re
from collections import defaultdict
from collections.abc import Iterator

from checker.package.index import FileEntry
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.target import package_around
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

_READ_BY_PEOPLE = (
    *(".gif", ".mp4", ".mov", ".webm", ".avi"),
    *(".md", ".pdf", ".docx", ".pptx", ".xlsx", ".odt", ".txt"),
)
_PICTURE = re.compile(
    r"(?!.*\b(materials?|textures?|mesh(es)?|models?|media|urdf|worlds?|maps?)\b)"
    r".*\.(png|jpe?g|bmp|webp)",
    re.IGNORECASE,
)
"""A picture in no folder of what a simulator or Nav2 reads."""
_VENDORED = re.compile(
    r"(.*/)?(third_?party|3rd_?party|externals?|extern|vendor(ed)?|libs?|deps)/.*", re.IGNORECASE
)
_OF_ITS_OWN = re.compile(
    r"(licen[cs]e|copying)([._-].*)?|package\.(xml|json)|setup\.py|pyproject\.toml", re.IGNORECASE
)


@rule("PKG015", "unsafe-file-name", Severity.WARNING, Concern.PORTABILITY)
def check(package: Package) -> Findings:
    """Report names with spaces, with non-ASCII letters, or that differ only in case."""
    if package.kind is PackageKind.WORLD and package_around(package) is not None:
        return  # reported of that package
    twins: dict[str, list[FileEntry]] = defaultdict(list)
    libraries = _libraries(package)
    for path, entry in package.index.entries.items():
        twins[path.casefold()].append(entry)
        yield from _letters(package, path, _severity(path, libraries))
    for first, *others in twins.values():
        for other in others:
            if posixpath.dirname(first.path) == posixpath.dirname(other.path):
                yield finding(
                    package.place(other.path),
                    f"{other.path} and {first.path} differ only in case",
                    severity=_severity(other.path, libraries),
                    related=[(package.place(first.path), "the other name")],
                )


def _libraries(package: Package) -> tuple[str, ...]:
    """Return the folders of vendored libraries that have a licence or a manifest of their own."""
    paths = filter(_VENDORED.fullmatch, package.index.entries)
    parts = map(posixpath.split, paths)
    return tuple({f"{folder}/" for folder, name in parts if _OF_ITS_OWN.fullmatch(name)})


def _severity(path: str, libraries: tuple[str, ...]) -> Severity | None:
    is_unread = path.startswith(libraries) or _PICTURE.fullmatch(path)
    return Severity.INFO if is_unread else None


def _letters(package: Package, path: str, severity: Severity | None) -> Iterator[Finding]:
    name = posixpath.basename(path)
    if name.lower().endswith(_READ_BY_PEOPLE):
        return
    if any(letter.isspace() for letter in name):
        yield finding(
            package.place(path), f"{name!r} has a space in its name", severity=severity, key="space"
        )
    strange = sorted({letter for letter in name if not letter.isascii()})
    if strange:
        letters = " ".join(map(_shown, strange))
        yield finding(
            package.place(path),
            f"{name!r} has {letters} in its name",
            severity=severity,
            key="ASCII",
        )


def _shown(letter: str) -> str:
    """Return a letter for a message: its code if fonts have no picture of it."""
    return letter if letter.isprintable() else f"U+{ord(letter):04X}"


GOOD = [{"meshes/wheel-2.1_left.dae": "<COLLADA/>"}, {"media/first drive.gif": "GIF89a"}]
BAD = [
    {"meshes/old body.dae": "<COLLADA/>", "@reported": ["meshes/old body.dae:1"]},
    {"meshes/räder.dae": "<COLLADA/>", "@reported": ["meshes/räder.dae:1"]},
    {
        "meshes/Wheel.dae": "<COLLADA/>",
        "meshes/wheel.dae": "<COLLADA/>",
        "@reported": ["meshes/wheel.dae:1"],
    },
]
