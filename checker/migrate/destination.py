"""Where the new package goes: a whole package under its final name, or none."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from checker.migrate.wishes import NotMigrated
from checker.record import record

_PREFIX = ".subt-check-migrate-"


@record()
class Staging:
    """A package that is being written.

    Attributes:
        folder: Of the package, for now within a hidden folder.
        final: Where it goes in the end.
    """

    folder: Path
    final: Path

    def write(self, path: str, content: bytes) -> None:
        """Write a file of the package and have it reach the disk."""
        target = self.folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        with target.open("wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())


@contextmanager
def staged(destination: Path, package: str) -> Iterator[Staging]:
    """Have a package written beside its final place; it takes that place when all went well.

    A folder that an interrupted run left behind stays hidden and does not count as content.

    Args:
        destination: Folder that the package goes into; made if need be.
        package: Name of the package's folder.

    Raises:
        NotMigrated: The destination is not empty, or cannot be written to.
    """
    made = _made(destination)
    hidden: Path | None = None
    try:
        hidden = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=destination))
        staging = Staging(hidden / package, destination / package)
        staging.folder.mkdir()
        yield staging
        staging.folder.rename(staging.final)
    except OSError as error:
        raise _not_written(destination, error) from None
    finally:
        if hidden is not None:
            shutil.rmtree(hidden, ignore_errors=True)
        for folder in made:
            # Only what is empty goes: after a failure, what was made for nothing.
            with suppress(OSError):
                folder.rmdir()


def _made(destination: Path) -> list[Path]:
    """Make the destination; return the folders that were not there, innermost first."""
    try:
        if destination.is_dir():
            held = [each.name for each in destination.iterdir()]
            if held := sorted(name for name in held if not name.startswith(_PREFIX)):
                raise NotMigrated(
                    f"{destination} is not empty (it contains {held[0]}); give a folder that is "
                    "empty or does not exist"
                )
            return []
        if os.path.lexists(destination):
            raise NotMigrated(
                f"{destination} is not a folder; give one that is empty or does not exist"
            )
        missing = [each for each in (destination, *destination.parents) if not each.exists()]
        destination.mkdir(parents=True)
    except OSError as error:
        raise _not_written(destination, error) from None
    return missing


def _not_written(destination: Path, error: OSError) -> NotMigrated:
    return NotMigrated(
        f"{error.filename or destination} cannot be written: {error.strerror or error}; "
        "no package was made"
    )
