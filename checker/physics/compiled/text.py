"""The text of a model that MuJoCo compiles: one element a line, its files beside it.

MuJoCo opens no file: each that is there goes along under a short name. For a mesh, texture or
height field that is absent a small one is written, so that the rest can be judged.
"""

from __future__ import annotations

import posixpath
from collections.abc import Mapping
from html import escape

from checker.base.record import Record
from checker.formats.mjcf.model import MjcfModel, NamedFile, read_model
from checker.package.mjcf_files import SUFFIXES
from checker.package.package import Package
from checker.source.binary_headers import LFS_POINTER
from checker.source.xml import Element

_FOLDERS = ("meshdir", "texturedir", "assetdir", "strippath")
_SUBSTITUTES: Mapping[str, Mapping[str, str]] = {
    "mesh": {"vertex": "-.01 -.01 -.01 .01 -.01 -.01 -.01 .01 -.01 -.01 -.01 .01 .01 .01 .01"},
    "texture": {"builtin": "flat", "width": "2", "height": "12"},
    "hfield": {"nrow": "2", "ncol": "2"},
}
_OF_FILES = ("file", "content_type", "gridsize", "gridlayout", "nrow", "ncol")
_ATTACHED_LIMIT = 20
"""Models that one model attaches."""
_POINTER_SIZE = 1_000
SIZE_LIMIT = 100_000_000
"""Bytes of a file."""


class MujocoText(Record, eq=False):
    """A model in the form in which MuJoCo gets it.

    Attributes:
        text: The model.
        attached: Texts of the models that it attaches, by their short names.
        lines: The element of each line of these texts, from the first line on.
        files: Paths on disk of the files that go along, by their short names.
        absent: Reasons why meshes and height fields do not go along, as clauses, by their names.
        obstacle: Why MuJoCo cannot be given the model, as a clause; empty if it can.
    """

    text: str
    attached: Mapping[str, str]
    lines: tuple[Element, ...]
    files: Mapping[str, str]
    absent: Mapping[str, str] = {}
    obstacle: str = ""

    def element(self, line: int) -> Element | None:
        """Return the element of a line; None if the line is 0 or beyond the end."""
        return self.lines[line - 1] if 0 < line <= len(self.lines) else None


class _Writer:
    def __init__(self, package: Package) -> None:
        self.package = package
        self.lines: list[Element] = []
        self.names: dict[str, str] = {}
        self.attached: dict[str, MjcfModel] = {}
        self.absent: dict[str, str] = {}
        self.obstacle = ""

    def text(self, model: MjcfModel) -> str:
        """Return the text of a model; its lines follow those of the texts before."""
        written = ["\n" * len(self.lines)]
        files: dict[int, list[NamedFile]] = {}
        for file in model.files:
            files.setdefault(id(file.element), []).append(file)
        open_tags: list[tuple[int, str]] = []
        for number, element in enumerate(model.elements):
            while open_tags and open_tags[-1][0] != model.parents[number]:
                written.append(f"</{open_tags.pop()[1]}>")
            attributes = self._attributes(element, files.get(id(element), []))
            stated = "".join(f' {name}="{_escaped(it)}"' for name, it in attributes.items())
            written.append(f"{chr(10) if number else ''}<{element.tag}{stated}>")
            self.lines.append(element)
            open_tags.append((number, element.tag))
        written += [f"</{tag}>" for _, tag in reversed(open_tags)]
        return "".join(written)

    def _attributes(self, element: Element, files: list[NamedFile]) -> Mapping[str, str]:
        stated = element.attributes
        if element.tag == "compiler":
            return {name: value for name, value in stated.items() if name not in _FOLDERS}
        if not files:
            return stated
        if absent := next(filter(None, map(self._absent, files)), ""):
            return self._substituted(element, files[0], absent)
        short = {file.attribute: self._short_name(file, element) for file in files}
        named = {} if element.tag == "model" else _default_name(files[0])
        return {**named, **stated, **short}

    def _absent(self, file: NamedFile) -> str:
        """Return why a file does not go along; empty if it does."""
        entry = self.package.resolve(file.path) if file.path else None
        if entry is None:
            return f"{file.uri.value} is missing"
        if entry.size > SIZE_LIMIT:
            return (
                f"{file.path} has {entry.size:,} bytes; only files of up to {SIZE_LIMIT:,} are read"
            )
        head = self.package.read_bytes(file.path) if entry.size < _POINTER_SIZE else b""
        if isinstance(head, bytes) and not head.startswith(LFS_POINTER):
            return ""
        return f"{file.path} is a Git LFS pointer: `git lfs pull` fetches it"

    def _substituted(self, element: Element, file: NamedFile, absent: str) -> Mapping[str, str]:
        substitute = _SUBSTITUTES.get(element.tag)
        if substitute is None:
            self.obstacle = self.obstacle or absent
            return element.attributes
        kept = {
            name: value
            for name, value in element.attributes.items()
            if name not in _OF_FILES and not name.startswith("file")
        }
        named = {**_default_name(file), **kept}
        if element.tag != "texture":
            self.absent[named["name"]] = absent
        return {**named, **substitute}

    def _short_name(self, file: NamedFile, element: Element) -> str:
        if element.tag == "model" and file.path.lower().endswith(SUFFIXES):
            return self._attached_name(file)
        entry = self.package.resolve(file.path)
        place = str(entry.location) if entry is not None else ""
        ending = posixpath.splitext(file.path)[1]
        return self.names.setdefault(place, f"f{len(self.names)}{ending}")

    def _attached_name(self, file: NamedFile) -> str:
        name = f"m{len(self.attached)}.xml"
        model = read_model(self.package, file.path)
        if isinstance(model, MjcfModel) and model.is_whole and len(self.attached) < _ATTACHED_LIMIT:
            self.attached[name] = model
        else:
            self.obstacle = self.obstacle or f"{file.path} cannot be attached"
        return name


def _escaped(value: str) -> str:
    """Return a value for between quotes, on one line."""
    return escape(" ".join(value.split("\n")))


def _default_name(file: NamedFile) -> Mapping[str, str]:
    """Return the name that MuJoCo gives an element without one: that of its file."""
    return {"name": posixpath.splitext(posixpath.basename(file.uri.value.replace("\\", "/")))[0]}


def mujoco_text(model: MjcfModel) -> MujocoText:
    """Return the text of a model and what goes along."""
    writer = _Writer(model.package)
    text, attached = writer.text(model), dict[str, str]()
    while len(attached) < len(writer.attached):
        name = next(name for name in writer.attached if name not in attached)
        attached[name] = writer.text(writer.attached[name])
    return MujocoText(
        text,
        attached,
        tuple(writer.lines),
        {name: place for place, name in writer.names.items()},
        writer.absent,
        writer.obstacle,
    )
