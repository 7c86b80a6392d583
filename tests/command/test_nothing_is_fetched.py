"""Addresses that a package names are visited by nobody: a server listens there in vain."""

from __future__ import annotations

import shutil
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.conftest import SAMPLES

SDF, URDF = "subtcheck_buggy_sensor_config_1", "ouster_description"


@pytest.fixture
def listener() -> Iterator[socket.socket]:
    """A socket at which whoever fetches something comes by."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        listening.settimeout(0.0)
        yield listening


def address(listening: socket.socket) -> str:
    return f"http://127.0.0.1:{listening.getsockname()[1]}"


def is_visited(listening: socket.socket) -> bool:
    try:
        listening.accept()[0].close()
    except BlockingIOError:
        return False
    return True


def replace(file: Path, old: str, new: str) -> None:
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1), "utf-8")


def check(package: Path, *arguments: str) -> int:
    done = subprocess.run(
        [sys.executable, "-m", "checker.cli", str(package), *arguments],
        capture_output=True,
        text=True,
        check=False,
    )
    assert "Traceback" not in done.stderr
    return done.returncode


def test_of_an_sdf_package(listener: socket.socket, tmp_path: Path) -> None:
    package = Path(shutil.copytree(SAMPLES / SDF, tmp_path / SDF))
    there = address(listener)
    mesh = f"<geometry><mesh><uri>{there}/a.dae</uri></mesh></geometry>"
    script = f"<material><script><uri>{there}/a.material</uri><name>a</name></script></material>"
    part = f'<visual name="far">{mesh}{script}</visual><collision name="far">{mesh}</collision>'
    replace(package / "model.sdf", "</link>", f"{part}</link>")
    nested = f"<include><uri>{there}/model</uri></include>"
    replace(package / "model.sdf", "</model>", f"{nested}</model>")
    outside = f'<!DOCTYPE package SYSTEM "{there}/a.dtd">'
    replace(package / "package.xml", "<package", f"{outside}<package")
    include = f'<include xmlns="http://www.w3.org/2001/XInclude" href="{there}/a.xml"/>'
    replace(package / "model.config", "</model>", f"{include}</model>")
    assert check(package, "--report", str(tmp_path / "report")) == 1
    assert not is_visited(listener)


@pytest.mark.parametrize("looks", ["<init_from>{}</init_from>", "<!DOCTYPE COLLADA SYSTEM '{}'>"])
def test_of_a_mesh(listener: socket.socket, tmp_path: Path, looks: str) -> None:
    package = Path(shutil.copytree(SAMPLES / SDF, tmp_path / SDF))
    said = looks.format(f"{address(listener)}/a.png")
    if said.startswith("<!"):
        replace(package / "meshes/wheel.dae", "<COLLADA", f"{said}<COLLADA")
    else:
        picture = f'<library_images><image id="far">{said}</image></library_images>'
        replace(package / "meshes/wheel.dae", "</COLLADA>", f"{picture}</COLLADA>")
    check(package, "--report", str(tmp_path / "report"))
    assert not is_visited(listener)


@pytest.mark.parametrize(
    "part",
    [
        '<xacro:include filename="{}/a.xacro"/>',
        '<xacro:property name="far" value="${{load_yaml(\'{}/a.yaml\')}}"/><a b="${{far}}"/>',
        '<link name="far"><visual><geometry><mesh filename="{}/a.dae"/></geometry></visual></link>',
    ],
)
def test_of_a_urdf_package(listener: socket.socket, tmp_path: Path, part: str) -> None:
    package = Path(shutil.copytree(SAMPLES / URDF, tmp_path / URDF))
    added = part.format(address(listener))
    replace(package / "urdf/example.urdf.xacro", "</robot>", f"{added}</robot>")
    check(package)
    assert not is_visited(listener)


def test_a_visitor_would_be_noticed(listener: socket.socket) -> None:
    with pytest.raises((urllib.error.URLError, TimeoutError)):
        urllib.request.urlopen(f"{address(listener)}/a.dae", timeout=0.2)  # noqa: S310 - our own
    assert is_visited(listener)
