"""A name in the expressions of a macro that nothing defines.

No available file calls the macro, so the fault is not visible yet: xacro fails with "name 'x' is
not defined" when the macro is called. A name counts as defined where any available file has a
property of that name, or a macro with such a parameter: a macro sees the names of its caller.
Packages that include files which are not available are not judged. Names in braces without a dollar
sign, such as `{prefix}`, are kept as text, and become part of the name of a link.

Fix: define the property, correct the name, or write `${prefix}`.
Source: xacro, `eval_text` and `handle_macro_call`.
"""

import builtins
import math
import re
from collections.abc import Iterable, Iterator

from checker.base.words import Suggestions
from checker.formats.urdf.macro_calls import macro_around
from checker.formats.xacro.files import local_path, named_path, path_of
from checker.formats.xacro.names import EXPRESSION, names_in, parameters_of
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.xml import Element, XmlDocument

_XACRO = "xacro:"
_MACRO, _PROPERTY, _INCLUDE = "xacro:macro", "xacro:property", "xacro:include"
_BINDS = re.compile(r"\bfor\b|\blambda\b")
_SYMBOLS = {*dir(math), *dir(builtins), "math", "python", "xacro", "load_yaml", "dotify"}
_BRACES = re.compile(r"(?<![$\\])\{([A-Za-z_]\w{0,100})\}")


@rule("URD026", "undefined-name-in-macro", Severity.WARNING, Concern.ROBOT)
def check(package: Package) -> Findings:
    """Report the names that no property, parameter or symbol of xacro has."""
    files = {file.path: package.xml(file.path) for file in package.index.with_suffix(".xacro")}
    documents = {path: it for path, it in files.items() if isinstance(it, XmlDocument)}
    for path, document in documents.items():
        for element in document.root.descendants(_INCLUDE):
            if not _is_at_hand(package, path, element.get("filename") or ""):
                yield unchecked(f"{path} includes {element.get('filename')}, which is not read")
                return
    at_hand = list(_at_hand(package))
    defined = {name for each in at_hand for name in _defined_names(each)}
    if any("$" in name for name in defined):
        yield unchecked("names of properties are computed")
        return
    called = _called_macros(at_hand)
    for document in documents.values():
        for macro in document.root.descendants(_MACRO):
            if _name(macro) not in called:
                yield from _undefined_names(macro, defined)


def _is_at_hand(package: Package, path: str, name: str) -> bool:
    """Return whether an included file was found; one whose name is computed was not."""
    named = named_path(path_of(package, path).rpartition("/")[0], name)
    local = local_path(package, named) if named is not None else None
    return local is not None and isinstance(package.xml(local), XmlDocument)


def _at_hand(package: Package) -> Iterator[XmlDocument]:
    """Yield all xacro files of the workspace."""
    for other in {id(it): it for it in (package, *package.workspace.packages.values())}.values():
        for file in other.index.with_suffix(".xacro"):
            document = other.xml(file.path)
            if isinstance(document, XmlDocument):
                yield document


def _called_macros(documents: Iterable[XmlDocument]) -> set[str]:
    """Return the names of macros that a robot calls, or a macro that one calls."""
    calls: dict[str, set[str]] = {}
    for document in documents:
        for element in document.elements:
            if element.tag.startswith(_XACRO):
                macro = macro_around(element)
                around = _name(macro) if macro is not None else ""
                calls.setdefault(around, set()).add(element.tag.removeprefix(_XACRO))
    called, waiting = set[str](), [""]
    while waiting:
        new = calls.get(waiting.pop(), set()) - called
        called |= new
        waiting += new
    return called


def _name(macro: Element) -> str:
    return (macro.get("name") or "").removeprefix(_XACRO)


def _defined_names(document: XmlDocument) -> Iterator[str]:
    for element in document.elements:
        if element.tag == _PROPERTY:
            yield element.get("name") or ""
        elif element.tag == _MACRO:
            yield from (it.name for it in parameters_of(element.get("params") or ""))
        elif element.tag == _INCLUDE and element.get("ns"):
            yield element.get("ns") or ""


def _undefined_names(macro: Element, defined: set[str]) -> Iterator[Finding]:
    suggestions = Suggestions(sorted(defined))
    for element in macro.descendants():
        for attribute, value in element.attributes.items():
            place = element.attribute(attribute) or element
            where = f"in macro {macro.get('name')!r}"
            for name in _names(EXPRESSION.findall(value)) - defined - _SYMBOLS:
                yield finding(
                    place,
                    f"{name!r} {where} is not defined: xacro fails when the macro is called"
                    f"{suggestions.hint(name)}",
                    key=name,
                )
            for name in _BRACES.findall(EXPRESSION.sub("", value)):
                if name in defined:
                    yield finding(
                        place,
                        f"{{{name}}} {where} is kept as text: expected ${{{name}}}",
                        key=name,
                    )


def _names(expressions: Iterable[str]) -> set[str]:
    return {name for it in expressions if not _BINDS.search(it) for name in names_in(it)}


def _arm(inside: str, more: str = "") -> object:
    return {
        "@urdf": True,
        "urdf/grip.xacro": f"""<robot name="grip" xmlns:xacro="http://ros.org/wiki/xacro">
{more}
<xacro:property name="width" value="0.1"/>
<xacro:macro name="grip" params="prefix parent *origin">
  {inside}
</xacro:macro>
</robot>
""",
    }


_MARK = "  <!-- ^ URD026 -->"
GOOD = [
    _arm('<link name="${prefix}finger"/><link name="${width * pi}"/>'),
    _arm("<link name=\"${'left' if prefix == 'l' else 'right'}\"/>"),
    _arm('<link name="${max(width, 2)} {other}"/>'),
    _arm('<link name="${$(arg size) * width}"/>'),
    _arm('<link name="${sum([x for x in sizes])}"/>'),
]
BAD = [
    _arm(f'<link name="${{widht}}"/>{_MARK}'),
    _arm(f'<link name="{{prefix}}finger"/>{_MARK}'),
]
