"""What a rule tells of its options: each is explained, in a form that a settings file takes."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from checker.base.cache import Cache, cache_folder
from checker.cli.rule import page_text
from checker.engine.judge import Judge
from checker.engine.review import run_and_set_aside
from checker.engine.run import Outcome
from checker.engine.subject import Subject
from checker.finding import Severity
from checker.package.inputs import open_input
from checker.report.report import Cause
from checker.rule import Concern, Findings, Rule
from checker.rule_testing import profile_of, write_example
from checker.rulebook.discovery import all_rules
from checker.rulebook.options import Option, option_texts, options_of, work_of
from checker.settings import Settings
from tests.each import of_each

RULES = [
    rule
    for rule in all_rules()
    if rule.check.__module__.startswith("rules.") and (rule.options or option_texts(rule))
]


def made(check: object) -> Rule:
    return Rule("KIN900", "made-up", Severity.INFO, Concern.ROBOT, check, "Made up.")  # type: ignore[arg-type]


def test_sections_are_read() -> None:
    def check(*, least: float = 0.5, names: object = ("a", 'b"'), on: bool = True) -> Findings:
        """Report little.

        More: not an option.

        Options:
            least: Metres; `what` is less
                is reported: always.
            names: Who is passed over.
        """
        del least, names, on
        yield from ()

    rule = made(check)
    assert work_of(rule) == "Report little.\n\nMore: not an option."
    assert options_of(rule) == (
        Option("least", "0.5", "Metres; `what` is less is reported: always."),
        Option("names", '["a", "b\\""]', "Who is passed over."),
        Option("on", "true", ""),
    )


def test_a_function_without_a_docstring_tells_nothing() -> None:
    def check(*, least: float = 0.5) -> Findings:
        del least
        yield from ()

    assert (work_of(made(check)), option_texts(made(check))) == ("", {})
    assert options_of(made(check)) == (Option("least", "0.5", ""),)


@of_each("rule", RULES, ids=lambda rule: rule.id)
def test_every_option_is_explained_and_nothing_else(rule: Rule) -> None:
    words = option_texts(rule)
    assert list(words) == list(rule.options)
    for name, said in words.items():
        assert said[0].isupper() or said[0] in "`0123456789", name
        assert said.endswith("."), name
        assert 20 <= len(said) <= 200, name
        assert "|" not in said, name


@of_each("rule", RULES, ids=lambda rule: rule.id)
def test_what_is_printed_can_be_pasted_into_settings(rule: Rule) -> None:
    _, _, after = page_text(rule).partition(f"below [rules.{rule.id}]:\n")
    lines = after.partition("\n\n")[0]
    read = {
        name: tuple(value) if isinstance(value, list) else value
        for name, value in tomllib.loads(lines).items()
    }
    assert read == rule.options


ODD = {float: (0, 1e-300, 1e300), int: (0, 1, 10**30), str: ("", "(", "\0/\\"), tuple: ([],)}
"""Values of the right type that nobody means, by the type of the default."""


@contextmanager
def example_of(rule: Rule, number: int, folder: Path) -> Iterator[Callable[..., Outcome]]:
    """Yield what runs a rule with options on one of its bad examples, or a good one below 0."""
    example = rule.bad[number] if number >= 0 else rule.good[number]
    with open_input(write_example(example, folder)) as opened:
        subject = Subject(opened.packages[0], Cache(cache_folder()))

        def run(**options: object) -> Outcome:
            settings = Settings(options={rule.id: options}, thorough=True)
            judge = Judge(profile_of(rule, example), settings)
            return run_and_set_aside([rule], all_rules(), subject, judge)

        yield run


@pytest.mark.slow
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.id)
def test_odd_values_stop_no_rule(rule: Rule, tmp_path: Path) -> None:
    with example_of(rule, 0, tmp_path) as run:
        for name, default in rule.options.items():
            for value in ODD.get(type(default), ()):
                unseen = run(**{name: value}).not_checked
                assert Cause.CRASHED not in {each.cause for each in unseen}, (name, value)


@pytest.mark.parametrize(
    ("id", "number", "options", "said"),
    [
        ("BRD001", 0, {"counts": [4, 8]}, "expected 4 or 8"),
        ("BRD001", 1, {"counts": [4]}, "expected 4; without it there is no limit"),
        ("GEO011", 1, {"least_clearance": 0}, ""),
        ("GEO011", 0, {"least_clearance": 0, "tolerance": 0.1}, ""),
        ("INE004", -3, {"warning_above": 0.5}, "are too large for 2 kg"),
        ("REF006", 1, {"folder": "textures/"}, ""),
        ("REF006", 1, {"folder": "textures"}, ""),
        ("ROS012", -3, {"published_elsewhere": ""}, "(camera_optical_frame)"),
        ("SEN010", -1, {"rgbd_pixels": 100}, "expected at most 100 pixels"),
        ("BRD002", 0, {"depth": -0.05}, "inside link"),
        ("SEN024", -4, {"angle": 1.6}, "looks in the same direction"),
        ("SEN024", -4, {"angle": 1.5}, ""),
        ("PKG013", 1, {"limit_megabytes": 29.5}, "5.png"),
    ],
)
def test_options_do_as_they_say(
    id: str, number: int, options: dict[str, object], said: str, tmp_path: Path
) -> None:
    (rule,) = (each for each in RULES if each.id == id)
    with example_of(rule, number, tmp_path) as run:
        messages = [each.message for each in run(**options).findings]
    assert any(said in each for each in messages) if said else not messages


def test_a_fix_has_as_many_digits_as_are_wanted(tmp_path: Path) -> None:
    (rule,) = (each for each in RULES if each.id == "GEO001")
    with example_of(rule, 0, tmp_path) as run:
        for digits, text in ((3, "1.571"), (50, "1.57079632679489662")):
            (found,) = run(digits=digits).findings
            assert found.fix is not None
            assert [edit.replacement for edit in found.fix.edits] == [text]
