"""Whether a package that a repository names exists nowhere."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.nowhere import is_nowhere
from checker.package.workspace import Workspace
from checker.rule_testing import write_example

OTHER = {"../acme_hand/package.xml": "<package><name>acme_hand</name></package>"}


@pytest.mark.parametrize(
    ("name", "files", "expected"),
    [
        ("acme_words", OTHER, True),
        ("acme_words", {}, False),
        ("acme_hand", OTHER, False),
        ("rclpy", OTHER, False),
        ("acme_words", {**OTHER, "../.gitmodules": "[submodule]\n"}, False),
        ("acme_words", {**OTHER, "../fetch.sh": "git clone acme_words\n"}, False),
        ("acme_words", {**OTHER, "../fetch.sh": "git clone acme_other\n"}, True),
    ],
)
def test_a_package_exists_nowhere(
    name: str, files: dict[str, object], expected: bool, tmp_path: Path
) -> None:
    package = write_example({"@ros2": True, **files}, tmp_path)
    assert is_nowhere(Workspace((tmp_path,)).at(package), name) is expected
