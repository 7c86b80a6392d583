"""What the port of the store promises, of each implementation: a folder, and S3."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from checker.base.errors import InvalidSettings
from checker.service.store.objects import Kind, StoreUnreachable
from checker.service.store.s3 import COPY_SECONDS, s3_objects
from checker.service.store.store import SUMMARY, Store, open_store
from tests.store.filled import KEY, OTHER, made, uploaded

Machine = Callable[[str], Store]


@pytest.fixture(params=["folder", pytest.param("s3", marks=pytest.mark.service)])
def machine(request: pytest.FixtureRequest, tmp_path: Path) -> Machine:
    """Return the store as the machine of a name has it."""
    if request.param == "folder":
        return lambda _: Store(tmp_path / "shared")
    url = request.getfixturevalue("bucket_url")
    return lambda name: Store(tmp_path / name, s3_objects(url, tmp_path / name))


def read(store: Store, name: str, key: str = KEY) -> str | None:
    path = store.file(key, name)
    return path.read_text() if path else None


def test_an_upload_is_there_on_every_machine(machine: Machine) -> None:
    content = b"robot" * 2_000_000
    hash = uploaded(machine("web"), content)
    path = machine("worker").upload(hash)
    assert path is not None
    assert path.read_bytes() == content
    assert machine("worker").upload(KEY) is None


def test_a_result_is_there_on_every_machine(machine: Machine) -> None:
    web, worker = machine("web"), machine("worker")
    assert not web.has(KEY)
    assert web.names(KEY) == ()
    made(worker, {"index.html": "", "机器人/robot.glb": "glTF", SUMMARY: "[]"})
    assert web.has(KEY)
    assert web.names(KEY) == ("index.html", "机器人/robot.glb")
    assert read(web, "机器人/robot.glb") == "glTF"
    assert read(web, SUMMARY) == "[]"
    assert read(web, "report.json") is None


def test_parts_of_a_check_are_there_for_the_next_one(machine: Machine) -> None:
    for name in ("static", "trial"):
        store = machine(name)
        with store.workplace() as place:
            (place / "parts" / "cache").mkdir(parents=True)
            (place / "parts" / "cache" / f"{name}.json").write_text(name)
            assert (store.parts(KEY) is None) == (name == "static")
            store.add_parts(KEY, place / "parts")
    folder = machine("third").parts(KEY)
    assert folder is not None
    texts = {path.name: path.read_text() for path in folder.rglob("*.json")}
    assert texts == {"static.json": "static", "trial.json": "trial"}


def test_many_machines_make_the_same_result(machine: Machine) -> None:
    def finish(number: int) -> None:
        store = machine(f"worker {number % 4}")
        made(store, {f"p/{name}": str(number) for name in ("report.html", "robot.glb")})

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(finish, range(12)))
    web = machine("web")
    assert read(web, "p/report.html") == read(web, "p/robot.glb") is not None


def test_what_nobody_needs_any_more_expires_everywhere(machine: Machine) -> None:
    web, worker = machine("web"), machine("worker")
    used, unused = uploaded(web, b"used"), uploaded(web, b"unused")
    for key in (KEY, OTHER):
        made(worker, {"report.json": "{}"}, key)
    worker.expire(time.time() - 60, ())
    assert (worker.has(KEY), worker.has(OTHER)) == (True, True)
    worker.expire(time.time() + 60, {used, OTHER})
    third = machine("third")
    assert [third.upload(hash) is not None for hash in (used, unused)] == [True, False]
    assert (third.has(KEY), third.has(OTHER)) == (False, True)


@pytest.fixture
def s3(bucket_url: str, tmp_path: Path) -> Store:
    return Store(tmp_path / "data", s3_objects(bucket_url, tmp_path / "data"))


def test_what_is_used_again_does_not_expire_in_s3(s3: Store) -> None:
    made(s3, {"report.json": "{}"})
    time.sleep(2.1)  # S3 counts whole seconds
    before = time.time()
    assert s3.has(KEY)
    s3.expire(before - 1, ())
    assert s3.has(KEY)
    s3.expire(time.time() + 60, ())
    assert not s3.has(KEY)


def test_copies_go_when_nobody_uses_them(s3: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    made(s3, {"report.json": "{}"})
    s3.sweep()
    copy = s3.folder / Kind.RESULT / KEY[:2] / KEY
    assert copy.is_dir()
    monkeypatch.setattr("checker.service.store.s3.COPY_SECONDS", -COPY_SECONDS)
    s3.sweep()
    assert not copy.exists()
    assert read(s3, "report.json") == "{}"


def test_nothing_of_an_upload_that_is_cut_off_is_kept(s3: Store) -> None:
    with s3.incoming() as incoming:
        incoming.write(b"half")
    uploaded(s3, b"whole")
    kept = [path for path in s3.folder.rglob("*") if path.is_file() and path.name != "lock"]
    assert [path.read_bytes() for path in kept] == [b"whole"]


def test_a_bucket_that_does_not_exist_is_said(bucket_url: str, tmp_path: Path) -> None:
    store = Store(tmp_path, s3_objects(bucket_url.replace("bucket-", "none-"), tmp_path))
    with pytest.raises(StoreUnreachable, match="its bucket does not exist"):
        uploaded(store, b"robot")


def test_a_store_that_is_away_is_said_soon(
    bucket_url: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("AWS_ENDPOINT_URL", "http://127.0.0.1:9")
    store = Store(tmp_path, s3_objects(bucket_url, tmp_path))
    begun = time.monotonic()
    for ask in (lambda: store.has(KEY), lambda: store.upload(KEY), lambda: uploaded(store, b"x")):
        with pytest.raises(StoreUnreachable, match="does not answer"):
            ask()
    assert time.monotonic() - begun < 15.0


def test_the_environment_says_where(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("SUBT_CHECK_DATA", str(tmp_path))
    monkeypatch.delenv("SUBT_CHECK_STORE", raising=False)
    assert open_store() == Store(tmp_path)
    monkeypatch.setenv("SUBT_CHECK_STORE", "s3://bucket/prefix")
    shared = open_store().shared
    assert "bucket" in str(getattr(shared, "bucket", ""))
    for wrong in ("bucket", "gs://bucket", "s3://"):
        monkeypatch.setenv("SUBT_CHECK_STORE", wrong)
        with pytest.raises(InvalidSettings, match="expected for example 's3://bucket/prefix'"):
            open_store()
