"""An upload becomes a result, or it is said why not; whatever it holds, the worker goes on."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import sys
import zipfile
from collections.abc import Callable, Iterable
from contextlib import ExitStack, closing
from pathlib import Path

import pytest

from checker.base.sandbox.task import DISTURBED, FAILED, OUT_OF_MEMORY
from checker.service.jobs.check import LIMITS, check_upload, failure, stored_result
from checker.service.jobs.children import Children, Ended
from checker.service.jobs.exchange import StageLimits
from checker.service.jobs.outcome import (
    FAILED_INSIDE,
    Cancelled,
    Checked,
    Died,
    Disturbed,
    Outcome,
    Refused,
)
from checker.service.jobs.port import Order, Stage
from checker.service.store.store import SUMMARY, Store
from support.disk import full, small_disk
from tests.jobs.launched import tasks
from tests.web.server import eventually

BUGGY = "subtcheck_buggy_sensor_config_1"
GURDY = "broken_gurdy_description"
LARGE = b"<sdf version='1.6'>" + b"<model name='one'/>" * 60_000 + b"</sdf>"


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "data")


def given(store: Store, name: str, content: bytes, profile: str = "") -> Order:
    with store.incoming() as incoming:
        incoming.write(content)
        return Order(incoming.finish(), name, profile)


def packed(folders: Iterable[Path], place: Path) -> bytes:
    with zipfile.ZipFile(place / "packed.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for folder in folders:
            for path in sorted(folder.rglob("*")):
                archive.write(path, path.relative_to(folder.parent))
    return (place / "packed.zip").read_bytes()


def check(
    store: Store,
    order: Order,
    stage: Stage = Stage.STATIC,
    cancelled: Callable[[], bool] = lambda: False,
    limits: StageLimits | None = None,
) -> Outcome:
    """Check, and see that nothing temporary is left."""
    with closing(Children(store, ahead=False)) as children:
        outcome = check_upload(store, children, order, stage, cancelled, limits)
    assert not list((store.folder / "incoming").iterdir())
    return outcome


def report_of(store: Store, outcome: Outcome) -> dict[str, object]:
    assert isinstance(outcome, Checked), outcome
    path = store.file(outcome.key, "report.json")
    assert path is not None
    report = json.loads(path.read_bytes())
    assert isinstance(report, dict)
    return report


def test_the_static_stage(store: Store, samples: Path, tmp_path: Path) -> None:
    order = given(store, "gurdy.zip", packed([samples / GURDY], tmp_path))
    outcome = check(store, order)
    assert isinstance(outcome, Checked)
    (package,) = outcome.packages
    assert (package["name"], package["verdict"], package["folder"]) == (GURDY, "not_ready", "")
    assert package["errors"] > 0
    assert re.match(r"Not ready: \d+ errors of the robot, ", outcome.words)
    assert sum(map(int, re.findall(r"\d+(?= errors? of| of )", outcome.words))) == package["errors"]
    assert outcome.words.endswith("(trial not run)")
    assert store.names(outcome.key) == ("report.json",)


def test_the_stage_of_the_trial(store: Store, samples: Path, tmp_path: Path) -> None:
    order = given(store, "buggy.zip", packed([samples / BUGGY], tmp_path))
    outcome = check(store, order, Stage.TRIAL)
    assert isinstance(outcome, Checked)
    assert outcome.words == "Ready: nothing to fix"
    names = ("report.html", "report.json", "report.sarif", "robot.glb")
    assert store.names(outcome.key) == names
    (package,) = report_of(store, outcome)["packages"]  # type: ignore[misc]
    assert package["path"] == f"buggy.zip/{BUGGY}"
    assert package["trial"]
    page = store.file(outcome.key, "report.html")
    assert page is not None
    assert "subt-check buggy.zip" in page.read_text("utf-8")


def test_an_archive_of_two_packages(store: Store, samples: Path, tmp_path: Path) -> None:
    content = packed([samples / GURDY, samples / "my_gurdy_description"], tmp_path)
    order = given(store, "two.zip", content)
    static = check(store, order)
    assert isinstance(static, Checked)
    assert [package["folder"] for package in static.packages] == [GURDY, "my_gurdy_description"]
    assert static.words == "2 packages: 1 ready and 1 not ready"
    outcome = check(store, order, Stage.TRIAL)
    assert isinstance(outcome, Checked)
    for name in (
        "index.html",
        *(f"{package['folder']}/report.html" for package in outcome.packages),
    ):
        assert name in store.names(outcome.key)


def test_a_single_model_file(store: Store, samples: Path) -> None:
    order = given(store, "model.sdf", (samples / BUGGY / "model.sdf").read_bytes())
    report = report_of(store, check(store, order))
    assert "given" not in json.dumps(report)
    (package,) = report["packages"]  # type: ignore[misc]
    assert (package["name"], package["path"]) == ("model.sdf", ".")


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        (
            "notes.zip",
            b"These are my notes.\n",
            r"notes\.zip is not a zip archive.*download it again",
        ),
        ("notes.tar.gz", b"These are my notes.\n", r"notes\.tar\.gz is not a tar\.gz archive"),
        ("empty.zip", b"PK\5\6" + bytes(18), r"empty\.zip contains no files; pack the package"),
    ],
)
def test_what_is_no_archive(name: str, content: bytes, reason: str, store: Store) -> None:
    outcome = check(store, given(store, name, content))
    assert isinstance(outcome, Refused)
    assert re.match(reason, outcome.reason)


def test_a_bomb(store: Store, tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "bomb.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("p/package.xml", bytes(300_000_000))
    outcome = check(store, given(store, "bomb.zip", (tmp_path / "bomb.zip").read_bytes()))
    assert isinstance(outcome, Refused)
    assert "makes it unpack to more than 200 times the size of the archive" in outcome.reason


def test_a_profile_that_does_not_exist(store: Store) -> None:
    outcome = check(store, given(store, "model.sdf", b"<sdf/>", profile="moon"))
    assert isinstance(outcome, Refused)
    assert "'moon'" in outcome.reason


def test_settings_of_this_machine_do_not_judge(store: Store, samples: Path) -> None:
    order = given(store, "model.sdf", (samples / BUGGY / "model.sdf").read_bytes())
    (store.folder / "subt-check.toml").write_text('select = ["no such rule"]')
    assert isinstance(check(store, order), Checked)


def forget(store: Store, order: Order) -> None:
    path = store.upload(order.upload)
    assert path is not None
    path.unlink()


def test_an_upload_that_is_gone(store: Store) -> None:
    order = given(store, "model.sdf", b"<sdf/>")
    forget(store, order)
    assert check(store, order) == Refused("the upload no longer exists; upload the package again")


def test_the_same_upload_is_checked_once(store: Store, samples: Path) -> None:
    order = given(store, "model.sdf", (samples / BUGGY / "model.sdf").read_bytes())
    outcome = check(store, order)
    # What had to be opened again would now be refused.
    forget(store, order)
    assert check(store, order) == outcome
    assert isinstance(check(store, order, Stage.TRIAL), Refused)
    assert isinstance(check(store, Order(order.upload, "robot.sdf")), Refused)


@pytest.mark.parametrize("said", ["", "{", "[]", '{"packages": 3, "words": ""}', "[" * 100_000])
def test_a_result_with_a_damaged_summary_is_made_again(
    said: str, store: Store, samples: Path
) -> None:
    order = given(store, "model.sdf", (samples / BUGGY / "model.sdf").read_bytes())
    outcome = check(store, order)
    assert isinstance(outcome, Checked)
    assert stored_result(store, order, Stage.STATIC) == outcome
    summary = store.file(outcome.key, SUMMARY)
    assert summary is not None
    summary.write_text(said, "utf-8")
    assert stored_result(store, order, Stage.STATIC) is None
    forget(store, order)
    assert isinstance(check(store, order), Refused), "it would be opened again"


CRASHING = """
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, rule

@rule("OWN001", "crash", Severity.ERROR, Concern.ROBOT)
def check(package: Package) -> Findings:
    raise ValueError(f"{package.root} is too much")
    yield
"""
RULES = {
    "crashing_rules.py": CRASHING,
    "crashing-1.0.dist-info/METADATA": "Name: crashing\nVersion: 1.0\n",
    "crashing-1.0.dist-info/entry_points.txt": "[subt_check.rules]\nown = crashing_rules\n",
}


def test_a_check_in_which_a_rule_crashed_is_repeated(
    store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, text in RULES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    order = given(store, "model.sdf", b"<sdf/>", profile="sdf")
    with monkeypatch.context() as patch:
        patch.setenv("PYTHONPATH", str(tmp_path))
        crashed = check(store, order)
    assert "ValueError:  is too much" in json.dumps(report_of(store, crashed))
    assert "OWN001" not in json.dumps(report_of(store, check(store, order)))


def test_it_is_cancelled_while_the_robot_drives(
    store: Store, samples: Path, tmp_path: Path
) -> None:
    order = given(store, "buggy.zip", packed([samples / BUGGY], tmp_path))

    def as_soon_as_children_work() -> bool:
        return len(tasks()) > 2

    assert check(store, order, Stage.TRIAL, as_soon_as_children_work) == Cancelled()
    assert eventually(lambda: not tasks())
    assert not list((store.folder).glob("results/*/*"))


def test_the_child_is_killed(
    store: Store, samples: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    order = given(store, "buggy.zip", packed([samples / BUGGY], tmp_path))

    def murder() -> bool:
        for each in tasks():
            os.kill(each, signal.SIGKILL)
        return False

    outcome = check(store, order, cancelled=murder)
    assert outcome == Disturbed("its process was killed (SIGKILL)")
    assert "code -9" in caplog.text


def test_a_process_of_the_trial_is_killed(store: Store, samples: Path, tmp_path: Path) -> None:
    order = given(store, "buggy.zip", packed([samples / BUGGY], tmp_path))
    with closing(Children(store, ahead=False)) as children:

        def murder() -> bool:
            """Kill what the process that checks has started, and not that one itself."""
            for each in tasks()[1:]:
                os.kill(each, signal.SIGKILL)
            return False

        outcome = check_upload(store, children, order, Stage.TRIAL, murder)
    assert isinstance(outcome, Disturbed), outcome
    assert stored_result(store, order, Stage.TRIAL) is None
    assert isinstance(check(store, order, Stage.TRIAL), Checked)


@pytest.mark.root
@pytest.mark.parametrize("stage", [Stage.STATIC, Stage.TRIAL])
def test_the_disk_is_full(stage: Stage, store: Store, samples: Path, tmp_path: Path) -> None:
    with small_disk(store.folder, 100_000_000) as disk:
        order = given(store, "buggy.zip", packed([samples / BUGGY], tmp_path))
        with full(disk):
            outcome = check(store, order, stage)
        assert isinstance(outcome, Disturbed), outcome
        assert stored_result(store, order, stage) is None
        assert isinstance(check(store, order, stage), Checked)


@pytest.mark.root
def test_the_disk_gets_full_meanwhile(store: Store, samples: Path, tmp_path: Path) -> None:
    with small_disk(store.folder, 100_000_000) as disk, ExitStack() as later:
        order = given(store, "buggy.zip", packed([samples / BUGGY], tmp_path))

        def fills() -> bool:
            if tasks()[1:] and not (disk / "filler").exists():
                later.enter_context(full(disk))
            return False

        outcome = check(store, order, Stage.TRIAL, cancelled=fills)
        assert (disk / "filler").exists()
        later.close()
        assert isinstance(outcome, Disturbed), outcome
        assert isinstance(check(store, order, Stage.TRIAL), Checked)


@pytest.mark.root
def test_the_disk_has_no_room_for_what_is_unpacked(store: Store, tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "large.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("p/model.sdf", "<sdf version='1.6'><model name='p'/></sdf>")
        archive.writestr("p/noise.bin", os.urandom(400_000) + bytes(30_000_000))
    with small_disk(store.folder, 50_000_000) as disk:
        order = given(store, "large.zip", (tmp_path / "large.zip").read_bytes())
        half = disk / "half"
        half.write_bytes(bytes(30_000_000))
        assert check(store, order) == Disturbed(
            "the system of the service says: No space left on device"
        )
        half.unlink()
        assert isinstance(check(store, order), Checked)


def test_the_machine_has_no_time(store: Store) -> None:
    limits = StageLimits(seconds=60.0, clock_seconds=0.1)
    outcome = check(store, given(store, "model.sdf", LARGE), limits=limits)
    assert outcome == Disturbed("the service had no time for it within 0.1 s")


@pytest.mark.parametrize(
    ("limits", "model", "reason"),
    [
        # A small model is checked in the memory that was taken before there was a limit.
        (StageLimits(seconds=60.0, memory=60_000_000), LARGE, "it "),
        (
            StageLimits(seconds=60.0, file_bytes=2_000),
            b"<sdf/>",
            "it failed with an internal error",
        ),
    ],
)
def test_a_limit_is_reached(limits: StageLimits, model: bytes, reason: str, store: Store) -> None:
    outcome = check(store, given(store, "model.sdf", model), limits=limits)
    assert isinstance(outcome, Died)
    assert outcome.reason.startswith(f"the checker could not finish: {reason}")
    assert "Traceback" not in outcome.reason


ENDS = {
    -signal.SIGXCPU: Died(
        "the checker could not finish: it needs more than 300 s of processor time; check fewer "
        "packages at a time"
    ),
    OUT_OF_MEMORY: Died(
        "the checker could not finish: it needs more than 4 GB of memory; check fewer packages at "
        "a time"
    ),
    -signal.SIGSEGV: Died(FAILED_INSIDE),
    FAILED: Died(FAILED_INSIDE),
    -signal.SIGKILL: Disturbed("its process was killed (SIGKILL)"),
    -signal.SIGTERM: Disturbed("its process was killed (SIGTERM)"),
    DISTURBED: Disturbed("the disk or the system of the service failed"),
    None: Disturbed("its process could not be started, or was ended with all others"),
}


@pytest.mark.parametrize("code", ENDS)
def test_what_the_package_does_is_told_from_what_befalls_its_check(code: int | None) -> None:
    assert failure(Ended(code), LIMITS[Stage.STATIC]) == ENDS[code]


def test_last_words_are_logged(store: Store, caplog: pytest.LogCaptureFixture) -> None:
    limits = StageLimits(seconds=60.0, file_bytes=2_000)
    check(store, given(store, "model.sdf", b"<sdf/>"), limits=limits)
    assert "Traceback (most recent call last)" in caplog.text


def test_reports_show_nothing_of_this_machine(
    store: Store, samples: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SUBT_CHECK_TOKENS", "hunter2")
    shutil.copytree(samples / "broken_rover_sensor_config_1", tmp_path / "rover")
    # Links, wrong paths and settings bring forth messages with paths in them.
    (tmp_path / "rover" / "subt-check.toml").write_text("baseline = 'none.json'\n")
    order = given(store, "rover.zip", packed([tmp_path / "rover", samples / GURDY], tmp_path))
    outcome = check(store, order, Stage.TRIAL)
    assert isinstance(outcome, Checked)
    secrets = (str(store.folder), str(tmp_path), sys.prefix, "hunter2", str(samples.parent))
    for name in store.names(outcome.key):
        path = store.file(outcome.key, name)
        assert path is not None
        content = path.read_bytes()
        assert not [secret for secret in secrets if secret.encode() in content], name
