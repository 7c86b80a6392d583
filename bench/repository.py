"""A repository of 20 packages, and 22 large humanoids: how long one command takes for all of them.

Packages are those of ROS 2 that SUBT_CHECK_MODERN names and the samples, each once, and again under
other names if there are too few. Humanoids are made: 30 links, each with a mesh of 20 000
to 50 000 triangles, which the limbs of both sides share; `--humanoids DIR` checks robots that are
there instead. Everything is checked twice, with an empty cache and with the one that this left.
Run with `python -m bench.repository` from the top folder, as `make bench` does.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from itertools import count, islice, pairwise
from math import pi
from pathlib import Path
from time import perf_counter

import numpy as np

from bench.machine import pace, undisturbed
from bench.service import show
from bench.static import ROOT, keep_bytecode

PACKAGES, HUMANOIDS = 20, 22
PACKAGES_LIMIT, HUMANOIDS_LIMIT = 10.0, 60.0
"""Seconds without trials, on two processors."""
_OTHERS = ("bugs", "repro")
"""Folders next to the packages, with faults on purpose."""


def sources() -> list[Path]:
    """Return the folders of packages that can be copied: first real ones, then samples."""
    modern = os.environ.get("SUBT_CHECK_MODERN")
    found = sorted(Path(modern).rglob("package.xml")) if modern else []
    real = [file.parent for file in found if not set(file.parts) & set(_OTHERS)]
    samples = sorted(file.parent for file in (ROOT / "samples").glob("*/package.xml"))
    return [*real, *(path for path in samples if "_sensor_config_" not in path.name)]


def repository(folder: Path, number: int) -> Path:
    """Write so many packages."""
    for package, round_ in islice(_rounds(sources()), number):
        copy = shutil.copytree(package, folder / f"round{round_}" / package.name)
        if round_:
            _rename(copy, package.name, f"{package.name}_{round_}")
    return folder


def _rounds(packages: list[Path]) -> Iterator[tuple[Path, int]]:
    # Every sample must have a place among many real packages.
    packages = packages[-PACKAGES:]
    return ((package, round_) for round_ in count() for package in packages)


def _rename(package: Path, old: str, new: str) -> None:
    for file in package.rglob("*"):
        if file.is_file() and file.suffix in (".xml", ".xacro", ".urdf", ".yaml", ".py", ".txt"):
            file.write_bytes(file.read_bytes().replace(old.encode(), new.encode()))


_PARTS = ("pelvis", "torso", "chest", "neck", "head", "camera")
_LIMBS = {
    "arm": ("shoulder", "upper_arm", "elbow", "forearm", "wrist", "hand"),
    "leg": ("hip", "thigh", "knee", "shin", "ankle", "foot"),
}


def humanoid(folder: Path, number: int) -> Path:
    """Write the package of a humanoid; each has its own meshes."""
    dice = random.Random(number)
    package = folder / f"bench_humanoid_{number}_description"
    (package / "urdf").mkdir(parents=True)
    (package / "meshes").mkdir()
    links = [(name, name) for name in _PARTS]
    links += [
        (f"{side}_{part}", part) for side in ("left", "right") for part in sum(_LIMBS.values(), ())
    ]
    for mesh in dict.fromkeys(mesh for _, mesh in links):
        triangles = dice.randrange(20_000, 50_000)
        (package / "meshes" / f"{mesh}.stl").write_bytes(_stl(triangles, dice.uniform(0.9, 1.1)))
    body = "".join(_link(package.name, *link) for link in links)
    body += "".join(_joint(*pair) for pair in _pairs([name for name, _ in links]))
    urdf = f'<robot name="humanoid_{number}">{body}</robot>\n'
    (package / "urdf/humanoid.urdf").write_text(urdf, "utf-8")
    (package / "package.xml").write_text(_MANIFEST.format(name=package.name), "utf-8")
    (package / "CMakeLists.txt").write_text(_CMAKE.format(name=package.name), "utf-8")
    return package


_MANIFEST = """<package format="3"><name>{name}</name><version>1.0.0</version>
<description>A humanoid.</description><maintainer email="a@example.com">A</maintainer>
<license>BSD</license><buildtool_depend>ament_cmake</buildtool_depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
_CMAKE = """cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
install(DIRECTORY urdf meshes DESTINATION share/${{PROJECT_NAME}})
ament_package()
"""


def _link(package: str, name: str, mesh: str) -> str:
    shape = f'<geometry><mesh filename="package://{package}/meshes/{mesh}.stl"/></geometry>'
    return (
        f'<link name="{name}"><inertial><mass value="2"/>'
        '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>'
        f"<visual>{shape}</visual><collision>{shape}</collision></link>\n"
    )


def _pairs(names: list[str]) -> Iterator[tuple[str, str, float]]:
    """Yield parent, child and their distance: a spine, and four limbs that are connected to it."""
    spine = names[: len(_PARTS)]
    yield from ((parent, child, 0.15) for parent, child in pairwise(spine))
    for side in ("left", "right"):
        for limb, top in (("arm", "chest"), ("leg", "pelvis")):
            chain = [top, *(f"{side}_{part}" for part in _LIMBS[limb])]
            yield from ((parent, child, -0.15) for parent, child in pairwise(chain))


def _joint(parent: str, child: str, away: float) -> str:
    across = {"left": 0.2, "right": -0.2}.get(child.partition("_")[0], 0.0)
    across = across if not parent.startswith(("left", "right")) else 0.0
    return (
        f'<joint name="{child}_joint" type="revolute"><parent link="{parent}"/>'
        f'<child link="{child}"/><origin xyz="0 {across} {away}"/><axis xyz="0 1 0"/>'
        '<limit lower="-1" upper="1" effort="100" velocity="5"/></joint>\n'
    )


def _stl(triangles: int, size: float) -> bytes:
    """Return a knobbly egg of about so many triangles, 0.14 m high."""
    rows = int((triangles / 2) ** 0.5)
    down, around = np.meshgrid(np.linspace(0, pi, rows + 1), np.linspace(0, 2 * pi, rows + 1))
    wide = 0.05 * size * np.sin(down) * (1 + 0.1 * np.cos(9 * around) * np.sin(7 * down))
    egg = np.stack([wide * np.cos(around), wide * np.sin(around), 0.07 * np.cos(down)], axis=-1)
    a, b, c, d = egg[:-1, :-1], egg[:-1, 1:], egg[1:, 1:], egg[1:, :-1]
    faces = np.zeros(2 * rows * rows, [("normal", "<3f4"), ("corners", "<9f4"), ("more", "<u2")])
    halves = [np.concatenate(corners, axis=-1) for corners in ((a, b, c), (a, c, d))]
    faces["corners"] = np.stack(halves).reshape(-1, 9)
    return bytes(80) + struct.pack("<I", len(faces)) + faces.tobytes()


def seconds(folder: Path, cache: Path, *more: str) -> float:
    """Return how long the command takes for a folder, in its own process."""
    begun = perf_counter()
    run = subprocess.run(
        [sys.executable, "-m", "checker.cli", str(folder), *more],
        cwd=ROOT, capture_output=True, text=True, check=False,
        env={**os.environ, "SUBT_CHECK_CACHE": str(cache)},
    )  # fmt: skip
    if run.returncode not in (0, 1):
        raise SystemExit(run.stderr)
    return perf_counter() - begun


def measure(name: str, folder: Path, limit: float) -> None:
    """Measure with and without what is in the cache, without and with trials."""
    with tempfile.TemporaryDirectory() as cache:

        def cold() -> float:
            shutil.rmtree(cache, ignore_errors=True)
            return seconds(folder, Path(cache), "--no-trial")

        show(f"{name}, nothing in the cache", undisturbed(cold), "s", limit)
        warm = undisturbed(lambda: seconds(folder, Path(cache), "--no-trial"))
        show(f"{name}, all in the cache", warm, "s", limit)
        show(f"{name}, with trials, meshes in the cache", seconds(folder, Path(cache)), "s")


def main() -> None:
    """Measure and print everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--humanoids", type=Path, help="folder of robots to check instead")
    given = parser.parse_args().humanoids
    keep_bytecode()
    show("a fixed piece of Python", pace(), "ms")
    with tempfile.TemporaryDirectory() as folder:
        packages = repository(Path(folder) / "repository", PACKAGES)
        measure(f"{PACKAGES} packages", packages, PACKAGES_LIMIT)
        robots = given or Path(folder) / "humanoids"
        for number in range(0 if given else HUMANOIDS):
            humanoid(robots, number)
        measure("humanoids" if given else f"{HUMANOIDS} humanoids", robots, HUMANOIDS_LIMIT)


if __name__ == "__main__":
    main()
