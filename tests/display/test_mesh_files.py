"""What mesh files look like: where they are, their colours, how many triangles, and what fails."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from checker.base.cache import Cache
from checker.model.mesh import Mesh
from checker.physics.mesh.surface import GREY, Appearance, Surface
from checker.report.scene import mesh_files
from tests.display.looking import looked, opened, picture
from tests.mesh.files import binary_stl, box, cylinder, dae, obj

RED, BLUE = (255, 0, 0), (0, 0, 255)


def surfaces(found: Appearance) -> tuple[Surface, ...]:
    assert not isinstance(found, str), found
    return found


@pytest.mark.slow
def test_surfaces_lie_where_the_meshes_do(samples: Path) -> None:
    """Units, nodes and axes are those that rules, views and the trial have."""
    seen = 0
    for package in sorted(samples.iterdir()):
        if package.is_dir():
            seen += _compare_boxes(package)
    assert seen >= 10


def test_surfaces_of_real_packages_lie_where_the_meshes_do(corpus: Path) -> None:
    seen = sum(_compare_boxes(each) for each in sorted(corpus.iterdir()) if each.is_dir())
    assert seen >= 100


def _compare_boxes(package: Path) -> int:
    number = 0
    with opened(package) as (_, files):
        for uri in files.meshes.uris:
            mesh, found = files.meshes.load(uri), files.load(uri)
            if not isinstance(mesh, Mesh):
                assert found == mesh.reason
                continue
            corners = np.concatenate([each.vertices for each in surfaces(found)])
            shown = sum(len(each.faces) for each in surfaces(found))
            assert mesh.triangles - mesh.degenerate <= shown <= mesh.triangles
            assert corners.min(axis=0) == pytest.approx(mesh.low, abs=1e-5), uri.value
            assert corners.max(axis=0) == pytest.approx(mesh.high, abs=1e-5), uri.value
            number += 1
    return number


def test_the_unit_of_collada_is_honoured_and_its_up_axis_is_not(tmp_path: Path) -> None:
    asset = '<unit name="inch" meter="0.0254"/><up_axis>Y_UP</up_axis>'
    (found,) = surfaces(
        looked({"meshes/a.dae": dae(box(1, 2, 3), asset)}, tmp_path)["meshes/a.dae"]
    )
    assert np.ptp(found.vertices, axis=0) == pytest.approx([0.0254, 0.0508, 0.0762])
    assert len(found.vertices) == 8


EFFECT = """
<library_images><image id="i"><init_from>{picture}</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
  <newparam sid="f"><surface type="2D"><init_from>i</init_from></surface></newparam>
  <newparam sid="s"><sampler2D><source>f</source></sampler2D></newparam>
  <technique sid="t"><lambert>{look}</lambert></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
"""
PLAIN = "<diffuse><color>0.1 0.2 0.3 1</color></diffuse>"
TEXTURE = '<diffuse><texture texture="s" texcoord="UV"/></diffuse>'
ACROSS = '<source id="uv"><float_array id="uvn" count="4">0 0.75 1 0.75</float_array>'
ACROSS += '<technique_common><accessor source="#uvn" count="2" stride="2"><param name="S"'
ACROSS += ' type="float"/><param name="T" type="float"/></accessor></technique_common></source>'


def collada(look: str, textured: bool = False, name: str = "a.png", alpha: str = "") -> bytes:
    """Return a box of one material whose first triangles lie left in the picture, others right."""
    more = EFFECT.format(look=look + alpha, picture=name)
    data = dae(box(1, 1, 1), more=more).decode()
    data = data.replace("<triangles ", '<triangles material="x" ')
    bound = '<bind_material><technique_common><instance_material symbol="x" target="#m"/>'
    bound += "</technique_common></bind_material>"
    data = data.replace('url="#part"/>', f'url="#part">{bound}</instance_geometry>')
    if textured:
        order = " ".join(f"{n} {int(n >= 18)}" for n in range(36))
        plain = " ".join(map(str, range(36)))
        data = data.replace("<vertices", f"{ACROSS}<vertices").replace(
            f"<p>{plain}</p>",
            f'<input semantic="TEXCOORD" source="#uv" offset="1" set="0"/><p>{order}</p>',
        )
        data = data.replace("0 0.75 1 0.75", "0.25 0.75 0.75 0.75")
    return data.encode()


def test_collada_has_the_colours_of_its_materials(tmp_path: Path) -> None:
    (found,) = surfaces(looked({"meshes/a.dae": collada(PLAIN)}, tmp_path)["meshes/a.dae"])
    assert found.colour == pytest.approx((0.1, 0.2, 0.3, 1.0))
    assert found.vertex_colours is None


@pytest.mark.parametrize(
    ("written", "opaque"),
    [
        ("<transparent><color>1 1 1 1</color></transparent>", 1.0),
        (
            "<transparent><color>1 1 1 1</color></transparent>"
            "<transparency><float>0.4</float></transparency>",
            0.4,
        ),
        (
            '<transparent opaque="RGB_ZERO"><color>1 1 1 1</color></transparent>'
            "<transparency><float>0.4</float></transparency>",
            0.6,
        ),
        # What cannot be seen at all is a slip of the exporter.
        (
            "<transparent><color>1 1 1 1</color></transparent>"
            "<transparency><float>0</float></transparency>",
            1.0,
        ),
        ("<transparent><color>nan</color></transparent>", 1.0),
    ],
)
def test_collada_may_be_transparent(written: str, opaque: float, tmp_path: Path) -> None:
    data = collada(PLAIN, alpha=written)
    (found,) = surfaces(looked({"meshes/a.dae": data}, tmp_path)["meshes/a.dae"])
    assert found.colour[3] == pytest.approx(opaque, abs=1e-3)


@pytest.mark.parametrize("place", ["meshes/a.png", "materials/textures/a.png"])
def test_pictures_colour_the_corners(place: str, tmp_path: Path) -> None:
    files = {
        "meshes/a.dae": collada(TEXTURE, textured=True),
        place: picture({(0, 0): RED, (1, 0): BLUE}),
    }
    (found,) = surfaces(looked(files, tmp_path)["meshes/a.dae"])
    assert found.vertex_colours is not None
    assert found.colour == (1.0, 1.0, 1.0, 1.0)
    first, last = found.faces[0][0], found.faces[-1][0]
    assert tuple(found.vertex_colours[first]) == (*RED, 255)
    assert tuple(found.vertex_colours[last]) == (*BLUE, 255)


def test_an_obj_file_has_the_looks_of_its_material_file(tmp_path: Path) -> None:
    data = b"mtllib a.mtl\nvt 0.25 0.75\n" + obj(box(1, 1, 1)).replace(
        b"f 1 2 3", b"usemtl painted\nf 1/1 2/1 3/1\nusemtl plain"
    )
    files: dict[str, str | bytes] = {
        "meshes/a.obj": data,
        "meshes/a.mtl": "newmtl plain\nKd 0.5 0.25 1\nd 0.5\nnewmtl painted\nmap_Kd a.png\n",
        "meshes/a.png": picture({(0, 0): RED}),
    }
    plain, painted = surfaces(looked(files, tmp_path)["meshes/a.obj"])
    assert plain.colour == (0.5, 0.25, 1.0, 0.5)
    assert len(plain.faces) == 11
    assert painted.vertex_colours is not None
    assert {tuple(each) for each in painted.vertex_colours} == {(*RED, 255)}


def test_faces_of_obj_may_count_backwards_and_have_more_corners(tmp_path: Path) -> None:
    data = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4// -3// -2// -1//\n"
    (found,) = surfaces(looked({"meshes/a.obj": data}, tmp_path)["meshes/a.obj"])
    assert len(found.vertices) == 4
    assert len(found.faces) == 2
    assert found.colour == GREY


def _giant_png() -> bytes:
    """Return a PNG file that says it has 10 000 million pixels."""
    header = struct.pack(">II5B", 100_000, 100_000, 8, 2, 0, 0, 0)
    pieces = ((b"IHDR", header), (b"IDAT", zlib.compress(b"\0" * 1000)), (b"IEND", b""))
    body = b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in pieces
    )
    return b"\x89PNG\r\n\x1a\n" + body


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "files"),
    [
        ("a.png", {}),
        ("a.png", {"meshes/a.png": b"no picture"}),
        ("a.png", {"meshes/a.png": _giant_png()}),
        ("a.png", {"meshes/a.png": picture({})[:40]}),
        ("../../../../../../../../etc/passwd", {}),
        ("file:///etc/passwd", {}),
        ("http://example.org/a.png", {}),
        ("\u202ea\U0001f916.png", {"meshes/a.png": picture({})}),
    ],
)
def test_without_its_picture_a_mesh_is_plain(
    name: str, files: dict[str, bytes], tmp_path: Path
) -> None:
    data = collada(TEXTURE, textured=True, name=name)
    (found,) = surfaces(looked({"meshes/a.dae": data, **files}, tmp_path)["meshes/a.dae"])
    assert found.vertex_colours is None
    assert len(found.faces) == 12


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("a.stl", binary_stl(box(1, 1, 1), declared=1_000_000_000), "is cut off"),
        (
            "a.stl",
            binary_stl([((float("nan"), 0, 0), (1, 0, 0), (0, 1, 0))]),
            "without a finite position",
        ),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 999999999999\n", "names corners"),
        ("a.dae", b"<COLLADA/>" * 2, "is not well-formed XML"),
        ("a.dae", b'<!DOCTYPE a [<!ENTITY b "c">]><COLLADA/>', "document type"),
        ("a.stl", b"", "is empty"),
    ],
)
def test_what_cannot_be_read_is_a_reason(name: str, data: bytes, said: str, tmp_path: Path) -> None:
    files = {f"meshes/{name}": data, "meshes/good.stl": binary_stl(box(1, 1, 1))}
    found = looked(files, tmp_path)
    assert said in str(found[f"meshes/{name}"])
    assert len(surfaces(found["meshes/good.stl"])[0].faces) == 12


@pytest.mark.slow
def test_a_robot_has_no_more_triangles_than_its_budget(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mesh_files, "FOR_ONE", 3000)
    monkeypatch.setattr(mesh_files, "FOR_ALL", 5000)
    files: dict[str, str | bytes] = {
        f"meshes/{sides}.stl": binary_stl(cylinder(1.0, 2.0, sides)) for sides in (10, 1000, 2000)
    }
    found = looked(files, tmp_path)
    counts = {uri: len(surfaces(each)[0].faces) for uri, each in found.items()}
    assert counts["meshes/10.stl"] == 40
    assert counts["meshes/1000.stl"] <= 3000
    assert counts["meshes/2000.stl"] <= 3000
    assert 3000 < sum(counts.values()) <= 5000
    for sides in (1000, 2000):
        (thinned,) = surfaces(found[f"meshes/{sides}.stl"])
        assert np.ptp(thinned.vertices, axis=0) == pytest.approx([2, 2, 2], rel=0.02)


def test_what_was_looked_at_is_not_read_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cache = Cache(tmp_path / "cache")
    files: dict[str, str | bytes] = {
        "meshes/a.dae": collada(TEXTURE, textured=True),
        "meshes/a.png": picture({(0, 0): RED, (1, 0): BLUE}),
    }
    (first,) = surfaces(looked(files, tmp_path / "1", cache)["meshes/a.dae"])
    with monkeypatch.context() as patch:
        patch.setattr("checker.base.child_server._Process", None)
        (again,) = surfaces(looked(files, tmp_path / "2", cache)["meshes/a.dae"])
    assert np.array_equal(first.vertices, again.vertices)
    assert np.array_equal(first.faces, again.faces)
    assert first.vertex_colours is not None
    assert np.array_equal(first.vertex_colours, again.vertex_colours)
    files["meshes/a.png"] = picture({(0, 0): BLUE, (1, 0): RED})
    (painted,) = surfaces(looked(files, tmp_path / "3", cache)["meshes/a.dae"])
    assert not np.array_equal(first.vertex_colours, painted.vertex_colours)


@pytest.mark.slow
@pytest.mark.parametrize("broken", [False, True])
def test_files_may_share_a_picture(tmp_path: Path, *, broken: bool) -> None:
    """It is read once for both, and looks as it does on one alone."""
    painted = b"no picture" if broken else picture({(0, 0): RED, (1, 0): BLUE})
    one = collada(TEXTURE, textured=True)
    alone: dict[str, str | bytes] = {"meshes/a.dae": one, "meshes/a.png": painted}
    both = {**alone, "meshes/b.dae": one + b"\n"}
    (first,) = surfaces(looked(alone, tmp_path / "1")["meshes/a.dae"])
    found = looked(both, tmp_path / "2")
    for name in ("meshes/a.dae", "meshes/b.dae"):
        (again,) = surfaces(found[name])
        assert (again.vertex_colours is None) is (first.vertex_colours is None) is broken
        assert broken or np.array_equal(first.vertex_colours, again.vertex_colours)


def test_the_same_file_gives_the_same_arrays(tmp_path: Path) -> None:
    data = binary_stl(box(1, 1, 1))
    found = looked({"meshes/a.stl": data, "meshes/b.stl": data}, tmp_path)
    assert surfaces(found["meshes/a.stl"])[0] is surfaces(found["meshes/b.stl"])[0]
