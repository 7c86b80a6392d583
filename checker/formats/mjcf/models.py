"""The models of MuJoCo in a package: the files that are given to MuJoCo, each with its includes."""

from __future__ import annotations

from checker.base.parts import NotAvailable, part
from checker.base.record import Record
from checker.formats.mjcf.model import MjcfModel, read_model
from checker.package.mjcf_files import mjcf_files
from checker.package.package import Package
from checker.source.xml_positions import XmlFault

MODELS_LIMIT = 40
"""Models of a package that are read."""


class MjcfFiles(Record, eq=False):
    """What became of the files of MuJoCo in a package.

    Attributes:
        models: The models that no other file includes and that have a body or a shape.
        broken: Files that are not well-formed XML.
        left_out: Number of files beyond the limit.
    """

    models: tuple[MjcfModel, ...]
    broken: tuple[XmlFault, ...]
    left_out: int = 0


@part
def files(package: Package) -> MjcfFiles | NotAvailable:
    """Return the files of MuJoCo; an included one is a part of the model that includes it."""
    paths = mjcf_files(package)
    if not paths:
        return NotAvailable("there is no model of MuJoCo", applicable=False)
    read = [read_model(package, path) for path in paths[:MODELS_LIMIT]]
    models = [each for each in read if isinstance(each, MjcfModel)]
    included = {path for model in models for path in model.included}
    return MjcfFiles(
        tuple(model for model in models if model.file not in included and _has_content(model)),
        tuple(each for each in read if isinstance(each, XmlFault)),
        len(paths[MODELS_LIMIT:]),
    )


@part
def models(files: MjcfFiles) -> tuple[MjcfModel, ...] | NotAvailable:
    """Return the models of MuJoCo."""
    if files.models:
        return files.models
    if files.broken:
        return NotAvailable(f"{files.broken[0].span.source.file} is not well-formed XML")
    return NotAvailable("no file of MuJoCo has a body or a shape", applicable=False)


def _has_content(model: MjcfModel) -> bool:
    """Return whether a file has bodies or shapes, or should have: an include is missing."""
    return not model.is_whole or any(True for _ in model.tagged("body", "geom"))
