"""Devices of a user's settings: read, judged by, and part of what a report depends on."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.errors import InvalidSettings
from checker.engine.report_cache import memory_key
from checker.package.inputs import open_input
from checker.pipeline import check_package
from checker.settings import Settings, find_settings
from tests.examples import write_example

OWN = r"""[[devices]]
id = "acme_l1"
name = "Acme L1"
kind = "lidar3d"
match = '\bAcme[- ]?L1\b'
sdf_types = ["gpu_lidar"]
values = { rows = 8, samples_by_rate = { "10" = [360] } }
"""
LIDAR = """<sensor name="acme_l1" type="gpu_lidar"><update_rate>10</update_rate>
<lidar><scan><horizontal><samples>720</samples></horizontal></scan></lidar></sensor>"""


def settings_from(text: str, folder: Path) -> Settings:
    (folder / "subt-check.toml").write_text(text)
    return find_settings([folder])


def test_a_robot_is_judged_by_the_users_devices(tmp_path: Path) -> None:
    package = write_example(LIDAR, tmp_path)
    settings = settings_from(f'select = ["SEN004", "SEN007"]\n{OWN}', tmp_path)
    (report,) = check_package(package, settings).packages
    assert {finding.message for finding in report.findings} == {
        "lidar 'acme_l1' has 720 samples a row at 10 Hz, expected 360 (Acme L1)",
        "lidar 'acme_l1' has 1 rows, expected 8 (Acme L1)",
    }
    assert {str(finding.severity) for finding in report.findings} == {"warning"}
    assert "1 of its own devices" in settings.description


def test_other_devices_are_another_report(tmp_path: Path) -> None:
    package = write_example(LIDAR, tmp_path)
    both = [settings_from(text, tmp_path) for text in (OWN, OWN.replace("360", "361"))]
    with open_input(package) as opened:
        first, second = (memory_key(opened.packages[0], settings) for settings in both)
    assert first != second


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("devices = 3", "devices is no list of tables"),
        ("devices = [3]", "device 1 is no table"),
        (OWN.replace('id = "acme_l1"\n', ""), "device 1 has no 'id'"),
        (OWN + OWN.replace("rows = 8", "row = 8"), "device 2 has the unknown values.row"),
        (OWN.replace("[- ]?", "[- ]*"), "device 1 has '*' in its match"),
    ],
)
def test_what_is_wrong_with_a_device_is_said(text: str, problem: str, tmp_path: Path) -> None:
    with pytest.raises(InvalidSettings, match=r"subt-check\.toml: ") as error:
        settings_from(text, tmp_path)
    assert problem in str(error.value)
