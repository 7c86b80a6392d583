"""A report is remembered as long as nothing that it depends on has changed."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from msgspec import to_builtins
from msgspec.structs import replace

from checker.base.cache import Cache
from checker.base.child_process import Limits
from checker.engine.report_cache import from_stored, memory_key, recall_report, remember
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


def test_what_lies_around_a_lone_file_belongs_to_it(packages: Path) -> None:
    file = packages / GOOD / "model.sdf"
    before = key_of(file)
    assert before == key_of(file) != ""
    (packages / GOOD / "meshes").mkdir(exist_ok=True)
    (packages / GOOD / "meshes/new.stl").touch()
    assert key_of(file) != before


@pytest.mark.parametrize("name", [GOOD, BROKEN])
def test_a_stored_report_is_the_same(name: str) -> None:
    report = static_report(name)
    again = from_stored(json.loads(json.dumps(to_builtins(report))), report.path)
    assert again == report


def test_what_is_remembered_is_recalled_under_the_path_of_now(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    report = replace(static_report(BROKEN), not_checked=())
    remember(cache, "key", report)
    assert recall_report(cache, "key", "other/path") == replace(report, path="other/path")
    assert recall_report(cache, "another", "other/path") is None
    assert recall_report(cache, "", "other/path") is None


def test_what_crashed_or_failed_is_tried_again(tmp_path: Path) -> None:
    crashed = NotChecked("PKG001", "could not run", Cause.CRASHED)
    remember(Cache(tmp_path), "key", replace(static_report(GOOD), not_checked=(crashed,)))
    assert recall_report(Cache(tmp_path), "key", "path") is None
    failed = Cache(tmp_path)
    failed.pass_over("mesh")
    remember(failed, "key", static_report(GOOD))
    assert recall_report(Cache(tmp_path), "key", "path") is None


def test_what_was_disturbed_is_tried_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SUBT_CHECK_CACHE", str(tmp_path))
    monkeypatch.setattr(Limits, "clock_seconds", 0.0)
    path = SAMPLES / "subtcheck_quadro_sensor_config_1"
    (report,) = check_package(path, Settings(trial=False)).packages
    assert "took longer" in report.disturbed
    assert not report.crashed
    assert not list(tmp_path.glob("report/*/*.json"))


def test_a_missing_sibling_is_remembered_until_it_is_there(packages: Path) -> None:
    shutil.rmtree(packages / GOOD)
    heir = packages / SIBLING
    with_hole = replace(static_report(GOOD), not_checked=(unseen_of(heir),))
    cache, key = Cache(packages.parent / "cache"), key_of(heir)
    remember(cache, key, with_hole)
    assert recall_report(cache, key_of(heir), "path") is not None
    shutil.copytree(SAMPLES / GOOD, packages / GOOD)
    assert recall_report(cache, key_of(heir), "path") is None


def unseen_of(package: Path) -> NotChecked:
    """Return what a rule could not look at because a sibling is missing."""
    (report,) = check_package(package, Settings(trial=False, cache=False)).packages
    return next(it for it in report.not_checked if it.cause is Cause.NOT_AT_HAND)


@pytest.mark.parametrize("content", ["", "{", "[]", '{"name": 1}', "null", "1e999"])
def test_a_foreign_entry_counts_as_none(tmp_path: Path, content: str) -> None:
    cache = Cache(tmp_path)
    remember(cache, "key", static_report(GOOD))
    (entry,) = tmp_path.glob("*/*/*.json")
    entry.write_text(content, "utf-8")
    assert recall_report(cache, "key", "path") is None


def test_a_reason_of_another_type_is_remembered_as_text(tmp_path: Path) -> None:
    class Words(str):
        __slots__ = ()

    missing = NotChecked("PKG001", Words("is missing"), Cause.NOT_AT_HAND)
    remember(Cache(tmp_path), "key", replace(static_report(GOOD), not_checked=(missing,)))
    again = recall_report(Cache(tmp_path), "key", "path")
    assert again is not None
    assert again.not_checked[0].reason == "is missing"
