"""Archives: what opens, and what is refused before anything is unpacked."""

from __future__ import annotations

import gzip
import io
import struct
import sys
import tarfile
import time
import unicodedata
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest

from checker.base.errors import RefusedArchive, UnreadableInput
from checker.package.archives.archive import unpack_archive
from checker.package.archives.index import _UNPRINTABLE, ArchiveLimits
from checker.package.inputs import open_input
from checker.source.text import SourceText

Pack = Callable[[list[tuple[str, bytes]]], Path]

MODEL = b"<sdf version='1.6'><model name='rover'/></sdf>"


def refusal(archive: Path, tmp_path: Path) -> str:
    """Return why an archive is refused, having seen that nothing was unpacked."""
    target = tmp_path / "target"
    target.mkdir()
    before = set(tmp_path.rglob("*"))
    with pytest.raises(RefusedArchive) as error:
        unpack_archive(archive, target)
    assert set(tmp_path.rglob("*")) == before
    return str(error.value)


@pytest.mark.parametrize("top", ["", "rover_sensor_config_1/", "repo/submitted_models/"])
def test_package_at_any_usual_depth(pack: Pack, top: str) -> None:
    folder = top if top != "repo/submitted_models/" else f"{top}rover_sensor_config_1/"
    archive = pack([(f"{folder}model.sdf", MODEL), (f"{folder}launch/spawner.rb", b"# nothing")])
    with open_input(archive) as opened:
        (package,) = opened.packages
        assert package.name == "rover_sensor_config_1"
        source = package.read("model.sdf")
        assert isinstance(source, SourceText)
        assert source.text == MODEL.decode()
        place = package.root
    assert not place.exists()


def test_archive_of_several_packages_opens_each_as_a_sibling(pack: Pack) -> None:
    archive = pack([("b_1/model.sdf", MODEL), ("a_1/model.sdf", MODEL), ("README.md", b"hello")])
    with open_input(archive) as opened:
        assert [package.name for package in opened.packages] == ["a_1", "b_1"]
        assert opened.packages[0].exists("../b_1/model.sdf")


def test_name_as_the_user_knows_it(pack: Pack, tmp_path: Path) -> None:
    archive = pack([("model.sdf", MODEL)])
    stored = archive.rename(tmp_path / "0f3a")
    with open_input(stored, name=archive.name) as opened:
        assert opened.packages[0].name == "rover_sensor_config_1"


def test_every_control_character_and_surrogate_is_refused_and_nothing_else() -> None:
    for number in range(sys.maxunicode + 1):
        character = chr(number)
        refused = unicodedata.category(character) in ("Cc", "Cs")
        assert bool(_UNPRINTABLE.search(character)) is refused, f"U+{number:04X}"


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("../evil.sdf", "'..'"),
        ("rover/../../evil.sdf", "'..'"),
        ("/etc/evil.sdf", "absolute path"),
        ("rover\\..\\evil.sdf", "backslash"),
        ("C:/evil.sdf", "drive letter"),
        ("rover/a\nb.sdf", "control character"),
        ("rover/a\x7fb.sdf", "control character"),
        ("n" * 256, "too long"),
        ("/".join(["folder" * 9] * 20), "too long"),
        ("/".join("d" * 51), "folders deep"),
    ],
)
def test_names_that_lead_elsewhere(pack: Pack, tmp_path: Path, name: str, reason: str) -> None:
    archive = pack([("rover/model.sdf", MODEL), (name, b"x")])
    assert reason in refusal(archive, tmp_path)


@pytest.mark.filterwarnings("ignore:Duplicate name")
@pytest.mark.parametrize(
    ("names", "reason"),
    [
        (["a/model.sdf", "a/model.sdf"], "appears twice"),
        (["a/model.sdf", "./a//model.sdf"], "appears twice"),
        (["a/model.sdf", "a/Model.sdf"], "differs from 'a/model.sdf' only in upper and lower case"),
        (["a/model.sdf", "A/other.sdf"], "differs from 'a' only in upper and lower case"),
        (["a/\u00e9.sdf", "a/e\u0301.sdf"], "differs from"),
        (["a/model.sdf", "a/model.sdf/b"], "both a file and a folder"),
    ],
)
def test_names_that_clash(pack: Pack, tmp_path: Path, names: list[str], reason: str) -> None:
    assert reason in refusal(pack([(name, MODEL) for name in names]), tmp_path)


@pytest.mark.slow
def test_ten_thousand_files(pack: Pack, tmp_path: Path) -> None:
    archive = pack([(f"rover/{number}.txt", b"") for number in range(10_000)])
    assert "rover/5000.txt' exceeds the limit of 5000 entries" in refusal(archive, tmp_path)


def test_a_quarter_of_a_million_folders(pack: Pack, tmp_path: Path) -> None:
    """Names of such length and depth took a gigabyte and two seconds to compare."""
    way = "/".join(["e\u0301" * 4] * 47)
    archive = pack([(f"rover/{number}/{way}/x", b"") for number in range(5_000)])
    begun = time.process_time()
    assert "the limit of 10000 files and folders" in refusal(archive, tmp_path)
    assert time.process_time() - begun < 1


def test_bomb_is_told_by_its_ratio(pack: Pack, tmp_path: Path) -> None:
    archive = pack([("rover/model.sdf", MODEL), ("rover/zeros.dae", bytes(30_000_000))])
    assert "zeros.dae' makes it unpack to more than 200 times" in refusal(archive, tmp_path)


def test_small_text_may_pack_as_well_as_it_likes(pack: Pack) -> None:
    archive = pack([("model.sdf", MODEL + b" " * 9_000_000)])
    assert archive.stat().st_size < 9_000_000 / 200
    with open_input(archive) as opened:
        assert opened.packages[0].exists("model.sdf")


def test_unpacked_size_is_limited(pack: Pack, tmp_path: Path) -> None:
    archive = pack([("a", bytes(600)), ("b", bytes(600))])
    limits = ArchiveLimits(unpacked_bytes=1000)
    with pytest.raises(RefusedArchive, match=r"'b' makes it unpack to more than the 0\.001 MB"):
        unpack_archive(archive, tmp_path / "target", limits=limits)


@pytest.mark.parametrize("keep", [0.0, 0.3, 0.6, 0.95])
def test_truncated(pack: Pack, keep: float) -> None:
    noise = b"".join(zlib.crc32(struct.pack("I", n)).to_bytes(4, "big") for n in range(9_000))
    archive = pack([("rover/model.sdf", MODEL), ("rover/mesh.stl", noise)])
    data = archive.read_bytes()
    archive.write_bytes(data[: int(len(data) * keep)])
    with pytest.raises(UnreadableInput, match=r"cut off|damaged|no files"), open_input(archive):
        pass


@pytest.mark.parametrize("data", [b"", b"no archive at all", bytes(2_000), b"PK\5\6" * 40])
@pytest.mark.parametrize("suffix", ["zip", "tar.gz", "tgz"])
def test_no_archive(tmp_path: Path, suffix: str, data: bytes) -> None:
    path = tmp_path / f"rover.{suffix}"
    path.write_bytes(data)
    with pytest.raises(UnreadableInput) as error, open_input(path):
        pass
    assert str(error.value).startswith(str(path))
    assert error.value.advice


def test_archive_without_files(pack: Pack) -> None:
    with pytest.raises(UnreadableInput, match="contains no files"), open_input(pack([])):
        pass


def test_archive_without_a_package(pack: Pack) -> None:
    archive = pack([("notes/README.md", b"hello")])
    with pytest.raises(UnreadableInput, match="contains no package") as error, open_input(archive):
        pass
    assert error.value.path == archive


def test_encrypted_zip(tmp_path: Path) -> None:
    path = tmp_path / "rover.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("model.sdf", MODEL)
    data = bytearray(path.read_bytes())
    data[data.index(b"PK\1\2") + 8] |= 1
    path.write_bytes(data)
    assert "'model.sdf' is encrypted" in refusal(path, tmp_path)


@pytest.mark.parametrize("mode", [0o120777, 0o020666, 0o060666, 0o010666])
def test_zip_with_link_or_device(tmp_path: Path, mode: int) -> None:
    path = tmp_path / "rover.zip"
    info = zipfile.ZipInfo("rover/link")
    info.create_system = 3
    info.external_attr = mode << 16
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(info, "/etc/passwd")
    assert "'rover/link' is a link or a device" in refusal(path, tmp_path)


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_zip_packed_by_an_unusual_method(tmp_path: Path, method: int) -> None:
    path = tmp_path / "rover.zip"
    with zipfile.ZipFile(path, "w", method) as archive:
        archive.writestr("model.sdf", MODEL)
    assert "another method than deflate" in refusal(path, tmp_path)


def test_zip_entry_without_a_name(tmp_path: Path) -> None:
    path = tmp_path / "rover.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("xyz", MODEL)
    path.write_bytes(path.read_bytes().replace(b"xyz", b"\0yz"))
    assert "control characters" in refusal(path, tmp_path)


def test_zip_whose_index_understates_a_size(tmp_path: Path) -> None:
    path = tmp_path / "rover.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("model.sdf", bytes(50_000_000))
    data = bytearray(path.read_bytes())
    struct.pack_into("<I", data, data.index(b"PK\1\2") + 24, 1_000)
    path.write_bytes(data)
    target = tmp_path / "target"
    target.mkdir()
    with pytest.raises(UnreadableInput):
        unpack_archive(path, target)
    assert sum(file.stat().st_size for file in target.iterdir()) <= 1_000


def test_zip_whose_index_overstates_a_size(tmp_path: Path) -> None:
    path = tmp_path / "rover.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("model.sdf", MODEL)
    data = bytearray(path.read_bytes())
    struct.pack_into("<I", data, data.index(b"PK\1\2") + 24, 1_000)
    path.write_bytes(data)
    with pytest.raises(UnreadableInput, match="whose stated size is wrong"), open_input(path):
        pass


def test_zip_with_an_endless_index(tmp_path: Path) -> None:
    path = tmp_path / "rover.zip"
    size = 5_000_000
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 9, 9, size, 0, 0)
    path.write_bytes(bytes(size) + end)
    with pytest.raises(UnreadableInput, match="more entries than any package"), open_input(path):
        pass


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        (tarfile.SYMTYPE, "symbolic link"),
        (tarfile.LNKTYPE, "hard link"),
        (tarfile.CHRTYPE, "device"),
        (tarfile.BLKTYPE, "device"),
        (tarfile.FIFOTYPE, "pipe"),
        (tarfile.GNUTYPE_SPARSE, "sparse"),
        (b"Z", "neither a file nor a folder"),
    ],
)
def test_tar_with_link_or_device(tmp_path: Path, kind: bytes, reason: str) -> None:
    path = tmp_path / "rover.tar.gz"
    with tarfile.open(path, "w:gz") as archive:
        info = tarfile.TarInfo("rover/special")
        info.type = kind
        info.linkname = "/etc/passwd"
        archive.addfile(info)
    message = refusal(path, tmp_path)
    assert "rover/special" in message
    assert reason in message


@pytest.mark.parametrize("form", [tarfile.USTAR_FORMAT, tarfile.GNU_FORMAT, tarfile.PAX_FORMAT])
def test_tar_formats_with_long_names(tmp_path: Path, form: int) -> None:
    path = tmp_path / "rover.tgz"
    name = "rover/" + "meshes/" * 12 + "w" * 90 + ".dae"
    with tarfile.open(path, "w:gz", format=form) as archive:
        folder = tarfile.TarInfo("rover")
        folder.type = tarfile.DIRTYPE
        archive.addfile(folder)
        for entry, data in ((name, b"mesh"), ("rover/model.sdf", MODEL)):
            info = tarfile.TarInfo(entry)
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))
    with open_input(path) as opened:
        assert opened.packages[0].read_bytes(name.removeprefix("rover/")) == b"mesh"


@pytest.mark.slow
@pytest.mark.parametrize(("name", "kind"), [("x", b"x"), ("x", b"g"), ("./", tarfile.DIRTYPE)])
def test_tar_of_endless_headers(tmp_path: Path, name: str, kind: bytes) -> None:
    """None of them is an entry of the package, so that no limit of these ends them."""
    path = tmp_path / "rover.tar.gz"
    info = tarfile.TarInfo(name)
    info.type = kind
    with gzip.open(path, "wb") as archive:
        archive.write(info.tobuf(tarfile.USTAR_FORMAT) * 100_000)
    with pytest.raises(UnreadableInput, match="more headers than any package"), open_input(path):
        pass


def test_tar_that_hides_a_path_in_an_extended_header(tmp_path: Path) -> None:
    path = tmp_path / "rover.tar.gz"
    with tarfile.open(path, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        info = tarfile.TarInfo("model.sdf")
        info.pax_headers = {"path": "../../evil.sdf"}
        archive.addfile(info)
    assert "'../../evil.sdf'" in refusal(path, tmp_path)


def test_tar_with_a_wrong_checksum(tmp_path: Path) -> None:
    path = tmp_path / "rover.tar.gz"
    raw = io.BytesIO()
    with tarfile.open(fileobj=raw, mode="w") as archive:
        archive.addfile(tarfile.TarInfo("model.sdf"))
    data = bytearray(raw.getvalue())
    data[0] ^= 1
    path.write_bytes(gzip.compress(bytes(data)))
    with pytest.raises(UnreadableInput, match="checksum"), open_input(path):
        pass


def test_tar_of_endless_extended_headers(tmp_path: Path) -> None:
    path = tmp_path / "rover.tar.gz"
    raw = io.BytesIO()
    with tarfile.open(fileobj=raw, mode="w", format=tarfile.PAX_FORMAT) as archive:
        info = tarfile.TarInfo("model.sdf")
        info.pax_headers = {"comment": "x" * 900_000}
        archive.addfile(info)
    header = raw.getvalue()[: raw.getvalue().rindex(b"model.sdf")]
    path.write_bytes(gzip.compress(header * 60))
    with pytest.raises(UnreadableInput, match="headers that are too large"), open_input(path):
        pass


def pax_header(data: bytes) -> bytes:
    """Return an extended header as a tar archive has it."""
    info = tarfile.TarInfo("header")
    info.type, info.size = tarfile.XHDTYPE, len(data)
    return info.tobuf(tarfile.USTAR_FORMAT) + data + b"\0" * (-len(data) % 512)


@pytest.mark.parametrize("record", [b"5 a=\n", b"6 ab=\n"])
def test_tar_with_extended_headers_of_tiny_records(tmp_path: Path, record: bytes) -> None:
    """To parse a hundred of a megabyte each would take twenty seconds."""
    path = tmp_path / "rover.tar.gz"
    header = pax_header(record * (990_000 // len(record)))
    path.write_bytes(gzip.compress(header * 100, compresslevel=1))
    started = time.process_time()
    with pytest.raises(UnreadableInput, match="more than 100 records"), open_input(path):
        pass
    assert time.process_time() - started < 1.0
