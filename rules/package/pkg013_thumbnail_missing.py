"""A thumbnail that is missing or cannot be read.

The five pictures show the robot in the catalogue of robots: `1.png` at an angle, then from the top,
the side, the front and the rear.

Fix: add the pictures as PNG files, called `1.png` to `5.png`, in `thumbnails/`.
Source: Model Migration Guide, step 7, final directory structure: `thumbnails/1.png` to `5.png`. The
order of the views is this rule's own.
"""

import posixpath

from checker.base.files import NotReadable, TooLarge
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.binary_headers import png_fault

FOLDER = "thumbnails"
VIEWS = {"1.png": "iso", "2.png": "top", "3.png": "side", "4.png": "front", "5.png": "rear"}

_ALL = 1e9
"""More megabytes than any file has."""


@rule("PKG013", "thumbnail-missing", Severity.INFO, Concern.PAPERWORK)
def check(package: Package, *, limit_megabytes: float = 30.0) -> Findings:
    """Look for the five pictures, and read every PNG file in their folder.

    Options:
        limit_megabytes: Size in MB (10⁶ bytes) above which a PNG file in `thumbnails` is not read,
            but listed as not checked.
    """
    folder = package.index.find(FOLDER)
    if folder is None or not folder.is_folder:
        return
    missing = [f"{n} ({v})" for n, v in VIEWS.items() if not package.exists(f"{FOLDER}/{n}")]
    if missing:
        yield finding(package.place(FOLDER), f"{FOLDER}/ lacks {', '.join(missing)}")
    for file in package.index.with_suffix(".png"):
        if posixpath.dirname(file.path) != FOLDER:
            continue
        data = package.read_bytes(file.path, int(min(limit_megabytes, _ALL) * 1e6))
        if isinstance(data, TooLarge):
            yield unchecked(f"{file.path} {data.reason}: the option limit_megabytes raises it")
            continue
        fault = data.reason if isinstance(data, NotReadable) else png_fault(data)
        if fault is not None:
            yield finding(package.place(file.path), f"{file.path} {fault}")


# One grey pixel.
_PNG = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b55"
    "0000000a49444154789c636800000082008177cd72b60000000049454e44ae426082"
)

GOOD = [{f"thumbnails/{number}.png": _PNG for number in range(1, 6)}]
BAD = [
    {
        **{f"thumbnails/{number}.png": _PNG for number in range(1, 5)},
        "@reported": ["thumbnails:1"],
    },
    {
        **{f"thumbnails/{number}.png": _PNG for number in range(1, 5)},
        "thumbnails/5.png": _PNG[:50],
        "@reported": ["thumbnails/5.png:1"],
    },
]
