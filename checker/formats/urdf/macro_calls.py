"""The smallest call of a macro that makes a robot, for files that contain macros and no robot."""

from __future__ import annotations

import re
from collections.abc import Mapping
from html import escape

from checker.base.record import Record
from checker.formats.xacro.names import FROM_OUTSIDE, PARAMETER, MacroParameter, parameters_of
from checker.package.package import Package
from checker.source.text import Span
from checker.source.xml import Element, XmlDocument

_MACRO = "xacro:macro"
_NAME = re.compile(r"[A-Za-z_][\w.-]{0,100}")
_PARAMETERS_LIMIT = 5000
"""Characters; real macros have a tenth of that."""
_ORIGIN = "origin"
WORLD = "world"
"""The link to which a macro is connected; it is fixed in Gazebo."""
_ROOT = "base_link"
"""The usual name of the first link, for a macro that makes its parent itself."""
_GIVEN = {"parent": WORLD, "parent_link": WORLD, "prefix": "", "tf_prefix": ""}


def macro_around(element: Element) -> Element | None:
    """Return the macro that contains an element; None outside of macros."""
    around = element.parent
    while around is not None and around.tag != _MACRO:
        around = around.parent
    return around


class MacroCall(Record, eq=False):
    """A call of a macro with only the required arguments.

    Attributes:
        name: The name of the macro.
        arguments: The arguments by name.
        blocks: Names of the blocks, all of them origins.
        number: The number of the macro's element in its file.
        span: The start tag of the macro.
    """

    name: str
    arguments: Mapping[str, str]
    blocks: tuple[str, ...]
    number: int
    span: Span

    @property
    def start_tag(self) -> str:
        """The start tag of the call."""
        stated = "".join(f' {name}="{escape(value)}"' for name, value in self.arguments.items())
        return f"<xacro:{self.name}{stated}>"

    @property
    def added(self) -> dict[str, str | int]:
        """Text that is added to the file before it is expanded, and where."""
        return {"text": self.text, "number": self.number, "name": self.name}

    @property
    def text(self) -> str:
        """Content of a robot file that calls the macro: the parent link and the call."""
        link = f'<link name="{WORLD}"/>' if WORLD in self.arguments.values() else ""
        blocks = '<origin xyz="0 0 0" rpy="0 0 0"/>' * len(self.blocks)
        call = f"{self.start_tag}{blocks}</xacro:{self.name}>"
        return f'<robot xmlns:xacro="http://ros.org/wiki/xacro">{link}{call}</robot>'


def minimal_call(package: Package, path: str) -> MacroCall | None:
    """Return how to call the one macro of a file that makes links; None if that is not clear.

    Args:
        package: The package being checked.
        path: The path of the file, as the package lists it.
    """
    document = package.xml(path)
    if not isinstance(document, XmlDocument) or document.root.tag != "robot":
        return None
    macros = [it for it in document.root.all(_MACRO) if next(it.descendants("link"), None)]
    called = {child.tag.removeprefix("xacro:") for macro in macros for child in macro.descendants()}
    outer = [macro for macro in macros if _name(macro) not in called]
    if len(outer) != 1 or not _NAME.fullmatch(_name(outer[0])):
        return None
    number = next(i for i, it in enumerate(document.elements) if it.node is outer[0].node)
    return _call(outer[0], number)


def _name(macro: Element) -> str:
    return (macro.get("name") or "").removeprefix("xacro:")


def _is_left(parameter: MacroParameter) -> bool:
    """Return whether a parent is empty by default: a joint needs one."""
    return bool(_GIVEN[parameter.name]) and not (parameter.default or "").strip("'\" ")


def _call(macro: Element, number: int) -> MacroCall | None:
    """Return the call of a macro; None if it needs what only its user can know."""
    arguments: dict[str, str] = {}
    blocks: list[str] = []
    made = {(link.get("name") or "").strip("${} ") for link in macro.descendants("link")}
    text = macro.get("params") or ""
    if len(text) > _PARAMETERS_LIMIT or PARAMETER.sub("", text).strip():
        return None
    for parameter in parameters_of(text):
        name, default = parameter.name, parameter.default
        if parameter.block and name.endswith(_ORIGIN) and default is None:
            blocks.append(name)
        elif name in _GIVEN and not parameter.block and (default is None or _is_left(parameter)):
            arguments[name] = _ROOT if name in made else _GIVEN[name]
        elif default is None or default == FROM_OUTSIDE:
            return None
    return MacroCall(_name(macro), arguments, tuple(blocks), number, macro.span)
