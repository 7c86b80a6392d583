"""Virtual environments for tests that run the installed project."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from collections.abc import Callable
from pathlib import Path

import pytest
from filelock import FileLock

ROOT = Path(__file__).parent.parent


def packages(environment: Path) -> Path:
    """Return the folder of a virtual environment's packages."""
    (folder,) = environment.glob("lib/python*/site-packages")
    return folder


def borrow_running_packages(environment: Path) -> None:
    """Let a virtual environment see what is installed in the running one, but not the project.

    The .pth files of a folder that a .pth file adds are not read: an editable installation of the
    project stays out of sight, and what lies deeper (as Pinocchio's does) is named here.
    """
    installed = sysconfig.get_path("purelib")
    deeper = [place for place in sys.path if place.startswith(installed + os.sep)]
    (packages(environment) / "running.pth").write_text("\n".join([installed, *deeper, ""]))


def shared(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], object]) -> Path:
    """Return a folder that the first worker of a run fills, and that all use.

    Args:
        factory: Of the run.
        name: Of the folder.
        make: Fills the empty folder.
    """
    base = factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / name
    with FileLock(f"{folder}.lock"):
        if not folder.exists():
            folder.mkdir()
            make(folder)
            folder.joinpath("made").touch()
    assert folder.joinpath("made").exists(), f"{name} could not be made"
    return folder


def build(source: Path, kind: str, target: Path, **environment: str) -> Path:
    """Build a distribution as a release does, and return it.

    Args:
        source: A checkout, or an unpacked sdist.
        kind: `wheel` or `sdist`.
        target: The folder to put it into.
        environment: Variables that are set for it.
    """
    command = [sys.executable, "-m", "build", f"--{kind}", "--no-isolation", "--outdir", target]
    done = subprocess.run(
        [*command, source],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | environment,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    (built,) = target.iterdir()
    return built


def built_wheel(factory: pytest.TempPathFactory) -> Path:
    """Build the wheel as a release does, from this checkout, and return it."""
    folder = shared(factory, "wheel", lambda folder: build(ROOT, "wheel", folder / "dist"))
    (built,) = folder.glob("dist/*.whl")
    return built


def pip_install(environment: Path, *arguments: str) -> None:
    """Install into a virtual environment that has no pip of its own."""
    pip = [sys.executable, "-m", "pip", "--python", str(environment / "bin/python"), "install"]
    command = [*pip, "--quiet", "--disable-pip-version-check", *arguments]
    # What lies on the path of the tests is not installed in the environment.
    own = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=own)
    assert done.returncode == 0, done.stdout + done.stderr


def make_environment(folder: Path) -> None:
    """Make a virtual environment without pip."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
