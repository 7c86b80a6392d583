"""What keeps a hostile xacro file within its process: no files, no programs, no network.

The expander checks expressions as well. This is the layer behind it, for what slips through: it is
put up in a process that does nothing but expand one file, and cannot be taken down in it.
"""

from __future__ import annotations

import os
import resource
import sys
from collections.abc import Callable
from contextlib import suppress

from checker.sandbox import seccomp

ANSWER_LIMIT = 60_000_000
"""Bytes that the process may write."""


def put_up() -> None:
    """Take from this process all that expanding a text does not need, for good."""
    os.environ.clear()
    resource.setrlimit(resource.RLIMIT_NOFILE, (0, 0))
    resource.setrlimit(resource.RLIMIT_NPROC, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (ANSWER_LIMIT, ANSWER_LIMIT))
    # The kernel holds native code as well, which no audit hook sees; where it does not, the rest
    # still holds Python.
    with suppress(seccomp.NotHeld):
        seccomp.gain_nothing()
        seccomp.forbid_calls(opens=False, changes=False, signals=False)
    sys.addaudithook(_refuser())


def _refuser() -> Callable[[str, object], None]:
    refusal = PermissionError

    def refuse(event: str, _: object) -> None:
        # The names stand in the code itself: a set elsewhere could be changed.
        if event not in ("compile", "exec", "builtins.id", "sys._getframe"):
            raise refusal(f"an expression may not do this ({event})")

    return refuse
