"""The client for VS Code: built from npm, and run with an editor in VS Code's place.

`editors/vscode/test/` has the tests themselves. They run the bundle that the package contains, with
its own language client, against real processes: `@vscode/test-web` would fetch VS Code itself.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from checker.base.resources import tool_version
from tests.conftest import SAMPLES
from tests.installing import shared

ROOT = SAMPLES.parent
BUILT = ROOT / "build/vscode"
PACKAGE = ROOT / f"dist/subt-check-{tool_version()}.vsix"
MOST_BYTES = 300_000


@pytest.fixture(scope="module")
def build(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the bundle and its tests, type-checked and packed."""
    missing = [program for program in ("node", "npm") if shutil.which(program) is None]
    if missing:
        pytest.skip(f"{' and '.join(missing)} not installed: apt install nodejs npm")

    def make(_: Path) -> None:
        PACKAGE.unlink(missing_ok=True)
        done = subprocess.run(
            [ROOT / "editors/vscode/build"], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr

    shared(tmp_path_factory, "vscode", make)
    return BUILT


def run_tests(build: Path, name: str, **environment: str) -> None:
    done = subprocess.run(
        ["node", "--test", f"test/{name}.test.cjs"],
        cwd=build,
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | environment,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.usefixtures("build")
def test_the_package_has_what_it_needs_and_no_more() -> None:
    with zipfile.ZipFile(PACKAGE) as archive:
        names = {name.removeprefix("extension/") for name in archive.namelist()}
        manifest = json.loads(archive.read("extension/package.json"))
        bundle = archive.read("extension/dist/extension.js")
        licences = archive.read("extension/dist/licences.txt").decode()
    about = {"extension.vsixmanifest", "[Content_Types].xml", "package.json", "readme.md"}
    about |= {"changelog.md", "icon.png", "LICENSE.txt"}
    steps = {
        step["media"]["markdown"] for step in manifest["contributes"]["walkthroughs"][0]["steps"]
    }
    assert names == about | steps | {"dist/extension.js", "dist/licences.txt"}
    assert f"./{manifest['main'].removeprefix('./')}" == "./dist/extension.js"
    assert str(ROOT).encode() not in bundle
    assert "vscode-languageclient" in licences
    assert PACKAGE.stat().st_size < MOST_BYTES


def test_the_client_starts_a_server_and_tells_it_what_it_must(build: Path) -> None:
    run_tests(build, "client")


def test_the_client_shows_what_our_server_finds(build: Path) -> None:
    run_tests(
        build,
        "server",
        SUBT_CHECK_SERVER=f"{sys.executable} -m checker.cli server",
        PYTHONPATH=str(ROOT),
        SAMPLES=str(SAMPLES),
    )
