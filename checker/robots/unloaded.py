"""Descriptions that no launch file loads by default, beside one that a launch file loads."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping

_NAME = re.compile(
    r"""(?:\$\([^()"'<>]{0,100}\)|\$(?!\()|[^\s"'/<>=$]){0,200}\.(?:urdf\.xacro|xacro|urdf)\b"""
)
_FILE_ARGUMENT = re.compile(
    r"""\bdefault(?:_value)?\s{0,8}=[^<>\n]{0,300}\.(?:urdf|xacro)\b"""
    r"""|(?:DeclareLaunchArgument\(\s{0,80}(?:name\s{0,8}=\s{0,8})?|<arg\s{1,8}name\s{0,8}=\s{0,8})"""
    r"""["'](?:model|(?:urdf|xacro|description|robot)_?(?:file|path|model)\w{0,40})["']"""
)
"""An argument of a launch file that is the file itself: `model:=urdf/arm.urdf`."""
_COMPUTED = re.compile(r"\$\([^()]{0,100}\)|\$?\{[^{}]{0,100}\}")
_ARGUMENT = re.compile(r"\$\(arg\s{1,8}([\w.-]{1,100})\s{0,8}\)")
_DEFAULT = r"""<arg\s[^<>]{{0,300}}\bname\s{{0,8}}=\s{{0,8}}["']{}["'][^<>]{{0,300}}"""
_VALUE = re.compile(r"""\b(?:default|value)\s{0,8}=\s{0,8}["']([\w.-]{0,100})["']""")


def may_be_loaded(launch_texts: Mapping[str, str], path: str) -> bool:
    """Return whether a launch file names a description, or a name that may be this one.

    So does one with an argument that takes any file.

    Args:
        launch_texts: The launch files of the workspace.
        path: The path of the description.
    """
    name = posixpath.basename(path)
    return any(
        name in text or _FILE_ARGUMENT.search(text) or _may_name(text, name)
        for text in launch_texts.values()
    )


def _may_name(text: str, name: str) -> bool:
    """Return whether a computed name in a text fits; arguments of ROS 1 have their defaults."""
    for found in _NAME.findall(text):
        written = _ARGUMENT.sub(lambda match: _default_of(text, match), found)
        fixed = [re.escape(part) for part in _COMPUTED.split(written)]
        if written[0] in "._-":  # the end of a name that is put together
            fixed.insert(0, "")
        if len(fixed) > 1 and re.fullmatch(".*".join(fixed), name):
            return True
        if written == name:
            return True
    return False


def _default_of(text: str, argument: re.Match[str]) -> str:
    declared = re.search(_DEFAULT.format(re.escape(argument[1])), text)
    value = _VALUE.search(declared.group()) if declared else None
    return value[1] if value else argument.group()
