"""One package: its files, read at most once, its kind, and the parts it has or inherits."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import field
from msgspec.structs import replace

from checker.base.files import NotReadable, TooLarge
from checker.base.record import Record
from checker.finding import Place
from checker.package.distribution_sign import (
    DistributionSign,
    distribution_sign,
    sign_around,
    sign_of_paths,
)
from checker.package.formats import xml_suffixes
from checker.package.index import (
    EntryKind,
    FileEntry,
    FileIndex,
    normal_path,
)
from checker.package.inheritance import (
    SHEET,
    SPAWNER,
    Found,
    Inherited,
    Missing,
    base_of,
    find_part,
    inherited_parts,
    own_sheet,
)
from checker.package.installed import data_file_items, installed_items
from checker.package.kind import PackageKind, kind_of, looks_like_package
from checker.package.mentions import has_word, mentioned_names
from checker.package.model_file import own_model
from checker.package.overlay import Overlay, OverlayText
from checker.package.references import (
    Reference,
    dependencies,
    loaded_files,
    spawner_references,
)
from checker.package.repository import Units, units_below
from checker.package.simulator_signs import simulator_signs
from checker.package.unused_model import unused_model
from checker.package.vendored import vendored_in
from checker.package.walk import build_index, entry_at
from checker.source.cmake import CMakeFile, read_cmake
from checker.source.setup_py import SetupFile, read_setup
from checker.source.text import SourceText
from checker.source.xml import (
    ATTRIBUTES_FOR_ONE,
    ELEMENTS_VARIABLE,
    XmlDocument,
    attributes_in,
    elements_in,
    elements_limit,
    parse_xml,
)
from checker.source.xml_positions import XmlFault

if TYPE_CHECKING:
    from checker.package.workspace import Workspace

_LAUNCH_FILE = re.compile(r"(?:^|/)launch/.*\.(?:py|xml|ya?ml|sh)$|[._]launch(?:\.\w+)?$")
BYTES_LIMIT = 200_000_000
DOCUMENTS_FOR_ALL = 4
"""Documents with as many elements as one may have that a package may have; the largest real package
has 5 500 elements."""
RUBY_FILES = 20
"""Greatest number of files that a spawner may load."""


class Package(Record, eq=False, dict=True):
    """A robot package.

    Paths are relative to its folder, with `/`; a sibling's file is `../<sibling>/…`.

    Attributes:
        root: Its folder, links resolved.
        workspace: The folder in which its siblings are looked up.
        only: For a single file, its name; then the index contains nothing else, and neighbours
            are looked for when a path names them.
    """

    root: Path
    workspace: Workspace
    only: str = ""
    _texts: dict[str, SourceText | NotReadable] = field(default_factory=dict)
    _documents: dict[str, XmlDocument | XmlFault | NotReadable] = field(default_factory=dict)
    _elements: dict[str, int] = field(default_factory=dict)

    def with_texts(self, texts: Mapping[str, SourceText]) -> Package:
        """Return the package as if some of its files held other texts; nothing is written."""
        added = {
            self._location(path): OverlayText(source.text, source.encoding)
            for path, source in texts.items()
        }
        overlay = Overlay({**self.workspace.overlay.texts, **added})
        return self.in_workspace(self.workspace.with_overlay(overlay))

    def in_workspace(self, workspace: Workspace) -> Package:
        """Return the package of another state of its workspace."""
        if not self.only:
            return workspace.at(self.root)
        return self.kept(workspace, self.workspace.overlay.changed_paths(workspace.overlay))

    def kept(self, workspace: Workspace, changed: Collection[Path]) -> Package:
        """Return the package in another state of its workspace, with all that was read before.

        Args:
            workspace: The other state.
            changed: Places of the files that contain another text there.
        """
        same = [path for path in self._texts if self._location(path) not in changed]
        package = Package(
            self.root,
            workspace,
            self.only,
            {path: self._texts[path] for path in same},
            {path: self._documents[path] for path in same if path in self._documents},
            {path: self._elements[path] for path in same if path in self._elements},
        )
        if (on_disk := vars(self).get("on_disk")) is not None:
            vars(package)["on_disk"] = on_disk
        return package

    def _location(self, path: str) -> Path:
        """Return the path of a file on disk, which may not exist."""
        entry = self._file(path)
        return entry.location if isinstance(entry, FileEntry) else self.root / path

    def __reduce__(self) -> tuple[Any, ...]:
        """Send a package to another process as its path."""
        return type(self.workspace).again, (self.workspace, self.root, self.only)

    @property
    def name(self) -> str:
        """The folder's name; of a single file, the file's."""
        return self.only or self.root.name

    @cached_property
    def declared_name(self) -> str:
        """The name in package.xml, under which it is installed; else the folder's."""
        manifest = self.xml("package.xml")
        name = manifest.root.child("name") if isinstance(manifest, XmlDocument) else None
        return (name.text.value if name is not None else "") or self.root.name

    def named(self, name: str) -> Package | None:
        """Return the available package of a name: this one if it has the name, else a neighbour."""
        own = name in (self.declared_name, self.root.name)
        return self if own else self.workspace.package(name)

    @property
    def other_packages(self) -> tuple[Package, ...]:
        """The other available packages; what is edited in memory is the same package."""
        packages = self.workspace.packages.values()
        return tuple(package for package in packages if package.root != self.root)

    @cached_property
    def on_disk(self) -> FileIndex:
        """All files, folders and links that are on disk."""
        if self.only:
            entry = entry_at(self.root / self.only, self.only, self.root, self.workspace.holds)
            return FileIndex({self.only: entry} if entry else {})
        return build_index(self.root, self.workspace.holds)

    @cached_property
    def index(self) -> FileIndex:
        """All files, folders and links, with what is not saved."""
        return self.workspace.overlay.indexed(self.on_disk, self.root / self.only)

    @property
    def is_loose(self) -> bool:
        """True for a folder of model files that has nothing of a package."""
        return not self.only and not looks_like_package(self.root)

    @cached_property
    def kind(self) -> PackageKind:
        """Kind of the package."""
        return kind_of(self)

    @cached_property
    def simulator_signs(self) -> Mapping[str, str]:
        """Simulators that its files name, each with the first place."""
        return simulator_signs(self)

    @cached_property
    def launch_texts(self) -> dict[str, str]:
        """The launch files of the package, comments included, by path."""
        paths = (it.path for it in self.index.files if _LAUNCH_FILE.search(it.path))
        texts = {path: self.read(path) for path in paths}
        return {path: it.text for path, it in texts.items() if isinstance(it, SourceText)}

    @cached_property
    def naming_launch_texts(self) -> dict[str, str]:
        """The launch files of the package, and those of other packages that name it."""
        name = self.declared_name
        others = self.workspace.launch_texts.items()
        return self.launch_texts | {path: text for path, text in others if has_word(text, name)}

    @cached_property
    def distribution_sign(self) -> DistributionSign | None:
        """ROS 2 distribution that its files, or those around it, name."""
        return distribution_sign(self)

    @cached_property
    def sign_of_paths(self) -> DistributionSign | None:
        """ROS 2 distribution whose folder its descriptions and scripts name."""
        return sign_of_paths(self)

    @cached_property
    def sign_around(self) -> DistributionSign | None:
        """ROS 2 distribution whose folder scripts and settings in and around it name."""
        return sign_around(self)

    @cached_property
    def vendored_in(self) -> str:
        """Folder of the copied repository that it is in; empty for the user's own packages."""
        return vendored_in(self)

    @cached_property
    def build_type(self) -> str | None:
        """The build type that package.xml states; None if it states none."""
        manifest = self.xml("package.xml")
        export = manifest.root.child("export") if isinstance(manifest, XmlDocument) else None
        build_type = export.child("build_type") if export is not None else None
        return build_type.text.value if build_type is not None else None

    @cached_property
    def is_urdf(self) -> bool:
        """True if its robot is described in URDF alone, as packages and files of ROS are."""
        if not self.only:
            return self.kind is PackageKind.URDF_DESCRIPTION
        document = self.xml(self.only)
        return isinstance(document, XmlDocument) and document.root.tag == "robot"

    @cached_property
    def unloaded_files(self) -> frozenset[str]:
        """Files that nothing loads as a robot, as the package itself states."""
        broken = (file.path for file in self.index.files if file.is_broken_for_tests)
        return frozenset(filter(None, (unused_model(self), *broken)))

    def folder_place(self) -> Place:
        """Return the place of the package as a whole, for findings about what is missing."""
        return Place("")

    def place(self, path: str) -> Place:
        """Return the place of a file or folder as a whole."""
        return Place(path)

    def path_on_disk(self, path: str) -> str:
        """Return the path to a sibling's file from the package's folder, wherever both lie."""
        name, _, rest = path.removeprefix("../").partition("/")
        sibling = self.workspace.package(name) if path.startswith("../") else None
        if sibling is None or sibling.root.parent == self.root.parent:
            return path
        return Path(os.path.relpath(sibling.root / rest, self.root)).as_posix()

    def resolve(self, path: str) -> FileEntry | None:
        """Return the file or folder at a path, or None if there is none in the workspace."""
        normal = normal_path(path)
        if normal is None:
            return None
        entry = self.index.find(normal)
        if entry is None and (self.only or self._below_link(normal)):
            entry = entry_at(self.root / normal, normal, self.root, self.workspace.holds)
        if entry is None and normal.startswith("../"):
            return self._resolve_in_sibling(normal)
        return entry if entry and (entry.is_file or entry.is_folder) else None

    def _resolve_in_sibling(self, normal: str) -> FileEntry | None:
        name, _, rest = normal.removeprefix("../").partition("/")
        if name == "..":
            return self._resolve_beside(normal)
        if name == self.root.name and not self.only:
            return self.resolve(rest)
        sibling = self.workspace.package(name)
        return sibling.resolve(rest) if sibling else self._resolve_beside(normal)

    def _resolve_beside(self, normal: str) -> FileEntry | None:
        """Return what is beside a loose folder of models, within what the user gave."""
        given = self.workspace.given
        if given is None or not self.is_loose or not self.root.parent.is_relative_to(given):
            return None
        return entry_at(self.root / normal, normal, given, self.workspace.holds)

    def _below_link(self, normal: str) -> bool:
        parts = normal.split("/")
        above = (self.index.find("/".join(parts[:end])) for end in range(1, len(parts)))
        return any(entry.target_state and entry.is_folder for entry in above if entry)

    def exists(self, path: str) -> bool:
        """Return whether a file or folder is there."""
        return self.resolve(path) is not None

    def read(self, path: str) -> SourceText | NotReadable:
        """Return a file's text, read once."""
        path = self._canonical(path)
        if path not in self._texts:
            entry = self._file(path)
            self._texts[path] = (
                entry
                if isinstance(entry, NotReadable)
                else self.workspace.overlay.read(entry.location, path)
            )
        return self._texts[path]

    def read_bytes(self, path: str, limit: int = BYTES_LIMIT) -> bytes | NotReadable:
        """Return a file's content, of at most `limit` bytes; it is not kept."""
        entry = self._file(path)
        if isinstance(entry, NotReadable):
            return entry
        return self.workspace.overlay.read_bytes(entry.location, path, limit)

    def _canonical(self, path: str) -> str:
        """Return the one spelling of a path under which its file is kept."""
        return (normal_path(path) or path).removeprefix(f"../{self.root.name}/")

    def _file(self, path: str) -> FileEntry | NotReadable:
        entry = self.resolve(path) or self.index.find(self._canonical(path))
        if entry is None:
            return NotReadable(path, "does not exist")
        if entry.kind is EntryKind.LINK and entry.content is EntryKind.LINK:
            reason = f"is a link that is not followed ({entry.target_state}: {entry.target})"
            return NotReadable(path, reason)
        return entry if entry.is_file else NotReadable(path, "is not a regular file")

    def xml(self, path: str) -> XmlDocument | XmlFault | NotReadable:
        """Return a file as XML, parsed once."""
        path = self._canonical(path)
        if path not in self._documents:
            source = self.read(path)
            self._documents[path] = (
                source if isinstance(source, NotReadable) else self._parsed(path, source)
            )
        return self._documents[path]

    def _parsed(self, path: str, source: SourceText) -> XmlDocument | XmlFault | TooLarge:
        count, attributes = elements_in(source.text), attributes_in(source.text)
        known = sum(self._elements.values())
        limit = elements_limit()
        of_attributes, for_all = limit * ATTRIBUTES_FOR_ONE, limit * DOCUMENTS_FOR_ALL
        if count > limit:
            reason = f"has {count:,} elements; only files of up to {limit:,} are checked"
        elif attributes > of_attributes:
            most = f"only files of up to {of_attributes:,} are checked"
            reason = f"has {attributes:,} attributes; {most}"
        elif known + count > for_all:
            before = f"the XML files before have {known:,} of the {for_all:,} for all"
            reason = f"has {count:,} elements; {before}"
        else:
            self._elements[path] = count
            return parse_xml(source)
        return TooLarge(path, f"{reason} ({ELEMENTS_VARIABLE}={2 * limit} doubles the limit)")

    @property
    def too_large(self) -> tuple[TooLarge, ...]:
        """The requested XML files that are too large to be checked."""
        return tuple(each for each in self._documents.values() if isinstance(each, TooLarge))

    @cached_property
    def build(self) -> CMakeFile | None:
        """CMakeLists.txt; None if it is missing or no text, or setup.py builds the package."""
        if self.build_type == "ament_python":
            return None
        source = self.read("CMakeLists.txt")
        return read_cmake(source) if isinstance(source, SourceText) else None

    @cached_property
    def setup(self) -> SetupFile | None:
        """setup.py; None if it is missing or calls no `setup`."""
        source = self.read("setup.py") if self.index.find("setup.py") else None
        return read_setup(source) if isinstance(source, SourceText) else None

    @cached_property
    def installed(self) -> tuple[tuple[str, str], ...]:
        """Targets of the files and folders that CMake or setup.py installs, and their sources."""
        of_setup = data_file_items(self.setup, self.index) if self.setup else ()
        return (*(installed_items(self.build) if self.build else ()), *of_setup)

    @cached_property
    def xml_files(self) -> tuple[str, ...]:
        """Paths of the files that are XML by their names.

        Meshes are left out, and models and worlds that are checked by themselves.
        """
        paths = (file.path for file in self.index.with_suffix(*xml_suffixes()))
        return tuple(path for path in paths if not self.lies_in_unit(path))

    def lies_in_unit(self, path: str) -> bool:
        """Return whether a file is in a unit within that is checked by itself."""
        return any(path == unit or path.startswith(f"{unit}/") for unit in self._units)

    @cached_property
    def _units(self) -> frozenset[str]:
        """Paths of what is within and no part of it: models and worlds, and packages as well."""
        found = Units(()) if self.only else units_below(self.root)
        places = [unit.folder / unit.only for unit in found.units]
        places += [folder for folder, _ in found.nested]
        return frozenset(
            place.relative_to(self.root).as_posix() for place in places if place != self.root
        )

    @cached_property
    def model_path(self) -> Found | Missing:
        """The model: the package's own (see `own_model`), else a sibling's."""
        return find_part(self, "model", own_model)

    def part(self, path: str) -> Found | Missing:
        """Find a file or folder in the package, else in the siblings it inherits from.

        The specification sheet is found under other spellings of its name, too.
        """
        if path == SHEET:
            return find_part(self, path, own_sheet)
        return find_part(self, path, lambda holder: path if holder.exists(path) else None)

    @cached_property
    def references(self) -> tuple[Reference, ...]:
        """Packages that the spawner and package.xml name, itself included."""
        return () if self.only else tuple(self._references())

    def _references(self) -> Iterator[Reference]:
        for ruby in self._ruby_files():
            by_sibling = ruby.file.startswith("../")
            for reference in spawner_references(ruby):
                yield replace(reference, by_sibling=by_sibling)
        manifest = self.xml("package.xml")
        if isinstance(manifest, XmlDocument):
            yield from dependencies(manifest)

    def _ruby_files(self) -> Iterator[SourceText]:
        """Yield the spawner and the Ruby files that it loads, siblings' among them."""
        waiting, seen = [SPAWNER], {SPAWNER}
        while waiting and len(seen) <= RUBY_FILES:
            source = self.read(waiting.pop(0))
            if isinstance(source, SourceText):
                yield source
                loaded = [path for path in loaded_files(source) if path not in seen]
                waiting += loaded
                seen.update(loaded)

    @cached_property
    def mentioned_names(self) -> frozenset[str]:
        """Names of meshes, pictures and models that any file mentions, in lower case."""
        return mentioned_names(self)

    @cached_property
    def base(self) -> Reference | None:
        """The mention of the sibling with the model, when the package has none."""
        return base_of(self)

    @cached_property
    def inherited(self) -> tuple[Inherited, ...]:
        """Parts that come from siblings."""
        return tuple(inherited_parts(self))
