"""What counts as a file of this program, and is left to every process in the sandbox."""

from __future__ import annotations

import os
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

from checker.base.child_process import Child, Limits
from checker.base.sandbox import layers, namespaces
from checker.base.sandbox.launcher import OwnLauncher
from checker.base.sandbox.program_files import program_paths
from checker.service.jobs import sandbox
from checker.service.jobs.sandbox import layers_of_checks
from checker.service.store.store import Store

ECHO = "def answer(request, files):\n    return request\n"


def test_relative_folders_and_homes_are_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "home" / "me" / "library").mkdir(parents=True)
    (tmp_path / "link").symlink_to("home")
    monkeypatch.setenv("HOME", str(tmp_path / "home" / "me"))
    named = [".", "", "..", str(tmp_path / "home"), str(tmp_path / "link"), "/"]
    named.append(str(tmp_path / "home" / "me" / "library"))
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(named))
    monkeypatch.chdir(tmp_path)
    found = program_paths()
    assert all(Path(path).is_absolute() for path in found)
    assert [path for path in found if path.startswith(str(tmp_path))] == [named[-1]]
    assert "/" not in found


def test_a_relative_folder_opens_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    body = "def answer(request, files):\n    return open(request, 'rb').read()\n"
    (tmp_path / "reads_all.py").write_text(body)
    (tmp_path / "secret").mkdir()
    (tmp_path / "secret" / "file").write_text("secret")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join((".", str(tmp_path))))
    for names in ((layers.LANDLOCK,), layers.ALL):
        with closing(OwnLauncher(names=names)) as starter:
            wanted = b"/etc/passwd"
            said = Child("reads_all", wanted, Limits(5), starter=starter).answer()
            assert not isinstance(said, bytes) or not starter.layers[0].held


@pytest.mark.programs
def test_an_environment_that_is_reached_by_a_link(tmp_path: Path) -> None:
    if namespaces.bubblewrap():
        pytest.skip(namespaces.bubblewrap())
    (tmp_path / "release").mkdir()
    (tmp_path / "release" / "lib").mkdir()
    (tmp_path / "release" / "lib" / "echoes.py").write_text(ECHO)
    (tmp_path / "current").symlink_to("release")
    script = (
        "from checker.base.child_process import Child, Limits\n"
        "from checker.base.sandbox.launcher import OwnLauncher\n"
        "print(Child('echoes', b'yes', Limits(5), starter=OwnLauncher()).answer())\n"
    )
    folders = (f"{tmp_path}/current", f"{tmp_path}/current/lib", str(Path(__file__).parents[2]))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(folders)}
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == "b'yes'\n", done.stderr


def test_data_among_the_files_of_the_program_are_not_hidden(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = Store(tmp_path / "venv" / "lib" / "data")
    assert all(layer.hides == (layer.name != layers.SECCOMP) for layer in held(store))
    monkeypatch.setattr(sandbox, "program_paths", lambda: [str((tmp_path / "venv/lib").resolve())])
    assert not [layer for layer in held(store) if layer.hides and layer.name != layers.ACCOUNT]


def held(store: Store) -> list[layers.Layer]:
    """Return the layers that hold, but for those that hide nothing on this machine.

    These are namespaces without bubblewrap, and the account where Python is in a folder that is
    closed to other users.
    """
    weak = {layers.NAMESPACES} if namespaces.bubblewrap() else set()
    found = [layer for layer in layers_of_checks(store) if layer.held and layer.name not in weak]
    return [layer for layer in found if "closed to other users" not in layer.words]
