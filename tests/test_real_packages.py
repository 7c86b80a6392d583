"""Real packages that nobody has judged yet are counted, and make no test fail."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.real_packages import CORPUS, MODERN, REVIEWS, judged_folders, not_judged


@pytest.fixture(autouse=True)
def folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for variable in (CORPUS, REVIEWS, MODERN):
        monkeypatch.setenv(variable, str(tmp_path / variable))
    for name in ("andino_new", "bugs", "create3_sim", "rover_new"):
        (tmp_path / MODERN / name).mkdir(parents=True)
    (tmp_path / MODERN / "README.md").touch()
    (tmp_path / CORPUS / "coro_pam_sensor_config_1").mkdir(parents=True)


def test_what_is_judged_is_looked_at() -> None:
    assert [folder.name for folder in judged_folders(MODERN)] == ["create3_sim"]
    assert judged_folders(REVIEWS) == []


def test_what_is_not_judged_is_counted() -> None:
    assert list(not_judged()) == [
        "SUBT_CHECK_MODERN: 2 folders are not judged yet: andino_new, rover_new"
    ]
