"""An upload attacks a service that runs: by an expression of xacro, of the kind that was published.

From a function that expressions know it goes to its globals, to the modules that are loaded, and to
ctypes; then it links the database into the result, and reads what it can into the report.
"""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from contextlib import closing
from pathlib import Path

import httpx
import pytest

from checker.base.sandbox import layers
from checker.base.sandbox.launcher import OwnLauncher
from tests.sandbox.assets import Outside
from tests.serving.conftest import (
    SECONDS,
    Serve,
    Serving,
    environment_of,
    serve,  # noqa: F401 (a fixture)
)
from tests.survival.conftest import upload, wait_for_end

SECRETS = {
    "token": "SECRET-token-4711",
    "other": "SECRET-upload-of-another",
    "home": "SECRET-of-the-home",
}


ROOT = Path(__file__).parents[2]
XACRO = "http://www.ros.org/wiki/xacro"


def _hidden(name: str) -> str:
    """Return an expression for a name between double underscores, which no filter of texts sees."""
    return f"'-_-_{name}_-_-'.replace('-','')"


def _got(thing: str, name: str) -> str:
    """Return an expression for an attribute whose name holds double underscores."""
    found = f"python.vars(python.type({thing}))[{_hidden(name)}]"
    return f"python.vars(python.type({found}))[{_hidden('get')}]({found},{thing})"


GLOBALS = _got("load_yaml", "globals")
MODULES = f"{GLOBALS}['sys'].modules"
OPEN = f"{GLOBALS}[{_hidden('builtins')}]['open']"


def packages(place: Path, expressions: list[str]) -> bytes:
    """Return packages whose xacro files each evaluate an expression into the name of a link."""
    with zipfile.ZipFile(place / "hostile.zip", "w") as archive:
        for number, each in enumerate(expressions):
            name = f"hostile{number}_description"
            robot = f'<robot xmlns:xacro="{XACRO}" name="r"><link name="${{{each}}}"/></robot>'
            archive.writestr(f"{name}/urdf/robot.urdf.xacro", robot)
            archive.writestr(
                f"{name}/package.xml",
                f"<package format='3'><name>{name}</name><version>0.1.0</version>"
                "<description>x</description><maintainer email='a@b.c'>x</maintainer>"
                "<license>MIT</license></package>",
            )
    return (place / "hostile.zip").read_bytes()


def served(serving: Serving, id: str) -> bytes:
    """Return all that the service says of a check, and all of its files."""
    api = f"{serving.url}/api/checks/{id}"
    told = httpx.get(api, timeout=SECONDS).json()
    pages = [f"{serving.url}/checks/{id}", api, f"{api}/index.html", f"{api}/packages/index.html"]
    pages += [serving.url + each for each in told["files"]]
    return b"".join(httpx.get(each, timeout=SECONDS).content for each in pages)


@pytest.fixture
def attacked(serve: Serve, tmp_path: Path) -> tuple[Path, bytes]:  # noqa: F811
    """Attack; return the folder of the data, and all that is served of the attack."""
    home, data = tmp_path / "home", tmp_path / "data"
    home.mkdir()
    (home / ".netrc").write_text(SECRETS["home"])
    given = {"SUBT_CHECK_DATA": str(data), "HOME": str(home), "A_TOKEN": SECRETS["token"]}
    serving = serve("--workers", 1, **given)
    wait_for_end(
        serving.url, upload(serving.url, "a.sdf", f"<sdf>{SECRETS['other']}</sdf>".encode())
    )
    database, page = str(data / "jobs.sqlite"), "index.html"
    libc = f"{MODULES}['ctypes'].CDLL(None)"
    expressions = [
        f"{libc}.link('{database}'.encode(),'{page}'.encode())",
        f"{MODULES}['os'].link('{database}','{page}')",
        f"{OPEN}('{home}/.netrc').read()",
        f"{OPEN}('{database}','rb').read()",
        f"{OPEN}('/proc/self/environ').read()",
        f"{MODULES}['os'].environ",
    ]
    id = upload(serving.url, "hostile.zip", packages(tmp_path, expressions))
    assert wait_for_end(serving.url, id)["stage"] == "done"
    good = upload(serving.url)
    assert wait_for_end(serving.url, good)["final"]
    return data, served(serving, id)


def test_nothing_is_read_written_or_served(attacked: tuple[Path, bytes]) -> None:
    data, found = attacked
    assert b"SQLite format 3" not in found
    for secret in SECRETS.values():
        assert secret.encode() not in found
    for each in (data / "results").rglob("*"):
        if each.is_file():
            assert each.stat().st_nlink == 1
            assert b"SQLite format 3" not in each.read_bytes()
    assert (data / "jobs.sqlite").stat().st_nlink == 1


def test_the_expression_is_refused(attacked: tuple[Path, bytes]) -> None:
    """It holds from when the interpreter of expressions evaluates what it knows, and no more."""
    _, found = attacked
    assert b"expression uses" in found


def layers_here() -> tuple[layers.Layer, ...]:
    with closing(OwnLauncher()) as starter:
        return starter.layers


def test_native_code_in_a_service(
    serve: Serve,  # noqa: F811
    outside: Outside,
    tmp_path: Path,
) -> None:
    """A worker of its own, whose process that checks is hostile from the start."""
    data = tmp_path / "data"
    own = {"SUBT_CHECK_DATA": str(data), "A_TOKEN": SECRETS["token"]}
    serving = serve("--workers", 0, **own)
    command = [sys.executable, "-m", "tests.sandbox.hostile_worker"]
    told = {"deed": "attempts", "without": ["many_processes"]}
    id = upload(serving.url, "other.sdf", f"<sdf>{SECRETS['other']}</sdf>".encode())
    (other,) = (each for each in (data / "uploads").rglob("*") if each.is_file())
    assets = outside.given | {"database": str(data / "jobs.sqlite"), "upload": str(other)}
    with subprocess.Popen(command, cwd=ROOT, env=environment_of(tmp_path) | own) as worker:
        try:
            wait_for_end(serving.url, id)
            said = json.dumps(told | {"assets": assets})
            hostile = upload(
                serving.url, "x.sdf", f"<sdf><!--HOSTILE{said}HOSTILE--></sdf>".encode()
            )
            assert wait_for_end(serving.url, hostile)["final"]
            found = served(serving, hostile)
            good = upload(serving.url)
            assert wait_for_end(serving.url, good)["stage"] == "done"
        finally:
            worker.kill()
    assert b'"read_database": "not: ' in found
    for secret in (*SECRETS.values(), "SECRET-of-somebody-else", "SQLite format 3"):
        assert secret.encode() not in found
    if {layer.name for layer in layers_here() if layer.held} == {*layers.ALL}:
        assert not {name for name, got in outside.got().items() if got}
    assert (data / "jobs.sqlite").stat().st_nlink == 1
