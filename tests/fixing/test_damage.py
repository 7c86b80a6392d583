"""What looks for damage finds it."""

from __future__ import annotations

import pytest

from tests.fixing.damage import lost, spoilt

MODEL = b'<sdf><model name="rover"><link name="left_wheel"/></model></sdf>'
LAUNCH = b'<launch><arg name="topic" value="/model/rover/link/left_wheel/imu"/></launch>'
MANIFEST = b"<package><name>acme_rover</name></package>"


def test_names_that_others_still_use() -> None:
    before = {"model.sdf": MODEL, "a.launch": LAUNCH, "package.xml": MANIFEST}
    renamed = MODEL.replace(b"left_wheel", b"wheel")
    assert list(lost(before, {**before, "model.sdf": renamed})) == [
        "a.launch mentions left_wheel, which is gone"
    ]
    everywhere = {path: data.replace(b"left_wheel", b"wheel") for path, data in before.items()}
    assert list(lost(before, everywhere)) == []


def test_a_package_that_is_renamed_in_its_manifest_alone() -> None:
    before = {"package.xml": MANIFEST, "a.rb": b"puts 'roslaunch acme_rover a.launch'"}
    after = {**before, "package.xml": MANIFEST.replace(b"acme_rover", b"a copy")}
    assert list(lost(before, after)) == ["a.rb mentions acme_rover, which is gone"]


@pytest.mark.parametrize(
    ("path", "good", "bad"),
    [
        ("a.xml", b"<a/>", b"<a>"),
        ("a.yaml", b"a: 1", b"a: [1"),
        ("a.launch.py", b"a = 1", b"a = "),
        pytest.param("a.rb", b"a = 1", b"a = (", marks=pytest.mark.programs),
    ],
)
def test_files_that_are_not_valid_any_more(path: str, good: bytes, bad: bytes) -> None:
    assert list(spoilt({path: good}, {path: bad})) == [f"{path} is not valid any more"]
    assert list(spoilt({path: bad}, {path: bad + b" "})) == []
    assert list(spoilt({path: good}, {})) == [f"{path} is gone"]
