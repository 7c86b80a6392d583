"""Files that git could not restore, so that a fix would mix with their author's changes.

A repository may be hostile: its configuration and attributes name programs that git starts (file
system monitors, hooks, filters, commands that fetch missing objects). So git is only used for the
ids of committed files and for the ignored files, with monitors, hooks, transports and writing off.
These commands apply no filter and no textconv, and enter no submodule. The files are compared here.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from checker.base.errors import CheckerError
from checker.base.words import plain, shortened

_QUIET = (
    *("--no-pager", "--no-optional-locks", "--no-replace-objects"),
    *("-c", "core.fsmonitor=false", "-c", "core.hooksPath=/dev/null", "-c", "protocol.allow=never"),
)
_SECONDS = 30.0
_SHA1_DIGITS = 40


class GitFailed(CheckerError):
    """The folder is in a repository, and git does not answer."""


def uncommitted(folder: Path, paths: Sequence[str]) -> list[str]:
    """Return the files that differ from the last commit, or that no commit has.

    None in a folder outside repositories or where git is not installed; ignored files are not the
    repository's and never among them.

    Args:
        folder: Links resolved.
        paths: The paths of files, relative to the folder.

    Raises:
        GitFailed: git does not answer.
    """
    git = shutil.which("git")
    if not paths or git is None or not Path(git).is_absolute() or not _in_repository(folder):
        return []
    committed = _committed(git, folder, paths)
    changed = [path for path in paths if not _is_same(folder / path, committed.get(path, ""))]
    new = [f"./{path}" for path in changed if path not in committed]
    ask = ["check-ignore", "-z", "--stdin"]
    ignored = _git_fields(git, folder, ask, {0, 1}, "\0".join(new)) if new else []
    return [path for path in changed if f"./{path}" not in ignored]


def _in_repository(folder: Path) -> bool:
    return any(os.path.lexists(place / ".git") for place in (folder, *folder.parents))


def _committed(git: str, folder: Path, paths: Sequence[str]) -> dict[str, str]:
    """Return the ids of the files that the last commit has, by path; none before the first one.

    With `./` in front, no name is an option or a pattern.
    """
    if not _git_fields(git, folder, ["rev-parse", "--verify", "--quiet", "HEAD^{commit}"], {0, 1}):
        return {}
    here = [f"./{path}" for path in paths]
    entries = _git_fields(git, folder, ["ls-tree", "-z", "HEAD", "--", *here], {0})
    split = (entry.partition("\t") for entry in entries)
    return {path: about.split()[-1] for about, _, path in split}


def _git_fields(
    git: str, folder: Path, words: Sequence[str], fine: set[int], given: str = ""
) -> list[str]:
    """Return what git answers, by its NUL characters.

    Raises:
        GitFailed: It ends with another exit code, or not at all.
    """
    own = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    quiet = {"GIT_NO_LAZY_FETCH": "1", "GIT_TERMINAL_PROMPT": "0", "LC_ALL": "C"}
    try:
        done = subprocess.run(  # noqa: S603 - the words are ours, and paths stand behind `--`
            [git, *_QUIET, *words],
            cwd=folder,
            env={**own, **quiet},
            input=os.fsencode(given),
            capture_output=True,
            timeout=_SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise _failed(folder, str(error)) from None
    if done.returncode not in fine:
        raise _failed(folder, os.fsdecode(done.stderr).partition("\n")[0])
    return [word for word in os.fsdecode(done.stdout).split("\0") if word]


def _failed(folder: Path, reason: str) -> GitFailed:
    return GitFailed(
        f"git cannot tell whether files in {folder} have uncommitted changes "
        f"({plain(shortened(reason, 300))}); --allow-dirty fixes them anyway"
    )


def _is_same(file: Path, id: str) -> bool:
    """Return whether a file has the content with this id, or had it with other line ends."""
    with suppress(OSError):
        data = file.read_bytes()
        make = hashlib.sha1 if len(id) == _SHA1_DIGITS else hashlib.sha256
        return any(
            make(b"blob %d\0" % len(each) + each, usedforsecurity=False).hexdigest() == id
            for each in (data, data.replace(b"\r\n", b"\n"))
        )
    return False
