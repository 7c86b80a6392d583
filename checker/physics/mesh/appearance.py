"""Appearance of mesh files: their triangles by colour, reduced in number.

Pictures become colours of corners, sampled where these are in the picture. Runs in a child process
only (see `worker`).
"""

from __future__ import annotations

import io
import json
from collections import Counter
from collections.abc import Mapping, Sequence
from functools import partial
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from checker.base.files import NotReadable
from checker.base.forked_work import ForkRunner, as_entry
from checker.base.parts import WorkerFailed
from checker.base.sandbox.files import Files
from checker.physics.mesh.content import NoSurface, Piece, by_material
from checker.physics.mesh.reader import read_content
from checker.physics.mesh.surface import (
    Appearance,
    Surface,
    appearance_to_json,
    merge_corners,
    shares,
    thinned,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

PIXELS = 40_000_000
"""Greatest size of a picture; 160 MB while it is read. One of 4096 × 4096 has 17 million."""
_SIDE = 512
"""Pixels to which a picture is reduced: a colour for each corner shows no more of it."""
_INWARDS = 0.15
"""Share of the way from a corner to the middle of its triangle: next to a seam of the picture
are pixels that are not visible."""


def picture(data: bytes) -> Array | None:
    """Return a PNG or JPEG file as red, green, blue, alpha (h × w × 4, uint8).

    It is opaque. None if it cannot be read, or is too large to be.
    """
    import numpy as np
    from PIL import Image

    try:
        with Image.open(io.BytesIO(data), formats=("PNG", "JPEG")) as image:
            if image.width * image.height > PIXELS:
                return None
            # Reduced first, so that as little as can be is converted; JPEG even decodes smaller.
            mixed = image if image.mode in ("L", "RGB", "RGBA") else image.convert("RGB")
            mixed.thumbnail((_SIDE, _SIDE), Image.Resampling.BOX)
            rgba = mixed.convert("RGB").convert("RGBA")
        return np.asarray(rgba, np.uint8)
    except MemoryError:
        raise
    except Exception:  # noqa: BLE001 - Pillow raises anything on corrupt files
        return None


def sampled(pixels: Array, places: Array) -> Array:
    """Return the colours of triangles' corners (n × 3 × 4, uint8).

    Args:
        pixels: The pixels of the picture (h × w × 4).
        places: The places of the corners in it (n × 3 × 2); outside 0 to 1 it repeats.
    """
    import numpy as np

    inside = places + _INWARDS * (places.mean(axis=1, keepdims=True) - places)
    with np.errstate(invalid="ignore"):
        share = np.nan_to_num(np.mod(inside, 1.0), nan=0.0)
    height, width = pixels.shape[:2]
    column = np.minimum((share[..., 0] * width).astype(np.int64), width - 1)
    row = np.minimum(((1.0 - share[..., 1]) * height).astype(np.int64), height - 1)
    colours: Array = pixels[row, column]
    return colours


Pictures = Mapping[str, "Array | None"]
"""Pixels (h × w × 4, uint8) by path; None if there are none."""
_SHARED = 64
"""Pictures that are kept, a megabyte each at most."""
_HEIGHT = 4
"""Bytes of a number."""
_SMALL = 100
"""Triangles that each material of a file keeps where there is room."""


def appearances(
    items: Sequence[Mapping[str, Any]], files: Files, run_in_forks: ForkRunner
) -> list[bytes]:
    """Return as JSON what each of some files looks like.

    Args:
        items: The items for each `file`, `name` (its suffix states the format), `triangles` (at
            most), `pictures` (by the names inside), `materials` (material files).
        files: All of these, under the names that the items give them.
        run_in_forks: Reads them.
    """
    if any(item["pictures"] for item in items):
        import_module("PIL.Image")
    shared = _shared_pictures(items, files, run_in_forks)
    read = run_in_forks([partial(_as_json, item, files, shared) for item in items])
    return [*map(as_entry, read)]


def _as_json(item: Mapping[str, Any], files: Files, shared: Pictures) -> bytes:
    return json.dumps(appearance_to_json(appearance_of(item, files, shared))).encode()


def appearance_of(
    item: Mapping[str, Any], files: Files, shared: Pictures = MappingProxyType({})
) -> Appearance:
    """Return what one file looks like.

    Args:
        item: See `appearances`.
        files: See `appearances`.
        shared: Pictures that are read already, by their path.
    """
    data = files.read(item["file"])
    if isinstance(data, NotReadable):
        return data.reason
    materials = map(files.read, item["materials"])
    try:
        at_hand = (material for material in materials if isinstance(material, bytes))
        pieces = by_material(read_content(data, item["name"], at_hand).pieces)
    except NoSurface as none:
        return none.reason
    painted = [_painted(piece, item["pictures"], files, shared) for piece in pieces]
    most = shares([len(look.faces) for look in painted], item["triangles"], _SMALL)
    return tuple(
        thinned(look, count) for look, count in zip(painted, most, strict=True) if count > 0
    )


def _painted(piece: Piece, pictures: Mapping[str, str], files: Files, shared: Pictures) -> Surface:
    """Return the triangles with the colours of their picture; without one, with their own."""
    path = pictures.get(piece.material.picture)
    pixels = None
    if path and piece.places is not None:
        pixels = shared[path] if path in shared else _picture(files, path)
    if pixels is None or piece.places is None:
        return merge_corners(piece.corners, piece.material.colour, None, None)
    colours = sampled(pixels, piece.places)
    white = (1.0, 1.0, 1.0, piece.material.colour[3])
    return merge_corners(piece.corners, white, colours, piece.places)


def _picture(files: Files, path: str) -> Array | None:
    data = files.read(path)
    return picture(data) if isinstance(data, bytes) else None


def _shared_pictures(
    items: Sequence[Mapping[str, Any]], files: Files, run_in_forks: ForkRunner
) -> Pictures:
    """Read the pictures that several files use: to decode one can take half a second."""
    uses = Counter(path for item in items for path in set(item["pictures"].values()))
    shared = [path for path, number in uses.most_common(_SHARED) if number > 1]
    read = run_in_forks([partial(_pixels, files, path) for path in shared])
    return dict(zip(shared, map(_as_picture, read), strict=True))


def _as_picture(read: bytes | WorkerFailed) -> Array | None:
    import numpy as np

    if isinstance(read, WorkerFailed) or not read:
        return None
    height = int.from_bytes(read[:_HEIGHT], "big")
    return np.frombuffer(read[_HEIGHT:], np.uint8).reshape(height, -1, 4)


def _pixels(files: Files, path: str) -> bytes:
    """Return a picture's height and its pixels; nothing if it cannot be read."""
    pixels = _picture(files, path)
    return b"" if pixels is None else len(pixels).to_bytes(_HEIGHT, "big") + pixels.tobytes()
