"""Carries out the Dockerfile's build stage in folders of a test, where no container engine is.

Nothing is fetched: pip finds in the running environment whatever the image would get from PyPI, and
refuses what constraints.txt does not name as it is installed.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
from dataclasses import dataclass
from pathlib import Path

from tests.deployment.dockerfile import DockerStage, Instruction
from tests.installing import borrow_running_packages

ROOT = Path(__file__).parent.parent.parent
_INSTALLED = "/opt/subt-check"


@dataclass(frozen=True)
class Image:
    """The folder that stands for the root of the image."""

    folder: Path

    @property
    def environment(self) -> Path:
        """The virtual environment that the run-time image gets."""
        return self.folder / _INSTALLED.lstrip("/")

    def build(self, stage: DockerStage, context: Path) -> None:
        """Carry out a stage; `context` is what the engine would be given."""
        here = self.folder / stage.only("WORKDIR").lstrip("/")
        here.mkdir(parents=True)
        for told in stage.instructions:
            if told.word == "COPY":
                _copy(told, context, here)
            elif told.word == "RUN":
                self._run(told.text, here)
        borrow_running_packages(self.environment)

    def _run(self, command: str, here: Path) -> None:
        own = {
            "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]),
            "PYTHONPATH": sysconfig.get_path("purelib"),
            "PIP_NO_INDEX": "1",
            "PIP_DISABLE_PIP_VERSION_CHECK": "1",
        }
        done = subprocess.run(
            ["sh", "-euc", command.replace(_INSTALLED, str(self.environment))],
            capture_output=True,
            text=True,
            check=False,
            cwd=here,
            env=os.environ | own,
        )
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"


def _copy(told: Instruction, context: Path, here: Path) -> None:
    words = told.text.split()
    if words[0].startswith("--from="):
        # The viewer: `make` has built it.
        shutil.copy(ROOT / Path(words[1]).relative_to("/source"), here / words[2])
        return
    for word in words[:-1]:
        target = here / words[-1]
        if (context / word).is_dir():
            shutil.copytree(context / word, target)
        else:
            shutil.copy(context / word, target)


def context_of(root: Path, target: Path) -> Path:
    """Copy what `.dockerignore` lets through."""
    lines = (root / ".dockerignore").read_text("utf-8").splitlines()
    rules = [line for line in lines if line and not line.startswith("#")]
    assert rules[0] == "*"
    shown = [rule[1:] for rule in rules if rule.startswith("!")]
    hidden = [rule.removeprefix("**/") for rule in rules[1:] if not rule.startswith("!")]
    target.mkdir()
    for name in shown:
        if (root / name).is_dir():
            left_out = shutil.ignore_patterns(*(rule for rule in hidden if "/" not in rule))
            shutil.copytree(root / name, target / name, ignore=left_out)
        else:
            shutil.copy(root / name, target / name)
    for rule in hidden:
        if "/" in rule:
            (target / rule).unlink(missing_ok=True)
    return target
