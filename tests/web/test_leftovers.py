"""A service that runs removes what killed processes have left, and nothing of the living."""

from __future__ import annotations

from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from checker.service.web.uploads import leftovers
from tests.store.test_crashes import HALF, in_progress, kill, start
from tests.web.board import BoardJobs
from tests.web.server import eventually

WORKS = """
import sys
from pathlib import Path
from checker.service.store.store import Store
with Store(Path(sys.argv[1])).workplace() as place:
    (place / "deep" / "er").mkdir(parents=True)
    (place / "deep" / "file").write_text("half")
    print(flush=True)
    sys.stdin.read()
"""


def test_the_dead_leave_nothing_in_a_service_that_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(leftovers, "SECONDS", 0.05)
    store = Store(tmp_path)
    dead, living = (start(HALF, store), start(WORKS, store)), start(HALF, store)
    with TestClient(create_app(BoardJobs(), store, Config()), base_url="http://localhost"):
        for each in dead:
            kill(each)
        assert eventually(lambda: len(in_progress(store)) == 1)
        living.communicate(b"")
    assert living.returncode == 0
    assert not in_progress(store)
