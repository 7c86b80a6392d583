"""The formats of robots: the files in each of them, and their readers.

A format is a folder of `checker/formats/` that defines `FORMAT`. Those of other distributions come
through the entry-point group `subt_check.formats`; an entry point names a `Format`.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import cast

from checker.base.distributions import load_entry_points
from checker.base.record import Record
from checker.base.resources import PACKAGE

FORMATS = ("sdf", "urdf")
"""Folders of `checker/formats/`; the first one is that of files which no format knows."""


class Format(Record):
    """A format of robots, whose files are XML.

    Attributes:
        name: The name, such as `sdf`.
        suffixes: Ends of the names of its files of robots, in lower case.
        world_suffixes: Ends of the names of its files of worlds.
        roots: Root elements of its files.
        reader: Module and name of the function that returns what a file contains
            (`checker.formats.content.Reader`), such as `acme.toy:read`.
        is_grouped: Whether files in one folder, and launch files, describe a robot together;
            otherwise each file outside of packages is checked by itself.
    """

    name: str
    suffixes: tuple[str, ...]
    roots: tuple[str, ...]
    reader: str = ""
    world_suffixes: tuple[str, ...] = ()
    is_grouped: bool = False


@cache
def formats() -> tuple[Format, ...]:
    """Return all formats, those of other distributions last."""
    ours = (import_module(f"{PACKAGE}.formats.{name}").FORMAT for name in FORMATS)
    return (*ours, *(cast("Format", each) for each in load_entry_points("formats")))


def format_of(root: str) -> Format:
    """Return the format of a file by its root element; the first one where none has it."""
    return next((each for each in formats() if root in each.roots), formats()[0])


@cache
def robot_suffixes() -> tuple[str, ...]:
    """Return the ends of the names of files of robots in any format."""
    return tuple(suffix for each in formats() for suffix in each.suffixes)


@cache
def model_suffixes() -> tuple[str, ...]:
    """Return the ends of the names of files of robots and worlds in any format."""
    return tuple(it for each in formats() for it in (*each.suffixes, *each.world_suffixes))


@cache
def xml_suffixes() -> tuple[str, ...]:
    """Return the ends of the names of files that are XML."""
    return (*single_file_suffixes(), "model.config", ".launch", ".srdf")


@cache
def single_file_suffixes() -> tuple[str, ...]:
    """Return the ends of the names of files that can be checked alone."""
    return (*model_suffixes(), ".xml", ".mjcf")


def is_checked_by_itself(name: str) -> bool:
    """Return whether a file outside of packages is checked by itself."""
    return name.lower().endswith(_single_suffixes())


@cache
def _single_suffixes() -> tuple[str, ...]:
    single = [each for each in formats() if not each.is_grouped]
    suffixes = [it for each in single for it in (*each.suffixes, *each.world_suffixes)]
    return (*suffixes, *(f"{suffix}.xacro" for suffix in suffixes))
