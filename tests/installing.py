"""Virtual environments for tests that run the installed project; nothing is fetched for them."""

from __future__ import annotations

import os
import sys
import sysconfig
from pathlib import Path


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
