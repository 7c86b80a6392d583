"""Processor time of a piece of work, without the pauses of the garbage collector.

What those cost depends on everything that other tests left behind.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Callable


def seconds(work: Callable[[], object]) -> float:
    gc.collect()
    gc.disable()
    try:
        start = time.process_time()
        work()
        return time.process_time() - start
    finally:
        gc.enable()
