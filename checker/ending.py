"""Requests to end, which come as signals."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Collection
from queue import SimpleQueue


def on_requests_to_end(numbers: Collection[signal.Signals], *do: Callable[[], object]) -> None:
    """Have something done at the first of some signals, something else at the second, and so on.

    A handler interrupts the main thread wherever it is: within `Event.wait`, say, where it holds
    the lock that `Event.set` waits for. So what is asked for is done by a thread of its own, and
    all that the handler does is to tell it, by the one queue that may be interrupted at any point.

    Args:
        numbers: Of the signals.
        do: What is to be done, in this order; further signals do nothing.
    """
    asked: SimpleQueue[None] = SimpleQueue()

    def in_turn() -> None:
        for each in do:
            asked.get()
            each()

    def on_signal(_number: int, _frame: object) -> None:
        asked.put(None)

    threading.Thread(target=in_turn, daemon=True, name="requests to end").start()
    for number in numbers:
        signal.signal(number, on_signal)
