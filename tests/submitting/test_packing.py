"""A folder is packed as a repository would have it, within what the service takes."""

from __future__ import annotations

import io
import os
import time
import zipfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.errors import UnreadableInput
from checker.package.archives.archive import unpack_archive
from checker.package.archives.index import ArchiveLimits
from checker.service.client.packing import pack
from tests.conftest import SAMPLES

BROKEN = SAMPLES / "broken_rover_sensor_config_1"


def packed(folder: Path, limits: ArchiveLimits | None = None) -> tuple[zipfile.ZipFile, str]:
    """Return the archive of a folder and what is said of it."""
    file = io.BytesIO()
    words = pack(folder, file, limits)
    return zipfile.ZipFile(file), "\n".join(words)


def written(folder: Path, **files: bytes) -> Path:
    for name, content in files.items():
        path = folder / name.replace("__", "/").replace("_", ".")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return folder


def test_a_package_comes_out_as_it_went_in(tmp_path: Path) -> None:
    file = tmp_path / "sent.zip"
    with file.open("wb") as archive:
        pack(BROKEN, archive)
    unpack_archive(file, tmp_path / "there", file.name)
    there = tmp_path / "there" / BROKEN.name
    names = [path.relative_to(BROKEN) for path in BROKEN.rglob("*") if not path.is_symlink()]
    assert len(names) > 5
    for name in names:
        if (BROKEN / name).is_file():
            assert (there / name).read_bytes() == (BROKEN / name).read_bytes()
        else:
            assert (there / name).is_dir()


def test_what_is_no_part_of_the_package_stays_here(tmp_path: Path) -> None:
    package = written(tmp_path / "rover", model_sdf=b"<sdf/>", meshes__a_dae=b"<a/>")
    for hidden in (".git/config", "launch/__pycache__/x.pyc", ".hg/store", ".svn/entries"):
        path = package / hidden
        path.parent.mkdir(parents=True)
        path.write_text("x", "utf-8")
    (package / "model.rsdf").write_text("x", "utf-8")
    archive, words = packed(package)
    kept = ["launch/", "meshes/", "meshes/a.dae", "model.rsdf", "model.sdf"]
    assert archive.namelist() == [f"rover/{name}" for name in kept]
    assert not words


def test_links_are_left_out_and_named(tmp_path: Path) -> None:
    package = written(tmp_path / "rover", model_sdf=b"<sdf/>")
    secret = written(tmp_path, secret_txt=b"secret") / "secret.txt"
    for name in ("a", "b", "c\x1b[31m", "d"):
        (package / name).symlink_to(secret)
    (package / "inside").symlink_to("model.sdf")
    os.mkfifo(package / "pipe")
    archive, words = packed(package)
    assert archive.namelist() == ["rover/model.sdf"]
    assert "5 links left out, as archives hold none: a, b, c�[31m and 2 more" in words
    assert "1 special file left out, as archives hold none: pipe" in words


def test_the_same_content_makes_the_same_archive(tmp_path: Path) -> None:
    first = written(tmp_path / "one/rover", model_sdf=b"<sdf/>", package_xml=b"<p/>")
    second = written(tmp_path / "two/rover", package_xml=b"<p/>", model_sdf=b"<sdf/>")
    os.utime(second / "model.sdf", (time.time() - 1e6,) * 2)
    (second / "package.xml").chmod(0o755)
    archives = [io.BytesIO(), io.BytesIO()]
    for folder, archive in zip((first, second), archives, strict=True):
        pack(folder, archive)
    assert archives[0].getvalue() == archives[1].getvalue()


def test_more_files_than_allowed_are_refused_before_they_are_packed(tmp_path: Path) -> None:
    package = written(tmp_path / "rover", a_sdf=b"", b_sdf=b"", c_sdf=b"")
    assert packed(package, ArchiveLimits(entries=3))[0].namelist()
    with pytest.raises(UnreadableInput, match="holds 3 files and folders, expected 2 or fewer"):
        packed(package, ArchiveLimits(entries=2))


def test_more_bytes_than_allowed_are_refused_before_they_are_packed(tmp_path: Path) -> None:
    package = written(tmp_path / "rover", model_sdf=b"<sdf/>")
    with (package / "sparse.stl").open("wb") as file:
        file.truncate(3_000_000_000)
    with pytest.raises(UnreadableInput, match="holds 3000 MB, expected 500 or less"):
        packed(package)


def test_a_name_that_is_no_text_is_packed_under_another(tmp_path: Path) -> None:
    package = written(tmp_path / "rover", model_sdf=b"<sdf/>")
    (package / os.fsdecode(b"\xff.stl")).write_bytes(b"x")
    assert "rover/�.stl" in packed(package)[0].namelist()


NAMES = st.text(
    st.characters(exclude_categories=("Cs", "Cc"), exclude_characters='/\\:*?"<>|\x00'),
    min_size=1,
    max_size=20,
).filter(lambda name: name.strip(". ") == name)


@given(names=st.sets(NAMES, min_size=1, max_size=4), content=st.binary(max_size=50))
def test_names_of_all_scripts_are_packed(
    names: set[str], content: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    package = tmp_path_factory.mktemp("packing") / "rover"
    package.mkdir()
    for name in names:
        (package / name).write_bytes(content)
    archive, _ = packed(package)
    assert {name.removeprefix("rover/") for name in archive.namelist()} == names
    assert {archive.read(name) for name in archive.namelist()} == {content}
