"""Meshes and textures on their way into the new package."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.migrate.migration import migrate
from checker.migrate.options import MigrationOptions
from tests.migrate.conftest import Write, body, urdf

ACME = MigrationOptions(organization="acme")
BOX = '<visual><geometry><box size="0.6 0.3 0.1"/></geometry></visual>'
MESH = """mtllib w.mtl
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1
usemtl m\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4
"""
pytestmark = pytest.mark.usefixtures("no_pictures")


def showing(*uris: str) -> str:
    visuals = (f'<visual><geometry><mesh filename="{uri}"/></geometry></visual>' for uri in uris)
    return urdf(body().replace(BOX, "".join(visuals)))


def own(folder: str) -> dict[str, str]:
    """A mesh with a texture, in a folder of its own."""
    return {
        f"{folder}/meshes/w.obj": MESH,
        f"{folder}/meshes/w.mtl": "newmtl m\nmap_Kd t.png\n",
        f"{folder}/meshes/t.png": folder,
    }


def uris_of(model: Path) -> list[str]:
    return [line.strip()[5:-6] for line in model.read_text("utf-8").splitlines() if "<uri>" in line]


def test_meshes_of_one_name_keep_their_own_textures(write: Write, tmp_path: Path) -> None:
    ours = "package://rover_description"
    robot = showing(f"{ours}/a/meshes/w.obj", f"{ours}/b/meshes/w.obj")
    made = migrate(write({"urdf/r.urdf": robot, **own("a"), **own("b")}), tmp_path / "made", ACME)
    uris = uris_of(made.folder / "model.sdf")
    assert uris == ["meshes/w.obj", "meshes/2/w.obj"]
    pictures = [(made.folder / uri).with_name("t.png").read_text("utf-8") for uri in uris]
    assert pictures == ["a", "b"]


@pytest.mark.parametrize("first", [True, False])
def test_a_missing_mesh_is_not_taken_for_another_of_its_name(
    write: Write, tmp_path: Path, first: bool
) -> None:
    there, missing = "package://rover_description/a/meshes/w.obj", "package://other/meshes/w.obj"
    robot = showing(*((missing, there) if first else (there, missing)))
    made = migrate(write({"urdf/r.urdf": robot, **own("a")}), tmp_path / "made", ACME)
    uris = uris_of(made.folder / "model.sdf")
    assert len(set(uris)) == 2
    assert [(made.folder / uri).exists() for uri in uris] == [not first, first]
    assert any(each.startswith(missing) for each in made.open_points)


def test_a_file_gets_a_name_that_uris_and_xacro_leave_as_it_is(
    write: Write, tmp_path: Path
) -> None:
    robot = showing("package://rover_description/meshes/a b#${x}.obj")
    source = write({"urdf/r.urdf": robot, "meshes/a b#${x}.obj": MESH})
    made = migrate(source, tmp_path / "made", ACME)
    assert uris_of(made.folder / "model.sdf") == ["meshes/a_b___x_.obj"]
    assert (made.folder / "meshes/a_b___x_.obj").is_file()
