"""What we read is, byte for byte, what the real Ruby prints."""

import math

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from checker.launch.spawner.reader import (
    EXECUTABLES_ARGUMENTS,
    SPAWNER_ARGUMENTS,
    Unread,
)
from tests.effort import examples

from .snippets import SNIPPETS

SPAWNER_CALLS = [
    (list(SPAWNER_ARGUMENTS), False),
    (list(SPAWNER_ARGUMENTS), True),
    (["X1", "https://fuel/x1", "tunnel", 0, 0, 0, 0, 0, 0], False),
    (["a b", "model://b", "cave_01", 1, -2, 3, 0, 1, -1], True),
    (["é<&>", "u", "w", 0.1, 1e-05, 0.2, -0.0, 3.141592653589793, 1e20], False),
    (["r", "u", "w", -10.7, 1e16, 123456789.123, 2.5e-08, 0.5, 100.0], True),
]
EXECUTABLES_CALLS = [
    (list(EXECUTABLES_ARGUMENTS), False),
    (["X1", "tunnel"], True),
    (["a b", "cave é"], False),
    (["", "'\""], True),
]


def test_every_package_emits_what_ruby_prints(corpus, ruby):
    packages = sorted(p.parent.parent.name for p in corpus.root.glob("*/launch/spawner.rb"))
    assert packages
    calls = [
        *(["spawner", *call] for call in SPAWNER_CALLS),
        *(["rosExecutables", *call] for call in EXECUTABLES_CALLS),
    ]
    for package in packages:
        # One process for each package, since the packages define the same functions.
        file = corpus.root / package / "launch" / "spawner.rb"
        [expected] = ruby.run([(file.resolve(), calls)])
        spawner = corpus.spawner(package)
        assert spawner.unread == ()
        assert spawner.syntax_faults == ()
        for (name, arguments, truth), text in zip(calls, expected, strict=True):
            emitted = spawner.evaluate(name, arguments, ground_truth=truth)
            assert not isinstance(emitted, Unread), (package, emitted)
            assert emitted.text == text, (package, name, arguments, truth)


@pytest.fixture(scope="module")
def real_snippets(ruby, tmp_path_factory):
    folder = tmp_path_factory.mktemp("snippets")
    jobs = []
    for number, text in enumerate(SNIPPETS.values()):
        file = folder / f"{number}.rb"
        file.write_bytes(text.encode())
        jobs.append((file, [("f", [], False)]))
    return dict(zip(SNIPPETS, [result for [result] in ruby.run(jobs)], strict=True))


@pytest.mark.parametrize("habit", SNIPPETS)
def test_habit(habit, emit, real_snippets):
    emitted = emit(SNIPPETS[habit])
    if isinstance(emitted, Unread):
        assert emitted.reason.startswith("raises "), emitted.reason
        assert "!" + emitted.reason.split()[1].rstrip(":") == real_snippets[habit]
    else:
        assert emitted.text == real_snippets[habit]


# Each example is a batch of values for one Ruby process; shrinking it would start hundreds.
in_batches = settings(
    max_examples=examples(5),
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.generate],
    database=None,
)

finite = st.floats(allow_nan=False, allow_infinity=False) | st.floats(-100, 100)
numbers = finite | st.integers(-(10**18), 10**18) | st.integers(-9, 9)


def ruby_number(number):
    return f"({number!r})" if isinstance(number, int) or math.isfinite(number) else "0"


@in_batches
@given(
    st.lists(
        st.tuples(numbers, st.sampled_from(["+", "-", "*", "/", "%", "<", ">="]), numbers),
        min_size=200,
        max_size=400,
    )
)
def test_arithmetic_and_its_text(ruby, emit, tmp_path, operations):
    lines = [
        f"begin; s << ({ruby_number(a)} {sign} {ruby_number(b)}).to_s; "
        f"rescue ZeroDivisionError; s << 'zero'; end; s << '|'"
        for a, sign, b in operations
    ]
    compare(ruby, emit, tmp_path, lines)


@in_batches
@given(st.lists(st.tuples(finite, st.integers(0, 14)), min_size=200, max_size=400))
def test_rounding(ruby, emit, tmp_path, cases):
    lines = [f"s << {ruby_number(a)}.round({digits}).to_s + '|'" for a, digits in cases]
    compare(ruby, emit, tmp_path, lines)


@in_batches
@given(st.lists(st.decimals(-100, 100, places=5), min_size=100, max_size=200))
def test_format(ruby, emit, tmp_path, numbers):
    """Numbers next to a rounding limit are refused, and rounded by nobody here."""
    lines = [f"s << format('%.3f %.1f %d|', {n}1, {n}1, {n}1)" for n in numbers]
    compare(ruby, emit, tmp_path, lines)


def compare(ruby, emit, tmp_path, lines):
    text = "def f\n  s = ''\n  " + "\n  ".join(lines) + "\n  s\nend\n"
    file = tmp_path / "f.rb"
    file.write_text(text)
    [[expected]] = ruby.run([(file, [("f", [], False)])])
    emitted = emit(text)
    assert not isinstance(emitted, Unread), emitted.reason
    ours, theirs = emitted.text.split("|"), expected.split("|")
    differing = [row for row in zip(lines, ours, theirs, strict=False) if row[1] != row[2]]
    assert differing == []
    assert len(ours) == len(theirs)
