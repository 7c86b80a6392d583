"""URIs of models on Fuel, and the available packages that were uploaded under their names."""

from __future__ import annotations

import posixpath
import re
from typing import TYPE_CHECKING
from urllib.parse import unquote

from checker.base.record import Record

if TYPE_CHECKING:
    from checker.package.package import Package

_FUEL = re.compile(r"https?://(?:\w+\.)?fuel\.(?:ignitionrobotics\.org|gazebosim\.org)\b", re.I)
_MODEL = re.compile(
    _FUEL.pattern + r"/1\.0/[^/]+/(?:models|worlds)/(?P<name>[^/]+)"
    r"(?:(?:/(?:tip|\d+))?/?|/(?:tip|\d+)/files/(?P<path>.+))",
    re.IGNORECASE | re.DOTALL,
)


class FuelUri(Record):
    """Model or world, and file, in a URI of Fuel.

    Attributes:
        model: Name of the model or world.
        path: The path of a file in it; empty for the model as a whole.
    """

    model: str
    path: str = ""


def is_on_fuel(uri: str) -> bool:
    """Return whether a URI leads to Fuel, in whatever form."""
    return _FUEL.match(uri) is not None


def read_fuel_uri(uri: str) -> FuelUri | None:
    """Return what a URI names; None if it is not of Fuel's form."""
    match = _MODEL.fullmatch(uri)
    return FuelUri(unquote(match["name"]), unquote(match["path"] or "")) if match else None


def package_on_fuel(package: Package, name: str) -> Package | None:
    """Return the available package of a model on Fuel, where names ignore case."""
    if name.casefold() == package.name.casefold():
        return package
    return package.workspace.package(name.lower())


def path_from_fuel(package: Package, uri: str) -> str | None:
    """Return the path of what a URI of Fuel names, from a package that names it.

    None if the package that it belongs to is not available.
    """
    named = read_fuel_uri(uri)
    holder = package_on_fuel(package, named.model) if named else None
    if named is None or holder is None:
        return None
    folder = "" if holder is package else f"../{holder.name}"
    return posixpath.normpath(posixpath.join(folder, named.path or "."))
