"""Whatever befalls a service, each check ends once, with the trial of its own robot.

`python -m bench.chaos` does the same with a hundred uploads and forty kills.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from bench.chaos import Trouble, away, filled, services, suffered
from bench.killer import KINDS

pytestmark = pytest.mark.service
DISK = 400_000_000
UPLOADS = 4
KILLS = 6
A_WHILE = 6.0


@pytest.fixture(params=["sqlite", "postgresql"])
def server(request: pytest.FixtureRequest) -> str:
    """The address of PostgreSQL, for two services; empty for one service on SQLite."""
    if request.param == "sqlite":
        return ""
    return str(request.getfixturevalue("postgres_url"))


def assert_all_went_well(trouble: Trouble) -> None:
    assert trouble.is_none, trouble
    assert trouble.ends == {"done": UPLOADS}


def test_processes_of_every_kind_are_killed(server: str, tmp_path: Path) -> None:
    with services(tmp_path, server) as groups:
        trouble = suffered(groups, UPLOADS, KILLS, pause=2.0)
    assert_all_went_well(trouble)
    assert len(trouble.kills) >= len(KINDS) - 1, "those of short life may not be met"


def test_the_database_is_away(server: str, tmp_path: Path) -> None:
    with services(tmp_path, server) as groups:
        trouble = suffered(groups, UPLOADS, meanwhile=lambda: away(groups[0], server, A_WHILE))
    assert_all_went_well(trouble)


def test_the_disk_is_full(tmp_path: Path) -> None:
    with services(tmp_path, "", DISK) as groups:
        trouble = suffered(groups, UPLOADS, meanwhile=lambda: filled(groups[0], A_WHILE))
    assert_all_went_well(trouble)
