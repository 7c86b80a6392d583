"""Descriptions that no launch file loads by default, beside one that a launch file loads."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Iterator, Mapping, Sequence

from checker.base.record import Record
from checker.package.mentions import has_file
from checker.source.text import without_comments

_NAME = re.compile(
    r"""(?:\$\([^()"'<>]{0,100}\)|\$(?!\()|[^\s"'/<>=$]){0,200}\.(?:urdf\.xacro|xacro|urdf)\b"""
)
_FILE_ARGUMENT = re.compile(
    r"""\bdefault(?:_value)?\s{0,8}=[^<>\n]{0,300}\.(?:urdf|xacro)\b"""
    r"""|(?:DeclareLaunchArgument\(\s{0,80}(?:name\s{0,8}=\s{0,8})?|<arg\s{1,8}name\s{0,8}=\s{0,8})"""
    r"""["'](model|(?:urdf|xacro|description|robot)_?(?:file|path|model)\w{0,40})["']"""
)
"""An argument of a launch file that is the file itself: `model:=urdf/arm.urdf`."""
_IN_NAME = re.compile(
    r"""\$\((?:arg|var)\s{1,8}([\w.-]{1,100})\s{0,8}\)[^\s"'<>/]{0,100}\.(?:urdf|xacro)\b"""
)
"""An argument that is a part of the name of a file: `arm_$(arg model).urdf`."""
_COMPUTED = re.compile(r"\$\([^()]{0,100}\)|\$?\{[^{}]{0,100}\}")
_ARGUMENT = re.compile(r"\$\(arg\s{1,8}([\w.-]{1,100})\s{0,8}\)")
_DECLARED = re.compile(r"<arg\s[^<>]{1,400}>")
_NAMED = re.compile(r"""\bname\s{0,8}=\s{0,8}["']([\w.-]{1,100})["']""")
_VALUE = re.compile(r"""\b(?:default|value)\s{0,8}=\s{0,8}["']([\w.-]{0,100})["']""")


class Naming(Record):
    """The texts that may name a description.

    Attributes:
        launches: All launch files, by path.
        own: Those of the package, or that name it, by path.
        pages: README files.
    """

    launches: Mapping[str, str]
    own: Mapping[str, str]
    pages: Sequence[str] = ()


def may_be_loaded(naming: Naming, path: str, loaded: Collection[str] = ()) -> bool:
    """Return whether a launch file names a description, or a name that may be this one.

    So does one with an argument that takes any file, beside a file that it loads by default, where
    a README names this one.

    Args:
        naming: The texts.
        path: The path of the description.
        loaded: The paths of the descriptions that are loaded.
    """
    folder, name = posixpath.split(path)
    told = any(has_file(page, name) for page in naming.pages)
    given = told and folder in {posixpath.dirname(it) for it in loaded}
    named = {file: text for file, text in naming.launches.items() if has_file(text, name)}
    written = (without_comments(file, text) for file, text in named.items())
    if not all(means_others(text, name, loaded) for text in written):
        return True
    return any(
        (given and takes_any_file(text)) or (text not in named.values() and _may_name(text, name))
        for text in naming.own.values()
    )


def takes_any_file(text: str) -> bool:
    """Return whether an argument of a launch file is the file of a description."""
    parts = _IN_NAME.findall(text)
    return any(name not in parts for name in _FILE_ARGUMENT.findall(text))


def means_others(text: str, name: str, loaded: Collection[str]) -> bool:
    """Return whether a text names no file so, but as the path of a loaded file of that name."""
    if not has_file(text, name):
        return True
    plain = text.replace('"', "'")
    paths = (it.split("/") for it in loaded if it.endswith(f"/{name}"))
    written = (f"{it[-2]}{between}{name}" for it in paths for between in ("/", "', '"))
    return plain.count(name) == sum(map(plain.count, written))


def _may_name(text: str, name: str) -> bool:
    """Return whether a computed name in a text fits; arguments of ROS 1 have their defaults."""
    defaults = dict(_defaults(text))
    for found in _NAME.findall(text):
        written = _ARGUMENT.sub(lambda it: defaults.get(it[1], it.group()), found)
        parts = _COMPUTED.split(written)
        if written[0] in "._-":  # the end of a name that is put together
            parts.insert(0, "")
        if written == name or (len(parts) > 1 and _fits(name, parts)):
            return True
    return False


def _fits(name: str, parts: Sequence[str]) -> bool:
    """Return whether a name consists of some parts in order, with any text between them."""
    first, *between, last = parts
    if len(name) < len(first) + len(last):
        return False
    at, end = len(first), len(name) - len(last)
    for part in between:
        at = name.find(part, at, end) + len(part)
        if at < len(part):
            return False
    return name.startswith(first) and name.endswith(last)


def _defaults(text: str) -> Iterator[tuple[str, str]]:
    """Yield the arguments that a launch file of ROS 1 declares with a default or value."""
    for tag in _DECLARED.findall(text):
        named, value = _NAMED.search(tag), _VALUE.search(tag)
        if named and value:
            yield named[1], value[1]
