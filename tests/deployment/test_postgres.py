"""The PostgreSQL of the tests is a real one, and nothing of it is left."""

from __future__ import annotations

import secrets
import tempfile
from pathlib import Path

import psycopg
import pytest

from support.postgres import fresh_database, started


def test_each_test_has_a_database_of_its_own(postgres_url: str) -> None:
    first, second = fresh_database(postgres_url), fresh_database(postgres_url)
    with psycopg.connect(first) as connection:
        connection.execute("CREATE TABLE robots (name text)")
        assert connection.info.server_version // 10_000 == 16
    with (
        psycopg.connect(second) as connection,
        pytest.raises(psycopg.errors.UndefinedTable),
    ):
        connection.execute("SELECT * FROM robots")


def test_it_wants_the_password(postgres_url: str) -> None:
    with pytest.raises(psycopg.OperationalError, match="password"):
        psycopg.connect(postgres_url, password=secrets.token_hex())


def _fail_while_it_serves() -> None:
    with started() as url:
        with psycopg.connect(url) as connection:
            (cluster,) = connection.execute("SHOW data_directory").fetchone() or ("",)
        assert Path(cluster).is_dir()
        raise LookupError(url, cluster)


def test_nothing_is_left_of_a_server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # A folder that only its owner may enter.
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.raises(LookupError) as failed:
        _fail_while_it_serves()
    url, cluster = failed.value.args
    assert not Path(cluster).parent.exists()
    with pytest.raises(psycopg.OperationalError):
        psycopg.connect(url)
