"""Working folders of containers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from checker.package.containers import container_with
from checker.package.inputs import open_input

Write = Callable[[Mapping[str, str]], Path]
FROM = "FROM ros:jazzy\n"


@pytest.mark.parametrize(
    ("dockerfile", "path", "found"),
    [
        (f"{FROM}WORKDIR /ws\n", "/ws/src/rover/hall.yaml", True),
        (f"{FROM}WORKDIR /ws\nWORKDIR src\n", "file:///ws/src/a.dae", True),
        (f"{FROM}WORKDIR /ws\n", "/other/hall.yaml", False),
        # Others have files of their own there.
        (f"{FROM}WORKDIR /home\n", "/home/ann/hall.yaml", False),
        (f"{FROM}WORKDIR $HOME/ws\nWORKDIR src\n", "/src/hall.yaml", False),
        (f"{FROM}WORKDIR /ws\n{FROM}WORKDIR src\n", "/ws/src/hall.yaml", True),
        (f"{FROM}WORKDIR /build\n{FROM}WORKDIR src\n", "/src/hall.yaml", True),
    ],
)
def test_what_is_below_a_working_folder(
    dockerfile: str, path: str, found: bool, write: Write
) -> None:
    space = write({"rover/package.xml": "<package/>", "rover/Dockerfile": dockerfile})
    with open_input(space / "rover") as opened:
        assert bool(container_with(opened.packages[0], path)) is found
