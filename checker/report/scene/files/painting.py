"""Pictures on triangles: one colour for each corner, sampled where it lies in the picture."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

FILE_LIMIT = 30_000_000
"""Bytes of a picture file."""
PIXELS = 40_000_000
"""Of a picture; 160 MB while it is read. One of 4096 × 4096 has 17 million."""
_SIDE = 512
"""Pixels to which a picture is reduced: a colour for each corner shows no more of it."""
_INWARDS = 0.15
"""Share of the way from a corner to the middle of its triangle: next to a seam of the picture
stands what nobody sees."""


def picture(data: bytes) -> Array | None:
    """Return a PNG or JPEG file as red, green, blue, alpha (h × w × 4, uint8).

    It is opaque. None where it cannot be read, or is too large to be.
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
        pixels: Of the picture (h × w × 4).
        places: Of the corners in it (n × 3 × 2); outside 0 to 1 it repeats.
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
