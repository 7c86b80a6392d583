"""Findings in SDF models that no launch file spawns, in a package whose launch files spawn one."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_paths
from tests.ros2_launch.conftest import CMAKE, NAME, PACKAGE_XML, python

_MODEL = """<sdf version="1.9"><model name="@"><link name="body"><inertial><mass>1</mass>
<inertia><ixx>-1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link></model></sdf>"""
_LAUNCH = f"""
share = get_package_share_directory('{NAME}')
model = @
return LaunchDescription([%Node(package='ros_gz_sim', executable='create',
    arguments=['-file', model])])
"""
_WRITTEN = "os.path.join(share, 'models', 'rover', 'model.sdf')"
_CHOSEN = "PathJoinSubstitution([share, 'models', LaunchConfiguration('robot'), 'model.sdf'])"
_WORLD = '<sdf version="1.9"><world name="hall"><include><uri>model://trike</uri></include></world></sdf>'


@pytest.mark.slow
@pytest.mark.parametrize(
    ("model", "first", "more", "severity"),
    [
        (_WRITTEN, "", {}, Severity.WARNING),
        (_WRITTEN, "", {"worlds/hall.sdf": _WORLD}, Severity.ERROR),
        (_WRITTEN, "", {"README.md": "Drag `trike` into the scene."}, Severity.ERROR),
        (_CHOSEN, "DeclareLaunchArgument('robot', default_value='rover'), ", {}, Severity.ERROR),
        ("os.environ['MODEL']", "", {}, Severity.ERROR),
    ],
)
def test_a_model_that_nothing_names(
    model: str, first: str, more: dict[str, str], severity: Severity, tmp_path: Path
) -> None:
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "launch/spawn.launch.py": python(_LAUNCH.replace("@", model).replace("%", first)),
        **{f"models/{name}/model.sdf": _MODEL.replace("@", name) for name in ("rover", "trike")},
        **more,
    }
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    report = check_paths([tmp_path], {"select": ("INE002",), "trial": False, "cache": False})

    found = {it.name: it.findings[0].severity for it in report.packages if it.findings}
    assert found == {"rover": Severity.ERROR, "trike": severity}


_STARTS = f"""
share = get_package_share_directory('{NAME}')
return LaunchDescription([
    # The other world: 'yard.world'
    IncludeLaunchDescription(PythonLaunchDescriptionSource(WORLD + '/gzserver.launch.py'),
        launch_arguments={{'world': os.path.join(share, 'worlds', 'hall.world')}}.items()),@])
"""
_SPAWNS = "Node(package='ros_gz_sim', executable='create', arguments=['-file', FILE])"
_HALL = '<sdf version="1.6"><world name="hall"/></sdf>'
_YARD = _WORLD.replace("trike", "toys/trike").replace("hall", "yard")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("launched", "more", "severity"),
    [
        ("", {}, Severity.WARNING),
        ("", {"worlds/yard.world": _HALL, "worlds/world.world": _YARD}, Severity.WARNING),
        ("", {"worlds/hall.world": _YARD}, Severity.ERROR),
        ("", {"README.md": "world:=yard.world shows more"}, Severity.ERROR),
        ("", {"scripts/add.py": "NAMES = ['trike']\n"}, Severity.ERROR),
        (_SPAWNS, {}, Severity.ERROR),
    ],
)
def test_a_model_of_a_world_that_no_launch_file_starts(
    launched: str, more: dict[str, str], severity: Severity, tmp_path: Path
) -> None:
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "launch/hall.launch.py": python(_STARTS.replace("@", launched)),
        "worlds/hall.world": _HALL,
        "worlds/yard.world": _YARD,
        "models/toys/trike/model.sdf": _MODEL.replace("@", "trike"),
        "models/toys/trike_2/model.config": "<model><name>trike</name></model>",
        **more,
    }
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    report = check_paths([tmp_path], {"select": ("INE002",), "trial": False, "cache": False})

    assert [it.findings[0].severity for it in report.packages if it.findings] == [severity]
