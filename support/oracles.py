"""Small C++ programs on libraries that Debian has, which tests and benches compile."""

from __future__ import annotations

import hashlib
import os
import shlex
import subprocess
from collections.abc import Sequence
from pathlib import Path


def is_installed(libraries: Sequence[str]) -> bool:
    """Return whether pkg-config knows some libraries."""
    try:
        return subprocess.run(["pkg-config", "--exists", *libraries], check=False).returncode == 0
    except FileNotFoundError:
        return False


def compiled(source: Path, libraries: Sequence[str], folder: Path) -> Path:
    """Compile a program with some libraries, unless a folder holds it already."""
    digest = hashlib.sha256(source.read_bytes()).hexdigest()[:16]
    program = folder / f"{source.stem}-{digest}"
    if not program.exists():
        wanted = ["pkg-config", "--cflags", "--libs", *libraries]
        flags = shlex.split(subprocess.check_output(wanted, text=True))
        new = program.with_suffix(f".{os.getpid()}")
        subprocess.run(["g++", "-std=c++17", "-O1", source, "-o", new, *flags], check=True)
        new.replace(program)
    return program
