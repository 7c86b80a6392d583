"""The commands of the README, one after the other, in a bare checkout and an empty environment."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from tests.conftest import SAMPLES

ROOT = SAMPLES.parent
BLOCK = re.compile(r"^```sh\n(.*?)^```", re.MULTILINE | re.DOTALL)
LEFT_OUT = "make test"
"""What the tests are run by."""


def commands() -> list[str]:
    """Return the lines of the README's shell blocks without their comments."""
    blocks = BLOCK.findall((ROOT / "README.md").read_text("utf-8"))
    lines = [line.split("  #")[0].strip() for block in blocks for line in block.splitlines()]
    return [line for line in lines if line != LEFT_OUT]


def test_every_command_works(tmp_path: Path) -> None:
    checkout, environment = tmp_path / "subt-check", tmp_path / "environment"
    subprocess.run(["git", "clone", "--quiet", ROOT, checkout], check=True)
    subprocess.run([sys.executable, "-m", "venv", environment], check=True)
    shutil.copytree(SAMPLES / "acme_scout", checkout / "my_robot")
    own = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    own["PATH"] = f"{environment / 'bin'}{os.pathsep}{own['PATH']}"
    assert len(commands()) == 7
    for command in commands():
        done = subprocess.run(
            ["sh", "-c", command],
            capture_output=True,
            text=True,
            check=False,
            cwd=checkout,
            env=own,
        )
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    assert (checkout / "report/index.html").is_file()
    assert (checkout / "demo/index.html").is_file()
