"""Reports do not show where an upload lay; nothing else of them changes."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_paths
from checker.report.report import NotOpened, Report
from checker.service.jobs.check_child import without_folder

PLACE = Path("/data/incoming/4f2a")


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        (f"{PLACE}/given/upload/model.sdf is odd", "model.sdf is odd"),
        (f"{PLACE}/temporary/subt-check-x1/rover/none.json", "rover/none.json"),
        (f"in {PLACE}/request.json, {PLACE}", "in request.json, "),
        ("/data/incoming/4f2 and given/upload", "/data/incoming/4f2 and given/upload"),
    ],
)
def test_paths_of_our_own(said: str, shown: str) -> None:
    report = Report((), {}, (NotOpened("x.zip", said, failed=True),))
    assert without_folder(report, PLACE).not_opened[0].reason == shown


def test_a_link_to_the_data(tmp_path: Path) -> None:
    (tmp_path / "disk" / "place").mkdir(parents=True)
    (tmp_path / "data").symlink_to("disk")
    said = f"{tmp_path}/disk/place/given/upload/a and {tmp_path}/data/place/given/upload/b"
    report = Report((), {}, (NotOpened("x.zip", said, failed=True),))
    neutral = without_folder(report, tmp_path / "data" / "place")
    assert neutral.not_opened[0].reason == "a and b"


def test_all_else_stays(samples: Path) -> None:
    paths = [samples / "broken_rover_sensor_config_1", samples / "broken_gurdy_description"]
    report = check_paths(paths, {"trial": False, "display": True})
    assert without_folder(report, PLACE) == report
