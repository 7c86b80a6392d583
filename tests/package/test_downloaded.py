"""A mesh that CMake downloads when the package is built is not there yet: not checked."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings

MODEL = """<sdf version="1.9"><model name="crate"><link name="l">
<collision name="c"><geometry><mesh><uri>meshes/crate.stl</uri></mesh></geometry></collision>
</link></model></sdf>
"""
CONFIG = '<model><name>crate</name><sdf version="1.9">model.sdf</sdf></model>'
HERE = "${CMAKE_CURRENT_SOURCE_DIR}/models/crate/meshes"


@pytest.mark.parametrize(
    ("build", "downloads"),
    [
        (f"file(DOWNLOAD https://example.org/crate.stl {HERE}/crate.stl)", True),
        (
            "foreach(part lid crate)\n"
            "  file(DOWNLOAD https://example.org/${part}.stl ${OTHER}/${part}.stl)\nendforeach()",
            True,
        ),
        (f"FetchContent_Declare(meshes URL https://example.org/m.zip SOURCE_DIR {HERE})", True),
        (f"ExternalProject_Add(m URL https://example.org/m.zip SOURCE_DIR {HERE})", True),
        (f"file(ARCHIVE_EXTRACT INPUT m.zip DESTINATION {HERE})", True),
        (f"file(DOWNLOAD https://example.org/lid.stl {HERE}/lid.stl)", False),
        (f"file(COPY lid.stl DESTINATION {HERE})", False),
        ("", False),
    ],
)
def test_what_a_build_above_downloads(tmp_path: Path, build: str, downloads: bool) -> None:
    folder = tmp_path / "models" / "crate"
    folder.mkdir(parents=True)
    (folder / "model.sdf").write_text(MODEL)
    (folder / "model.config").write_text(CONFIG)
    (tmp_path / "CMakeLists.txt").write_text(f"project(crates)\n{build}\n")
    settings = Settings(trial=False, select=("REF002",), profile="gazebo-harmonic")
    (report,) = (it for it in check_package(tmp_path, settings).packages if it.name == "crate")
    assert [finding.rule for finding in report.findings] == ([] if downloads else ["REF002"])
    assert any("CMakeLists.txt" in it.reason for it in report.not_checked) == downloads
