"""Rules for the new name of a thing."""

from __future__ import annotations

import keyword
import re

from checker.editor.names.mention import NameKind
from checker.editor.names.readers.expressions import EXPRESSION, expressions, is_composed
from checker.editor.names.readers.plugin_names import RESERVED

_PART = re.compile(r"[\w.-]+")
_PART_LIMIT = 200
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
_MACRO = re.compile(r"[A-Za-z_][\w.-]*")
_TOPIC = re.compile(r"[A-Za-z0-9_.-]+(?:/[A-Za-z0-9_.-]+)*")
_NUMBER = re.compile(r"[+-]?(?:\d[\d_]*\.?[\d_]*|\.\d+)(?:[eE][+-]?\d+)?|0[xob][\da-fA-F_]+")
_YAML_WORDS = frozenset({"true", "false", "yes", "no", "on", "off", "null", "y", "n"})
_XACRO_WORDS = frozenset(
    (
        *(
            "pi",
            "e",
            "tau",
            "inf",
            "nan",
            "sin",
            "cos",
            "tan",
            "sqrt",
            "radians",
            "degrees",
            "math",
        ),
        *("python", "xacro", "True", "False", "len", "str", "float", "int", "list", "dict", "min"),
        *("max", "abs", "round", "range", "load_yaml", "pow", "floor", "ceil", "atan2", "map"),
    )
)
_PARTS = frozenset({NameKind.LINK, NameKind.JOINT, NameKind.FRAME})
_XACRO_TAGS = frozenset(
    (
        *("macro", "property", "arg", "include", "insert_block", "if", "unless", "element"),
        *("attribute", "call"),
    )
)


def invalid(kind: NameKind, old: str, new: str) -> str:
    """Return why a thing cannot have a name; empty if it can.

    Args:
        kind: The kind of the thing.
        old: Its name as it is written.
        new: The new name.
    """
    shown = f"{new!r} is not a name for a {kind}"
    if is_composed(old) or is_composed(new):
        if expressions(old) != expressions(new):
            return f"{shown}: it must keep the expressions of {old!r}"
        old, new = EXPRESSION.sub("x", old), EXPRESSION.sub("x", new)
    if len(new) > _PART_LIMIT:
        return f"{shown}: it is longer than {_PART_LIMIT} characters"
    if kind in _PARTS and "/" in old:
        new = new.replace("/", "_")  # a robot that has such names may have another one
    if kind is NameKind.MACRO and new in _XACRO_TAGS:
        return f"{shown}: xacro:{new} is an element of xacro"
    if kind in (NameKind.PROPERTY, NameKind.ARGUMENT):
        return _invalid_identifier(kind, new, shown)
    pattern, rule = _SPELLINGS.get(kind, (_PART, "use letters, digits, '_', '-' and '.'"))
    if not pattern.fullmatch(new):
        return f"{shown}: {rule}"
    return _invalid_part(new, shown) if pattern is _PART else ""


_SPELLINGS = {
    NameKind.TOPIC: (_TOPIC, "use letters, digits, '_', '-', '.', with '/' between steps"),
    NameKind.MACRO: (_MACRO, "use letters, digits, '_', '-', '.', and start with a letter"),
}


def _invalid_identifier(kind: NameKind, new: str, shown: str) -> str:
    if not _IDENTIFIER.fullmatch(new):
        return f"{shown}: use letters, digits and '_', and start with a letter"
    if keyword.iskeyword(new) or (kind is NameKind.PROPERTY and new in _XACRO_WORDS):
        return f"{shown}: it means something else in an expression"
    return ""


def _invalid_part(new: str, shown: str) -> str:
    if new in RESERVED or (new.startswith("__") and new.endswith("__")):
        return f"{shown}: SDFormat reserves it"
    if _NUMBER.fullmatch(new) or new.lower() in _YAML_WORDS:
        return f"{shown}: YAML reads it as a value that is no text"
    return ""
