"""`$(…)`: what is put in, what is left alone, what is wrong."""

from __future__ import annotations

import string

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.launch.ros1.graph import LaunchFaultKind as Kind
from checker.launch.ros1.substitution import (
    ExpressionFault,
    Unknown,
    evaluate,
    is_known,
    substitute,
)

ARGS = {"name": "X1", "n": "3", "f": "1.5", "on": "true", "empty": "", "env": "$(env HOME)"}
TEXT = st.text(alphabet=string.printable, max_size=60)
PIECES = st.lists(
    st.sampled_from(["$(", ")", "arg ", "eval ", "find p", "name", "$", "(", "'", "n", " == ", "1"])
).map("".join)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("/model/$(arg name)/pose", "/model/X1/pose"),
        ("$(arg name)$(arg n)", "X13"),
        ("$( arg name )", "X1"),
        ("$(dirname)/a.launch", "./launch/a.launch"),
        ("$(arg env)", "$(env HOME)"),
        ("plain (text) $5", "plain (text) $5"),
    ],
)
def test_known_substitutions_are_made(text, expected):
    result = substitute(text, ARGS, "./launch")
    assert result.text == expected
    assert result.faults == ()


@pytest.mark.parametrize(
    "text", ["$(env HOME)", "$(optenv A b c)", "$(find p)/x", "$(anon n)", "$(eval env('A'))"]
)
def test_what_the_machine_knows_stays_as_written(text):
    result = substitute(text, ARGS, "./launch")
    assert result.text == text
    assert result.faults == ()
    assert not is_known(result.text)


@pytest.mark.parametrize("text", ["$(arg)", "$(arg a b)", "$(agr name)", "$()", "$(eval 1 +)"])
def test_what_roslaunch_refuses_is_a_fault(text):
    result = substitute(text, ARGS, "./launch")
    assert [fault.kind for fault in result.faults] == [Kind.SUBSTITUTION]
    assert result.text == text


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("n == 3", True),
        ("n > 3 or name == 'X1'", True),
        ("not on", False),
        ("arg('name') != ''", True),
        ("empty != ''", False),
        ("1 < n < 4", True),
        ("n + 1", 4),
        ("n * f", 4.5),
        ("-n % 2", 1),
        ("'a' + name", "aX1"),
        ("on and n == 3 and true", True),
        ("name.upper() + str(n)", "X13"),
        ("1 if on else 2", 1),
        ("int('2') + ceil(e)", 5),
    ],
)
def test_expressions(expression, value):
    result = evaluate(expression, ARGS)
    assert result == value
    assert type(result) is type(value)


@pytest.mark.parametrize(
    "expression",
    [
        "__import__('os').system('x')",
        "[x for x in (1,)]",
        "9 ** 9 ** 9",
        "env == ''",
        "(lambda: 1)()",
        "10" + " * 1000000" * 40,
        "not " * 90 + "on",
        "1" * 500,
    ],
)
def test_everything_beyond_the_language_is_not_known(expression):
    assert evaluate(expression, ARGS) == Unknown()


@pytest.mark.parametrize("expression", ["nobody == 1", "arg('nobody')"])
def test_an_undeclared_arg_in_an_expression_is_a_fault(expression):
    result = evaluate(expression, ARGS)
    assert isinstance(result, ExpressionFault)
    assert result.undeclared == "nobody"


@pytest.mark.parametrize(
    "expression", ["1 / 0", "int(name)", "name < 3", "name - 1", "1 +", "$(arg n) > 1"]
)
def test_an_expression_that_python_refuses_is_a_fault(expression):
    result = evaluate(expression, ARGS)
    assert isinstance(result, ExpressionFault)
    assert not result.undeclared


@given(TEXT | PIECES)
def test_no_text_makes_a_substitution_raise(text):
    result = substitute(text, ARGS, "./launch")
    assert all(0 <= fault.start < fault.end <= len(text) for fault in result.faults)
    if "$(" not in text:
        assert result.text == text


@given(TEXT | PIECES)
def test_no_text_makes_an_expression_raise(text):
    assert isinstance(evaluate(text, ARGS), str | int | float | Unknown | ExpressionFault)


@pytest.mark.parametrize("opening", ["(", "[", "-", "not ", "arg("])
def test_deeply_nested_expressions_are_refused_without_recursion(opening):
    assert isinstance(evaluate(opening * 100_000, ARGS), Unknown | ExpressionFault)
    assert isinstance(evaluate(opening * 99, ARGS), Unknown | ExpressionFault)
