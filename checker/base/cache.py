"""Results on disk by the hash of everything that they depend on.

A cache never fails: what cannot be read or written is computed again. Entries are JSON, never
pickles, so that a foreign file in the folder can at most be wrong, not run.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterator
from contextlib import suppress
from functools import cache as once
from pathlib import Path
from typing import Any

from msgspec import field

from checker.base.files import make_folder
from checker.base.record import Record

SIZE_LIMIT = 300_000_000
"""Bytes on disk; the entries that were used least recently go first."""
_ENTRY = re.compile(r"[0-9a-f]{64}\.json")
_PRUNING = "00"
"""Beginning of the keys whose use checks the size of the cache: one key in 256."""


def cache_folder() -> Path:
    """Return where results are kept: `SUBT_CHECK_CACHE`, else the user's cache folder."""
    own = os.environ.get("SUBT_CHECK_CACHE")
    if own:
        return Path(own)
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(base).expanduser() / "subt-check"


def key_of(*parts: bytes | str) -> str:
    """Return the key of a result that depends on these parts and on nothing else."""
    digest = hashlib.sha256()
    for part in parts:
        data = part.encode(errors="surrogatepass") if isinstance(part, str) else part
        digest.update(len(data).to_bytes(8, "big"))
        digest.update(data)
    return digest.hexdigest()


@once
def code_hash(*folders: str) -> str:
    """Return a hash of this program's own sources below some of its folders or files.

    Sources count by size and time of change: to read them all takes longer than to recall a report.

    Args:
        folders: Relative to the package `checker`; results of one are stale when it changes.
    """
    root = Path(__file__).parents[1]
    return key_of(*sorted(digest for name in folders for digest in _sources(str(root / name))))


def _sources(place: str) -> Iterator[str]:
    if not Path(place).is_dir():
        yield _state(place)
    for folder, _, names in os.walk(place):
        for name in names:
            if name.endswith((".py", ".json")):
                yield _state(f"{folder}/{name}")


def _state(path: str) -> str:
    status = os.stat(path)  # noqa: PTH116 - a Path for each of a thousand files takes its time
    return f"{path} {status.st_size} {status.st_mtime_ns}"


class Cache(Record):
    """Results by kind and key.

    Attributes:
        folder: The folder of the entries; None keeps nothing.
    """

    folder: Path | None
    _passing: list[str] = field(default_factory=list)
    _disturbances: list[str] = field(default_factory=list)

    def pass_over(self, kind: str, disturbance: str = "") -> None:
        """Note that a result is not kept, as of a process that ran out of time.

        Args:
            kind: The kind of the result.
            disturbance: The reason why there is none, where the cause is momentary.
        """
        self._passing.append(kind)
        if disturbance:
            self._disturbances.append(f"{kind}: {disturbance}")

    @property
    def is_whole(self) -> bool:
        """True if all results so far would be the same the next time."""
        return not self._passing

    @property
    def disturbed(self) -> str:
        """Reason why the first missing result may be there the next time; else empty."""
        return self._disturbances[0] if self._disturbances else ""

    def get(self, kind: str, key: str) -> Any:
        """Return a result as the JSON that was put; None if it is not known."""
        if self.folder is None:
            return None
        path = self._path(kind, key)
        try:
            value = json.loads(path.read_bytes())
        except (OSError, ValueError, RecursionError):
            return None
        with suppress(OSError):
            os.utime(path)
        return value

    def put(self, kind: str, key: str, result: Any) -> None:
        """Keep a result that JSON can express."""
        if self.folder is None:
            return
        import tempfile

        path = self._path(kind, key)
        with suppress(OSError):
            make_folder(path.parent)
            with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as file:
                file.write(json.dumps(result, separators=(",", ":")).encode())
            Path(file.name).replace(path)
        if key.startswith(_PRUNING):
            self.prune()

    def _path(self, kind: str, key: str) -> Path:
        if self.folder is None:
            raise ValueError("a cache without a folder keeps nothing")
        return self.folder / kind / key[:2] / f"{key}.json"

    def prune(self, limit: int = SIZE_LIMIT) -> None:
        """Drop the entries that were used least recently until the rest fits into `limit` bytes."""
        if self.folder is None:
            return
        entries = []
        for path in self.folder.glob("*/[0-9a-f][0-9a-f]/*.json"):
            # The folder may hold what others keep.
            with suppress(OSError):
                if not _ENTRY.fullmatch(path.name):
                    continue
                status = path.stat()
                entries.append((status.st_mtime, status.st_size, path))
        room = limit
        for _, size, path in sorted(entries, reverse=True):
            room -= size
            if room < 0:
                with suppress(OSError):
                    path.unlink()


NO_CACHE = Cache(None)
"""Keeps nothing."""
