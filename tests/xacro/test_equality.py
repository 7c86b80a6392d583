"""Expressions come to what xacro itself makes of them."""

from __future__ import annotations

from typing import Any

import pytest
import xacro
from hypothesis import HealthCheck, given, settings

from checker.formats.xacro.expression.bounds import RefusedExpression
from checker.formats.xacro.expression.builtins import FUNCTIONS
from checker.formats.xacro.expression.evaluation import evaluate
from checker.formats.xacro.symbols import global_symbols
from tests.effort import examples
from tests.xacro.grammar import EXPRESSIONS
from tests.xacro.oracle import native_outcome, shown

USED = (
    "y.a.b[1].c",
    "y['a']['b']",
    "y.a.b[0:1]",
    "y.nothing",
    "y['nothing']",
    "y.a.b.c",
    "y.items()",
    "y.get('a')",
    "list(y.keys())",
    "[x.c for x in z if x]",
    "z[0].c",
    "z + [1]",
    "list(z)",
    "sorted(y)",
    "len(z)",
    "'a' in y",
    "z[0] == {'c': 5}",
    "xacro.dotify(d).b[0]",
    "d.a",
    "n.a",
    "'a'.b",
    "d['a']",
    "d['c']",
    "t[7]",
    "t['a']",
    "s[1:-1:2]",
    "s[::-1]",
    "[n, *t, *s]",
    "{**d, 'c': 2}",
    "dict(d, e=1)",
    "dict(**d)",
    "max(*t)",
    "max([], default=1)",
    "'{} {a:>5}'.format(n, a=s)",
    "'{0:.2f}{0!r}'.format(r)",
    "'%5.1f|%s' % (r, t)",
    "'%(a)d' % d",
    "f'{n:03d} {s!r:>12} {r:{n}.1f}'",
    "s.split('_')[0].title()",
    "'-'.join(s.split('_'))",
    "sorted(t, key=abs)",
    "sorted(t, key=lambda v: -v)",
    "min(t, key=lambda v, w=2: v * w)",
    "list(map(lambda x: x + n, t))",
    "list(map(lambda a, b: a * b, t, t))",
    "list(map(float, t))",
    "list(filter(None, [0, 1]))",
    "list(filter(lambda x: x > 0, t))",
    "list(zip(t, s))",
    "[[i * j for i in t] for j in t if j]",
    "{k: v for k, v in d.items()}",
    "{len(x) for x in s}",
    "sum(x for x in t)",
    "any(x > 3 for x in t)",
    "python.all(t)",
    "python.sum([[1], [2]], [])",
    "[i for i, j in t]",
    "[i for i, j in ['abc']]",
    "[y for x in [1] for y in [y]]",
    "1 < n < 5 != 2",
    "n if t else s",
    "t and s or n",
    "not t",
    "-n ** 2",
    "~n",
    "n // 0",
    "7 % -3",
    "python.isinstance(n, (int, python.str))",
    "python.divmod(7, 2)",
    "round(2.5)",
    "round(r, 1)",
    "int('0x1f', 16)",
    "int('x')",
    "float('nan')",
    "bool('')",
    "str(t)",
    "str()",
    "list('ab')",
    "pi",
    "math.pi * radians(90)",
    "sqrt(-1)",
    "math.floor(2.7)",
    "hypot(3, 4)",
    "math.inf",
    "math.factorial(20)",
    "math.comb(9, 3)",
    "math.prod(t)",
    "fsum([.1] * 10)",
    "math.lcm(4, 6)",
    "nothing",
    "t.append(1)",
    "t.nothing",
    "t.sort(reverse=True)",
    "t.index(4)",
    "t()",
    "s()",
    "xacro.tokenize('a, b;c')",
    "xacro.tokenize('a-b', '-')",
    "xacro.abs_filename('/a')",
    "xacro.warning('x')",
    "math.nothing",
    "xacro.nothing",
    "range(3)",
    "list(range(5, 0, -2))",
    "len(map(str, t))",
    "map(str, t)[0]",
    "s * 3",
    "t * 2",
    "t + s",
    "'a' 'b'",
    "s in s",
    "1 in s",
    "list(python.reversed(t))",
    "dict(python.enumerate(s))",
    "python.set(t) & {1.5}",
    "{1} | {2}",
    "True + 1",
    "None",
    "None == n",
    "n is None",
    "'x'.replace('x', 'yz')",
    "'a\\tb'.expandtabs(4)",
)


def nothing(*_: Any) -> Any:
    raise FileNotFoundError


def names() -> dict[str, Any]:
    return {
        **FUNCTIONS,
        **global_symbols(nothing),
        "n": 3,
        "r": 0.25,
        "s": "front_left",
        "t": [1.5, -2, 4],
        "d": {"a": 1, "b": [2]},
        "y": xacro.YamlDictWrapper(a={"b": [1, {"c": 2}]}, items=3),
        "z": xacro.YamlListWrapper([{"c": 5}, [6]]),
    }


def outcome(expression: str) -> str:
    try:
        return shown(evaluate(expression, names()))
    except Exception as error:  # noqa: BLE001 - whatever it is
        return type(error).__name__


@settings(max_examples=examples(800), suppress_health_check=list(HealthCheck))
@given(EXPRESSIONS)
def test_generated_expressions(expression: str) -> None:
    try:
        found = shown(evaluate(expression, names()))
    except RefusedExpression as refusal:
        # A root of a negative number, or a function that was built in where none may stand.
        assert "complex" in str(refusal)  # noqa: PT017
        return
    except Exception as error:  # noqa: BLE001 - compared below
        found = type(error).__name__
    assert found == native_outcome(expression, names())


@pytest.mark.parametrize(
    "expression",
    USED,
)
def test_what_robots_use(expression: str) -> None:
    assert outcome(expression) == native_outcome(expression, names())
