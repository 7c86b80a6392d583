"""Packages whose mesh files are looked at, for tests."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from checker.base.cache import NO_CACHE, Cache
from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.mesh.surface import Appearance
from checker.report.scene.mesh_files import MeshFiles
from checker.rule_testing import write_example


def picture(colours: Mapping[tuple[int, int], tuple[int, int, int]], side: int = 2) -> bytes:
    """Return a square PNG file, black but for some pixels (column, row)."""
    from PIL import Image

    image = Image.new("RGB", (side, side))
    for place, colour in colours.items():
        image.putpixel(place, colour)
    file = io.BytesIO()
    image.save(file, "PNG")
    return file.getvalue()


@contextmanager
def opened(path: Path, cache: Cache = NO_CACHE) -> Iterator[tuple[Robot, MeshFiles]]:
    """Open a package; give its first robot and the looks of its meshes."""
    with open_input(path) as found:
        subject = Subject(found.packages[0], cache)
        robots = subject.all(Robot)
        assert isinstance(robots, tuple)
        meshes = robots[0].meshes
        assert isinstance(meshes, PackageMeshes)
        files = MeshFiles(meshes)
        try:
            yield robots[0], files
        finally:
            files.stop()
            subject.close()


def looked(
    files: Mapping[str, str | bytes], folder: Path, cache: Cache = NO_CACHE
) -> dict[str, Appearance]:
    """Return what the meshes of a package look like, by their paths.

    Args:
        files: By path; those below meshes/ of mesh formats are named by the model.
        folder: Where to write the package.
        cache: Where results are kept.
    """
    uris = [path for path in files if path.endswith((".dae", ".obj", ".stl"))]
    visuals = "".join(
        f'<visual name="v{n}"><geometry><mesh><uri>{uri}</uri></mesh></geometry></visual>'
        for n, uri in enumerate(uris)
    )
    changes = {"@fragment": f'<link name="a">{visuals}</link>', **files}
    with opened(write_example(changes, folder), cache) as (_, found):
        return {uri.value: found.load(uri) for uri in found.meshes.uris}
