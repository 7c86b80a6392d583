"""The index of a package's files, and reading them."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.files import NotReadable, TooLarge, read_bytes
from checker.package.index import EntryKind, LinkState, normal_path
from checker.package.package import Package
from checker.package.workspace import Workspace
from checker.source.text import SourceText
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault
from tests.effort import limited

Write = Callable[[Mapping[str, str]], Path]

MODEL = "<sdf version='1.6'><model name='rover'/></sdf>"


def package_at(folder: Path) -> Package:
    return Workspace((folder.parent,)).at(folder)


@pytest.fixture
def rover(write: Write) -> Path:
    files = {"rover/model.sdf": MODEL, "rover/meshes/Wheel.dae": "m", "other/model.sdf": MODEL}
    return write({**files, "secret/key.txt": "x"}) / "rover"


def test_files_folders_and_sizes(rover: Path) -> None:
    index = package_at(rover).index
    assert list(index.entries) == ["meshes", "meshes/Wheel.dae", "model.sdf"]
    assert index.entries["model.sdf"].size == len(MODEL)
    assert index.entries["meshes"].kind is EntryKind.FOLDER
    assert index.faults == ()


def test_git_is_skipped_and_junk_is_not(rover: Path) -> None:
    for folder in (".git", "__pycache__", ".vscode"):
        (rover / folder).mkdir()
        (rover / folder / "file").touch()
    paths = package_at(rover).index.entries
    assert "__pycache__/file" in paths
    assert ".vscode/file" in paths
    assert ".git" not in paths


def test_what_an_editor_keeps_in_a_hidden_folder_is_no_file_of_the_robot(write: Write) -> None:
    kept = (
        "models/.history/arm_1.xml",
        "robot/.idea/a.yaml",
        ".github/workflows/ci.yml",
        "arm.xml",
    )
    index = package_at(
        write({"rover/model.sdf": MODEL} | {f"rover/{it}": "x" for it in kept}) / "rover"
    ).index
    assert [it.path for it in index.files] == [".github/workflows/ci.yml", "arm.xml", "model.sdf"]
    assert index.find("models/.history/arm_1.xml")


@pytest.mark.parametrize(
    ("target", "state", "readable"),
    [
        ("model.sdf", LinkState.OK, True),
        ("meshes", LinkState.OK, False),
        ("../other/model.sdf", LinkState.SIBLING, True),
        ("../secret/key.txt", LinkState.OUTSIDE, False),
        ("/etc/passwd", LinkState.OUTSIDE, False),
        ("/dev/zero", LinkState.OUTSIDE, False),
        ("nowhere.sdf", LinkState.DANGLING, False),
        ("model.sdf/below", LinkState.DANGLING, False),
        ("link", LinkState.LOOP, False),
        (".", LinkState.LOOP, False),
        ("..", LinkState.LOOP, False),
    ],
)
def test_links(rover: Path, target: str, state: LinkState, readable: bool) -> None:
    (rover / "link").symlink_to(target)
    package = package_at(rover)
    entry = package.index.entries["link"]
    assert (entry.kind, entry.target_state, entry.target) == (EntryKind.LINK, state, target)
    assert isinstance(package.read("link"), SourceText) is readable
    assert package.exists("link") is (readable or target == "meshes")
    if not package.exists("link"):
        reason = f"is a link that is not followed ({state}: {target})"
        assert package.read("link") == NotReadable("link", reason)


def test_file_behind_a_link_to_a_folder(rover: Path) -> None:
    (rover / "parts").symlink_to("meshes")
    (rover / "key").symlink_to("../secret")
    package = package_at(rover)
    assert package.exists("parts/Wheel.dae")
    assert not package.exists("key/key.txt")


def test_pipe_is_never_opened(rover: Path) -> None:
    os.mkfifo(rover / "pipe.sdf")
    package = package_at(rover)
    assert package.index.entries["pipe.sdf"].kind is EntryKind.SPECIAL
    assert package.read("pipe.sdf") == NotReadable("pipe.sdf", "is not a regular file")
    assert package.xml_files == ("model.sdf",)


def test_ten_thousand_files_are_indexed_in_a_breath(rover: Path) -> None:
    for number in range(10_000):
        (rover / "meshes" / f"{number}.dae").touch()
    with limited(2):
        index = package_at(rover).index
    assert len(index.files) == 10_002
    assert index.faults == ()


def test_limits_are_said(rover: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("checker.package.walk.MAX_ENTRIES", 2)
    (fault,) = package_at(rover).index.faults
    assert fault.reason == "contains more than 2 files; the rest is not checked"


def test_depth_is_bounded(rover: Path) -> None:
    (rover / "/".join(["d"] * 60)).mkdir(parents=True)
    (fault,) = package_at(rover).index.faults
    assert fault.reason == "is more than 50 folders deep"


def test_name_that_is_no_utf8(rover: Path) -> None:
    (rover / os.fsdecode(b"wheel\xff.dae")).write_text("m")
    package = package_at(rover)
    assert package.read_bytes("wheel\N{REPLACEMENT CHARACTER}.dae") == b"m"


@pytest.mark.parametrize("path", ["meshes/wheel.dae", "Meshes/WHEEL.DAE", "meshes/Wheel.stl"])
def test_similar_paths_are_offered(rover: Path, path: str) -> None:
    package = package_at(rover)
    assert not package.exists(path)
    assert package.index.similar_files(path) == ("meshes/Wheel.dae",)


def test_case_comes_before_extension(rover: Path) -> None:
    (rover / "meshes" / "wheel.STL").touch()
    found = package_at(rover).index.similar_files("meshes/wheel.stl")
    assert found == ("meshes/wheel.STL", "meshes/Wheel.dae")


@pytest.mark.parametrize(
    "path",
    [
        "/etc/passwd",
        "../secret/key.txt",
        "../../etc/passwd",
        "../rover/../secret/key.txt",
        "meshes/../../secret/key.txt",
        "C:/x",
        "..\\secret\\key.txt",
        "a\0b",
        "",
        "..",
        ".",
    ],
)
def test_paths_that_lead_nowhere(rover: Path, path: str) -> None:
    package = package_at(rover)
    assert package.resolve(path) is None
    assert isinstance(package.read(path), NotReadable)


@given(st.lists(st.sampled_from(["..", ".", "a", "b", ""]), min_size=1).map("/".join))
def test_normal_paths_climb_only_at_their_start(path: str) -> None:
    normal = normal_path(path)
    if normal is not None:
        parts = normal.split("/")
        climbing = [part == ".." for part in parts]
        assert climbing == sorted(climbing, reverse=True)
        assert not normal.startswith("/")


def test_sibling_files_are_named_from_here(rover: Path) -> None:
    package = package_at(rover)
    source = package.read("../other/model.sdf")
    assert isinstance(source, SourceText)
    assert source.file == "../other/model.sdf"
    assert package.read("meshes/../../rover/model.sdf") is package.read("model.sdf")


def test_each_file_is_read_and_parsed_once(rover: Path) -> None:
    package = package_at(rover)
    assert package.read("model.sdf") is package.read("./model.sdf")
    document = package.xml("model.sdf")
    assert isinstance(document, XmlDocument)
    assert document is package.xml("meshes/../model.sdf")
    assert document.source is package.read("model.sdf")
    assert isinstance(package.xml("meshes/Wheel.dae"), XmlFault)
    assert package.xml("none.sdf") == NotReadable("none.sdf", "does not exist")


def test_sparse_file_of_200_mb_is_not_read(rover: Path) -> None:
    with (rover / "big.sdf").open("wb") as file:
        file.truncate(200_000_000)
    package = package_at(rover)
    assert package.index.entries["big.sdf"].size == 200_000_000
    expected = "has 200.0 MB, more than the limit of 20 MB"
    assert package.read("big.sdf") == TooLarge("big.sdf", expected)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig", "utf-8", "utf-32"])
def test_encodings(rover: Path, encoding: str) -> None:
    (rover / "model.sdf").write_bytes(MODEL.encode(encoding))
    document = package_at(rover).xml("model.sdf")
    assert isinstance(document, XmlDocument)
    assert document.root.tag == "sdf"


@pytest.mark.parametrize("data", [b"\xff\xfe\x00", b"a\0b", b"caf\xe9"])
def test_bytes_that_are_no_text(rover: Path, data: bytes) -> None:
    (rover / "model.sdf").write_bytes(data)
    assert isinstance(package_at(rover).read("model.sdf"), NotReadable)


def test_folder_is_no_text(rover: Path) -> None:
    assert package_at(rover).read("meshes") == NotReadable("meshes", "is not a regular file")


def test_place_of_the_folder(rover: Path) -> None:
    assert str(package_at(rover).folder_place()) == ".:1:1"


def test_thumbnails_of_all_packages_are_known_by_their_size(rover: Path) -> None:
    other, key = rover.parent / "other", rover.parent / "secret" / "key.txt"
    for package in (rover, other):
        (package / "thumbnails").mkdir()
        (package / "thumbnails" / "1.png").write_bytes(b"picture")
    (other / "thumbnails" / "2.png").symlink_to(rover / "thumbnails" / "1.png")
    (other / "thumbnails" / "3.png").symlink_to(key)
    (other / "thumbnails" / "4.png").touch()
    by_size = package_at(rover).workspace.thumbnails_by_size
    assert {size: [(p.name, path) for p, path in found] for size, found in by_size.items()} == {
        7: [
            ("other", "thumbnails/1.png"),
            ("other", "thumbnails/2.png"),
            ("rover", "thumbnails/1.png"),
        ]
    }


def test_a_folder_of_thumbnails_that_is_a_link_is_not_followed(rover: Path) -> None:
    (rover / "thumbnails").symlink_to(rover.parent / "secret")
    assert package_at(rover).workspace.thumbnails_by_size == {}


@pytest.mark.skipif(not Path("/proc/version").exists(), reason="no /proc, whose files have no size")
def test_a_file_with_more_in_it_than_its_size_is_read_up_to_the_limit() -> None:
    location = Path("/proc/version")
    content = location.read_bytes()
    assert read_bytes(location, "version", 10_000) == content
    assert read_bytes(location, "version", len(content)) == content
    assert isinstance(read_bytes(location, "version", len(content) - 1), NotReadable)
