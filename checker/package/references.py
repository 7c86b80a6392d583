"""Other packages that a package names: in its spawner's text and in its package.xml.

Text patterns find the names without evaluating any Ruby; the XML that the spawner emits is
found elsewhere.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from enum import StrEnum

from checker.base.record import Record
from checker.finding import Place
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

# A spawner's text without its comments, every other character where it was.


# `#{` interpolates, and `#` behind a character is a fragment (`a#b`), so neither is a comment.
_COMMENT_START = re.compile(r"<!--|(?<!\S)#(?!\{)|^=begin\b|^__END__$", re.MULTILINE)
_BLOCK_END = re.compile(r"^=end\b.*$", re.MULTILINE)
_NOT_LINE_END = re.compile(r"[^\r\n]")


def blank_comments(text: str) -> str:
    """Replace Ruby comments, and the XML comments inside of strings, by blanks."""
    kept: list[str] = []
    at = 0
    unclosed = False
    while start := _COMMENT_START.search(text, at):
        end = -1 if unclosed and start.group() == "<!--" else _end(text, start)
        kept.append(text[at : start.start()])
        if end < 0:
            unclosed = True
            end = start.end()
            kept.append(start.group())
        else:
            kept.append(_NOT_LINE_END.sub(" ", text[start.start() : end]))
        at = end
    return "".join([*kept, text[at:]])


def _end(text: str, start: re.Match[str]) -> int:
    """Return where a comment ends, or -1 for an XML comment that never does."""
    if start.group() == "<!--":
        end = text.find("-->", start.end())
        return end + 3 if end >= 0 else -1
    if start.group() == "#":
        end = text.find("\n", start.end())
        return end if end >= 0 else len(text)
    block_end = _BLOCK_END.search(text, start.end()) if start.group() == "=begin" else None
    return block_end.end() if block_end else len(text)


PROVIDED = frozenset({"subt_ros"})
"""Packages of the challenge itself; what their launch files bridge is known and right."""
RUN_TIME_TAGS = frozenset({"exec_depend", "run_depend", "depend"})


class ReferenceKind(StrEnum):
    """Way in which another package is named."""

    ROSLAUNCH = "roslaunch"
    REQUIRE = "require"
    LAUNCH = "launch file"
    DEPENDENCY = "dependency"


class Reference(Record):
    """One mention of a package.

    Attributes:
        package_name: The package that is named.
        kind: The kind of the reference.
        place: The place of the reference.
        file: The launch file that roslaunch starts, such as `description.launch`.
        by_sibling: Whether it is in another package's Ruby file, which the spawner loads.
    """

    package_name: str
    kind: ReferenceKind
    place: Place
    file: str = ""
    by_sibling: bool = False


# Every repetition is bounded, so that no text makes the search slow.
_ROSLAUNCH = re.compile(
    r"\broslaunch\s{1,8}(?:-\S{0,80}\s{1,8}){0,8}"
    r"(?P<package>[A-Za-z][\w-]{0,199})\s{1,8}(?P<file>[^\s<>\"'#]{1,200}\.launch)\b"
)
_REQUIRE_LINE = re.compile(r"^[^\n]*?\b(?:require_relative|require|load)\b[^\n]*", re.MULTILINE)
_SIBLING_FILE = re.compile(
    r"\.\.(?:/|['\"]\s{0,8},\s{0,8}['\"])(?P<package>[A-Za-z][\w-]{0,199})"
    r"(?:/|['\"]\s{0,8},\s{0,8}['\"])(?:launch|config)\b"
)
_ROSPACK = re.compile(r"(?:`|%x.)\s{0,8}rospack\s{1,8}find\s{1,8}(?P<package>[A-Za-z][\w-]{0,199})")


_QUOTED = re.compile(r"""["']([^"'\n]{1,300})["']""")
_COMPUTED = re.compile(r"#\{[^}\n]{0,200}\}")
_FILE_BEHIND = re.compile(r"[^\n]{0,20}?/([\w./-]{1,200}\.rb)\b")


def loaded_files(source: SourceText) -> Iterator[str]:
    """Yield the Ruby files that one loads, as paths from the package; they may not exist."""
    text, folder = blank_comments(source.text), posixpath.dirname(source.file)
    for line in _REQUIRE_LINE.finditer(text):
        written = (_COMPUTED.sub("", part) for part in _QUOTED.findall(line.group()))
        parts = [part.strip("/") for part in written if part]
        if parts:
            path = posixpath.normpath(posixpath.join(folder, *parts))
            yield path if path.endswith(".rb") else f"{path}.rb"
    for match in _ROSPACK.finditer(text):
        behind = _FILE_BEHIND.match(text, match.end())
        if behind is not None:
            yield f"../{match['package']}/{posixpath.normpath(behind.group(1))}"


def spawner_references(source: SourceText) -> Iterator[Reference]:
    """Yield the packages that a spawner names: loaded Ruby files, then roslaunch commands."""
    text = blank_comments(source.text)
    for line in _REQUIRE_LINE.finditer(text):
        for match in _SIBLING_FILE.finditer(text, line.start(), line.end()):
            yield _reference(source, match, ReferenceKind.REQUIRE)
    for match in _ROSPACK.finditer(text):
        yield _reference(source, match, ReferenceKind.REQUIRE)
    for match in _ROSLAUNCH.finditer(text):
        yield _reference(source, match, ReferenceKind.ROSLAUNCH, match["file"])


def _reference(
    source: SourceText, match: re.Match[str], kind: ReferenceKind, file: str = ""
) -> Reference:
    return Reference(match["package"], kind, source.place(*match.span("package")), file)


_URDF_FILE = re.compile(
    r"\$\(find\s{1,8}([A-Za-z][\w-]{0,199})\s{0,8}\)/"
    r"[^\s'\"]{0,300}(?:\.urdf|\.xacro|\bdescription\w{0,40}\.launch)\b"
)


def descriptions_named(launch: XmlDocument) -> Iterator[Reference]:
    """Yield the packages whose URDF files a launch file loads, or has their launch file load."""
    for element in launch.elements:
        for name in ("command", "textfile", "default", "value", "file"):
            attribute = element.attribute(name)
            match = _URDF_FILE.search(attribute.value) if attribute is not None else None
            if match is not None:
                place = (element.attribute(name) or element).span.place()
                yield Reference(match[1], ReferenceKind.LAUNCH, place, posixpath.basename(match[0]))


def dependencies(manifest: XmlDocument) -> Iterator[Reference]:
    """Yield the packages that a package.xml needs when it runs."""
    for element in manifest.root.children:
        if element.tag in RUN_TIME_TAGS and element.text.value:
            place = element.text.span.place()
            yield Reference(element.text.value, ReferenceKind.DEPENDENCY, place)
