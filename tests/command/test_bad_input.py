"""Whatever is given, the command ends soon, with a sentence or a finding, and without a traceback.

The fixture `run` fails on tracebacks, on text that is no UTF-8, and on work of half a minute.
"""

from __future__ import annotations

import io
import json
import os
import re
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.command.conftest import Run

CONTROL = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
ENTITIES = "".join(f'<!ENTITY {chr(98 + n)} "{f"&{chr(97 + n)};" * 10}">' for n in range(25))
DTD = f"""<!DOCTYPE sdf [<!ENTITY a "aaaaaaaaaa">{ENTITIES}]>
<sdf version="1.6"><model name="&z;"/></sdf>"""
EXTERNAL = """<!DOCTYPE sdf [<!ENTITY secret SYSTEM "file:///etc/hostname">]>
<sdf version="1.6"><model name="&secret;"/></sdf>"""


def refused(done: subprocess.CompletedProcess[str], reason: str) -> bool:
    assert (done.returncode, done.stdout) == (2, ""), done
    assert done.stderr.count("\n") == 1
    assert reason in done.stderr
    return True


def reported(done: subprocess.CompletedProcess[str]) -> set[str]:
    """Return the rules that report an error."""
    assert done.returncode == 1, done
    return set(re.findall(r" error ([A-Z][A-Z0-9]{2}\d{3}) ", done.stdout))


def test_a_path_that_does_not_exist(run: Run) -> None:
    assert refused(run("nowhere"), "nowhere does not exist")


@pytest.mark.parametrize("length", [300, 10_000])
def test_a_path_of_many_characters(run: Run, length: int) -> None:
    done = run("n" * length, "--jobs", 2)
    assert refused(done, "cannot be opened: File name too long")
    assert len(done.stderr) < 1000


def test_an_empty_folder(run: Run, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    assert refused(run("empty"), "empty is an empty folder")


def test_a_folder_without_a_package(run: Run, tmp_path: Path) -> None:
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes/today.txt").write_text("milk")
    assert refused(run("notes"), "notes contains no package")


@pytest.mark.parametrize("name", ["readme.txt", "chassis"])
def test_a_file_that_is_no_package(run: Run, tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text("milk")
    assert refused(run(name), f"{name} is not a package, archive or model file")


def test_models_of_isaac_are_named(run: Run, tmp_path: Path) -> None:
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm/part.stl").write_bytes(b"solid")
    (tmp_path / "arm/arm.usda").write_text("#usda 1.0")
    unchecked = "which this version does not check; give the robot as URDF"
    assert refused(run("arm"), f"no package; arm.usda is a USD file, {unchecked}")
    assert refused(run("arm/arm.usda"), f"arm.usda is a USD file, {unchecked}")


def test_models_of_other_formats_beside_a_robot_are_named(run: Run, rover: Path) -> None:
    for name in ("arm.usd", "lift.sdf.jinja", "model.sdf.erb"):
        (rover / name).write_text("")
    (package,) = json.loads(run(rover, "--output-format", "json").stdout)["packages"]
    unsupported = [it for it in package["not_checked"] if it["cause"] == "not_supported"]
    unchecked = "which this version does not check"
    assert [each["reason"] for each in unsupported] == [
        f"arm.usd is a USD file, {unchecked}",
        f"lift.sdf.jinja is a template of a model, {unchecked}",
    ]


def test_models_beside_packages_are_named(run: Run, rover: Path) -> None:
    (rover.parent / "demo/models").mkdir(parents=True)
    rover.rename(rover.parent / "demo/models/rover")
    for name in ("arm.usd", "hand.usd"):
        (rover.parent / f"demo/models/{name}").write_text("")
    report = json.loads(run(rover.parent, "--output-format", "json").stdout)
    (beside,) = report["not_opened"]
    assert beside["reason"].startswith(
        "contains models outside its packages: demo/models/arm.usd and 1 more are USD files"
    )
    assert "USD" not in json.dumps(report["packages"][0]["not_checked"])


def test_devices_and_pipes_are_not_read(run: Run, tmp_path: Path, rover: Path) -> None:
    os.mkfifo(tmp_path / "pipe.sdf")
    assert refused(run("pipe.sdf"), "is not a package, archive or model file")
    assert refused(run("/dev/zero"), "is not a package, archive or model file")
    (rover / "model.sdf").unlink()
    os.mkfifo(rover / "model.sdf")
    assert "PKG003" in reported(run(rover))


def test_links_in_a_circle(run: Run, tmp_path: Path, rover: Path) -> None:
    (tmp_path / "one").symlink_to("two")
    (tmp_path / "two").symlink_to("one")
    assert refused(run("one"), "one cannot be opened")
    (rover / "meshes").symlink_to(".")
    (rover / "specifications.md").unlink()
    (rover / "specifications.md").symlink_to("specifications.md")
    done = run(rover)
    assert done.returncode in (0, 1)


@pytest.mark.parametrize(
    ("content", "rule"),
    [
        (b"", "SDF001"),
        (b"<sdf version='1.6'><model name='m'><link name=", "SDF001"),
        (b"\x7fELF\x02\x01\x01\x00\x00\xff\xfe\xfd", "SDF001"),
        ("<a>" * 10_000 + "</a>" * 10_000, "SDF001"),
        (DTD, "SDF001"),
        (EXTERNAL, "SDF001"),
        (b"<sdf version='1.6'><model name='m'/></sdf>" + b"\x00" * 1000, "SDF001"),
    ],
    ids=["empty", "cut off", "binary", "deep", "entities", "external", "zeros"],
)
def test_a_model_that_is_no_xml_is_a_finding(
    run: Run, rover: Path, content: bytes | str, rule: str
) -> None:
    data = content if isinstance(content, bytes) else content.encode()
    (rover / "model.sdf").write_bytes(data)
    done = run(rover)
    assert rule in reported(done)
    assert "/model.sdf:" in done.stdout
    hostname = Path("/etc/hostname").read_text() if Path("/etc/hostname").exists() else ""
    assert not hostname.strip() or hostname.strip() not in done.stdout


def test_a_model_of_200_megabytes_is_not_read(run: Run, rover: Path) -> None:
    with (rover / "model.sdf").open("wb") as file:
        file.truncate(200_000_000)
    done = run(rover)
    assert "model.sdf has 200.0 MB, more than the limit of 20 MB" in done.stdout
    assert done.returncode == 1 or "Incomplete" in done.stdout


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-8-sig", "latin-1"])
def test_a_model_in_another_encoding_is_read_or_said_to_be_none(
    run: Run, rover: Path, encoding: str
) -> None:
    text = '<sdf version="1.6"><model name="r\u00f6ver"><link name="a"/></model></sdf>'
    head = "" if encoding != "latin-1" else '<?xml version="1.0" encoding="latin-1"?>\n'
    (rover / "model.sdf").write_bytes((head + text).encode(encoding))
    done = run(rover)
    assert "1 link," in done.stdout or "SDF001" in done.stdout


@pytest.mark.parametrize("file", ["launch/spawner.rb", "CMakeLists.txt", "specifications.md"])
@pytest.mark.parametrize("content", [b"\x00\xff" * 1000, b"(" * 100_000, b"#{" * 50_000])
def test_other_files_that_make_no_sense(run: Run, rover: Path, file: str, content: bytes) -> None:
    (rover / file).write_bytes(content)
    assert run(rover).returncode in (0, 1)


def test_names_with_terminal_escapes_reach_no_terminal(run: Run, tmp_path: Path) -> None:
    evil = "\x1b]0;owned\x07\x1b[2J\u202e\x9b31m"
    package = tmp_path / f"a{evil}_sensor_config_1"
    package.mkdir()
    (package / f"{evil}.sdf").write_text("<sdf")
    (package / "model.sdf").write_text(
        '<sdf version="1.6"><model name="m\u009b31m\u202e">'
        "<link name='\u0085'/><joint name='j'><parent>\u009bx</parent></joint></model></sdf>"
    )
    (package / "model.config").write_text("<model><sdf>\u009bmodel.sdf</sdf></model>")
    done = run(package)
    assert done.returncode == 1
    assert not CONTROL.search(done.stdout.replace("\n", ""))
    as_json = run(package, "--format", "json").stdout
    assert not CONTROL.search(as_json.replace("\n", ""))
    assert json.loads(as_json)["packages"][0]["name"] == package.name
    missing = run(tmp_path / f"{evil}.sdf")
    assert missing.returncode == 2
    assert not CONTROL.search(missing.stderr.replace("\n", ""))


def test_names_that_are_no_text(run_apart: Run, rover: Path) -> None:
    strange = rover.rename(rover.with_name(f"{rover.name}\udcff"))
    (strange / "\udcfe.sdf").write_text("<sdf")
    for arguments in (["--format", "json"], [], ["--output", "out.txt"]):
        assert run_apart(strange, *arguments).returncode == 1


@pytest.mark.parametrize("length", [10_000, 1_000_000])
def test_a_name_of_many_characters(run: Run, rover: Path, length: int) -> None:
    name = "n" * length
    (rover / "model.sdf").write_text(
        f'<sdf version="1.6"><model name="{name}"><link name="{name}"/><link name="{name}"/>'
        f'<joint name="{name}" type="fixed"><parent>{name}</parent><child>x{name}</child>'
        "</joint></model></sdf>"
    )
    done = run(rover)
    assert {"KIN001", "SDF009"} <= reported(done)
    assert max(map(len, done.stdout.splitlines())) < 1000


@pytest.mark.root
@pytest.mark.parametrize("spoilt", [".", "model.sdf", "launch", "subt-check.toml"])
def test_what_may_not_be_read_is_said(rover: Path, spoilt: str, open_folder: Path) -> None:
    rover = rover.rename(open_folder / rover.name)
    (rover / "subt-check.toml").touch()
    (rover / spoilt).chmod(0)
    # The first run loads all modules, which the other user may not be able to read.
    start = (
        "import io, os, sys; from contextlib import redirect_stdout; from checker.cli import main\n"
        "with redirect_stdout(io.StringIO()): main()\n"
        "os.setuid(65534); sys.exit(main())"
    )
    # Nothing is recalled, or that run would load little.
    child = [sys.executable, "-c", start, str(rover), "--no-cache"]
    done = subprocess.run(child, capture_output=True, text=True, check=False)
    assert "Traceback" not in done.stderr
    assert "internal error" not in done.stderr
    assert done.returncode in (0, 1, 2)
    assert "Ready: nothing" not in done.stdout
    assert "permission" in (done.stdout + done.stderr).lower()


def zipped(*members: tuple[str, bytes]) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, content in members:
            archive.writestr(name, content)
    return data.getvalue()


def tarred(*members: tarfile.TarInfo) -> bytes:
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w:gz") as archive:
        for member in members:
            archive.addfile(member, io.BytesIO(b"\0" * member.size))
    return data.getvalue()


def linked(kind: bytes, target: str) -> tarfile.TarInfo:
    member = tarfile.TarInfo("rover/model.sdf")
    member.type, member.linkname = kind, target
    return member


def bomb() -> bytes:
    return zipped(*((f"rover/{n}.bin", b"\0" * 50_000_000) for n in range(20)))


@pytest.mark.parametrize(
    ("name", "make"),
    [
        ("a.zip", lambda: zipped(("../../model.sdf", b"<sdf/>"))),
        ("a.zip", lambda: zipped(("/tmp/model.sdf", b"<sdf/>"))),  # noqa: S108 - never written
        ("a.zip", lambda: zipped(("rover\\..\\..\\model.sdf", b"<sdf/>"))),
        ("a.tar.gz", lambda: tarred(tarfile.TarInfo("../../model.sdf"))),
        ("a.tar.gz", lambda: tarred(tarfile.TarInfo("/etc/model.sdf"))),
        ("a.tar.gz", lambda: tarred(linked(tarfile.SYMTYPE, "/etc/passwd"))),
        ("a.tar.gz", lambda: tarred(linked(tarfile.LNKTYPE, "../../x"))),
        ("a.tar.gz", lambda: tarred(linked(tarfile.CHRTYPE, ""))),
        ("a.zip", lambda: zipped(*((f"rover/{n}", b"") for n in range(10_001)))),
        ("a.zip", bomb),
        ("a.zip", lambda: zipped(("n" * 10_000, b""))),
        ("a.zip", lambda: zipped(("\x1b[31mrover/model.sdf", b"<sdf/>"))),
        ("a.zip", lambda: b"PK\x03\x04 and no more"),
        ("a.zip", lambda: b""),
        ("a.tar.gz", lambda: b"\x1f\x8b\x08\x00 and no more"),
        ("a.tar.gz", lambda: b""),
    ],
    ids=[
        *("zip leaves", "zip absolute", "zip backslash", "tar leaves", "tar absolute"),
        *("tar symlink", "tar hard link", "tar device", "many files", "bomb", "long name"),
        *("escapes", "cut zip", "empty zip", "cut tar", "empty tar"),
    ],
)
def test_archives_that_could_do_harm_are_refused(
    run: Run, tmp_path: Path, name: str, make: Callable[[], bytes]
) -> None:
    (tmp_path / name).write_bytes(make())
    done = run(name)
    assert refused(done, f"{name} ")
    assert not CONTROL.search(done.stderr.replace("\n", ""))
    assert len(done.stderr) < 1000
    assert not list(tmp_path.rglob("model.sdf"))


def test_an_archive_leaves_nothing_behind(run: Run, tmp_path: Path, rover: Path) -> None:
    files = [path for path in rover.rglob("*") if path.is_file()]
    members = ((str(path.relative_to(tmp_path)), path.read_bytes()) for path in files)
    (tmp_path / "rover.zip").write_bytes(zipped(*members))
    own = tmp_path / "temporary"
    own.mkdir()
    done = run("rover.zip", TMPDIR=str(own))
    assert f"{rover.name}: " in done.stdout
    assert not list(own.iterdir())
