"""Starts commands as a container does: by a user without name, home or rights."""

from __future__ import annotations

import os
import subprocess
from functools import cache
from pathlib import Path

_USER = "10001"
_NAMELESS = ("unshare", "--user", f"--map-user={_USER}", f"--map-group={_USER}", "--")
_POWERLESS = ("setpriv", "--bounding-set=-all", "--inh-caps=-all", "--no-new-privs", "--")


@cache
def _become() -> tuple[str, ...]:
    """Return how to start a command without rights; not every system lets us lose the name too."""
    tried = subprocess.run([*_NAMELESS, "true"], capture_output=True, check=False)
    if tried.returncode == 0:
        return _NAMELESS
    return _POWERLESS if os.geteuid() == 0 else ()


def bare_command(environment: Path, *arguments: str) -> list[str]:
    """Return the command that starts `subt-check` of an environment without rights."""
    return [*_become(), str(environment / "bin/subt-check"), *arguments]


def bare_environment(environment: Path, data: Path) -> dict[str, str]:
    """Return all the variables that it gets."""
    return {
        "PATH": os.pathsep.join([str(environment / "bin"), os.defpath]),
        "SUBT_CHECK_DATA": str(data / "data"),
        "SUBT_CHECK_CACHE": str(data / "cache"),
    }
