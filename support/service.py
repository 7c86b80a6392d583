"""The whole service on this machine, as `subt-check serve` starts it."""

from __future__ import annotations

import os
import sys
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from support.started import address, process

ROOT = Path(__file__).parents[1]


@contextmanager
def service(
    data: Path,
    more: Mapping[str, str] | None = None,
    workers: int = 1,
    options: Sequence[str] = (),
) -> Iterator[str]:
    """Start a service, yield its address, and stop it.

    Args:
        data: Its folder.
        more: Variables of its environment.
        workers: The number of workers.
        options: Further options of `subt-check serve`.
    """
    command = [sys.executable, "-m", "checker.cli", "serve", "--port", "0"]
    command += ["--workers", str(workers), "--data", str(data), *options]
    log = data.parent / f"{data.name}.log"
    with process(command, ROOT, {**os.environ, **(more or {})}, log) as started:
        yield address(started)


def zip_of(folders: list[Path], archive: Path, also: Mapping[str, bytes] | None = None) -> Path:
    """Pack folders below their own names, with further files, and return the archive."""
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as made:
        for folder in folders:
            for path in sorted(folder.rglob("*")):
                if path.is_file():
                    made.write(path, path.relative_to(folder.parent))
        for name, content in (also or {}).items():
            made.writestr(name, content, zipfile.ZIP_STORED)
    return archive
