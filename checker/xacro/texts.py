"""Evaluates texts of xacro files, which mix plain words, `${…}` and `$(…)`: as xacro, bounded."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import Any

import xacro

from checker.xacro.expression.bounds import Allowance, Budget, ExpressionLimit
from checker.xacro.expression.values import weigh

LENGTH_LIMIT = 2_000_000
"""Characters that one text may come to."""
_TOKEN = re.compile(
    r"\$(?P<escaped>\$+[{(])|\$\{(?P<expression>[^}]*)\}|\$\((?P<extension>[^)]*)\)"
    r"|(?P<words>[^$]+|\$[^{($]+|\$$)"
)


def text_value(text: str, symbols: Any, allowance: Allowance) -> Any:
    """Return what a text comes to; if it is one expression alone, that value as it is.

    Stands in for `xacro.eval_text`.

    Raises:
        xacro.XacroException: It is no such text, or an expression in it fails.
        ExpressionLimit: It would be too long.
    """
    results = [_result(token, symbols) for token in _tokens(text)]
    if len(results) == 1:
        return results[0]
    budget = Budget(allowance)
    try:
        for each in results:
            if type(each) is not str:
                weigh(each, budget)
        shown = [str(each) for each in results]
    finally:
        budget.close()
    if sum(map(len, shown)) > LENGTH_LIMIT:
        raise ExpressionLimit(f"comes to more than {LENGTH_LIMIT} characters")
    return "".join(shown)


def _tokens(text: str) -> Iterator[re.Match[str]]:
    """Yield the parts of a text; what xacro cannot read counts one part earlier, as there."""
    position, before = 0, None
    while position < len(text):
        token = _TOKEN.match(text, position)
        if token is None:
            raise xacro.XacroException("invalid expression: " + text[position:])
        if before is not None:
            yield before
        before, position = token, token.end()
    if before is not None:
        yield before


def _result(token: re.Match[str], symbols: Any) -> Any:
    kind, part = str(token.lastgroup), token[str(token.lastgroup)]
    if kind == "expression":
        try:
            return xacro.safe_eval(xacro.eval_text(part, symbols), symbols)
        except Exception as error:
            suffix = f"{os.linesep}when evaluating expression '{part}'"
            raise xacro.XacroException(exc=error, suffix=suffix) from error
    if kind == "extension":
        # As in xacro, where what is not text is written as Python writes it.
        return xacro.eval_extension("$(%s)" % xacro.eval_text(part, symbols))  # noqa: UP031
    return part
