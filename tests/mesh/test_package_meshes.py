"""A robot's meshes: found by their URIs, read once, kept on disk, each file on its own."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from checker.base.cache import NO_CACHE, Cache
from checker.base.child_server import Asked, Server
from checker.base.parts import WorkerFailed
from checker.engine.early_parts import begin_meshes
from checker.engine.subject import Subject
from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.mesh import process
from checker.physics.mesh.process import MeshServer, are_new, mesh_server
from checker.report.scene.processes import StartedProcesses
from checker.rule_testing import write_example
from checker.rulebook.example_files import NAME
from tests.mesh.files import binary_stl, box, dae, obj

FUEL = "https://fuel.ignitionrobotics.org/1.0/acme/models"
CUBE = binary_stl(box(1, 1, 1))


def fragment(*uris: str) -> str:
    return "".join(
        f'<visual name="v{n}"><geometry><mesh><uri>{uri}</uri></mesh></geometry></visual>'
        for n, uri in enumerate(uris)
    )


def robot_of(files: Mapping[str, str | bytes], folder: Path, cache: Cache = NO_CACHE) -> Robot:
    """Write a package whose model shows all that `files` holds below meshes/."""
    uris = [path for path in files if path.startswith("meshes/") and not path.endswith(".mtl")]
    changes = {"@fragment": f'<link name="a">{fragment(*uris)}</link>', **files}
    with open_input(write_example(changes, folder)) as opened:
        robots = Subject(opened.packages[0], cache).all(Robot)
        assert isinstance(robots, tuple)
        _ = robots[0].mesh_uses
        return robots[0]


def read(files: Mapping[str, str | bytes], folder: Path, cache: Cache = NO_CACHE) -> list[object]:
    return [use.file for use in robot_of(files, folder, cache).mesh_uses]


@pytest.mark.parametrize(
    ("uri", "trouble"),
    [
        ("meshes/a.stl", None),
        ("./meshes/../meshes/a.stl", None),
        (f"model://{NAME}/meshes/a.stl", None),
        (f"model://{NAME.upper()}/meshes/a.stl", None),
        (f"package://{NAME}/meshes/a.stl", None),
        (f"{FUEL}/{NAME.upper()}/tip/files/meshes/a.stl", None),
        (f"{FUEL}/{NAME.upper()}/2/files/meshes/b.stl", MeshTrouble.MISSING),
        (f"{FUEL}/another/tip/files/meshes/a.stl", MeshTrouble.NOT_LOOKED_AT),
        ("meshes/A.stl", MeshTrouble.MISSING),
        ("meshes", MeshTrouble.MISSING),
        ("../other/meshes/a.stl", MeshTrouble.NOT_LOOKED_AT),
        ("../../../../etc/passwd.stl", MeshTrouble.NOT_LOOKED_AT),
        ("model://other/meshes/a.stl", MeshTrouble.NOT_LOOKED_AT),
        ("file:///etc/passwd.stl", MeshTrouble.NOT_LOOKED_AT),
        ("/etc/passwd.stl", MeshTrouble.NOT_LOOKED_AT),
        ("https://fuel.example.org/a.stl", MeshTrouble.NOT_LOOKED_AT),
    ],
)
def test_where_a_uri_leads(uri: str, trouble: MeshTrouble | None, tmp_path: Path) -> None:
    example = {"@fragment": fragment(uri), "meshes/a.stl": CUBE}
    with open_input(write_example(example, tmp_path)) as opened:
        robots = Subject(opened.packages[0]).all(Robot)
        assert isinstance(robots, tuple)
        found = robots[0].mesh_uses[0].file
    if trouble is None:
        assert isinstance(found, Mesh)
        assert found.path == "meshes/a.stl"
    else:
        assert isinstance(found, MeshFault)
        assert found.trouble is trouble


def test_a_lone_file_finds_the_mesh_beside_it(tmp_path: Path) -> None:
    (tmp_path / "a.stl").write_bytes(CUBE)
    link = f'<link name="l">{fragment("a.stl")}</link>'
    model = tmp_path / "lone.sdf"
    model.write_text(f'<sdf version="1.6"><model name="m">{link}</model></sdf>')
    with open_input(model) as opened:
        robots = Subject(opened.packages[0]).all(Robot)
        assert isinstance(robots, tuple)
        assert isinstance(robots[0].mesh_uses[0].file, Mesh)


def test_one_content_under_two_names_is_read_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[int] = []
    give = Server.give

    def counted(server: Server, request: bytes, contents: Any) -> Asked:
        asked.append(len(json.loads(request)["items"]))
        return give(server, request, contents)

    monkeypatch.setattr(Server, "give", counted)
    one, other = read({"meshes/a.stl": CUBE, "meshes/b.stl": CUBE}, tmp_path)
    assert asked == [1]
    assert isinstance(one, Mesh)
    assert isinstance(other, Mesh)
    assert (one.path, other.path) == ("meshes/a.stl", "meshes/b.stl")
    assert one.volume == other.volume


def test_textures_come_from_the_material_file_beside_an_obj(tmp_path: Path) -> None:
    cache = Cache(tmp_path / "cache")
    mesh = b"mtllib a.mtl\n" + obj(box(1, 1, 1))
    (first,) = read({"meshes/a.obj": mesh, "meshes/a.mtl": "map_Kd red.png\n"}, tmp_path, cache)
    (second,) = read({"meshes/a.obj": mesh, "meshes/a.mtl": "map_Kd blue.png\n"}, tmp_path, cache)
    assert isinstance(first, Mesh)
    assert isinstance(second, Mesh)
    assert (first.textures, second.textures) == (("red.png",), ("blue.png",))


def test_faults_of_one_file_leave_the_others(tmp_path: Path) -> None:
    good, bad, odd = read(
        {"meshes/a.stl": CUBE, "meshes/b.stl": CUBE[:-1], "meshes/c.fbx": b"Kaydara"}, tmp_path
    )
    assert isinstance(good, Mesh)
    assert isinstance(bad, MeshFault)
    assert isinstance(odd, MeshFault)
    assert (bad.trouble, odd.trouble) == (MeshTrouble.UNREADABLE, MeshTrouble.UNSUPPORTED)


@pytest.mark.slow
def test_a_file_that_brings_its_reader_down_takes_no_other_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(process, "SECONDS_FOR_ONE", 1)
    endless = obj(box(1, 1, 1)) + b"\nf 1 2 3" * 4_000_000
    first, killer, last = read(
        {
            "meshes/a.stl": CUBE,
            "meshes/b.obj": endless,
            "meshes/c.obj": obj(box(1, 2, 3)),
        },
        tmp_path,
    )
    assert isinstance(first, Mesh)
    assert isinstance(last, Mesh)
    assert isinstance(killer, MeshFault)
    assert killer.trouble is MeshTrouble.NOT_LOOKED_AT
    assert killer.reason == "was not read: its reader needs more than 1 s of processor time"


def test_results_are_kept_and_no_library_is_loaded_for_them(tmp_path: Path) -> None:
    cache = Cache(tmp_path / "cache")
    files = {"meshes/a.stl": CUBE, "meshes/b.stl": CUBE[:-1]}
    before = read(files, tmp_path, cache)
    script = f"""
import sys
from pathlib import Path
from checker.base import child_server
from checker.base.cache import Cache
from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
child_server._Process = None
with open_input(Path({str(tmp_path / NAME)!r})) as opened:
    robot, = Subject(opened.packages[0], Cache(Path({str(tmp_path / "cache")!r}))).all(Robot)
    print([use.file for use in robot.mesh_uses])
print(sorted({{"numpy", "scipy", "trimesh", "collada"}} & set(sys.modules)))
"""
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == f"{before}\n[]\n"


def test_a_foreign_entry_in_the_cache_is_read_anew(tmp_path: Path) -> None:
    cache = Cache(tmp_path / "cache")
    before = read({"meshes/a.stl": CUBE}, tmp_path, cache)
    for entry in (tmp_path / "cache").rglob("*.json"):
        entry.write_text('{"mesh": {"path": 1}}')
    assert read({"meshes/a.stl": CUBE}, tmp_path, cache) == before


def test_what_was_given_up_is_tried_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cache = Cache(tmp_path / "cache")
    gave_up = {"trouble": "not checked", "reason": "took too long"}
    with monkeypatch.context() as patch:
        answer = json.dumps([{"fault": gave_up}]).encode()
        patch.setattr(Asked, "answer", lambda _: answer)
        (found,) = read({"meshes/a.stl": CUBE}, tmp_path, cache)
        assert found == MeshFault(MeshTrouble.NOT_LOOKED_AT, "took too long")
    assert isinstance(read({"meshes/a.stl": CUBE}, tmp_path, cache)[0], Mesh)


@pytest.mark.parametrize("answer", [b"nonsense", b"[]", b"[1]", WorkerFailed("crashed")])
def test_no_proper_answer(
    answer: bytes | WorkerFailed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Asked, "answer", lambda _: answer)
    (found,) = read({"meshes/a.stl": CUBE}, tmp_path)
    assert isinstance(found, MeshFault)
    assert found.trouble is MeshTrouble.NOT_LOOKED_AT


def test_a_reading_that_was_begun_can_be_ended(tmp_path: Path) -> None:
    changes = {"@fragment": f'<link name="a">{fragment("meshes/a.stl")}</link>'}
    with open_input(write_example({**changes, "meshes/a.stl": CUBE}, tmp_path)) as opened:
        subject = Subject(opened.packages[0])
        begin_meshes(subject)
        subject.close()
        robots = subject.all(Robot)
        assert isinstance(robots, tuple)
        assert isinstance(robots[0].mesh_uses[0].file, MeshFault)
        assert not subject.one(MeshServer).server.alive


def test_a_child_that_waits_reads_what_it_is_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cache = Cache(tmp_path / "cache")
    changes = {"@fragment": f'<link name="a">{fragment("meshes/a.stl")}</link>'}
    package = write_example({**changes, "meshes/a.stl": CUBE}, tmp_path)
    with open_input(package) as opened:
        assert are_new(opened.packages[0], cache)
        server = mesh_server().start()
        monkeypatch.setattr("checker.base.child_server._Process", None)  # no other is started
        subject = Subject(opened.packages[0], cache, processes=StartedProcesses(server))
        robots = subject.all(Robot)
        assert isinstance(robots, tuple)
        (use,) = robots[0].mesh_uses
        assert isinstance(use.file, Mesh)
        assert not are_new(opened.packages[0], cache)
        subject.close()
        # One that no robot names stays unknown, and is no reason to start the child each time.
        (package / "meshes" / "unused.stl").write_bytes(CUBE[:-1])
    with open_input(package) as again:
        assert not are_new(again.packages[0], cache)


def test_a_child_that_waits_in_vain_is_ended(tmp_path: Path) -> None:
    package = write_example({"meshes/a.stl": CUBE}, tmp_path)
    with open_input(package) as opened:
        server = mesh_server().start()
        assert server.alive
        Subject(opened.packages[0], processes=StartedProcesses(server)).close()
    assert not server.alive


def test_a_file_that_is_too_large_is_not_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(process, "SIZE_LIMIT", 100)
    (found,) = read({"meshes/a.stl": CUBE}, tmp_path)
    assert isinstance(found, MeshFault)
    assert found.trouble is MeshTrouble.NOT_LOOKED_AT


def test_the_name_in_the_model_says_the_format_not_that_behind_a_link(tmp_path: Path) -> None:
    example = {"@fragment": f'<link name="a">{fragment("meshes/a.stl")}</link>'}
    example |= {"meshes/a.blob": CUBE, "@links": {"meshes/a.stl": "a.blob"}}
    with open_input(write_example(example, tmp_path)) as opened:
        robots = Subject(opened.packages[0]).all(Robot)
        assert isinstance(robots, tuple)
        assert isinstance(robots[0].mesh_uses[0].file, Mesh)


def test_parts_that_are_picked_are_measured_by_themselves(tmp_path: Path) -> None:
    node = '<node name="lid"><translate>5 0 0</translate><instance_geometry url="#part"/></node>'
    pick = "<submesh><name>{}</name></submesh>"
    visuals = "".join(
        f'<visual name="{name}"><geometry><mesh><uri>meshes/a.dae</uri>{pick.format(name)}</mesh>'
        "</geometry></visual>"
        for name in ("body", "lid", "none")
    )
    example = {"@fragment": visuals, "meshes/a.dae": dae(box(1, 1, 1), node=node)}
    with open_input(write_example(example, tmp_path)) as opened:
        robots = Subject(opened.packages[0]).all(Robot)
        assert isinstance(robots, tuple)
        body, lid, none = robots[0].mesh_uses
        assert isinstance(body.file, Mesh)
        assert body.file.triangles == 24
        assert body.mesh is not None
        assert lid.mesh is not None
        assert (body.mesh.low, body.mesh.high) == ((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))
        assert (lid.mesh.low, lid.mesh.high) == ((4.5, -0.5, -0.5), (5.5, 0.5, 0.5))
        assert none.mesh is None
