"""The schema of settings takes what the checker takes, and refuses what it refuses."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.errors import InvalidSettings
from checker.cli import main
from checker.engine.options import check_against_rules
from checker.engine.settings_schema import ID, settings_schema
from checker.rulebook.discovery import all_rules
from checker.settings import _KEYS, parse_settings
from tests.conftest import SAMPLES

ROOT = SAMPLES.parent
SCHEMA = settings_schema()
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
RULES = [rule for rule in all_rules() if rule.options]
WORDS = st.sampled_from(["ros2", "jazzy", "warning", "info", "error", "KIN001", "GEO", "", "mars"])
# To JSON Schema 1.0 is a whole number, to TOML it is none.
FLOATS = st.floats(-2, 2).filter(lambda number: not number.is_integer())
VALUES = st.one_of(WORDS, st.booleans(), st.integers(-2, 2), FLOATS, st.lists(WORDS, max_size=2))


def test_the_command_writes_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rules", "--format", "settings-schema"]) == 0
    assert json.loads(capsys.readouterr().out) == SCHEMA


def test_it_describes_every_option_of_every_rule() -> None:
    described = SCHEMA["properties"]["rules"]["properties"]
    assert described.keys() == {rule.id for rule in RULES}
    for rule in RULES:
        options = described[rule.id]["properties"]
        defaults = {name: it["default"] for name, it in options.items()}
        assert defaults == json.loads(json.dumps(rule.options))


def test_it_is_a_schema_of_all_keys() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    assert set(SCHEMA["properties"]) == set(_KEYS)
    assert SCHEMA["$id"] == ID


def test_the_files_that_are_written_and_shown_fit() -> None:
    page = (ROOT / "docs/usage.md").read_text("utf-8")
    example = tomllib.loads(page.partition("```toml\n")[2].partition("```")[0])
    assert example
    jsonschema.validate(example, SCHEMA)


@given(content=st.dictionaries(st.sampled_from([*_KEYS, "colour"]), VALUES, max_size=3))
def test_it_takes_what_the_checker_takes(content: dict[str, Any]) -> None:
    # Whether a folder or file is there, no schema says.
    content = {key: it for key, it in content.items() if key not in ("package-path", "baseline")}
    # Nor whether some rule is left.
    content.pop("ignore", None)
    _compare(content)


@given(data=st.data())
def test_it_takes_options_and_severities_as_the_checker_does(data: st.DataObject) -> None:
    rule = data.draw(st.sampled_from(RULES))
    name = data.draw(st.sampled_from([*rule.options, "no_such_option"]))
    _compare({"rules": {rule.id: {name: data.draw(VALUES)}}})
    _compare({"severity": {rule.id: data.draw(VALUES)}})
    keys = st.sampled_from(["rule", "reason", "file", "element", "colour"])
    _compare({"suppress": [data.draw(st.dictionaries(keys, st.sampled_from([rule.id, "", 1])))]})


def _compare(content: dict[str, Any]) -> None:
    try:
        check_against_rules(parse_settings(content, Path("subt-check.toml")), all_rules())
        taken = True
    except InvalidSettings as error:
        taken = False
        # Rules of others may have names that ours have not.
        if "there is no rule" in error.problem or "names the group" in error.problem:
            return
    assert VALIDATOR.is_valid(content) == taken, content
