"""Small packages for tests of the editor, and edits of their files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path

from checker.editor.names.index import NameIndex, names_of
from checker.editor.names.mention import Mention
from checker.finding import Edit
from checker.package.package import Package
from checker.package.workspace import Workspace
from checker.source.text import SourceText

NAME = "rover"
MANIFEST = "<package><name>{name}</name></package>"


def package_of(folder: Path, files: Mapping[str, str], name: str = NAME) -> Package:
    """Write a package; `../other/…` is a file of a sibling."""
    for path, text in {"package.xml": MANIFEST.format(name=name), **files}.items():
        place = (folder / name / path).resolve()
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
        if path.startswith("../"):
            manifest = folder / path.split("/")[1] / "package.xml"
            manifest.write_text(MANIFEST.format(name=manifest.parent.name))
    return Workspace((folder.resolve(),)).at((folder / name).resolve())


def texts(package: Package) -> dict[str, str]:
    """Return the texts of a package by path."""
    sources = {file.path: package.read(file.path) for file in package.index.files}
    return {path: it.text for path, it in sources.items() if isinstance(it, SourceText)}


def edited(package: Package, edits: Iterable[Edit]) -> Package:
    """Return the package with edits made in memory; each replaces what it says it does."""
    by_file: dict[str, list[Edit]] = defaultdict(list)
    for edit in edits:
        by_file[edit.place.file].append(edit)
    changed = {}
    for path, its in by_file.items():
        source = package.read(path)
        assert isinstance(source, SourceText)
        text = source.text
        stretches = []
        for edit in its:
            stretch = source.stretch_of(edit)
            assert stretch is not None, edit
            stretches.append((*stretch, edit.replacement))
        for start, end, new in sorted(stretches, reverse=True):
            text = text[:start] + new + text[end:]
        changed[path] = SourceText(path, text, encoding=source.encoding)
    return package.with_texts(changed)


def mention(index: NameIndex, kind: str, name: str, path: str = "") -> Mention:
    """Return the first mention of a thing, a definition before others."""
    found = [
        it for it in index.mentions if it.kind == kind and it.name == name and path in ("", it.path)
    ]
    assert found, f"no {kind} {name}"
    return min(found, key=lambda it: (not it.is_definition, it.path, it.start))


def places(index: NameIndex, mentions: Iterable[Mention]) -> set[tuple[str, int]]:
    """Return the lines of mentions by file."""
    return {(it.path, index.files[it.path].source.position(it.start)[0]) for it in mentions}


def renamed(package: Package, kind: str, name: str, new: str) -> dict[str, str]:
    """Return the texts of the files that change when a thing gets another name."""
    index = names_of(package)
    edits = index.rename(mention(index, kind, name), new)
    assert not isinstance(edits, str), edits
    after = edited(package, edits)
    return {path: texts(after)[path] for path in {edit.place.file for edit in edits}}


def refusal(package: Package, kind: str, name: str, new: str) -> str:
    """Return why a thing cannot have another name."""
    index = names_of(package)
    reason = index.rename(mention(index, kind, name), new)
    assert isinstance(reason, str), reason
    return reason
