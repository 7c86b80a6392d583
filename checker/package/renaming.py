"""Another name for a package: in all of its files, or in none."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator

from checker.base.files import NotReadable
from checker.finding import Edit, Fix, Safety
from checker.package.package import Package
from checker.source.text import SourceText, Span

_VALID = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:[_-][A-Za-z0-9]+)*")
_WORD = re.compile(r"[\w-]+")
TEXTS = (
    *(".xml", ".config", ".sdf", ".world", ".urdf", ".xacro", ".launch", ".rb", ".ign", ".py"),
    *(".txt", ".md", ".rst", ".yaml", ".yml", ".rviz", ".cfg", ".ini", ".sh", ".cmake"),
)
"""Files whose text can name a package and is changed."""
_LIMIT = 50_000_000
"""Greatest size of a file, bytes; the mentions of a larger one are unknown."""
# What is in front of a name that can mean nothing but a package.
_OF_PACKAGE = re.compile(
    r"(?:\$\(\s*(?:find|find-pkg-share|find-pkg-prefix|dirname)\s+|(?:package|model)://"
    r"|\b(?:rospack|catkin_find|ros2 pkg prefix)\s+(?:find\s+)?|\b(?:roslaunch|rosrun)\s+"
    r"|\b(?:pkg|package)\s*=\s*['\"]|\bproject\s*\(\s*\"?|\bshare/|submitted_models/|\.\./"
    r"|(?:get_package_share_directory|get_package_share_path|FindPackageShare)\(\s*['\"])\Z",
    re.IGNORECASE,
)
_LOOK_BACK = 60


def is_package_name(name: str) -> bool:
    """Return whether a name can be that of a package: words of letters and digits."""
    return _VALID.fullmatch(name) is not None


def package_renamed(package: Package, old: str, new: str) -> Fix | None:
    """Return the fix that names a package otherwise, wherever its files mention the name.

    None if a mention would be left over or lost: in the name of a file, in a longer name, in a
    file that is not text, in a sibling package; if another package has one of the names; and
    where a plain word such as `rover` represents something else too.

    Args:
        package: The package.
        old: The name that is mentioned.
        new: The name that takes its place.
    """
    if not is_package_name(old) or not is_package_name(new) or _is_used_beside(package, old):
        return None
    edits: list[Edit] = []
    for file in package.index.entries.values():
        if old.lower() in file.path.lower():
            return None
        found = _edits(package, file.path, old, new) if file.is_file else ()
        if found is None:
            return None
        edits += found
    return Fix(Safety.UNSAFE, tuple(edits)) if edits else None


def _edits(package: Package, path: str, old: str, new: str) -> tuple[Edit, ...] | None:
    """Return the edits of a file, none if it does not mention the name; None if it cannot."""
    data = package.read_bytes(path, _LIMIT)
    if isinstance(data, NotReadable):
        return None
    source = package.read(path) if path.lower().endswith(TEXTS) else None
    if not isinstance(source, SourceText):
        return None if old.lower().encode() in data.lower() else ()
    # On Fuel and to the SubT launcher, packages are called in upper case.
    instead = {old: new, old.upper(): new.upper()}
    edits = []
    for word in _words_with(source.text, old):
        written = word.group()
        if written in (new, new.upper()):
            continue
        if written not in instead or not _means_package(source, word.start(), old):
            return None
        edits.append(Span(source, *word.span()).replacement(instead[written]))
    return tuple(edits)


def _words_with(text: str, name: str) -> Iterator[re.Match[str]]:
    """Yield the words that a name is, or is a part of, in any case."""
    low = name.lower()
    if low in text.lower():
        yield from (word for word in _WORD.finditer(text) if low in word.group().lower())


def _means_package(source: SourceText, start: int, name: str) -> bool:
    """Return whether a mention is of the package: by its form, or by `_` or `-` in the name."""
    if "_" in name or "-" in name:
        return True
    before = source.text[max(0, start - _LOOK_BACK) : start]
    within = before.rpartition("<")[2]
    named = source.file == "package.xml" and within.partition(">")[0].endswith(("name", "depend"))
    return named or _OF_PACKAGE.search(before) is not None


def _is_used_beside(package: Package, name: str) -> bool:
    """Return whether a sibling has the name or mentions it."""
    named = (name in (other.root.name, other.declared_name) for other in package.other_packages)
    return any(named) or is_mentioned_beside(package, [name])


def is_mentioned_beside(package: Package, names: Collection[str]) -> bool:
    """Return whether the text of a sibling package mentions a name, or cannot be read."""
    encoded = [name.encode() for name in names]
    for other in package.other_packages:
        for file in other.index.with_suffix(*TEXTS):
            data = other.read_bytes(file.path, _LIMIT)
            if isinstance(data, NotReadable) or any(name in data for name in encoded):
                return True
    return False


def leaves_mentions(package: Package, names: Collection[str], edits: Iterable[Edit]) -> bool:
    """Return whether a text of the package would still mention a name after some edits."""
    originals: dict[str, list[str]] = {}
    for edit in edits:
        originals.setdefault(edit.place.file, []).append(edit.original)
    for file in package.index.with_suffix(*TEXTS):
        source = package.read(file.path)
        text = source.text if isinstance(source, SourceText) else ""
        edited = originals.get(file.path, [])
        for name in names:
            if text.count(name) > sum(each.count(name) for each in edited):
                return True
    return False
