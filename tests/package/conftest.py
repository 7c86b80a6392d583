"""Builders of small packages and archives."""

from __future__ import annotations

import io
import tarfile
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

Write = Callable[[Mapping[str, str]], Path]
Entries = list[tuple[str, bytes]]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write files, by their paths, below a folder `space`, and return that folder."""

    def writer(files: Mapping[str, str]) -> Path:
        space = tmp_path / "space"
        for path, text in files.items():
            place = space / path
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8")
        return space

    return writer


def _zip(path: Path, entries: Entries) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in entries:
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)


def _tar(path: Path, entries: Entries) -> None:
    with tarfile.open(path, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for name, data in entries:
            info = tarfile.TarInfo(name)
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))


@pytest.fixture(params=["zip", "tar.gz"])
def pack(request: pytest.FixtureRequest, tmp_path: Path) -> Callable[[Entries], Path]:
    """Pack entries into an archive of each format, called `rover_sensor_config_1`."""

    def packer(entries: Entries) -> Path:
        path = tmp_path / f"rover_sensor_config_1.{request.param}"
        (_zip if request.param == "zip" else _tar)(path, entries)
        return path

    return packer
