"""Reads what mesh files look like, in a child process (see `checker.base.child_process`)."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Mapping
from functools import partial
from importlib import import_module
from time import monotonic
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from checker.base.disk_file import NotReadable
from checker.base.forked_work import Ended, all_apart
from checker.base.sandbox.files import Files
from checker.physics.mesh.limits import SECONDS_FOR_ONE
from checker.physics.mesh.reader import load_libraries, read_surface
from checker.physics.mesh.surface import NoSurface
from checker.report.scene.early import SECONDS_FOR_ALL
from checker.report.scene.files.collada import collada_pieces
from checker.report.scene.files.painting import picture, sampled
from checker.report.scene.files.piece import Piece, by_look
from checker.report.scene.files.thinning import joined, shares, thinned
from checker.report.scene.files.wavefront import wavefront_pieces
from checker.report.scene.files.wire import Looked, to_json
from checker.report.scene.surface import Surface

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

Pictures = Mapping[str, "Array | None"]
"""Pixels (h × w × 4, uint8) by path; None where there are none."""
_SHARED = 64
"""Pictures that are kept, a megabyte each at most."""
_HEIGHT = 4
"""Bytes of a number."""
_LATE = f"was not read: the others took {SECONDS_FOR_ALL} s"
_SMALL = 100
"""Triangles that each material of a file keeps where there is room."""


def prepare() -> None:
    """Import what most files need, before it is known which files there are."""
    load_libraries(["mesh.dae"])
    import_module("PIL.Image")


def answer(request: bytes, files: Files) -> bytes:
    """Read files.

    Args:
        request: JSON: for each file `file`, `name` (its suffix says the format), `triangles` (at
            most), `pictures` (by the names inside), `materials` (material files).
        files: All of these, under the names that the request gives them.

    Returns:
        JSON: what each file looks like, in the same order.
    """
    asked = json.loads(request)
    load_libraries(each["name"] for each in asked if not each["name"].lower().endswith(".obj"))
    if any(each["pictures"] for each in asked):
        import_module("PIL.Image")
    until = monotonic() + SECONDS_FOR_ALL
    shared = _shared_pictures(asked, files, until)
    works = [partial(_as_bytes, each, files, shared) for each in asked]
    looked = all_apart(works, SECONDS_FOR_ONE, until, _LATE)
    return b"[" + b",".join(map(_said, looked)) + b"]"


def _said(looked: bytes | Ended) -> bytes:
    return json.dumps(to_json(looked.reason)).encode() if isinstance(looked, Ended) else looked


def _shared_pictures(asked: Iterable[Mapping[str, Any]], files: Files, until: float) -> Pictures:
    """Read the pictures that several files use: to decode one can take half a second."""
    uses = Counter(path for each in asked for path in set(each["pictures"].values()))
    shared = [path for path, number in uses.most_common(_SHARED) if number > 1]
    read = all_apart(
        [partial(_pixels, files, path) for path in shared], SECONDS_FOR_ONE, until, _LATE
    )
    return dict(zip(shared, map(_as_picture, read), strict=True))


def _as_picture(read: bytes | Ended) -> Array | None:
    import numpy as np

    if isinstance(read, Ended) or not read:
        return None
    height = int.from_bytes(read[:_HEIGHT], "big")
    return np.frombuffer(read[_HEIGHT:], np.uint8).reshape(height, -1, 4)


def _pixels(files: Files, path: str) -> bytes:
    """Return a picture's height and its pixels; nothing if it cannot be read."""
    pixels = _picture(files, path)
    return b"" if pixels is None else len(pixels).to_bytes(_HEIGHT, "big") + pixels.tobytes()


def _as_bytes(asked: Mapping[str, Any], files: Files, shared: Pictures) -> bytes:
    return json.dumps(to_json(look(asked, files, shared))).encode()


def look(asked: Mapping[str, Any], files: Files, shared: Pictures = MappingProxyType({})) -> Looked:
    """Return what one file looks like.

    Args:
        asked: See `answer`.
        files: See `answer`.
        shared: Pictures that are read already, by their path.
    """
    data = files.read(asked["file"])
    if isinstance(data, NotReadable):
        return data.reason
    try:
        pieces = by_look(_pieces(data, asked, files))
    except NoSurface as none:
        return none.reason
    painted = [_painted(piece, asked["pictures"], files, shared) for piece in pieces]
    most = shares([len(each.faces) for each in painted], asked["triangles"], _SMALL)
    return tuple(
        thinned(each, count) for each, count in zip(painted, most, strict=True) if count > 0
    )


def _pieces(data: bytes, asked: Mapping[str, Any], files: Files) -> Iterable[Piece]:
    match asked["name"].rpartition(".")[2].lower():
        case "dae":
            return collada_pieces(data)
        case "obj":
            materials = map(files.read, asked["materials"])
            return wavefront_pieces(data, (each for each in materials if isinstance(each, bytes)))
        case _:
            return (Piece(corners=read_surface(data, asked["name"]).corners),)


def _picture(files: Files, path: str) -> Array | None:
    data = files.read(path)
    return picture(data) if isinstance(data, bytes) else None


def _painted(piece: Piece, pictures: Mapping[str, str], files: Files, shared: Pictures) -> Surface:
    """Return the triangles with the colours of their picture; without one, with their own."""
    path = pictures.get(piece.look.picture)
    pixels = None
    if path and piece.places is not None:
        pixels = shared[path] if path in shared else _picture(files, path)
    if pixels is None or piece.places is None:
        return joined(piece.corners, piece.look.colour, None, None)
    colours = sampled(pixels, piece.places)
    white = (1.0, 1.0, 1.0, piece.look.colour[3])
    return joined(piece.corners, white, colours, piece.places)
