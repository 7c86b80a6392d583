"""Where the data of the service lies."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.errors import CheckerError
from checker.service.store.place import data_folder


def test_the_folder_that_the_environment_names(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SUBT_CHECK_DATA", "/one")
    assert data_folder() == Path("/one")


def test_the_folder_of_the_user(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SUBT_CHECK_DATA", raising=False)
    monkeypatch.setenv("XDG_DATA_HOME", "/two")
    assert data_folder() == Path("/two/subt-check")
    monkeypatch.delenv("XDG_DATA_HOME")
    monkeypatch.setenv("HOME", "/home/robot")
    assert data_folder() == Path("/home/robot/.local/share/subt-check")


def test_a_user_without_a_home(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SUBT_CHECK_DATA", raising=False)
    monkeypatch.setenv("XDG_DATA_HOME", "~no-such-user/data")
    with pytest.raises(CheckerError, match="set SUBT_CHECK_DATA"):
        data_folder()
