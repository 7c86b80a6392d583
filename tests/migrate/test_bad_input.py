"""What cannot be migrated: one sentence that says why, and no half-written package."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

from checker.base.errors import UnreadableInput
from checker.migrate.migration import migrate
from checker.migrate.new_package import stage_package
from checker.migrate.options import MigrationOptions, NotMigrated
from tests.conftest import SAMPLES
from tests.migrate.conftest import FOUR, MANIFEST, Write, body, urdf

ROBOT = urdf(body() + FOUR)
PACKAGE = "acme_rover_sensor_config_1"
ACME = MigrationOptions(organization="acme")
XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
pytestmark = pytest.mark.usefixtures("no_pictures")

Files = Mapping[str, str]


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({"CMakeLists.txt": "project(rover)"}, "contains no robot in URDF"),
        ({"urdf/a.urdf": urdf("")}, "contains no robot in URDF"),
        ({"model.sdf": "<sdf version='1.6'/>"}, "already has an SDF model (model.sdf)"),
        (
            {"urdf/a.urdf": ROBOT, "urdf/b.urdf": ROBOT},
            "describes several robots: urdf/a.urdf, urdf/b.urdf; choose one with --urdf",
        ),
        (
            {"urdf/a.urdf": "<robot name='a'><link"},
            "urdf/a.urdf cannot be expanded: urdf/a.urdf:1:",
        ),
        (
            {"urdf/a.urdf.xacro": f"<robot name='a' {XACRO}><xacro:nothing/></robot>"},
            "urdf/a.urdf.xacro cannot be expanded: urdf/a.urdf.xacro:1:",
        ),
        (
            {
                "urdf/a.urdf.xacro": f"<robot name='a' {XACRO}><link name='$(arg which)'/>"
                "<link name='b'/></robot>"
            },
            "give it with --args name:=value",
        ),
        (
            {"urdf/a.urdf": ROBOT.replace("left_rear", "left_rear#{`id`}")},
            "is a name that launch files cannot contain",
        ),
        (
            {"urdf/a.urdf": urdf(body("base_link")).replace("rover", "№")},
            "'№' is not a package name; give --robot",
        ),
    ],
    ids=[
        *("no URDF", "no link", "SDF already", "two robots", "no XML", "unknown macro"),
        *("missing argument", "Ruby in a name", "no Latin name"),
    ],
)
def test_a_source_that_cannot_be_migrated(
    write: Write, tmp_path: Path, files: Files, said: str
) -> None:
    with pytest.raises(NotMigrated, match=re.escape(said)):
        migrate(write(files), tmp_path / "made", ACME)
    assert not (tmp_path / "made").exists()


def test_one_of_two_robots_can_be_chosen(write: Write, tmp_path: Path) -> None:
    source = write({"urdf/a.urdf": ROBOT, "urdf/b.urdf": urdf(body(), name="box")})
    wishes = MigrationOptions(organization="acme", urdf="urdf/b.urdf")
    made = migrate(source, tmp_path / "made", wishes)
    assert made.folder.name == "acme_box_sensor_config_1"


def test_a_file_that_is_chosen_and_not_there(write: Write, tmp_path: Path) -> None:
    source = write({"urdf/a.urdf": ROBOT})
    with pytest.raises(NotMigrated, match=r"other.urdf is not a file of .*; found: urdf/a.urdf"):
        migrate(source, tmp_path / "made", MigrationOptions(urdf="other.urdf"))


def test_arguments_reach_xacro(write: Write, tmp_path: Path) -> None:
    text = ROBOT.replace("<robot", f"<robot {XACRO}").replace(
        'mass value="10.0"', 'mass value="$(arg m)"'
    )
    source = write({"urdf/rover.urdf.xacro": text})
    made = migrate(
        source, tmp_path / "made", MigrationOptions(organization="acme", args={"m": "12"})
    )
    assert "<mass>12</mass>" in (made.folder / "model.sdf").read_text("utf-8")


def test_a_source_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(UnreadableInput, match="does not exist"):
        migrate(tmp_path / "nothing", tmp_path / "made", ACME)


def test_a_lone_file_is_migrated(write: Write, tmp_path: Path) -> None:
    source = write({"urdf/rover.urdf": ROBOT})
    made = migrate(source / "urdf/rover.urdf", tmp_path / "made", ACME)
    assert made.folder == tmp_path / "made" / PACKAGE


def test_two_packages_in_the_source(write: Write, tmp_path: Path) -> None:
    source = write({"urdf/rover.urdf": ROBOT})
    both = tmp_path / "both"
    for name in ("a_description", "b_description"):
        shutil.copytree(source, both / name)
    with pytest.raises(NotMigrated, match=r"several packages \(a_description, b_description\)"):
        migrate(both, tmp_path / "made", ACME)


def test_a_mesh_that_is_not_there_is_said(write: Write, tmp_path: Path) -> None:
    mesh = '<mesh filename="package://elsewhere/meshes/a.dae"/>'
    box = '<box size="0.6 0.3 0.1"/></geometry></visual>'
    source = write(body().replace(box, f"{mesh}</geometry></visual>") + FOUR)
    made = migrate(source, tmp_path / "made", ACME)
    assert any("is in elsewhere, which is not available" in each for each in made.open_points)


def test_the_destination_has_a_package_of_this_name(write: Write, tmp_path: Path) -> None:
    (tmp_path / "made" / PACKAGE).mkdir(parents=True)
    with pytest.raises(NotMigrated, match=rf"made/{PACKAGE} exists; move it away"):
        migrate(write({"urdf/a.urdf": ROBOT}), tmp_path / "made", ACME)
    assert [each.name for each in (tmp_path / "made").iterdir()] == [PACKAGE]
    assert not list((tmp_path / "made" / PACKAGE).iterdir())


def test_the_destination_is_a_package(write: Write, tmp_path: Path) -> None:
    (tmp_path / "made").mkdir()
    (tmp_path / "made/package.xml").write_text("<package/>", "utf-8")
    with pytest.raises(NotMigrated, match="made is a package, and ROS finds no package inside"):
        migrate(write({"urdf/a.urdf": ROBOT}), tmp_path / "made", ACME)
    assert [each.name for each in (tmp_path / "made").iterdir()] == ["package.xml"]


def test_the_destination_is_a_workspace_with_other_packages(write: Write, tmp_path: Path) -> None:
    other = tmp_path / "made" / "other"
    other.mkdir(parents=True)
    (other / "package.xml").write_text("<package><name>other</name></package>", "utf-8")
    made = migrate(write({"urdf/a.urdf": ROBOT}), tmp_path / "made", ACME)
    assert made.folder == tmp_path / "made" / PACKAGE
    assert sorted(each.name for each in (tmp_path / "made").iterdir()) == [PACKAGE, "other"]
    assert [each.name for each in other.iterdir()] == ["package.xml"]


def test_the_destination_lies_inside_the_source(write: Write) -> None:
    source = write({"urdf/a.urdf": ROBOT})
    with pytest.raises(NotMigrated, match="is inside package rover_description"):
        migrate(source, source / "made", ACME)
    assert not (source / "made").exists()


def test_a_license_of_several_lines_stays_in_its_line(write: Write, tmp_path: Path) -> None:
    manifest = MANIFEST.replace(">MIT<", ">MIT\n# Injected<")
    source = write({"package.xml": manifest, "urdf/a.urdf": ROBOT})
    made = migrate(source, tmp_path / "made", ACME)
    sheet = (made.folder / "specifications.md").read_text("utf-8")
    assert "has the licence MIT # Injected." in sheet


def test_the_destination_is_a_file(write: Write, tmp_path: Path) -> None:
    (tmp_path / "made").write_text("mine", "utf-8")
    with pytest.raises(NotMigrated, match="is not a folder"):
        migrate(write({"urdf/a.urdf": ROBOT}), tmp_path / "made", ACME)


def test_an_empty_destination_is_kept_after_a_failure(tmp_path: Path) -> None:
    (tmp_path / "made").mkdir()
    with pytest.raises(RuntimeError), stage_package(tmp_path / "made", PACKAGE):
        raise RuntimeError
    assert not list((tmp_path / "made").iterdir())


def command(*arguments: object) -> subprocess.Popen[str]:
    words = [sys.executable, "-m", "checker.cli", "migrate", *map(str, arguments), "--no-trial"]
    pipe = subprocess.PIPE
    return subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True, cwd=SAMPLES.parent)


@pytest.mark.root
def test_a_folder_that_cannot_be_written_to(write: Write, open_folder: Path) -> None:
    source = write({"urdf/a.urdf": ROBOT}).rename(open_folder / "rover_description")
    # The first run loads all modules, which the other user may not be able to read.
    start = (
        "import io, os, sys, tempfile; from contextlib import redirect_stdout\n"
        "from checker.cli import main\n"
        "with redirect_stdout(io.StringIO()), tempfile.TemporaryDirectory() as place:\n"
        "    main(['migrate', sys.argv[1], place, '--no-trial'])\n"
        "os.setuid(65534); sys.exit(main(['migrate', *sys.argv[1:]]))"
    )
    made = open_folder / "made"
    child = [sys.executable, "-c", start, str(source), str(made)]
    done = subprocess.run(child, capture_output=True, text=True, check=False, cwd=SAMPLES.parent)
    expected = f"subt-check: {made} cannot be written: Permission denied; no package was made\n"
    assert (done.returncode, done.stderr) == (2, expected)
    assert not made.exists()


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 64 KB."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(place)]
    able = shutil.which("mount") is not None
    if not able or subprocess.run(mount, check=False, capture_output=True).returncode:
        pytest.skip("a small file system cannot be mounted here")
    yield place
    subprocess.run(["umount", str(place)], check=False)


@pytest.mark.root
def test_a_full_disk(small_disk: Path) -> None:
    said = "No space left on device; no package was made"
    with pytest.raises(NotMigrated, match=said):
        migrate(SAMPLES / "husky_description", small_disk, ACME)
    assert not list(small_disk.iterdir())


def test_a_disk_that_is_full_at_the_first_mesh(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(NotMigrated, match="No space left on device; no package was made"):
        migrate(SAMPLES / "husky_description", tmp_path / "made", ACME)
    assert not (tmp_path / "made").exists()


@pytest.mark.service
def test_a_kill_in_the_middle_leaves_no_half_package(tmp_path: Path) -> None:
    made = tmp_path / "made"
    child = command(SAMPLES / "husky_description", made)
    until = time.monotonic() + 60
    while not list(made.glob(".*/*/meshes")) and time.monotonic() < until:
        time.sleep(0.005)
    child.send_signal(signal.SIGKILL)
    child.communicate()
    assert [each.name.startswith(".") for each in made.iterdir()] == [True]
    again = migrate(SAMPLES / "husky_description", made, ACME)
    assert (again.folder / "launch/spawner.rb").is_file()


def test_the_command_says_why(tmp_path: Path) -> None:
    child = command(tmp_path / "nothing", tmp_path / "made")
    out, err = child.communicate(timeout=60)
    assert (child.returncode, out) == (2, "")
    assert err == f"subt-check: {tmp_path / 'nothing'} does not exist; check the spelling.\n"


def test_the_command_lists_what_is_left_to_do(write: Write, tmp_path: Path) -> None:
    child = command(write({"urdf/a.urdf": ROBOT}), tmp_path / "made")
    out, err = child.communicate(timeout=60)
    # SEN022: no IMU can be guessed at.
    assert (child.returncode, err) == (1, "")
    assert out.startswith(f"made {tmp_path}/made/my_team_rover_sensor_config_1\ndecided:\n  - ")
    assert "left to you:\n  - the organization's name, here 'my_team' (--organization)\n" in out
    assert "error SEN022" in out
    assert "1 error of the robot, 1 of the interface and 1 of the paperwork" in out
