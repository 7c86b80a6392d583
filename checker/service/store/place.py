"""Folder with the data of the service."""

from __future__ import annotations

import os
from pathlib import Path

from checker.base.errors import CheckerError

DATABASE = "jobs.sqlite"
"""The file of the database in that folder, unless it is elsewhere."""


def choose(data: str, store: str) -> None:
    """Make this process, and those that it starts, use a folder and a bucket; empty for no change.

    Args:
        data: The folder, for `SUBT_CHECK_DATA`.
        store: Address of the bucket, for `SUBT_CHECK_STORE`.
    """
    if data:
        os.environ["SUBT_CHECK_DATA"] = str(Path(data).absolute())
    if store:
        os.environ["SUBT_CHECK_STORE"] = store


def data_folder() -> Path:
    """Return the folder of uploads, results and the database; it may not be there yet.

    `SUBT_CHECK_DATA`, else the user's data folder as the XDG base directories state.

    Raises:
        CheckerError: The user has no home folder, as in some containers.
    """
    own = os.environ.get("SUBT_CHECK_DATA")
    if own:
        return Path(own).absolute()
    base = os.environ.get("XDG_DATA_HOME") or "~/.local/share"
    try:
        return (Path(base).expanduser() / "subt-check").absolute()
    except RuntimeError:
        raise CheckerError(
            "this user has no home folder for uploads and reports; set SUBT_CHECK_DATA to a "
            "writable folder"
        ) from None
