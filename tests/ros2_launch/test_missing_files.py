"""A missing file that two nodes of a launch file name is one finding."""

from __future__ import annotations

from pathlib import Path

from checker.pipeline import check_package
from checker.settings import Settings
from tests.ros2_launch.conftest import CMAKE, NAME, PACKAGE_XML, python

_BODY = f"""
share = get_package_share_directory('{NAME}')
path = os.path.join(share, 'config', 'lift.yaml')
return LaunchDescription([
    Node(package='p', executable='e', parameters=[path]),
    Node(package='p', executable='f', condition=IfCondition('false'), parameters=[path])])
"""


def test_a_condition_makes_no_finding_of_its_own(tmp_path: Path) -> None:
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "launch/lift.launch.py": "from launch.conditions import IfCondition\n" + python(_BODY),
        "config/lift_real.yaml": "",
    }
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(text)
    settings = Settings(trial=False, select=("LCH001",))
    (report,) = check_package(tmp_path / NAME, settings).packages
    (found,) = report.findings
    assert found.message.endswith("does not exist; config has lift_real.yaml")
