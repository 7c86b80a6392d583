"""Results on disk: found again, never in the way, bounded in size."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.cache import NO_CACHE, Cache, cache_folder, code_hash, key_of

parts = st.lists(st.text() | st.binary(), max_size=4)


def test_what_was_put_is_found(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    assert cache.get("mesh", "ab12") is None
    cache.put("mesh", "ab12", {"a": [1, 2.5, None]})
    assert cache.get("mesh", "ab12") == {"a": [1, 2.5, None]}
    assert cache.get("trial", "ab12") is None


def test_a_cache_without_a_folder_keeps_nothing() -> None:
    NO_CACHE.put("mesh", "ab12", 1)
    NO_CACHE.prune()
    assert NO_CACHE.get("mesh", "ab12") is None


@pytest.mark.parametrize("content", [b"", b"{", b"\xff\xfe", b"[" * 100_000])
def test_a_damaged_entry_is_not_found(content: bytes, tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    cache.put("mesh", "ab12", 1)
    (entry,) = tmp_path.rglob("*.json")
    entry.write_bytes(content)
    assert cache.get("mesh", "ab12") is None


def test_a_folder_that_cannot_be_written_is_no_fault(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    cache = Cache(tmp_path / "file")
    cache.put("mesh", "ab12", 1)
    cache.prune()
    assert cache.get("mesh", "ab12") is None


def test_what_was_used_least_recently_goes_first(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    keys = [start.ljust(64, "0") for start in ("aa1", "bb2", "cc3")]
    for age, key in enumerate(keys):
        cache.put("mesh", key, "x" * 100)
        (entry,) = tmp_path.rglob(f"{key}.json")
        os.utime(entry, (1_000_000 - age, 1_000_000 - age))
    assert cache.get("mesh", keys[2])  # the oldest, now used
    cache.prune(limit=250)
    assert [cache.get("mesh", key) is not None for key in keys] == [
        True,
        False,
        True,
    ]


@given(parts, parts)
def test_keys_are_equal_for_equal_parts_alone(
    one: list[str | bytes], other: list[str | bytes]
) -> None:
    def as_bytes(each: list[str | bytes]) -> list[bytes]:
        return [part.encode() if isinstance(part, str) else part for part in each]

    assert (key_of(*one) == key_of(*other)) is (as_bytes(one) == as_bytes(other))


def test_a_key_of_text_that_is_no_unicode() -> None:
    assert key_of("\ud800") != key_of("")


def test_the_hash_of_the_code_depends_on_what_it_is_asked_for() -> None:
    assert code_hash("mesh") == code_hash("mesh")
    assert len({code_hash("mesh"), code_hash("cache.py"), code_hash("mesh", "cache.py")}) == 3


def test_where_results_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SUBT_CHECK_CACHE", "/one")
    assert cache_folder() == Path("/one")
    monkeypatch.delenv("SUBT_CHECK_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", "/two")
    assert cache_folder() == Path("/two/subt-check")


def test_the_size_is_looked_at_now_and_then(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pruned: list[str] = []
    monkeypatch.setattr(Cache, "prune", lambda self: pruned.append(str(self.folder)))
    cache = Cache(tmp_path)
    cache.put("kind", "01" + "0" * 62, 1)
    assert not pruned
    cache.put("kind", "00" + "0" * 62, 1)
    assert pruned == [str(tmp_path)]


def test_what_others_keep_in_the_folder_stays(tmp_path: Path) -> None:
    for name in ("photos/2024/family.jpg", "kind/ab/notes.json"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_bytes(b"x" * 100)
    Cache(tmp_path).prune(limit=0)
    assert len([path for path in tmp_path.rglob("*") if path.is_file()]) == 2
