"""Any archive is refused, or unpacks strictly inside its folder, byte by byte as packed."""

from __future__ import annotations

import io
import tarfile
import tempfile
import warnings
import zipfile
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from checker.base.errors import UnreadableInput
from checker.package.archives.archive import unpack_archive
from tests.effort import examples

PART = st.one_of(
    st.sampled_from(["..", ".", "", "a", "A", "b", "model.sdf", "C:", "\\", "~", "...", " "]),
    st.text(max_size=6),
)
NAME = st.lists(PART, min_size=1, max_size=5).map("/".join).filter(lambda name: name != "")
ENTRIES = st.lists(st.tuples(NAME, st.binary(max_size=40)), min_size=1, max_size=5)


def unpacked(archive: Path) -> dict[str, bytes] | None:
    """Return what was unpacked, or None when refused, having seen that nothing lies outside."""
    with tempfile.TemporaryDirectory() as place:
        target = Path(place) / "outer" / "target"
        target.mkdir(parents=True)
        try:
            unpack_archive(archive, target)
        except UnreadableInput:
            written = None
        else:
            files = [path for path in target.rglob("*") if path.is_file()]
            written = {path.relative_to(target).as_posix(): path.read_bytes() for path in files}
        assert [path.name for path in Path(place).iterdir()] == ["outer"]
        assert [path.name for path in (Path(place) / "outer").iterdir()] == ["target"]
        assert not any(path.is_symlink() for path in target.rglob("*"))
        return written


def is_plain(name: str) -> bool:
    name = name.split("\0", maxsplit=1)[0]  # zipfile and tarfile write no further
    return ".." not in name.split("/") and not name.startswith("/")


@settings(max_examples=examples(200))
@given(ENTRIES)
def test_zip_stays_inside(entries: list[tuple[str, bytes]]) -> None:
    with tempfile.TemporaryDirectory() as place, warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        path = Path(place) / "a.zip"
        try:
            with zipfile.ZipFile(path, "w") as archive:
                for name, data in entries:
                    archive.writestr(zipfile.ZipInfo(name), data)
        except UnicodeEncodeError:
            return
        written = unpacked(path)
    if written is not None:
        assert all(is_plain(name) for name, _ in entries)
        assert sorted(written.values()) == sorted(
            data for name, data in entries if not name.split("\0")[0].endswith("/")
        )


@settings(max_examples=examples(200))
@given(ENTRIES, st.sampled_from([tarfile.GNU_FORMAT, tarfile.PAX_FORMAT]))
def test_tar_stays_inside(entries: list[tuple[str, bytes]], form: int) -> None:
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "a.tar.gz"
        try:
            with tarfile.open(path, "w:gz", format=form) as archive:
                for name, data in entries:
                    info = tarfile.TarInfo(name)
                    info.size = len(data)
                    archive.addfile(info, io.BytesIO(data))
        except (UnicodeEncodeError, ValueError):
            return
        written = unpacked(path)
    if written is not None:
        assert all(is_plain(name) for name, _ in entries)
        assert len(written) == len(entries)


@settings(max_examples=examples(200))
@given(st.data(), st.sampled_from(["zip", "tar.gz"]))
def test_damaged_bytes_never_raise_anything_else(data: st.DataObject, suffix: str) -> None:
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / f"a.{suffix}"
        if suffix == "zip":
            with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
                archive.writestr("rover/model.sdf", "<sdf/>" * 20)
                archive.writestr("rover/model.config", "<model/>" * 20)
        else:
            with tarfile.open(path, "w:gz", compresslevel=0) as tar:
                info = tarfile.TarInfo("rover/model.sdf")
                info.size = 600
                tar.addfile(info, io.BytesIO(b"x" * 600))
        content = bytearray(path.read_bytes())
        places = st.integers(0, len(content) - 1)
        for at in data.draw(st.lists(places, min_size=1, max_size=6)):
            content[at] = data.draw(st.integers(0, 255))
        path.write_bytes(content)
        unpacked(path)
