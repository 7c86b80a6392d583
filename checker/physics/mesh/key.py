"""Under which key the cache keeps what a mesh file holds."""

from __future__ import annotations

from checker.base.cache import code_hash, key_of
from checker.base.resources import version_of

KIND = "mesh"
_LIBRARIES = ("lxml", "numpy", "pycollada", "scipy", "trimesh")


def mesh_key(data: bytes, suffix: str) -> str:
    """Return a hash of all that the facts of a mesh depend on.

    Args:
        data: Content of the file.
        suffix: Of its name, with the dot.
    """
    libraries = map(version_of, _LIBRARIES)
    return key_of(suffix.lower(), data, code_hash("physics/mesh", "model/mesh.py"), *libraries)
