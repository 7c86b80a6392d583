"""Which layers hold around the processes that check uploads on this machine."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing

from checker.sandbox.launcher import OwnLauncher
from checker.sandbox.layers import Layer
from checker.store.store import Store


def layers_of_checks(store: Store) -> Sequence[Layer]:
    """Return the layers around a check, whose folder lies in the store.

    Raises:
        OSError: The system starts no process, or the disk is full.
    """
    with (
        store.workplace() as folder,
        closing(OwnLauncher(folder)) as starter,
    ):
        return starter.layers
