"""A report is remembered as long as nothing that it depends on has changed."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from checker.base.cache import Cache
from checker.engine.report_cache import from_stored, memory_key, recalled, remember, to_stored
from checker.package.inputs import open_input
from checker.pipeline import check_package
from checker.report.report import Cause, NotChecked, PackageReport
from checker.settings import Settings
from tests.conftest import SAMPLES

GOOD = "husky_migration_sensor_config_1"
SIBLING = "husky_migration_sensor_config_2"
BROKEN = "broken_rover_sensor_config_1"


@pytest.fixture
def packages(tmp_path: Path) -> Path:
    folder = tmp_path / "packages"
    for name in (GOOD, SIBLING):
        shutil.copytree(SAMPLES / name, folder / name)
    return folder


def key_of(package: Path, **wishes: Any) -> str:
    with open_input(package) as opened:
        (only,) = opened.packages
        return memory_key(only, Settings(**wishes))


def static_report(name: str) -> PackageReport:
    (report,) = check_package(
        SAMPLES / name, Settings(select=("PKG", "SDF", "KIN", "SPW"))
    ).packages
    return report


def test_nothing_changed(packages: Path) -> None:
    assert key_of(packages / GOOD) == key_of(packages / GOOD) != ""


def change_a_letter(packages: Path) -> None:
    file = packages / GOOD / "model.sdf"
    before = file.stat()
    file.write_text(file.read_text("utf-8").replace("base_link", "base_limb"), "utf-8")
    os.utime(file, ns=(before.st_atime_ns, before.st_mtime_ns))


def add_a_file(packages: Path) -> None:
    (packages / GOOD / "notes.md").write_text("", "utf-8")


def change_a_sibling(packages: Path) -> None:
    (packages / SIBLING / "package.xml").write_text("<package/>", "utf-8")


def add_a_sibling(packages: Path) -> None:
    (packages / "husky_migration_sensor_config_3").mkdir()


def remove_the_sibling(packages: Path) -> None:
    shutil.rmtree(packages / SIBLING)


def make_a_link(packages: Path) -> None:
    (packages / GOOD / "link.sdf").symlink_to("model.sdf")


@pytest.mark.parametrize(
    "change",
    [
        change_a_letter,
        add_a_file,
        change_a_sibling,
        add_a_sibling,
        remove_the_sibling,
        make_a_link,
    ],
)
def test_a_change_is_seen(packages: Path, change: Callable[[Path], None]) -> None:
    before = key_of(packages / GOOD)
    change(packages)
    assert key_of(packages / GOOD) != before


def test_other_settings_are_another_report(packages: Path) -> None:
    assert key_of(packages / GOOD) != key_of(packages / GOOD, ignore=("PKG",))


def test_a_lone_file_is_not_worth_remembering(packages: Path) -> None:
    assert key_of(packages / GOOD / "model.sdf") == ""


@pytest.mark.parametrize("name", [GOOD, BROKEN])
def test_a_stored_report_is_the_same(name: str) -> None:
    report = static_report(name)
    again = from_stored(json.loads(json.dumps(to_stored(report))), report.path)
    assert again == report


def test_what_is_remembered_is_recalled_under_the_path_of_now(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    report = replace(static_report(BROKEN), not_checked=())
    remember(cache, "key", report)
    assert recalled(cache, "key", "other/path") == replace(report, path="other/path")
    assert recalled(cache, "another", "other/path") is None
    assert recalled(cache, "", "other/path") is None


@pytest.mark.parametrize("cause", [Cause.CRASHED, Cause.NOT_AT_HAND])
def test_what_could_not_be_looked_at_is_looked_for_again(tmp_path: Path, cause: Cause) -> None:
    unseen = NotChecked("PKG001", "could not run", cause)
    remember(Cache(tmp_path), "key", replace(static_report(GOOD), not_checked=(unseen,)))
    assert recalled(Cache(tmp_path), "key", "path") is None


@pytest.mark.parametrize("content", ["", "{", "[]", '{"name": 1}', "null", "1e999"])
def test_a_foreign_entry_counts_as_none(tmp_path: Path, content: str) -> None:
    cache = Cache(tmp_path)
    remember(cache, "key", static_report(GOOD))
    (entry,) = tmp_path.glob("*/*/*.json")
    entry.write_text(content, "utf-8")
    assert recalled(cache, "key", "path") is None
