"""What the user may give, and what is said when there is no package in it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from checker.base.errors import UnreadableInput
from checker.package.inputs import open_input, with_package_path
from checker.package.kind import PackageKind

Write = Callable[[Mapping[str, str]], Path]

MODEL = "<sdf version='1.6'><model name='rover'/></sdf>"
ROVER = {"rover/model.sdf": MODEL, "rover/package.xml": "<package><name>rover</name></package>"}


def complaint(path: Path) -> UnreadableInput:
    with pytest.raises(UnreadableInput) as error, open_input(path):
        pass
    assert str(path) in str(error.value)
    assert error.value.reason in str(error.value)
    assert error.value.advice in str(error.value)
    return error.value


def names(path: Path) -> list[str]:
    with open_input(path) as opened:
        return [package.name for package in opened.packages]


def test_package_folder(write: Write) -> None:
    space = write(ROVER)
    with open_input(space / "rover") as opened:
        (package,) = opened.packages
        assert package.name == "rover"
        assert opened.workspace.directories == (space,)


def test_package_folder_by_a_relative_path(write: Write, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(write(ROVER) / "rover")
    assert names(Path()) == ["rover"]


def test_folder_of_packages(write: Write) -> None:
    space = write({**ROVER, "b/model.sdf": MODEL, "README.md": "hello", ".git/model.sdf": MODEL})
    assert names(space) == ["b", "rover"]


def test_repository_around_the_submissions(write: Write) -> None:
    space = write(
        {
            "submitted_models/rover/model.sdf": MODEL,
            "submitted_models/b/model.sdf": MODEL,
            "subt_ros/package.xml": "<package/>",
        }
    )
    assert names(space) == ["b", "rover"]


def test_packages_one_level_deeper(write: Write) -> None:
    assert names(write({"one/a/model.sdf": MODEL, "two/b/model.sdf": MODEL})) == ["a", "b"]


def test_a_workspace_is_searched_at_any_depth(write: Write) -> None:
    deep = "/".join(f"level{number}" for number in range(20))
    assert names(write({f"src/{deep}/a/model.sdf": MODEL, "src/b/model.sdf": MODEL})) == ["b", "a"]


def test_models_below_a_model_config_without_a_model_are_found(write: Write) -> None:
    config = "<model><sdf>model.sdf</sdf></model>"
    floors = {
        "floors/model.config": config,
        "floors/plain/model.config": config,
        "floors/plain/model.sdf": MODEL,
        "floors/parts/model.sdf": MODEL,
    }
    assert names(write(floors)) == ["floors", "plain"]
    assert names(write({**floors, "floors/model.sdf": MODEL})) == ["floors"]


@pytest.mark.parametrize(
    "mark", ["COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE", ".catkin", ".built_by"]
)
def test_what_the_build_tools_ignore_is_left_out(write: Write, mark: str) -> None:
    files = {f"install/{mark}": "", "install/share/a/model.sdf": MODEL, "src/b/model.sdf": MODEL}
    assert names(write(files)) == ["b"]


@pytest.mark.parametrize(
    "mark",
    [
        "install/a/share/colcon-core/packages/a",
        "install/a/share/ament_index/resource_index/packages/a",
        "install/share/colcon-core/packages/a",
        "build/a/colcon_build.rc",
    ],
)
def test_what_colcon_built_is_left_out_unless_it_is_named(write: Write, mark: str) -> None:
    top = mark.partition("/")[0]
    space = write({mark: "", f"{top}/a/share/a/urdf/a.urdf": "<robot name='a'/>", **ROVER})
    if mark.startswith("install/share"):
        space = write({"install/share/a/urdf/a.urdf": "<robot name='a'/>"})
        (space / "install/a/share/a/urdf/a.urdf").unlink()
    with open_input(space) as opened:
        assert [package.name for package in opened.packages] == ["rover"]
        assert [(it.name, it.reason) for it in opened.skipped] == [(top, "is what colcon built")]
    assert names(space / top) == ["a"]


def test_a_folder_with_nothing_but_what_colcon_built_is_refused(write: Write) -> None:
    space = write(
        {"install/a/share/colcon-core/packages/a": "", "install/a/share/a/a.urdf": "<a/>"}
    )
    refused = complaint(space)
    assert refused.reason == "contains no package except what colcon built in install"
    assert refused.advice == f"give the sources, or {space / 'install'}"


def test_what_colcon_built_in_a_package_is_no_part_of_it(write: Write) -> None:
    built = "rover/install/rover/share/colcon-core/packages/rover"
    urdf = "rover/install/rover/share/rover/urdf/rover.urdf"
    with open_input(write({**ROVER, built: "", urdf: "<robot name='a'/>"})) as opened:
        (package,) = opened.packages
        assert not package.index.with_suffix(".urdf")


def test_virtual_environments_of_python_are_left_out(write: Write) -> None:
    files = {
        "venv/pyvenv.cfg": "",
        "venv/lib/python3/site-packages/a/model.sdf": MODEL,
        # A workspace in which someone made one is still a workspace.
        "ws/pyvenv.cfg": "",
        "ws/src/b/model.sdf": MODEL,
    }
    assert names(write(files)) == ["b"]


def test_what_tools_made_is_left_out(write: Write) -> None:
    files = {
        "src/b/package.xml": "<package/>",
        "src/b/debian/control": "",
        "src/b/debian/b/opt/ros/noetic/share/b/package.xml": "<package/>",
        "Library/PackageCache/com.unity.urdf/tests/cube/package.xml": "<package/>",
    }
    assert names(write(files)) == ["b"]


def test_a_ros_package_in_another_is_none(write: Write) -> None:
    files = {
        "src/arm/package.xml": "<package><name>arm</name></package>",
        "src/arm/urdf/arm.urdf": "<robot name='arm'><link name='base'/></robot>",
        "src/arm/old/arm/package.xml": "<package><name>arm</name></package>",
        "src/arm/old/arm/urdf/old.urdf": "<robot name='old'><link name='base'/></robot>",
        "src/arm/models/cup/model.config": "<model/>",
        "src/arm/models/cup/package.xml": "<package><name>cup</name></package>",
        "src/arm/models/cup/model.sdf": MODEL,
    }
    space = write(files)
    with open_input(space) as opened:
        assert [package.name for package in opened.packages] == ["arm", "cup"]
        assert opened.packages[0].xml_files == ("package.xml", "urdf/arm.urdf")
        (skipped,) = opened.skipped
    assert skipped.name == "src/arm/old/arm"
    assert skipped.reason.startswith("is inside package src/arm, where colcon")
    assert names(space / "src/arm/old/arm") == ["arm"]


def test_the_source_space_of_a_workspace_that_looks_like_a_package_is_searched(
    write: Write,
) -> None:
    files = {"package.xml": "<package/>", **{f"src/{name}": text for name, text in ROVER.items()}}
    assert "rover" in names(write(files))


def test_copies_of_jupyter_are_no_part_of_a_package(write: Write) -> None:
    copy = "rover/launch/.ipynb_checkpoints/drive-checkpoint.launch"
    with open_input(write({**ROVER, copy: "<launch/>"}) / "rover") as opened:
        assert not opened.packages[0].index.with_suffix(".launch")


def test_a_folder_that_is_named_is_opened_although_it_is_ignored(write: Write) -> None:
    space = write({"rover/COLCON_IGNORE": "", **ROVER})
    assert names(space / "rover") == ["rover"]
    refused = complaint(space)
    assert (
        refused.reason == "contains no package except 1 package that rover/COLCON_IGNORE excludes"
    )
    assert refused.advice == f"give {space / 'rover'}"


def test_what_is_left_out_beside_packages_is_said(write: Write) -> None:
    space = write({**ROVER, "notes/README.md": "hello"})
    (space / "alias").symlink_to(space / "rover")
    with open_input(space) as opened:
        assert [package.name for package in opened.packages] == ["rover"]
        assert {(item.name, item.reason.split(";")[0]) for item in opened.skipped} == {
            ("notes", "contains no package"),
            ("alias", "is a link"),
        }


@pytest.mark.parametrize("further", ["b", "b/other"])
def test_packages_are_found_in_further_folders(further: str, write: Write) -> None:
    space = write({"a/rover/model.sdf": MODEL, "b/other/model.sdf": MODEL})
    with open_input(space / "a" / "rover") as opened:
        (package,) = opened.packages
        assert package.workspace.package("other") is None
        seeing = with_package_path(package, [space / further])
        assert seeing.workspace.package("other") is not None
        assert seeing.exists("../other/model.sdf")


def test_a_further_folder_that_is_not_there_is_told(write: Write) -> None:
    space = write({"a/rover/model.sdf": MODEL})
    with open_input(space / "a" / "rover") as opened:
        for wrong in (space / "b", space / "a/rover/model.sdf"):
            with pytest.raises(UnreadableInput):
                with_package_path(opened.packages[0], [wrong])


@pytest.mark.parametrize("suffix", ["sdf", "world", "urdf", "xacro", "xml", "SDF"])
def test_single_file(write: Write, suffix: str) -> None:
    space = write({f"models/rover.{suffix}": MODEL, "models/wheel.dae": "mesh", "top.dae": "mesh"})
    with open_input(space / "models" / f"rover.{suffix}") as opened:
        (package,) = opened.packages
        assert package.kind is PackageKind.SINGLE_FILE
        assert [file.path for file in package.index.files] == [f"rover.{suffix}"]
        assert package.exists("wheel.dae")
        assert not package.exists("../top.dae")


def test_single_file_within_a_package_reaches_all_of_it(write: Write) -> None:
    files = {**ROVER, "rover/urdf/rover.urdf": "<robot/>", "rover/meshes/wheel.dae": "mesh"}
    space = write({**files, "secret.dae": "mesh"})
    with open_input(space / "rover" / "urdf" / "rover.urdf") as opened:
        (package,) = opened.packages
        assert package.exists("../meshes/wheel.dae")
        assert not package.exists("../../secret.dae")
        assert opened.workspace.package("rover") is not None


def test_single_file_deep_in_a_package_reaches_all_of_it(write: Write) -> None:
    deep = "robots/crane/urdf/crane.urdf"
    files = {f"robots-data/{deep}": "<robot/>", "robots-data/meshes/hook.dae": "mesh"}
    space = write({**files, "robots-data/package.xml": "<package><name>data</name></package>"})
    with open_input(space / "robots-data" / deep) as opened:
        (package,) = opened.packages
        named = package.workspace.package("data")
        assert named is not None
        assert named.exists("meshes/hook.dae")


def test_missing_path(tmp_path: Path) -> None:
    assert complaint(tmp_path / "nowhere").reason == "does not exist"


def test_empty_folder(tmp_path: Path) -> None:
    assert complaint(tmp_path).reason == "is an empty folder"


def test_folder_without_a_package(write: Write) -> None:
    assert "contains no package" in complaint(write({"notes/README.md": "hello"})).reason


def test_folder_within_a_package_names_the_package(write: Write) -> None:
    space = write({**ROVER, "rover/meshes/wheel.dae": "mesh"})
    assert complaint(space / "rover" / "meshes").advice.endswith(str(space / "rover"))


@pytest.mark.parametrize("name", ["rover.rar", "README.md", "rover.tar.xz", "rover"])
def test_file_of_another_kind(write: Write, name: str) -> None:
    assert "not a package, archive or model" in complaint(write({name: "hello"}) / name).reason


@pytest.mark.parametrize(
    ("name", "kind", "advice"),
    [
        ("inner.zip", "an archive", "the package in it"),
        ("arm.STL", "a mesh", ".urdf, .xacro or .sdf"),
        ("arm.step", "a CAD file", "export the robot"),
        (
            "arm.usda",
            "is a USD file, which this version does not check",
            "as URDF, xacro, SDF or MJCF",
        ),
    ],
)
def test_what_is_given_in_place_of_a_package(
    write: Write, name: str, kind: str, advice: str
) -> None:
    told = complaint(write({f"notes/parts/{name}": "hello", "notes/README.md": "hello"}))
    assert kind in told.reason
    assert name in told.reason
    assert advice in told.advice


@pytest.mark.parametrize(("name", "kind"), [("arm.stl", "a mesh"), ("a.rar", "an archive")])
def test_what_a_file_is(write: Write, name: str, kind: str) -> None:
    assert complaint(write({name: "hello"}) / name).reason.startswith(f"is {kind}")


def test_link_in_a_circle(tmp_path: Path) -> None:
    (tmp_path / "a").symlink_to(tmp_path / "b")
    (tmp_path / "b").symlink_to(tmp_path / "a")
    assert "cannot be opened" in complaint(tmp_path / "a").reason


def test_pipe_is_not_opened(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "rover.zip")
    os.mkfifo(tmp_path / "rover.sdf")
    assert complaint(tmp_path / "rover.zip").reason == "is not a regular file"
    assert "not a package, archive" in complaint(tmp_path / "rover.sdf").reason


def as_nobody(statement: str, *arguments: Path) -> str:
    """Run a statement as a user without rights and return what it prints."""
    program = (
        "import os, sys\nfrom pathlib import Path\n"
        "from checker.package.inputs import open_input\n"
        "from checker.base.errors import UnreadableInput\n"
        "if os.getuid() == 0: os.setgroups([]); os.setgid(65534); os.setuid(65534)\n" + statement
    )
    return subprocess.run(
        [sys.executable, "-c", program, *map(str, arguments)],
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    ).stdout


OPEN = """
try:
    with open_input(Path(sys.argv[1])) as opened:
        print([p.name for p in opened.packages], [(s.name, s.reason) for s in opened.skipped])
        for package in opened.packages:
            print(package.index.faults, package.read('model.sdf'))
except UnreadableInput as error:
    print(error.reason)
"""


@pytest.fixture
def reachable(tmp_path: Path) -> None:
    """Let other users pass through the folders above."""
    for folder in (tmp_path, *tmp_path.parents):
        if folder.owner() == tmp_path.owner() and folder != folder.parent:
            folder.chmod(folder.stat().st_mode | 0o111)


@pytest.mark.usefixtures("reachable")
def test_unreadable_folder(write: Write) -> None:
    space = write(ROVER)
    (space / "rover").chmod(0)
    said = as_nobody(OPEN, space / "rover")
    assert "Permission denied" in said


@pytest.mark.usefixtures("reachable")
def test_unreadable_single_file(write: Write) -> None:
    space = write({"models/rover.sdf": MODEL})
    (space / "models" / "rover.sdf").chmod(0)
    assert "permission denied" in as_nobody(OPEN, space / "models" / "rover.sdf")


@pytest.mark.usefixtures("reachable")
def test_unreadable_subfolder_is_said(write: Write) -> None:
    space = write({**ROVER, "b/model.sdf": MODEL})
    (space / "b").chmod(0)
    assert "('b', 'cannot be read: permission denied')" in as_nobody(OPEN, space)


@pytest.mark.usefixtures("reachable")
def test_unreadable_file_and_folder_within_a_package(write: Write) -> None:
    space = write({**ROVER, "rover/meshes/wheel.dae": "mesh"})
    (space / "rover" / "model.sdf").chmod(0)
    (space / "rover" / "meshes").chmod(0)
    said = as_nobody(OPEN, space / "rover")
    assert "IndexFault(path='model.sdf', reason='cannot be read: permission denied')" in said
    assert "IndexFault(path='meshes', reason='cannot be listed: Permission denied')" in said
    assert "NotReadable(path='model.sdf', reason='cannot be read: Permission denied')" in said


def test_a_robot_folder_without_a_manifest_is_one_package(write: Write) -> None:
    robot = '<robot name="arm"><link name="base"/></robot>'
    space = write({"arm/urdf/arm.urdf": robot, "arm/meshes/base.stl": "mesh"})
    assert names(space) == ["arm"]
    assert names(space / "arm") == ["arm"]
