"""Which tier a test belongs to: what it needs decides, programs or time.

The first tier needs Python and what `make dev` installs, and no case of it takes seconds. What
needs a program carries a mark by the fixtures that it uses and by the place where it stands; what
is slow has its mark in the test itself.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

TESTS = Path(__file__).parent
MARKS: Mapping[str, str] = {
    "browser": "needs Chromium and the viewer that is built",
    "service": "needs a network, a port, a database server, workers of the service, or kills",
    "install": "needs a second installation of the project: wheel, image, hook, editor's client",
    "programs": "needs what `make dev` does not install: ruby, git, zsh, Sphinx, OpenGL, schemas",
    "oracle": "needs other programs that read robots: libsdformat, drake",
    "corpus": "needs real packages",
    "root": "needs to mount a disk or to become another user",
    "slow": "needs seconds for each case: whole checks, trials, hostile or very large input",
}
BY_FIXTURE: Mapping[str, str] = {
    "chromium": "browser",
    "postgres_url": "service",
    "bucket_url": "service",
    "serve": "service",
    "start_service": "service",
    "outside": "service",
    "ruby": "programs",
    "sarif": "programs",
    "junit": "programs",
    "corpus": "corpus",
}
BY_PLACE: Mapping[str, str] = {
    "oracle": "oracle",
    "editor/test_random_edits.py": "slow",
    "portable": "slow",
    "test_places.py": "slow",
    "trial/test_ackermann.py": "slow",
    "trial/test_copter.py": "slow",
    "trial/test_mechanics.py": "slow",
    "trial/test_suspension.py": "slow",
    "test_products.py": "slow",
    "editor/test_vscode_client.py": "install",
    "deployment/test_image.py": "install",
    "deployment/test_postgres.py": "service",
    "deployment/test_running.py": "install",
    "repository/test_action.py": "install",
    "repository/test_init.py": "programs",
    "repository/test_pre_commit.py": "install",
    "test_readme_commands.py": "install",
    "test_wheel.py": "install",
    "command/test_nothing_is_fetched.py": "service",
    "survival": "service",
    "viewer": "browser",
    "fixing/test_bad_conditions.py": "service",
    "jobs": "service",
    "sandbox/test_as_others.py": "service",
    "serving/test_supervisor.py": "service",
    "store/test_crashes.py": "service",
    "store/test_life.py": "service",
    "test_background.py": "service",
    "test_forked_work.py": "service",
    "serving/test_connection.py": "service",
    "web/test_hostile_requests.py": "service",
    "web/test_main.py": "service",
}
"""Folders and modules, all of whose tests need the same."""
SMOKE = (
    "fixing/test_uncommitted.py::test_committed_files_are_fixed",
    "oracle/test_libsdformat.py::test_models_are_read_alike",
    "report/html/test_in_browser.py::test_without_javascript_everything_but_the_3d_is_there",
    "serving/test_serve.py::test_what_is_sent_is_checked_and_told",
    "test_wheel.py::test_a_sample_from_the_wheel_is_ready",
    "test_wheel.py::test_it_carries_code_rules_data_and_samples",
    "viewer/test_viewer.py::test_it_knows_the_trial_and_shows_its_start",
)
"""Tests of other tiers that the gate runs too; each is skipped without the program it needs."""
_PROGRAMS = {"chromium": "browser", "postgres": "service"} | dict.fromkeys(
    ("git", "node", "npm", "ruby"), "programs"
)


def marks_of(item: pytest.Item) -> Iterator[str]:
    """Yield the marks that a test has by its fixtures and its place."""
    place = item.path.relative_to(TESTS)
    if f"{place.as_posix()}::{getattr(item, 'originalname', '')}" in SMOKE:
        yield "smoke"
    for each in (place, *place.parents):
        if mark := BY_PLACE.get(each.as_posix()):
            yield mark
    for name in getattr(item, "fixturenames", ()):
        if mark := BY_FIXTURE.get(name):
            yield mark


class Guard:
    """Fails a test of the first tier that opens a network port or starts a foreign program."""

    def __init__(self) -> None:
        self._active = False
        sys.addaudithook(self._look)

    def watch(self, item: pytest.Item | None) -> None:
        """Watch a test, unless it carries a mark; None ends it."""
        self._active = item is not None and not any(item.get_closest_marker(each) for each in MARKS)

    def _look(self, event: str, given: tuple[Any, ...]) -> None:
        if not self._active:
            return
        if event in ("socket.bind", "socket.connect") and isinstance(given[1], tuple):
            pytest.fail("it opens a network port: it needs the mark `service`")
        if event == "subprocess.Popen":
            program = Path(os.fsdecode(given[0])).name
            if mark := _PROGRAMS.get(program):
                pytest.fail(f"it starts {program}: it needs the mark `{mark}`")
