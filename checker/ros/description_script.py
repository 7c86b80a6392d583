"""Scripts that print a robot's description: the arguments for xacro, read as text and never run."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping

from checker.base.record import Record
from checker.package.package import Package
from checker.source.text import SourceText

_LONGEST = 50_000
"""Characters of a script that are read."""
_FIRST_LINE = re.compile(r"#!.{0,100}\b(?:ba|da|z|k)?sh\b|#!.{0,100}\bpython")
_SUFFIXES = (".py", ".sh", ".bash")
_COMMENT = re.compile(r"^\s*#.*$", re.MULTILINE)
_RUNS_XACRO = re.compile(r"(?<![.\w-])xacro(?:\.py)?(?![\w.-]*/)\b")
_FILE = re.compile(r"([\w.-]{1,100}\.(?:xacro|urdf))\b")
_TAKES = re.compile(
    r"\$(?:[@*#1-9]|\{[@*#1-9])|\b(?:shift|getopts?)\b"
    r"|\b(?:argv|argparse|optparse|docopt|click|fire|typer)\b"
)
_LEARNS = re.compile(
    r"^\s*\.\s|\b(?:source|eval|read|rosparam|get_param|environ|getenv|stdin)\b", re.MULTILINE
)
"""Words by which a script learns of values from elsewhere."""
_ARGUMENT = re.compile(r"\b(\w{1,100}):=([^\s;|&)]{0,100})")
_COMPUTED = re.compile(r"[${}%+,]")


class DescriptionScript(Record, eq=False):
    """A script of the shell or of Python that has xacro make a description.

    Attributes:
        path: Within its package.
        files: Descriptions of the package that it names.
        takes_arguments: Whether it does something with its arguments.
        learns_more: Whether it may know values from elsewhere: other files, parameters.
        arguments: What it gives to xacro itself, as `name:=value`; None for a value known only
            at run time.
    """

    path: str
    files: tuple[str, ...]
    takes_arguments: bool
    learns_more: bool
    arguments: Mapping[str, str | None]


def read_description_script(package: Package, path: str) -> DescriptionScript | None:
    """Read a script; None if it is none, or does not run xacro according to its text.

    Args:
        package: The package that contains it.
        path: The path within the package.
    """
    source = package.read(path)
    if not isinstance(source, SourceText):
        return None
    text = source.text[:_LONGEST]
    if not path.endswith(_SUFFIXES) and not _FIRST_LINE.match(text):
        return None
    text = _COMMENT.sub("", text)
    if not _RUNS_XACRO.search(text):
        return None
    arguments = {name: _value(value) for name, value in _ARGUMENT.findall(text)}
    return DescriptionScript(
        path,
        _files(package, text),
        bool(_TAKES.search(text)),
        bool(_LEARNS.search(text)),
        arguments,
    )


def _value(written: str) -> str | None:
    """Return a value without its quotes; None if it is computed."""
    value = written.strip("\"'`")
    return None if not value or _COMPUTED.search(value) else value


def _files(package: Package, text: str) -> tuple[str, ...]:
    """Return the descriptions whose names are in a text, where one file alone has that name."""
    by_name: dict[str, list[str]] = {}
    for file in package.index.with_suffix(".xacro", ".urdf"):
        by_name.setdefault(posixpath.basename(file.path), []).append(file.path)
    named = (by_name.get(name, []) for name in dict.fromkeys(_FILE.findall(text)))
    return tuple(paths[0] for paths in named if len(paths) == 1)
