"""Values of xacro's arguments that choose another robot than the defaults do.

A file names them where it compares an argument, or a parameter of a macro that gets it, tests it,
or includes a file whose name it is part of; a launch file where it lists the choices for one.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping

from checker.formats.xacro.files import named_path, path_of
from checker.package.package import Package
from checker.source.xml import Element, XmlDocument

_VALUE = re.compile(r"[\w-]{1,100}")
_ARGUMENT = re.compile(r"\$\(arg\s{1,8}([\w.-]{1,100})\s{0,8}\)")
_WHOLE = re.compile(r"\$\{\s{0,8}(?:not\s{1,8})?([A-Za-z_]\w{0,100})\s{0,8}\}")
_COMPARED = re.compile(
    r"""\b([A-Za-z_]\w{0,100})['"]?\s{0,8}[=!]=\s{0,8}(?:['"]([\w./-]{1,100})['"]|(\d{1,9})\b)"""
)
_EITHER = re.compile(r"\b[A-Za-z_]\w{0,100}(?:\s{1,8}or\s{1,8}[A-Za-z_]\w{0,100}){1,9}")
_NO_CALLS = frozenset({"xacro:arg", "xacro:if", "xacro:unless", "xacro:include", "xacro:macro"})
"""Elements of xacro itself, which hand no parameter to a macro."""
_SIMULATOR = re.compile(r"gz|gazebo|ign|sim", re.IGNORECASE)
_OPPOSITES = {
    "true": "false",
    "false": "true",
    "True": "False",
    "False": "True",
    "0": "1",
    "1": "0",
}


def further_values(
    package: Package,
    documents: Iterable[XmlDocument],
    chosen: Mapping[str, str],
    allowed: Mapping[str, Iterable[str]],
) -> list[tuple[str, str]]:
    """Return names of arguments with values that they do not have, in the order of the files.

    Args:
        package: The package being checked.
        documents: The documents to expand, the robot's own file and all that it may include.
        chosen: Values that are given, by name.
        allowed: Values that a launch file allows, by name.
    """
    documents = [*documents]
    elements = [e for document in documents for e in document.elements if _is_xacro(e)]
    values = {**defaults(documents), **chosen}
    aliases = {name: name for name in values} | _aliases(elements)
    listed = [(name, value) for name, options in allowed.items() for value in options]
    found = [
        (aliases[name], value)
        for element in elements
        for name, value in _compared_values(package, element, values, aliases)
        if aliases.get(name) in values
    ]
    tried = dict.fromkeys((*listed, *found))
    return [(name, value) for name, value in tried if value != values.get(name)]


def compared_texts(documents: Iterable[XmlDocument], name: str) -> list[str]:
    """Return the texts that conditions compare an argument with, or a parameter of its name.

    A default, which counts only behind its declaration, is the first; then the simulator's texts.
    """
    documents = [*documents]
    elements = [e for document in documents for e in document.elements if _is_xacro(e)]
    aliases = {name: name} | _aliases(elements)
    found = (
        text or number
        for element in elements
        if element.tag in ("xacro:if", "xacro:unless")
        for named, text, number in _COMPARED.findall(
            _ARGUMENT.sub(r"\1", element.get("value") or "")
        )
        if aliases.get(named) == name
    )
    default = defaults(documents).get(name, "")
    texts = dict.fromkeys((default, *found) if default else found)
    return sorted(texts, key=lambda text: (text != default, _SIMULATOR.match(text) is None))


def alternatives(documents: Iterable[XmlDocument], name: str) -> set[str]:
    """Return the arguments of which one is chosen instead of another: `${classic or fortress}`."""
    elements = [e for document in documents for e in document.elements if _is_xacro(e)]
    aliases = _aliases(elements)
    found: set[str] = set()
    for element in elements:
        for attribute in element.attributes.values():
            for chain in _EITHER.findall(_ARGUMENT.sub(r"\1", attribute)):
                named = {aliases.get(it, it) for it in chain.split()[::2]}
                found |= named if name in named else set()
    return found - {name}


def _is_xacro(element: Element) -> bool:
    return element.tag.startswith("xacro:")


def defaults(documents: Iterable[XmlDocument]) -> dict[str, str]:
    """Return the arguments that files declare, with their defaults."""
    args = (it for document in documents for it in document.elements if it.tag == "xacro:arg")
    return {arg.get("name") or "": arg.get("default") or "" for arg in args}


def _aliases(elements: Iterable[Element]) -> dict[str, str]:
    """Return the arguments whose values properties and parameters of macros have, by their name."""
    found: dict[str, str] = {}
    for element in elements:
        given = {} if element.tag in _NO_CALLS else element.attributes
        if element.tag == "xacro:property":
            given = {element.get("name") or "": element.get("value") or ""}
        matches = ((name, _ARGUMENT.fullmatch(value)) for name, value in given.items())
        found |= {name: match[1] for name, match in matches if match}
    return found


def _compared_values(
    package: Package, element: Element, values: Mapping[str, str], aliases: Mapping[str, str]
) -> Iterator[tuple[str, str]]:
    if element.tag in ("xacro:if", "xacro:unless"):
        test = _ARGUMENT.sub(r"\1", element.get("value") or "")
        yield from ((name, text or number) for name, text, number in _COMPARED.findall(test))
        whole = _WHOLE.fullmatch(test)
        flag = whole[1] if whole else test
        value = values.get(aliases.get(flag, ""), "")
        if value in _OPPOSITES:
            yield flag, _OPPOSITES[value]
    elif element.tag == "xacro:include":
        yield from _of_file_name(package, element)


def _of_file_name(package: Package, element: Element) -> Iterator[tuple[str, str]]:
    """Yield the values that lead to a file that is there, of a name with one argument in it.

    The argument may be in it several times: `arms/$(arg model)/$(arg model).xacro`.
    """
    name = _WHOLE.sub(r"$(arg \1)", element.get("filename") or "")
    arguments = set(_ARGUMENT.findall(name))
    if len(arguments) != 1:
        return
    argument, mark = arguments.pop(), "@@"
    folder = posixpath.dirname(path_of(package, element.source.file))
    path = named_path(folder, _ARGUMENT.sub(mark, name))
    if path is None:
        return
    before, between, *further = path.split(mark)
    for file in package.index.with_suffix(".xacro", ".urdf"):
        whole = path_of(package, file.path)
        rest = whole.removeprefix(before)
        value = rest.split(between or None, 1)[0] if further else rest.removesuffix(between)
        if whole == path.replace(mark, value) and _VALUE.fullmatch(value):
            yield argument, value
