"""Lets uploads come first: a check that would begin among many of them waits for a moment.

Who uploads looks at the page until the answer comes; the checks of a crowd take minutes anyway. To
stand back (`limits`) is not enough: what fills each gap still takes caches, and on
rented machines half of a core, from those who serve.
"""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic, sleep

from checker.service.store.store import Store

_CROWD = 8
"""Uploads at once."""
_SECONDS = 1.0
"""At most; a hundred uploads of 1 MB take as long, and slow ones shall keep nobody waiting."""
_LOOK = 0.05


def let_pass(store: Store, cancelled: Callable[[], bool], seconds: float = _SECONDS) -> None:
    """Wait as long as many uploads come in.

    Args:
        store: Where they come in.
        cancelled: Whether nobody waits for the check any more.
        seconds: At most.
    """
    deadline = monotonic() + seconds
    while store.coming() >= _CROWD and monotonic() < deadline and not cancelled():
        sleep(_LOOK)
