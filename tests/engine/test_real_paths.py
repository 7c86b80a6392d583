"""Findings in a model that another one includes, from a folder further up."""

from __future__ import annotations

from pathlib import Path

from checker.pipeline import check_package
from checker.report.finding_text import path_of
from checker.report.ownership import each_once
from checker.settings import Settings

CONFIG = "<model><name>{name}</name><sdf version='1.7'>model.sdf</sdf></model>"
LINK = "<link name='hull'><inertial><mass>-1</mass></inertial></link>"
INCLUDE = "<include><uri>model://core</uri></include>"


def test_a_fault_of_an_included_model_is_reported_once_where_it_is(tmp_path: Path) -> None:
    for folder, content in {
        "kite/core": LINK,
        "kite/variants/long": INCLUDE,
        "kite/variants/short": INCLUDE,
    }.items():
        model = tmp_path / folder
        model.mkdir(parents=True)
        (model / "model.config").write_text(CONFIG.format(name=model.name))
        (model / "model.sdf").write_text(
            f"<sdf version='1.7'><model name='{model.name}'>{content}</model></sdf>"
        )
    report = check_package(tmp_path, Settings(trial=False, select=("INE002",)))
    reported = [path_of(found.places[0], package) for package, found in each_once(report)]
    assert [Path(path).resolve() for path in reported] == [tmp_path / "kite/core/model.sdf"]
    assert [len(package.findings) for package in report.packages] == [1, 1, 1]
