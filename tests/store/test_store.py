"""Uploads and results: whole or not there, named by what they hold, gone in time."""

from __future__ import annotations

import gzip
import os
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from threading import Event

import pytest
from blake3 import blake3
from hypothesis import given
from hypothesis import strategies as st

from checker.service.store.store import SUMMARY, Store, TooLarge
from tests.effort import examples
from tests.store.filled import KEY, OTHER, made, uploaded

BACK = '<p class="back"><a href="../../">Back to the check</a></p>'


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "data")


def everything(store: Store) -> list[str]:
    paths = (path for path in store.folder.rglob("*") if path.is_file())
    return sorted(path.relative_to(store.folder).as_posix() for path in paths)


def age(path: Path | None, seconds: float) -> None:
    assert path is not None
    os.utime(path, (time.time() - seconds,) * 2)


def test_an_upload_in_pieces_is_found_by_its_hash(store: Store) -> None:
    with store.incoming(limit=10) as incoming:
        for piece in (b"robot", b"", b"model"):
            incoming.write(piece)
        hash = incoming.finish()
    assert hash == blake3(b"robotmodel").hexdigest()
    path = store.upload(hash)
    assert path is not None
    assert path.read_bytes() == b"robotmodel"


def test_an_upload_that_is_too_large_leaves_nothing(store: Store) -> None:
    with store.incoming(2_000_000) as incoming:
        incoming.write(b"x" * 2_000_000)
        with pytest.raises(TooLarge, match="larger than the 2 MB allowed"):
            incoming.write(b"x")
    assert everything(store) == []


def test_an_upload_that_is_cut_leaves_nothing(store: Store) -> None:
    with store.incoming() as incoming:
        incoming.write(b"half of ")
    with suppress(ConnectionError), store.incoming() as incoming:
        incoming.write(b"half of ")
        raise ConnectionError
    assert everything(store) == []


def test_the_same_upload_again_lies_there_once(store: Store) -> None:
    assert uploaded(store, b"same") == uploaded(store, b"same")
    assert len(list((store.folder / "uploads").glob("*/*"))) == 1


@given(st.text(max_size=80) | st.sampled_from(["../lock", "..", "", KEY[:-1], KEY.upper()]))
def test_what_is_no_key_names_nothing(key: str) -> None:
    store = Store(Path("/nowhere/that/could/be"))
    assert store.upload(key) is None
    assert store.file(key, "report.json") is None
    assert store.names(key) == ()


def test_a_result_of_one_package(store: Store) -> None:
    assert not store.has(KEY)
    made(store, {"report.json": "{}", "robot.glb": "glTF", SUMMARY: "[]"})
    assert store.has(KEY)
    assert store.names(KEY) == ("report.json", "robot.glb")
    for name, text in (("robot.glb", "glTF"), (SUMMARY, "[]")):
        path = store.file(KEY, name)
        assert path is not None
        assert path.read_text() == text


def test_a_result_of_several_packages(store: Store) -> None:
    made(store, {"index.html": "", "x1~2/report.html": "", "机器人/robot.glb": ""})
    assert store.names(KEY) == ("index.html", "x1~2/report.html", "机器人/robot.glb")
    assert store.file(KEY, "x1~2/report.html") is not None
    assert store.file(KEY, "x1~3/report.html") is None


@pytest.mark.parametrize(
    "name", ["../report.html", "a/../report.html", "/report.html", "a/b/robot.glb", "", ".", "a\n"]
)
def test_a_file_outside_the_result_is_not_given(name: str, store: Store) -> None:
    made(store, {"report.html": "", "a/robot.glb": ""})
    (store.folder / "results" / KEY[:2] / "report.html").write_text("another's")
    assert store.file(KEY, name) is None


def test_the_first_result_of_a_key_wins(store: Store) -> None:
    made(store, {"report.json": "first"})
    made(store, {"report.json": "second", "report.html": "second"})
    path = store.file(KEY, "report.json")
    assert path is not None
    assert path.read_text() == "first"
    assert store.names(KEY) == ("report.json",)
    assert not list((store.folder / "incoming").iterdir())


def test_many_finish_the_same_key_at_once(store: Store) -> None:
    def finish(number: int) -> None:
        made(store, {f"p/{name}": str(number) for name in ("report.html", "robot.glb")})

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(finish, range(24)))
    html, glb = (store.file(KEY, f"p/{name}") for name in ("report.html", "robot.glb"))
    assert html is not None
    assert glb is not None
    assert html.read_text() == glb.read_text()


@pytest.mark.parametrize("name", ["report.html", "p/robot.glb"])
def test_a_link_in_a_result_is_refused(name: str, store: Store, tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("password")
    with store.workplace() as place:
        (place / "made" / "p").mkdir(parents=True)
        (place / "made" / name).symlink_to(tmp_path / "secret")
        with pytest.raises(ValueError, match="is not a file of a result"):
            store.keep(KEY, place / "made")
    assert not store.has(KEY)


def test_a_link_to_a_result_is_refused(store: Store, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    with store.workplace() as place:
        (place / "made").symlink_to(tmp_path / "elsewhere")
        with pytest.raises(ValueError, match="is not a link"):
            store.keep(KEY, place / "made")
    assert not store.has(KEY)


def test_what_no_result_holds_is_refused(store: Store) -> None:
    with pytest.raises(ValueError, match=r"'evil\.svg' is not a file of a result"):
        made(store, {"evil.svg": "<svg/>"})
    with pytest.raises(ValueError, match="is not the key"):
        made(store, {"report.json": "{}"}, key="../../secret")
    assert not store.has(KEY)


def test_a_result_that_is_too_large_is_refused(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("checker.service.store.store.RESULT_LIMIT", 10)
    made(store, {"report.json": "x" * 10})
    with pytest.raises(ValueError, match="at most"):
        made(store, {"report.json": "x" * 6, "report.html": "x" * 5}, key=OTHER)


def test_files_of_a_result_lie_there_compressed_as_well(store: Store) -> None:
    page = "<header>\n" + "a report " * 1_000
    made(store, {"report.json": page, "a/report.html": page, "a/robot.glb": "short"})
    assert store.names(KEY) == ("a/report.html", "a/robot.glb", "report.json")
    for name, expected in (
        ("report.json", page),
        ("a/report.html", page.replace("<header>", f"<header>\n{BACK}")),
    ):
        path = store.file(KEY, name)
        assert path is not None
        packed = path.with_name(f"{path.name}.gz").read_bytes()
        assert len(packed) < len(page) / 10
        assert gzip.decompress(packed).decode() == expected
        assert store.file(KEY, f"{name}.gz") is None
    assert [*store.folder.rglob("robot.glb.gz")] == []


def test_what_nobody_needs_any_more_expires(store: Store) -> None:
    hashes = [uploaded(store, text) for text in (b"old", b"old, still used", b"new")]
    for key in (KEY, OTHER):
        made(store, {"p/report.html": ""}, key)
    for path in [*map(store.upload, hashes[:2]), store.folder / "results" / KEY[:2] / KEY]:
        age(path, 1000)
    store.expire(time.time() - 500, {hashes[1]})
    assert [store.upload(hash) is not None for hash in hashes] == [False, True, True]
    assert (store.has(KEY), store.has(OTHER)) == (False, True)
    assert not list((store.folder / "incoming").iterdir())


def test_what_is_used_again_does_not_expire(store: Store) -> None:
    hash = uploaded(store, b"old")
    made(store, {"report.json": "{}"})
    for path in (store.upload(hash), store.folder / "results" / KEY[:2] / KEY):
        age(path, 1000)
    uploaded(store, b"old")
    assert store.has(KEY)
    store.expire(time.time() - 500, ())
    assert store.upload(hash) is not None
    assert store.has(KEY)


def test_parts_of_checks_are_kept_a_day_longer(store: Store) -> None:
    paths = [store.folder / "parts" / (digit * 2) / (digit * 64) for digit in "ab"]
    shared = store.folder / "cache" / "mesh"
    for path, seconds in zip((*paths, shared), (90_000, 80_000, 0), strict=True):
        path.mkdir(parents=True)
        age(path, seconds)
    store.expire(time.time(), ())
    assert [store.parts(digit * 64) is not None for digit in "ab"] == [False, True]
    assert not shared.parent.exists()


@pytest.fixture
def lax_umask() -> Iterator[None]:
    before = os.umask(0)
    yield
    os.umask(before)


@pytest.mark.usefixtures("lax_umask")
def test_others_cannot_read_it(store: Store) -> None:
    hash = uploaded(store, b"mine")
    with store.workplace() as place:
        for path in (store.folder, *store.folder.rglob("*"), place):
            assert path.stat().st_mode & 0o077 == 0, path
    assert store.upload(hash) is not None


def test_what_others_could_read_is_tightened(store: Store, tmp_path: Path) -> None:
    uploaded(store, b"mine")
    made(store, {"rover/report.json": ""})
    (tmp_path / "elsewhere").mkdir(mode=0o755)
    (store.folder / "results" / "link").symlink_to(tmp_path / "elsewhere")
    ours = [store.folder, *(path for path in store.folder.rglob("*") if not path.is_symlink())]
    for path in ours:
        path.chmod(0o777 if path.is_dir() else 0o644)
    store.tighten()
    modes = {path: path.stat().st_mode & 0o777 for path in ours}
    assert modes == {path: 0o700 if path.is_dir() else 0o600 for path in ours}
    assert (tmp_path / "elsewhere").stat().st_mode & 0o777 == 0o755


def test_what_lies_beside_it_in_its_folder_is_not_touched(store: Store) -> None:
    uploaded(store, b"mine")
    (store.folder / "letters").mkdir()
    lax = (store.folder, store.folder / "letters", store.folder / "uploads")
    for path in lax:
        path.chmod(0o755)
    store.tighten()
    assert [path.stat().st_mode & 0o777 for path in lax] == [0o755, 0o755, 0o700]


def test_what_expires_while_it_is_listed_is_whole_or_not_there(store: Store) -> None:
    files = {f"rover_{number}/report.json": "" for number in range(9)}
    over = Event()

    def listed() -> set[tuple[str, ...]]:
        seen = set()
        while not over.is_set():
            seen.add(store.names(KEY))
        return seen

    with ThreadPoolExecutor(1) as pool:
        looking = pool.submit(listed)
        for _ in range(examples(200)):
            made(store, files)
            store.expire(time.time() + 60, ())
        over.set()
        assert looking.result() <= {(), tuple(sorted(files))}
