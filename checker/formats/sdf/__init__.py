"""SDF 1.4 to 1.12."""

from checker.package.formats import Format

FORMAT = Format(
    "sdf",
    (".sdf",),
    ("sdf", "world", "model"),
    reader=f"{__name__}.content:read",
    world_suffixes=(".world",),
)
