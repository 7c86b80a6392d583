"""Textures of a model's mesh in the ROS package around the model."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings

SDF = """<sdf version="1.9"><model name="stall"><static>true</static><link name="body">
<visual name="v"><geometry><mesh><uri>model://stall/meshes/stall.obj</uri></mesh></geometry></visual>
</link></model></sdf>
"""
FILES = {
    "package.xml": "<package><name>market</name></package>",
    "photos/wood.png": "x",
    "models/stall/model.config": "<model><sdf version='1.9'>model.sdf</sdf></model>",
    "models/stall/model.sdf": SDF,
    "models/stall/meshes/stall.obj": "mtllib stall.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "models/stall/meshes/stall.mtl": "newmtl wood\nmap_Kd ../../../photos/{}.png\n",
}


@pytest.mark.parametrize(("picture", "found"), [("wood", 0), ("steel", 1)])
def test_found_around_the_model(picture: str, found: int, tmp_path: Path) -> None:
    for name, text in FILES.items():
        path = tmp_path / "market" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.format(picture) if name.endswith(".mtl") else text)
    settings = Settings(select=("MSH006",), trial=False)
    reports = check_package(tmp_path, settings).packages
    (report,) = (report for report in reports if report.name == "stall")
    assert [finding.rule for finding in report.findings] == ["MSH006"] * found
