"""Source of a migration: the only URDF description of a package."""

from __future__ import annotations

import copy
import os
import posixpath
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from checker.base.cache import NO_CACHE
from checker.base.record import Record
from checker.convert.xml_writer import document_text
from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.expansion import Expander, xacro_server
from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.migrate.options import NotMigrated
from checker.package.inputs import Opened, open_input
from checker.package.manifests import PackageManifest, Paperwork
from checker.package.package import Package
from checker.physics.mesh.uris import MeshFile, file_behind
from checker.robots.package_descriptions import PackageDescriptions
from checker.robots.urdf_files import UrdfFiles

_NAMED_LIMIT = 8
_GIVE_ARGUMENT = "; give it with --args name:=value"


class Source(Record, eq=False):
    """A description to migrate.

    Attributes:
        package: The package that contains it.
        description: The robot, after xacro.
    """

    package: Package
    description: UrdfDescription

    @property
    def manifest(self) -> PackageManifest | None:
        """The package.xml, if there is one."""
        return None if self.package.only else Paperwork(self.package).manifest


@contextmanager
def opened_source(path: Path, urdf: str, args: Mapping[str, str]) -> Iterator[Source]:
    """Open the description to migrate.

    Args:
        path: A package folder, a folder of packages, an archive or a URDF file.
        urdf: The file that describes the robot; empty to find it.
        args: Arguments for xacro.

    Raises:
        NotMigrated: There is no description in it, there are several, or xacro refuses it.
        UnreadableInput: The path cannot be opened.
    """
    with open_input(path) as opened:
        package = _package_of(opened, path, urdf)
        chosen = _file_in(package, urdf) if urdf else ""
        server = xacro_server()
        expander = Expander(NO_CACHE, server)
        try:
            descriptions = PackageDescriptions(package, expander, only=chosen, args=args)
            yield Source(package, _only_one(descriptions.files, package, path))
        finally:
            server.stop()


def _package_of(opened: Opened, path: Path, urdf: str) -> Package:
    """Return the one package that has a description."""
    described = [package for package in opened.packages if urdf or package.is_urdf]
    if len(described) == 1:
        return described[0]
    if described:
        names = _listed([package.name for package in described])
        raise NotMigrated(
            f"{path} contains several packages ({names}); give the folder of one of them"
        )
    with_model = [item for item in opened.packages if item.index.with_suffix(".sdf")]
    if with_model:
        raise NotMigrated(
            f"{path} already has an SDF model ({with_model[0].index.with_suffix('.sdf')[0].path}), "
            "so there is nothing to migrate. To check it, run: subt-check check PATH"
        )
    raise _without_urdf(path)


def _without_urdf(path: Path) -> NotMigrated:
    return NotMigrated(
        f"{path} contains no robot in URDF (a .urdf or .xacro file with <robot> and links); give a "
        "description package, or name the file with --urdf"
    )


def _file_in(package: Package, urdf: str) -> str:
    """Return a file that the author names as the package lists it."""
    if package.exists(urdf):
        return urdf
    real = Path(os.path.realpath(urdf))
    if real.is_relative_to(package.root) and real.is_file():
        return real.relative_to(package.root).as_posix()
    paths = [file.path for file in package.index.with_suffix(".urdf", ".xacro")]
    raise NotMigrated(
        f"{urdf} is not a file of {package.name}; found: {_listed(paths) or 'no URDF file'}"
    )


def _only_one(files: UrdfFiles, package: Package, path: Path) -> UrdfDescription:
    with_links = [description for description in files.descriptions if description.robot.links]
    if len(with_links) == 1:
        return with_links[0]
    if with_links:
        names = _listed([link.file for link in with_links])
        raise NotMigrated(
            f"{package.name} describes several robots: {names}; choose one with --urdf"
        )
    if files.faults:
        raise NotMigrated(_fault(files.faults[0]))
    unread = (*files.unread, *files.unused, *files.set_aside)
    if unread:
        raise NotMigrated(f"{unread[0]}{_GIVE_ARGUMENT if ': arg ' in unread[0] else ''}")
    raise _without_urdf(path)


def _fault(fault: XacroFault) -> str:
    advice = _GIVE_ARGUMENT if fault.kind is XacroFaultKind.ARGUMENT else ""
    hint = f" ({fault.hint})" if fault.hint else ""
    return f"{fault.file} cannot be expanded: {fault.span.place()}: {fault.message}{hint}{advice}"


def _listed(names: list[str]) -> str:
    more = len(names) - _NAMED_LIMIT
    return ", ".join(names[:_NAMED_LIMIT]) + (f" and {more} more" if more > 0 else "")


# The description as it was, in one file, kept beside the model that was made from it.


_COMMENT = " The robot as it was simulated in Gazebo 9, expanded; model.sdf is made from it. "


def original_text(source: Source, new_uris: Mapping[str, str]) -> bytes:
    """Return the expanded URDF, whose meshes are those of the new package.

    Args:
        source: The description.
        new_uris: URI of each file that was taken along, by its old path.
    """
    from lxml import etree

    root = copy.deepcopy(source.description.document.root.node)
    folder = posixpath.dirname(source.description.file)
    for element in root.iter("mesh", "texture"):
        file = file_behind(source.package, folder, element.get("filename") or "")
        if isinstance(file, MeshFile) and file.path in new_uris:
            element.set("filename", new_uris[file.path])
    root.insert(0, etree.Comment(_COMMENT))
    return document_text(root).encode()


# What the source's package.xml says, for the paperwork of the new package.


NO_NAME, NO_EMAIL, NO_LICENSE = "TODO", "todo@example.org", "TODO"


class Papers(Record):
    """The authors of the robot and its licence.

    Attributes:
        name: The name of the maintainer.
        email: The email of the maintainer.
        license: The license of the package.
        open_points: What the author has to fill in.
    """

    name: str
    email: str
    license: str
    open_points: tuple[str, ...]


def papers_of(source: Source) -> Papers:
    """Return what is known; what is not known is TODO."""
    manifest = source.manifest
    people = (*manifest.maintainers, *manifest.authors) if manifest is not None else ()
    person = next(
        (candidate for candidate in people if candidate.name.value and candidate.email.value), None
    )
    license = (
        next((entry.value for entry in manifest.licenses if entry.value), "") if manifest else ""
    )
    open_points = []
    if person is None:
        open_points.append("the maintainer, with email (package.xml, model.config)")
    if not license or license.upper() == NO_LICENSE:
        open_points.append("the license (package.xml)")
    return Papers(
        _one_line(person.name.value) if person else NO_NAME,
        _one_line(person.email.value) if person else NO_EMAIL,
        _one_line(license) or NO_LICENSE,
        tuple(open_points),
    )


def _one_line(text: str) -> str:
    """Return a text that stays in its line of the sheet."""
    return " ".join(text.split())
