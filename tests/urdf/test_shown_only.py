"""Descriptions that no simulator gets."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport, VerdictKind
from checker.settings import Settings
from tests.ros2_launch.conftest import CMAKE, NAME, PACKAGE_XML, python

_SHOWN = '<link name="body"><visual><geometry><box size="1 1 1"/></geometry></visual></link>'
_SOLID = """<robot name="other"><link name="body"><inertial><mass value="1"/>
<inertia ixx="0.2" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>
"""
_TURNS = """<link name="hand"/><joint name="hand" type="continuous"><parent link="body"/>
<child link="hand"/></joint>"""
_PUBLISHER = f"""
share = get_package_share_directory('{NAME}')
text = ParameterValue(Command(['xacro ', os.path.join(share, 'urdf', 'box.urdf')]), value_type=str)
state = Node(package='robot_state_publisher', executable='robot_state_publisher',
    parameters=[{{'robot_description': text}}])
"""
_RVIZ = f"{_PUBLISHER}return LaunchDescription([state, Node(package='rviz2', executable='rviz2')])"
_CLOCK = _RVIZ.replace(
    "[state",
    "[DeclareLaunchArgument('use_sim_time', description='Use simulation (Gazebo) clock'), state",
)
_SPAWNED = f"""{_PUBLISHER}
world = IncludeLaunchDescription(PathJoinSubstitution([
    FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py']))
spawner = Node(package='ros_gz_sim', executable='create', arguments=[GIVEN])
return LaunchDescription([state, world, spawner])
"""
_TOPIC = _SPAWNED.replace("GIVEN", "'-topic', 'robot_description'")
_PLANNED = _TOPIC.replace("'box.urdf'", "'other.urdf'").replace(
    "return LaunchDescription([",
    """planned = Command(['xacro ', os.path.join(share, 'urdf', 'box.urdf')])
planner = Node(package='moveit_ros_move_group', executable='move_group',
    parameters=[{'robot_description': ParameterValue(planned, value_type=str)}])
return LaunchDescription([planner, """,
)
_SDF = "'-file', os.path.join(share, 'models', 'box.sdf')"


def _report(tmp_path: Path, launch: str, *, urdf: str = _SHOWN, comment: str = "") -> PackageReport:
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "launch/show.launch.py": python(launch),
        "urdf/box.urdf": f'{comment}<robot name="box">{urdf}</robot>',
        "models/box.sdf": '<sdf version="1.9"><model name="box"><link name="b"/></model></sdf>',
    }
    if "other.urdf" in launch:
        files["urdf/other.urdf"] = _SOLID
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return check_package(
        tmp_path / NAME, Settings(select=("URD007", "URD016", "GEO002", "INE009", "KIN007", "TRI"))
    ).packages[0]


@pytest.mark.parametrize(
    "launch",
    [_RVIZ, _CLOCK, _PLANNED, _SPAWNED.replace("GIVEN", _SDF)],
)
def test_what_no_simulator_gets_needs_no_collision(tmp_path: Path, launch: str) -> None:
    report = _report(tmp_path, launch, urdf=_SHOWN + _TURNS)
    assert {found.severity for found in report.findings} == {Severity.INFO}
    assert report.verdict is VerdictKind.READY


@pytest.mark.parametrize(
    ("given", "severity"),
    [("'-topic', 'robot_description'", Severity.ERROR), ("'-file', text", Severity.WARNING)],
)
def test_what_is_spawned_needs_it(tmp_path: Path, given: str, severity: Severity) -> None:
    report = _report(tmp_path, _SPAWNED.replace("GIVEN", given))
    assert {it.severity for it in report.findings if it.rule == "URD007"} == {severity}


_HARDWARE = """<ros2_control name="box" type="system"><hardware>
<plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware></ros2_control>"""
_IN_WORLD = _SPAWNED.replace("launch.py']))", "launch.py']), launch_arguments={'gz_args': hall})")
_IN_WORLD = _IN_WORLD.replace("world, spawner", "world").replace(
    "\nworld =", "\nhall = os.path.join(share, 'worlds', 'hall.sdf')\nworld ="
)
_INCLUDES = "<include><uri>/home/ann/models/crate</uri></include>"


@pytest.mark.parametrize(
    ("launch", "parts", "severity"),
    [
        (_IN_WORLD, _INCLUDES, Severity.INFO),
        (_IN_WORLD, f'<model name="crate">{_INCLUDES}</model>', Severity.INFO),
        (_IN_WORLD, "<include><uri>model://tree</uri></include>", Severity.WARNING),
        (_IN_WORLD + "# create -topic robot_description", _INCLUDES, Severity.WARNING),
    ],
)
def test_gazebo_gets_the_robot_of_the_started_world(
    tmp_path: Path, launch: str, parts: str, severity: Severity
) -> None:
    files = {
        "worlds/hall.sdf": f'<sdf version="1.8"><world name="hall">{parts}</world></sdf>',
        "models/crate/model.sdf": """<sdf version="1.8"><model name="crate">
<link name="a"/><link name="b"/><plugin filename="libp.so" name="p"/>
<joint name="j" type="fixed"><parent>a</parent><child>b</child></joint></model></sdf>""",
    }
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(parents=True)
        path.write_text(text)
    report = _report(tmp_path, launch, urdf=_SHOWN + _HARDWARE)
    assert {it.severity for it in report.findings if it.rule == "URD007"} == {severity}


def test_a_comment_may_say_what_it_is_for(tmp_path: Path) -> None:
    report = _report(tmp_path, _TOPIC, comment="<!-- A simple model for RViz. -->")
    assert report.verdict is VerdictKind.READY


_MUJOCO = _RVIZ.replace("[state", "[state, Node(package='box', executable='mujoco_sim')")
_GRIP = '<gazebo reference="body"><mu1 value="0.0"/></gazebo>'
_EYE = '<gazebo reference="body"><sensor name="eye" type="camera"/></gazebo>'


@pytest.mark.parametrize(
    ("launch", "program", "urdf", "severity"),
    [
        (_MUJOCO, "import mujoco", _GRIP, Severity.INFO),
        (_MUJOCO, "import mujoco", _EYE, Severity.ERROR),
        (_MUJOCO, "import numpy", _GRIP, Severity.ERROR),
        (_MUJOCO, "import mujoco  # box.urdf", _GRIP, Severity.ERROR),
        (_TOPIC, "import mujoco", _GRIP, Severity.ERROR),
    ],
)
def test_what_stands_beside_models_of_mujoco_is_not_for_gazebo(
    tmp_path: Path, launch: str, program: str, urdf: str, severity: Severity
) -> None:
    report = _beside_mujoco(tmp_path, launch, program, _SHOWN + urdf)
    assert {it.severity for it in report.findings if it.rule == "URD007"} == {severity}


@pytest.mark.parametrize(
    ("launch", "severity"), [(_MUJOCO, Severity.INFO), (_TOPIC, Severity.WARNING)]
)
def test_limits_beside_models_of_mujoco_may_be_placeholders(
    tmp_path: Path, launch: str, severity: Severity
) -> None:
    limited = _TURNS.replace("</joint>", '<limit effort="1" velocity="9999"/></joint>')
    report = _beside_mujoco(tmp_path, launch, "import mujoco", _SHOWN + limited)
    assert {it.severity for it in report.findings if it.rule == "KIN007"} == {severity}


def _beside_mujoco(tmp_path: Path, launch: str, program: str, urdf: str) -> PackageReport:
    folder = tmp_path / NAME / "mujoco"
    folder.mkdir(parents=True)
    (folder / "sim.py").write_text(f"{program}\n")
    (folder / "box.xml").write_text("<mujoco><worldbody><geom size='1'/></worldbody></mujoco>")
    return _report(tmp_path, launch, urdf=urdf)


_TOP_HEAVY = """<link name="body">
<inertial><origin xyz="0 0 2"/><mass value="9"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
</link>
<link name="left_wheel"><collision><origin rpy="1.5708 0 0"/>
<geometry><cylinder radius="0.1" length="0.05"/></geometry></collision></link>
<link name="right_wheel"><collision><origin rpy="1.5708 0 0"/>
<geometry><cylinder radius="0.1" length="0.05"/></geometry></collision></link>
<joint name="left" type="continuous"><axis xyz="0 1 0"/><origin xyz="0 0.2 0"/>
<parent link="body"/><child link="left_wheel"/></joint>
<joint name="right" type="continuous"><axis xyz="0 1 0"/><origin xyz="0 -0.2 0"/>
<parent link="body"/><child link="right_wheel"/></joint>
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("launch", "severity"),
    [
        (_RVIZ, Severity.INFO),
        (_TOPIC, Severity.WARNING),
    ],
)
def test_what_no_simulator_gets_does_not_tip_over(
    tmp_path: Path, launch: str, severity: Severity
) -> None:
    report = _report(tmp_path, launch, urdf=_TOP_HEAVY)
    assert {it.severity for it in report.findings if it.rule == "INE009"} == {severity}


_FOR_SOLVER = """<link name="foot"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
<gazebo reference="lamp"><fdir1>1 0 0</fdir1></gazebo>
<transmission name="gear"><joint name="hinge"/></transmission>
"""
_PLUGIN = '<gazebo><plugin name="p" filename="libgazebo_ros_control.so"/></gazebo>'


@pytest.mark.parametrize(
    ("more", "severities"),
    [("", {Severity.INFO}), (_PLUGIN, {Severity.ERROR, Severity.INFO})],
)
def test_without_launch_files_what_only_gazebo_reads_is_an_info(
    tmp_path: Path, more: str, severities: set[Severity]
) -> None:
    # Not beside the folders of other tests, whose launch files would count.
    folder = tmp_path / "models"
    folder.mkdir()
    (folder / "foot.urdf").write_text(f'<robot name="foot">{_FOR_SOLVER}{more}</robot>')
    settings = Settings(select=("URD006", "URD007", "URD008", "GEO002"))
    report = check_package(folder, settings).packages[0]
    assert {found.severity for found in report.findings} == severities


@pytest.mark.parametrize(
    ("named", "severity"), [("other.urdf", Severity.INFO), ("sketch.urdf", Severity.WARNING)]
)
def test_what_no_launch_file_names_in_a_loose_folder_is_an_info(
    tmp_path: Path, named: str, severity: Severity
) -> None:
    launch = f"DESCRIPTION = '{named}'\nWORLD = 'gazebo_ros'\n"
    for path, text in {
        f"{NAME}/package.xml": PACKAGE_XML,
        f"{NAME}/launch/sim.launch.py": launch,
        "sketches/sketch.urdf": f'<robot name="sketch">{_SHOWN}</robot>',
    }.items():
        (tmp_path / path).parent.mkdir(exist_ok=True, parents=True)
        (tmp_path / path).write_text(text)
    report = check_package(tmp_path, Settings(select=("URD007",)))
    found = [found for package in report.packages for found in package.findings]
    assert [it.severity for it in found] == [severity]
