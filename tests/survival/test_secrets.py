"""What the service keeps and logs opens no report, and is for its user alone."""

from __future__ import annotations

from pathlib import Path

import httpx
import pytest
from msgspec.structs import astuple

from checker.service.jobs.durable.receipts import key_of_check
from support.postgres import dump
from support.service import zip_of
from tests.conftest import SAMPLES
from tests.serving.conftest import SECONDS, Serve, Serving
from tests.survival.conftest import Home, kill, receipt, upload, wait_for_end

MODEL = "broken_gurdy_description"
NOBODYS = "x" * 22
"""An id that was never given."""


def everything(home: Home) -> bytes:
    """Return all bytes that the service has written: database, data and logs."""
    files = [each for each in home.folder.rglob("*") if each.is_file()]
    kept = b"".join(each.read_bytes() for each in files)
    return kept if home.database.startswith("sqlite") else kept + dump(home.database)


def watched(url: str, id: str) -> None:
    """Ask for a check in each of the ways there are."""
    page, api = f"{url}/checks/{id}", f"{url}/api/checks/{id}"
    for address in (page, api, f"{api}/events", f"{api}/report.json", f"{api}/report.html"):
        assert httpx.get(address, timeout=SECONDS).status_code in (200, 204)


def test_ids_are_nowhere_and_what_is_there_opens_nothing(home: Home, tmp_path: Path) -> None:
    serving = home.serve(workers=1)
    package = zip_of([SAMPLES / MODEL], tmp_path / f"{MODEL}.zip").read_bytes()
    done = upload(serving.url, f"{MODEL}.zip", package)
    assert wait_for_end(serving.url, done)["stage"] == "done"
    watched(serving.url, done)
    again = upload(serving.url, f"{MODEL}.zip", package)
    cancelled, secret = astuple(receipt(serving.url))
    cancel = f"{serving.url}/api/checks/{cancelled}/cancel"
    ended = httpx.post(cancel, headers={"Subt-Check-Secret": secret}, timeout=SECONDS)
    assert ended.status_code == 200
    assert secret.encode() not in everything(home)
    assert_hidden(home, [done, again, cancelled])
    assert_useless(serving, [key_of_check(done), serving.told.split('"check": "')[1][:12]])
    kill(serving)
    waits = upload(home.serve().url)
    assert_hidden(home, [done, again, cancelled, waits])


def assert_hidden(home: Home, ids: list[str]) -> None:
    found = everything(home)
    for id in ids:
        assert id.encode() not in found
        assert key_of_check(id).encode() in found


def assert_useless(serving: Serving, digests: list[str]) -> None:
    """Assert that each digest is answered as an id that was never given."""
    for digest in digests:
        for path in ("/checks/{}", "/api/checks/{}", "/api/checks/{}/report.json"):
            answers = [
                httpx.get(serving.url + path.format(id), timeout=SECONDS)
                for id in (digest, NOBODYS)
            ]
            assert [each.status_code for each in answers] == [404, 404]
            assert answers[0].content == answers[1].content
        answer = httpx.delete(f"{serving.url}/api/checks/{digest}", timeout=SECONDS)
        assert answer.status_code == 404


@pytest.fixture
def checked(serve: Serve, tmp_path: Path) -> Path:
    """The data of a service that has checked a package, under the laxest umask, and runs."""
    serving = serve("--workers", 1, SUBT_CHECK_DATA=str(tmp_path / "data"))
    package = zip_of([SAMPLES / MODEL], tmp_path / f"{MODEL}.zip")
    id = upload(serving.url, package.name, package.read_bytes())
    assert wait_for_end(serving.url, id)["stage"] == "done"
    return tmp_path / "data"


def modes(data: Path) -> dict[str, str]:
    """Return what others may do with each file and folder of the service, where it is anything."""
    found = {str(each): each.stat().st_mode & 0o777 for each in (data, *data.rglob("*"))}
    wanted = {each: 0o700 if Path(each).is_dir() else 0o600 for each in found}
    return {each: oct(mode) for each, mode in found.items() if mode != wanted[each]}


def test_files_are_for_the_user_of_the_service_alone(checked: Path) -> None:
    names = {each.relative_to(checked).parts[0] for each in checked.rglob("*") if each.is_file()}
    beside = {"jobs.sqlite", "jobs.sqlite-wal", "jobs.sqlite-shm", "lock"}
    assert names == {"incoming", "parts", "results", "uploads", "workers", *beside}
    assert modes(checked) == {}


def test_data_of_a_laxer_version_is_tightened_at_the_start(checked: Path, serve: Serve) -> None:
    for each in (checked, *checked.rglob("*")):
        each.chmod(0o755 if each.is_dir() else 0o644)
    assert serve("--workers", 0, SUBT_CHECK_DATA=str(checked)).url
    assert modes(checked) == {}
