"""Files that are cut off, corrupt or hostile become faults that say what is wrong."""

from __future__ import annotations

import struct
from time import process_time

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.physics.mesh.reader import read_mesh
from tests.effort import examples
from tests.mesh.files import WRITERS, binary_stl, box, dae, obj, text_stl

CUBE = box(1, 1, 1)
NOWHERE = [((0.0, 0.0, 0.0), (1.0, 0.0, float("nan")), (0.0, 1.0, 0.0))]
FAR = [((0.0, 0.0, 0.0), (1e300, 0.0, 0.0), (0.0, 1.0, 0.0))]


def fault(data: bytes, name: str, trouble: MeshTrouble = MeshTrouble.UNREADABLE) -> str:
    read = read_mesh(data, name)
    assert isinstance(read, MeshFault), read
    assert read.trouble is trouble
    return read.reason


@pytest.mark.parametrize("suffix", ["stl", "dae", "obj", "STL"])
def test_empty(suffix: str) -> None:
    assert fault(b"", f"a.{suffix}") == "is empty"
    assert fault(b" \n", f"a.{suffix}") == "is empty"


def test_a_billion_triangles_in_84_bytes() -> None:
    data = binary_stl([], declared=1_000_000_000).replace(b"solid", b"-----")
    reason = fault(data, "a.stl")
    assert reason == "is cut off: it declares 1,000,000,000 triangles, but its 84 bytes contain 0"


def shown_by(levels: str, triangles: int = 1) -> bytes:
    """Return a COLLADA file whose scene shows the node `top`."""
    nodes = f'<library_nodes><node id="n0"><instance_geometry url="#part"/></node>{levels}'
    file = dae(CUBE * triangles, more=f"{nodes}</library_nodes>")
    return file.replace(b'<instance_geometry url="#part"/>\n', b'<instance_node url="#top"/>\n')


def test_nodes_that_show_one_another() -> None:
    """Nine levels of ten say a billion; a node that shows itself, endlessly many."""
    levels = "".join(
        f'<node id="{"top" if level == 9 else f"n{level}"}">'
        + f'<instance_node url="#n{level - 1}"/>' * 10
        + "</node>"
        for level in range(1, 10)
    )
    begun = process_time()
    reason = fault(shown_by(levels), "a.dae", MeshTrouble.NOT_LOOKED_AT)
    assert reason == "shows more than 50,000 nodes, each as often as others name it"
    assert process_time() - begun < 30.0


def test_more_triangles_than_are_read() -> None:
    top = '<node id="top">' + '<instance_node url="#n0"/>' * 200 + "</node>"
    reason = fault(shown_by(top, triangles=1000), "a.dae", MeshTrouble.NOT_LOOKED_AT)
    assert reason == "shows more than 2,000,000 triangles"


def test_a_binary_stl_cut_off() -> None:
    assert "declares 12 triangles" in fault(binary_stl(CUBE)[:-1], "a.stl")


def test_a_binary_stl_with_more_behind_is_read() -> None:
    read = read_mesh(binary_stl(CUBE) + b"\0" * 7, "a.stl")
    assert isinstance(read, Mesh)
    assert read.defects == ("7 bytes follow its last triangle",)


def test_an_stl_as_text_cut_off() -> None:
    data = text_stl(CUBE)
    assert "3 for each triangle" in fault(data[: data.rindex(b"vertex")], "a.stl")
    read = read_mesh(data[: data.rindex(b"endsolid")], "a.stl")
    assert isinstance(read, Mesh)
    assert read.defects == ("it does not end in `endsolid`",)


def test_words_for_numbers() -> None:
    assert "not a number" in fault(text_stl(CUBE).replace(b"0.5", b"half", 1), "a.stl")


@pytest.mark.parametrize("write", [binary_stl, text_stl])
def test_a_corner_that_is_no_number(write: object) -> None:
    assert "without a finite position: triangle 1" in fault(write(NOWHERE), "a.stl")  # type: ignore[operator]


def test_a_corner_out_of_all_bounds() -> None:
    assert "1e+300" in fault(obj(FAR), "a.obj")
    assert "without a finite position" in fault(dae(FAR), "a.dae")


@pytest.mark.parametrize("data", [b"solid nothing\nendsolid\n", binary_stl([])])
def test_no_triangles(data: bytes) -> None:
    assert fault(data, "a.stl") == "contains no triangles"


def test_faces_of_corners_that_are_not_there() -> None:
    bad = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"
    assert fault(bad, "a.obj") == "names corners that do not exist"
    data = dae(CUBE).replace(b"<p>0 1 2 ", b"<p>0 1 99 ")
    read_mesh(data, "a.dae")
    assert "below 0" in fault(dae(CUBE).replace(b"<p>0 1 2 ", b"<p>0 1 -2 "), "a.dae")


def test_another_format_of_that_name() -> None:
    assert "not a COLLADA" in fault(b"<robot/>", "a.dae")
    assert "not well-formed" in fault(binary_stl(CUBE), "a.dae")


def test_a_pointer_is_no_broken_file() -> None:
    pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0"
    assert "Git LFS" in fault(pointer, "a.dae", MeshTrouble.POINTER)


def test_a_format_that_is_not_read() -> None:
    assert ".fbx" in fault(b"Kaydara", "a.fbx", MeshTrouble.UNSUPPORTED)


def test_brackets_in_an_id_are_a_defect() -> None:
    read = read_mesh(dae(CUBE, name="<STL_BINARY>"), "a.dae")
    assert isinstance(read, Mesh)
    assert read.volume == pytest.approx(1.0)
    assert '"<STL_BINARY>"' in read.defects[0]


BOMB = '<!DOCTYPE COLLADA [<!ENTITY a "ha">' + "".join(
    f'<!ENTITY {chr(98 + k)} "{f"&{chr(97 + k)};" * 10}">' for k in range(12)
)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_entities_are_not_expanded(encoding: str) -> None:
    text = dae(CUBE, more="<extra>&m;</extra>").decode()
    text = text.replace('<?xml version="1.0"?>', f'<?xml version="1.0"?>{BOMB}]>')
    text = text.replace('"1.0"?>', f'"1.0" encoding="{encoding}"?>')
    assert "document type" in fault(text.encode(encoding), "a.dae", MeshTrouble.NOT_LOOKED_AT)


def test_looks_that_are_broken_do_not_hide_the_surface() -> None:
    more = '<library_effects><effect id="e"><profile_COMMON/></effect></library_effects>'
    data = dae(CUBE, more=more).replace(
        b'url="#part"/>',
        b'url="#part"><bind_material><technique_common><instance_material symbol="s"'
        b' target="#gone"/></technique_common></bind_material></instance_geometry>',
    )
    assert isinstance(read_mesh(data, "a.dae"), Mesh)


def test_textures_are_those_that_an_effect_uses() -> None:
    more = (
        '<library_images><image id="a"><init_from>a.png</init_from></image>'
        '<image id="b"><init_from>b.png</init_from></image></library_images>'
        "<library_effects><effect><profile_COMMON><newparam><surface><init_from>a</init_from>"
        "</surface></newparam></profile_COMMON></effect></library_effects>"
    )
    read = read_mesh(dae(CUBE, more=more), "a.dae")
    assert isinstance(read, Mesh)
    assert read.textures == ("a.png",)


WHOLE = {suffix: write(CUBE) for suffix, write in WRITERS.items()}


@pytest.mark.parametrize("suffix", WHOLE)
@settings(max_examples=examples(100))
@given(data=st.data())
def test_a_file_with_bytes_changed_never_raises(suffix: str, data: st.DataObject) -> None:
    content = bytearray(WHOLE[suffix])
    places = st.integers(0, len(content) - 1)
    for at, byte in data.draw(st.lists(st.tuples(places, st.integers(0, 255)), max_size=8)):
        content[at] = byte
    read_mesh(bytes(content[: data.draw(places) + 1]), f"a.{suffix}")


@pytest.mark.parametrize("suffix", WHOLE)
@settings(max_examples=examples(50))
@given(content=st.binary(max_size=400))
@example(b"solid" + struct.pack("<I", 7))
def test_random_bytes_never_raise(suffix: str, content: bytes) -> None:
    assert isinstance(read_mesh(content, f"a.{suffix}"), Mesh | MeshFault)
