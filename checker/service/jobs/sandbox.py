"""Active layers of the sandbox around the processes that check uploads on this machine."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing

from msgspec.structs import replace

from checker.base.sandbox.launcher import OwnLauncher
from checker.base.sandbox.layers import ACCOUNT, Layer
from checker.base.sandbox.program_files import program_paths
from checker.service.store.store import Store


def layers_of_checks(store: Store) -> Sequence[Layer]:
    """Return the layers around a check, whose folder is in the store.

    Raises:
        OSError: The system starts no process, or the disk is full.
    """
    with (
        store.workplace() as folder,
        closing(OwnLauncher(folder)) as starter,
    ):
        return [_of_store(layer, store) for layer in starter.layers]


def _of_store(layer: Layer, store: Store) -> Layer:
    """Return a layer, which hides nothing if the data is among the files of the program."""
    folder = store.folder.resolve()
    within = next((path for path in program_paths() if folder.is_relative_to(path)), None)
    if within is None or layer.name == ACCOUNT:
        return layer
    words = f"{layer.words}; but the data is in {within}, which the program needs"
    return replace(layer, words=words, hides=False) if layer.hides else layer
