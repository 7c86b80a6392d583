"""Expressions as people and chance write them: mostly of fitting types, sometimes not."""

from __future__ import annotations

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

Text = SearchStrategy[str]


def _filled(pattern: str, *parts: Text) -> Text:
    return st.tuples(*parts).map(lambda found: pattern.format(*found))


def _one(*words: str) -> Text:
    return st.sampled_from(words)


_NUMBER = st.one_of(
    st.integers(0, 99).map(str),
    st.floats(0, 1e6, allow_nan=False).map(repr),
    _one("n", "r", "pi", "True", "-1", "0", "1e-3", "inf", "t[0]", "d['a']", "y.a.b[0]"),
)
_STRING = st.one_of(
    st.text("ab_ %{}é\t", max_size=6).map(repr), _one("s", "s[0]", "''", "'3.5'", "'7'", "'x'")
)
_LIST = _one("t", "[]", "[1, 2]", "['a', 'b']", "(1, 2)", "range(4)", "z", "d['b']", "{1, 2}")
_DICT = _one("d", "y", "{}", "{'a': 1}", "{1: 'x', 2: 'y'}")
_ARITHMETIC = _one("+", "-", "*", "/", "//", "%", "&", "|", "^")
_COMPARISON = _one("==", "!=", "<", "<=", ">", ">=", "in", "not in")
_UNARY = _one(
    *("abs", "round", "int", "float", "bool", "sin", "cos", "sqrt", "radians", "math.floor"),
    *("degrees", "exp", "log", "math.ceil", "fabs", "math.isnan", "math.atan", "str"),
)
_OF_TEXT = _one(
    *("upper()", "lower()", "strip()", "title()", "split()", "split('_')", "replace('a', 'bc')"),
    *("startswith('a')", "endswith('t')", "find('_')", "count('a')", "zfill(5)", "center(9, '*')"),
    *("ljust(7)", "join(['x', 'y'])", "partition('_')", "isdigit()", "splitlines()", "rfind('t')"),
    *("expandtabs(3)", "format(1, a=2)", "capitalize()", "rsplit('_', 1)", "index('q')", "nope()"),
)
_OF_LIST = _one("count(1)", "index(2)", "copy()", "pop()", "append(1)", "reverse()", "extend(t)")
_OF_DICT = _one("get('a')", "keys()", "items()", "pop('q', 1)", "copy()", "setdefault(1)")
_FORMAT = _one("", ":.2f", ":>8", ":03d", "!r", "!s:^9", ":+e", ":x", ":,", ":q", ":>{n}", ":%")
_PERCENT = _one("%d", "%5.2f", "%s", "%r", "%%", "%x", "%-8s|", "%+.3e", "%c", "%(a)s", "%g %s")
_OF_TWO = _one("atan2", "pow", "max", "min", "round", "divmod", "fmod")
_KEY = _one("str", "lambda v: -v", "None")
_COLLECTING = _one("len", "sum", "min", "max", "sorted", "list", "tuple", "set", "any", "all")


def _more(inner: Text) -> Text:
    """Return expressions made of others."""
    return st.one_of(
        _filled("({} {} {})", inner, _ARITHMETIC, inner),
        _filled("({} {} {})", _NUMBER, _ARITHMETIC, inner),
        _filled("({} {} {})", inner, _COMPARISON, inner),
        _filled("({} < {} <= {})", inner, inner, inner),
        _filled("({} ** {})", inner, _one("2", "3", "0.5", "-1", "0")),
        _filled("({} {} {})", inner, _one("<<", ">>"), _one("0", "3", "-1")),
        _filled("({} {} {})", inner, _one("and", "or"), inner),
        _filled("({} if {} else {})", inner, inner, inner),
        _filled("({}{})", _one("-", "+", "~", "not "), inner),
        _filled("{}({})", _UNARY, inner),
        _filled("{}({})", _COLLECTING, inner),
        _filled(
            "{}({}, {})",
            _one("atan2", "pow", "max", "min", "round", "divmod", "fmod"),
            inner,
            inner,
        ),
        _filled("[{}, {}, *{}]", inner, inner, _LIST),
        _filled("({}, {})", inner, inner),
        _filled("{{{}, {}}}", inner, _NUMBER),
        _filled("{{'k': {}, {}: 2}}", inner, inner),
        _filled("{}[{}]", inner, _one("0", "-1", "1:", ":2", "::-1", "'a'", "9", "n")),
        _filled("[x for x in {} if {}]", inner, _one("x", "x != 2", "not x", "True")),
        _filled("[({}, x) for x in {} for n in t]", inner, inner),
        _filled("{{x: {} for x in {}}}", inner, inner),
        _filled("list(x == {} for x in {})", inner, inner),
        _filled("[a for a, b in {}]", inner),
        _filled("list(map({}, {}))", _one("float", "str", "abs", "lambda v: v * 2", "len"), inner),
        _filled("list(filter({}, {}))", _one("None", "lambda v: v", "bool", "3"), inner),
        _filled("sorted({}, key={}, reverse={})", inner, _KEY, inner),
        _filled("list(zip({}, {}))", inner, inner),
        _filled("list(enumerate({}, {}))", inner, _NUMBER),
        _filled("list(reversed({}))", inner),
        _filled("isinstance({}, {})", inner, _one("int", "str", "(list, dict)", "float")),
        _filled("({}).{}", inner, st.one_of(_OF_TEXT, _OF_LIST, _OF_DICT)),
        _filled("({} % {})", _PERCENT.map(repr), inner),
        _filled('f"{{{}{}}}"', _NUMBER.filter(lambda text: "'" not in text), _FORMAT),
        _filled("{}.format({})", _one("'{}'", "'{0:>9}'", "'{:.3f}'", "'{} {}'", "'{a}'"), inner),
    )


EXPRESSIONS: Text = st.one_of(
    st.recursive(st.one_of(_NUMBER, _STRING, _LIST, _DICT), _more, max_leaves=6),
    _filled("{}.{}", _STRING, _OF_TEXT),
    _filled("{}.{}", _LIST, _OF_LIST),
    _filled("{}.{}", _DICT, _OF_DICT),
    _more(_NUMBER),
    _more(_STRING),
    _more(_LIST),
)
