"""Reads what mesh files look like in a child process: the module behind `checker.confined`."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Mapping
from functools import partial
from importlib import import_module
from pathlib import Path
from time import monotonic
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from checker.display.early import SECONDS_FOR_ALL
from checker.display.files.collada import collada_pieces
from checker.display.files.painting import FILE_LIMIT, picture, sampled
from checker.display.files.piece import Piece, by_look
from checker.display.files.thinning import joined, shares, thinned
from checker.display.files.wavefront import wavefront_pieces
from checker.display.files.wire import Looked, to_json
from checker.display.surface import Surface
from checker.mesh.apart import Ended, all_apart
from checker.mesh.limits import SECONDS_FOR_ONE, SIZE_LIMIT
from checker.mesh.materials import SIZE_LIMIT as MATERIAL_LIMIT
from checker.mesh.reader import load_libraries, read_surface
from checker.mesh.surface import NoSurface
from checker.package.reading import NotReadable, read_bytes

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


def answer(request: bytes) -> bytes:
    """Read files.

    Args:
        request: JSON: for each file `file` (absolute path, links resolved), `name` (its suffix says
            the format), `triangles` (at most), `pictures` (their paths by the names inside),
            `materials` (paths of material files).

    Returns:
        JSON: what each file looks like, in the same order.
    """
    asked = json.loads(request)
    load_libraries(each["name"] for each in asked if not each["name"].lower().endswith(".obj"))
    if any(each["pictures"] for each in asked):
        import_module("PIL.Image")
    until = monotonic() + SECONDS_FOR_ALL
    shared = _shared_pictures(asked, until)
    works = [partial(_as_bytes, each, shared) for each in asked]
    looked = all_apart(works, SECONDS_FOR_ONE, until, _LATE)
    return b"[" + b",".join(map(_said, looked)) + b"]"


def _said(looked: bytes | Ended) -> bytes:
    return json.dumps(to_json(looked.reason)).encode() if isinstance(looked, Ended) else looked


def _shared_pictures(asked: Iterable[Mapping[str, Any]], until: float) -> Pictures:
    """Read the pictures that several files use: to decode one can take half a second."""
    uses = Counter(path for each in asked for path in set(each["pictures"].values()))
    shared = [path for path, number in uses.most_common(_SHARED) if number > 1]
    read = all_apart([partial(_pixels, path) for path in shared], SECONDS_FOR_ONE, until, _LATE)
    return dict(zip(shared, map(_as_picture, read), strict=True))


def _as_picture(read: bytes | Ended) -> Array | None:
    import numpy as np

    if isinstance(read, Ended) or not read:
        return None
    height = int.from_bytes(read[:_HEIGHT], "big")
    return np.frombuffer(read[_HEIGHT:], np.uint8).reshape(height, -1, 4)


def _pixels(path: str) -> bytes:
    """Return a picture's height and its pixels; nothing if it cannot be read."""
    pixels = _picture(path)
    return b"" if pixels is None else len(pixels).to_bytes(_HEIGHT, "big") + pixels.tobytes()


def _as_bytes(asked: Mapping[str, Any], shared: Pictures) -> bytes:
    return json.dumps(to_json(look(asked, shared))).encode()


def look(asked: Mapping[str, Any], shared: Pictures = MappingProxyType({})) -> Looked:
    """Return what one file looks like.

    Args:
        asked: See `answer`.
        shared: Pictures that are read already, by their path.
    """
    data = read_bytes(Path(asked["file"]), asked["name"], SIZE_LIMIT)
    if isinstance(data, NotReadable):
        return data.reason
    try:
        pieces = by_look(_pieces(data, asked["name"], asked["materials"]))
    except NoSurface as none:
        return none.reason
    painted = [_painted(piece, asked["pictures"], shared) for piece in pieces]
    most = shares([len(each.faces) for each in painted], asked["triangles"], _SMALL)
    return tuple(
        thinned(each, count) for each, count in zip(painted, most, strict=True) if count > 0
    )


def _pieces(data: bytes, name: str, materials: Iterable[str]) -> Iterable[Piece]:
    match name.rpartition(".")[2].lower():
        case "dae":
            return collada_pieces(data)
        case "obj":
            files = (read_bytes(Path(path), path, MATERIAL_LIMIT) for path in materials)
            return wavefront_pieces(data, (file for file in files if isinstance(file, bytes)))
        case _:
            return (Piece(corners=read_surface(data, name).corners),)


def _picture(path: str) -> Array | None:
    data = read_bytes(Path(path), path, FILE_LIMIT)
    return picture(data) if isinstance(data, bytes) else None


def _painted(piece: Piece, pictures: Mapping[str, str], shared: Pictures) -> Surface:
    """Return the triangles with the colours of their picture; without one, with their own."""
    path = pictures.get(piece.look.picture)
    pixels = None
    if path and piece.places is not None:
        pixels = shared[path] if path in shared else _picture(path)
    if pixels is None or piece.places is None:
        return joined(piece.corners, piece.look.colour, None, None)
    colours = sampled(pixels, piece.places)
    white = (1.0, 1.0, 1.0, piece.look.colour[3])
    return joined(piece.corners, white, colours, piece.places)
