"""Packages that an accident went through: whatever happens to the text, the check goes on."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from checker.pipeline import check_package
from checker.report.report import Cause
from checker.settings import Settings
from tests.conftest import SAMPLES
from tests.effort import examples

SAMPLE_NAMES = ("husky_migration_sensor_config_1", "broken_rover_sensor_config_1")
TEXTS = {".sdf", ".rb", ".launch", ".md", ".xml", ".config", ".txt", ".xacro"}
DEBRIS = (
    *("<", ">", '"', "'", "/>", "</", "&amp;", "&x;", "<![CDATA[", "]]>", "<!--", "-->", "--"),
    *("#{", "}", "end", "def", "if", "do", "$(arg", "$(", "${", "(", ")", "|", "~~", "::"),
    *("nan", "1e400", "-1", "0x10", "__x__", "é", "\0", "\x1b[31m", "\t", "\n", "\u2028", "\ufeff"),
)

mutation = st.tuples(
    st.sampled_from(("insert", "remove", "repeat", "cut off")),
    st.floats(0, 1),
    st.integers(1, 200),
    st.sampled_from(DEBRIS),
)


def mutate(text: str, kind: str, where: float, length: int, debris: str) -> str:
    at = int(where * len(text))
    match kind:
        case "insert":
            return text[:at] + debris + text[at:]
        case "remove":
            return text[:at] + text[at + length :]
        case "repeat":
            return text[: at + length] + text[at:]
        case _:
            return text[:at]


@pytest.mark.slow
@pytest.mark.parametrize("name", SAMPLE_NAMES)
@settings(max_examples=examples(60), suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_no_mutation_stops_the_check(name: str, data: st.DataObject, tmp_path: Path) -> None:
    package = tmp_path / name
    shutil.rmtree(package, ignore_errors=True)
    shutil.copytree(SAMPLES / name, package)
    files = sorted(file for file in package.rglob("*") if file.suffix in TEXTS)
    for _ in range(data.draw(st.integers(1, 4))):
        file = data.draw(st.sampled_from(files))
        text = file.read_bytes().decode("utf-8", "replace")
        file.write_bytes(mutate(text, *data.draw(mutation)).encode("utf-8", "replace"))
    (report,) = check_package(package, Settings(trial=False)).packages
    assert not [each for each in report.not_checked if each.cause is Cause.CRASHED]
    assert all(finding.places and finding.message for finding in report.findings)
