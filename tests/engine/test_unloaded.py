"""Findings in robots that no launch file loads."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest

from checker.engine.unloaded import less_of_unloaded, unloaded_in
from checker.finding import Place, Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport, ReportedFinding
from checker.robots.unloaded import Naming, may_be_loaded
from checker.rule import Finding
from checker.settings import Settings
from tests.ros2_launch.conftest import CMAKE, NAME, PACKAGE_XML, python

_BODY = """<inertial><mass value="1"/><inertia ixx="@" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
</inertial>"""
_GOOD, _FAULTY = _BODY.replace("@", "1"), _BODY.replace("@", "-1")
_LAUNCH = f"""
share = get_package_share_directory('{NAME}')
text = ParameterValue(Command(['xacro ', os.path.join(share, 'urdf', 'new.urdf.xacro')]),
    value_type=str)
return LaunchDescription([Node(package='robot_state_publisher',
    executable='robot_state_publisher', parameters=[{{'robot_description': text}}])])
"""
_HEAD = '<robot name="rover" xmlns:xacro="http://ros.org/wiki/xacro">'
_CHOICE = """<xacro:arg name="tool" default="false"/>
<xacro:if value="$(arg tool)"><link name="tool">@</link></xacro:if>"""


def _check(tmp_path: Path, new: str, old: str = "", rule: str = "INE002") -> PackageReport:
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "launch/show.launch.py": python(_LAUNCH),
        "urdf/new.urdf.xacro": f"{_HEAD}{new}</robot>",
    }
    if old:
        files["urdf/old.urdf.xacro"] = f"{_HEAD}{old}</robot>"
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return check_package(tmp_path / NAME, Settings(select=(rule,), trial=False)).packages[0]


def _faults(report: PackageReport) -> list[ReportedFinding]:
    return [found for found in report.findings if found.rule == "INE002"]


def _link(body: str) -> str:
    return f'<link name="body">{body}</link>'


def test_what_is_loaded_has_errors(tmp_path: Path) -> None:
    (found,) = _faults(_check(tmp_path, _link(_FAULTY), _link(_GOOD)))
    assert found.severity is Severity.ERROR


_CONTROLLED = """<gazebo>
<plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
<parameters>$(find rover_description)/config/none.yaml</parameters></plugin></gazebo>"""


def test_files_of_plugins_that_nothing_loads_have_warnings(tmp_path: Path) -> None:
    plugin = _CONTROLLED.replace("rover_description", NAME)
    report = _check(tmp_path, _link(_GOOD), _link(_GOOD) + plugin, rule="R2C006")
    (found,) = (it for it in report.findings if it.rule == "R2C006")
    assert found.severity is Severity.WARNING
    assert "which no launch file loads" in found.message


@pytest.mark.parametrize(
    ("plugin", "severity"),
    [
        ("acme_hardware/Arm", Severity.WARNING),
        ("mock_components/GenericSystem", Severity.WARNING),
        ("gz_ros2_control/GazeboSimSystem", Severity.ERROR),
        ("", Severity.ERROR),
    ],
)
def test_what_is_hardware_alone_has_warnings(
    plugin: str, severity: Severity, tmp_path: Path
) -> None:
    inside = f"<plugin>{plugin}</plugin>" if plugin else ""
    control = f"""<ros2_control name="arm" type="system"><hardware>{inside}</hardware>
</ros2_control>"""
    (found,) = _faults(_check(tmp_path, _link(_FAULTY) + control))
    assert found.severity is severity
    assert ("starts a simulator" in found.message) is (severity is Severity.WARNING)


_ARM = """<link name="base"/><link name="boom"><inertial><origin xyz="0.5 0 0"/>
<mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="swing" type="revolute"><parent link="base"/><child link="boom"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<ros2_control name="arm" type="system"><hardware><plugin>{}</plugin></hardware>
<joint name="swing"><command_interface name="position"/></joint></ros2_control>"""


@pytest.mark.parametrize(
    ("plugin", "severity"),
    [
        ("mock_components/GenericSystem", Severity.INFO),
        ("gz_ros2_control/GazeboSimSystem", Severity.WARNING),
    ],
)
def test_a_weak_arm_that_no_simulator_gets_is_an_info(
    plugin: str, severity: Severity, tmp_path: Path
) -> None:
    report = _check(tmp_path, _ARM.format(plugin), rule="INE015")
    (found,) = (it for it in report.findings if it.rule == "INE015")
    assert found.severity is severity
    assert ("starts a simulator" in found.message) is (severity is Severity.INFO)


_SCANNER = """<link name="base"/><link name="wheel"/>
<joint name="axle" type="continuous"><parent link="base"/><child link="wheel"/></joint>
<gazebo reference="base"><sensor name="scan" type="ray"><ray><scan><horizontal>
<samples>9</samples><min_angle>1</min_angle><max_angle>-1</max_angle>
</horizontal></scan></ray></sensor></gazebo>"""
_DRIVE = '<gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so"/></gazebo>'


@pytest.mark.parametrize(("drive", "severity"), [("", Severity.INFO), (_DRIVE, Severity.WARNING)])
def test_a_sensor_counts_less_where_no_simulator_would_drive_its_robot(
    drive: str, severity: Severity, tmp_path: Path
) -> None:
    report = _check(tmp_path, _SCANNER + drive, rule="SEN003")
    (found,) = (it for it in report.findings if it.rule == "SEN003")
    assert found.severity is severity
    assert ("nothing drives it" in found.message) is not bool(drive)


@pytest.mark.parametrize(
    ("rule", "counts"),
    [("INE002", True), ("SEN003", True), ("GEO010", True), ("GEO012", False), ("URD007", False)],
)
def test_what_a_simulator_alone_shows_counts_less(rule: str, counts: bool) -> None:
    robot = SimpleNamespace(never_simulated="no launch file starts a simulator")
    assert bool(unloaded_in({"driven": SimpleNamespace(robot=robot)}, rule)) is counts


def test_what_rviz_alone_gets_has_warnings(tmp_path: Path) -> None:
    path = tmp_path / NAME / "launch" / "simulate.launch.py"
    path.parent.mkdir(parents=True)
    path.write_text(python(_LAUNCH.replace("new.urdf", "solid.urdf").replace("text =", "gz =")))
    (found,) = _faults(_check(tmp_path, f'{_link(_FAULTY)}<gazebo reference="body"/>'))
    assert found.severity is Severity.WARNING
    assert found.message.endswith("(Gazebo gets another description)")


def _at(file: str) -> Finding:
    return Finding((Place(file, 1, 1, 1),), "radius 0.1 m, expected 0.2 m")


@pytest.mark.parametrize(
    ("of_loaded", "kept"),
    [([], ["urdf/old.urdf"]), (None, ["urdf/old.urdf", "config/wheels.yaml"])],
)
def test_parameters_are_those_of_the_loaded_robot(
    of_loaded: list[Finding] | None, kept: list[str]
) -> None:
    said: list[tuple[str, list[Finding]]] = [("", of_loaded)] if of_loaded is not None else []
    said.append(("only in urdf/old.urdf", [_at("urdf/old.urdf"), _at("config/wheels.yaml")]))
    found = [it for it in less_of_unloaded(said, Severity.ERROR) if isinstance(it, Finding)]
    assert [it.places[0].file for it in found] == kept
    assert {it.severity for it in found} == {Severity.WARNING}


def test_what_tests_load_has_warnings(tmp_path: Path) -> None:
    _check(tmp_path, _link(_GOOD))
    path = tmp_path / NAME / "test" / "fake.urdf"
    path.parent.mkdir()
    path.write_text(f"{_HEAD}{_link(_FAULTY)}</robot>")
    launch = _LAUNCH.replace("'urdf', 'new.urdf.xacro'", "'test', 'fake.urdf'")
    path.with_name("fake.launch.py").write_text(python(launch))
    report = check_package(tmp_path / NAME, Settings(select=("INE002",), trial=False))

    (found,) = _faults(report.packages[0])
    assert found.severity is Severity.WARNING


def test_what_nothing_loads_has_warnings(tmp_path: Path) -> None:
    (found,) = _faults(_check(tmp_path, _link(_GOOD), _link(_FAULTY)))
    assert found.severity is Severity.WARNING
    assert found.message.endswith("(only in urdf/old.urdf.xacro, which no launch file loads)")


def test_what_a_launch_file_names_in_another_folder_has_warnings(tmp_path: Path) -> None:
    launch, folder = tmp_path / NAME / "launch", tmp_path / NAME / "urdf/kept"
    launch.mkdir(parents=True)
    folder.mkdir(parents=True)
    (launch / "old.launch.py").write_text(python(_LAUNCH.replace("new.urdf", "old.urdf")))
    (folder / "old.urdf.xacro").write_text(f"{_HEAD}{_link(_FAULTY)}</robot>")
    (found,) = _faults(_check(tmp_path, _link(_GOOD)))
    assert found.severity is Severity.WARNING
    assert found.message.endswith("(only in urdf/kept/old.urdf.xacro, which no launch file loads)")


def test_what_another_value_makes_has_warnings(tmp_path: Path) -> None:
    (found,) = _faults(_check(tmp_path, _link(_GOOD) + _CHOICE.replace("@", _FAULTY)))
    assert found.severity is Severity.WARNING
    assert found.message.endswith("(only with tool:=true, which no launch file gives by default)")


_MESH = '<visual><geometry><mesh filename="package://{name}/{file}"/></geometry></visual>'


def test_what_nothing_names_has_a_warning(tmp_path: Path) -> None:
    folder = tmp_path / NAME
    (folder / "web/public").mkdir(parents=True)
    (folder / "package.xml").write_text(PACKAGE_XML)
    (folder / "objects.yaml").write_text(f"lid: package://{NAME}/lid.urdf")
    (folder / "web/page.ts").write_text("load('hull.urdf')")
    for name, files in (
        ("lid", ["lid.stl"]),
        ("trial_2", ["a.stl", "b.stl"]),
        ("web/public/hull", ["c.stl"]),
    ):
        shapes = "".join(_MESH.format(name=NAME, file=file) for file in files)
        (folder / f"{name}.urdf").write_text(f"{_HEAD}{_link(shapes)}</robot>")
    report = check_package(folder, Settings(select=("REF002",), trial=False)).packages[0]
    lid, leftover = (found for found in report.findings if found.rule == "REF002")
    assert (lid.severity, lid.places[0].file) == (Severity.ERROR, "lid.urdf")
    assert (leftover.severity, leftover.places[0].file) == (Severity.WARNING, "trial_2.urdf")
    assert leftover.message.endswith("(only in trial_2.urdf, which nothing loads)")


@pytest.mark.parametrize(
    ("text", "loaded"),
    [
        ("arm_v2.urdf.xacro", True),
        ("$(find arm)/urdf/arm_$(arg kind).urdf.xacro", True),
        ("<arg name='kind' default='v1'/> $(find arm)/urdf/arm_$(arg kind).urdf.xacro", False),
        ("f'{name}_v2.urdf.xacro'", True),
        ("name + '.urdf.xacro'", True),
        ("name + '_v1.urdf.xacro'", False),
        ("arm_v1.urdf.xacro", False),
        ("my_arm_v2.urdf.xacro", False),
        ("<arg name='model' default='$(find arm)/urdf/arm_v1.urdf'/>", False),
    ],
)
def test_computed_names_may_be_those_of_a_file(text: str, loaded: bool) -> None:
    texts = {"launch/a.launch": text}
    assert (
        may_be_loaded(Naming(texts, texts), "urdf/arm_v2.urdf.xacro", {"urdf/arm.urdf"}) is loaded
    )


@pytest.mark.parametrize(
    ("text", "loaded"),
    [
        ('join(share, "urdf_v1", "arm.urdf")', False),
        ("$(find arm)/urdf_v1/arm.urdf", False),
        ("join(share, 'urdf_v1', 'arm.urdf') or join(share, kind, 'arm.urdf')", True),
        ("join(share, kind, 'arm.urdf')", True),
        ("# join(share, kind, 'arm.urdf')", False),
        ("<!-- $(arg kind)/arm.urdf --> $(find arm)/urdf_v1/arm.urdf", False),
    ],
)
def test_a_file_of_the_name_of_a_loaded_one(text: str, loaded: bool) -> None:
    texts = {f"launch/a.launch{'.py' if 'join' in text else ''}": text}
    assert may_be_loaded(Naming(texts, texts), "urdf_v2/arm.urdf", {"urdf_v1/arm.urdf"}) is loaded


@pytest.mark.parametrize(
    "text",
    [
        "<arg name='model' default='$(find arm)/urdf/arm.urdf'/>",
        "DeclareLaunchArgument(name='urdf_file', default_value=path)",
    ],
)
def test_an_argument_takes_a_file_that_a_page_names(text: str) -> None:
    texts, loaded = {"launch/a.launch": text}, {"urdf/arm.urdf"}
    told = Naming(texts, texts, ["roslaunch arm a.launch model:=urdf/arm_v2.urdf"])
    assert may_be_loaded(told, "urdf/arm_v2.urdf", loaded)
    assert not may_be_loaded(told, "original/arm_v2.urdf", loaded)
    assert not may_be_loaded(Naming(texts, texts), "urdf/arm_v2.urdf", loaded)


_CONVERTED = '<sdf version="1.9"><model name="rover"><link/></model></sdf>'


@pytest.mark.parametrize(
    ("name", "severity"),
    [
        # Converted from the description beside it, and named by nothing.
        ("urdf/new.sdf", Severity.WARNING),
        # A simulator may be given it by hand.
        ("sdf/rover.sdf", Severity.ERROR),
    ],
)
def test_a_converted_description_has_warnings(
    name: str, severity: Severity, tmp_path: Path
) -> None:
    _check(tmp_path, _link(_GOOD))
    path = tmp_path / NAME / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(_CONVERTED)
    reports = check_package(tmp_path, Settings(select=("SDF005",), trial=False)).packages

    (found,) = (found for report in reports for found in report.findings if found.rule == "SDF005")
    assert found.severity is severity


@pytest.mark.parametrize(("folder", "severity"), [("", Severity.ERROR), ("old/", Severity.WARNING)])
def test_what_is_in_a_folder_of_old_files_has_warnings(
    folder: str, severity: Severity, tmp_path: Path
) -> None:
    _check(tmp_path, _link(_GOOD))
    path = tmp_path / NAME / f"launch/{folder}drive.launch.py"
    path.parent.mkdir(exist_ok=True)
    path.write_text("def generate_launch_description():\n    return LaunchDescription([])\n")
    settings = Settings(select=("LCH011",), trial=False)
    (found,) = check_package(tmp_path / NAME, settings).packages[0].findings
    assert found.severity is severity


@pytest.mark.parametrize(
    ("name", "severity"), [("hand.urdf", Severity.WARNING), ("new.urdf", Severity.ERROR)]
)
def test_what_nothing_loads_may_be_given_to_xacro_by_hand(
    name: str, severity: Severity, tmp_path: Path
) -> None:
    _check(tmp_path, _link(_GOOD))
    folder = tmp_path / NAME
    (folder / "urdf/new.urdf.xacro").rename(folder / "urdf/new.urdf")
    launch = _LAUNCH.replace("xacro ", "cat ").replace("new.urdf.xacro", "new.urdf")
    (folder / "launch/show.launch.py").write_text(python(launch))
    text = f'<robot name="hand"><link name="$(find {NAME})"/></robot>'
    (folder / "urdf" / name).write_text(text)
    settings = Settings(select=("URD001",), trial=False)
    (found,) = check_package(folder, settings).packages[0].findings
    assert found.severity is severity
    assert ("is loaded without xacro" in found.message) is (severity is Severity.ERROR)


_LIBRARY = _LAUNCH.replace(f"'{NAME}'", "'crane_library'").replace("new.urdf", "crane.urdf")


@pytest.mark.parametrize(
    ("launch", "severity"),
    [
        (_LIBRARY, Severity.WARNING),
        (_LIBRARY.replace("'crane.urdf.xacro'", "kind + '.urdf.xacro'"), Severity.WARNING),
        (_LIBRARY.replace("'crane.urdf.xacro'", "kind + '.urdf'"), Severity.ERROR),
        (_LIBRARY.replace("'crane.urdf.xacro'", "kind"), Severity.ERROR),
        (f"{_LIBRARY}# {{'name': 'winch'}}", Severity.ERROR),
        (f"{_LIBRARY}# ../urdf/winch.urdf", Severity.ERROR),
    ],
)
def test_what_lies_beside_the_launch_of_a_robot_that_is_not_available_has_a_warning(
    launch: str, severity: Severity, tmp_path: Path
) -> None:
    _check(tmp_path, _link(_GOOD))
    folder = tmp_path / NAME
    (folder / "urdf/new.urdf.xacro").rename(folder / "urdf/winch.urdf")
    (folder / "urdf/winch.urdf").write_text(f'<robot name="winch">{_link(_FAULTY)}</robot>')
    (folder / "launch/show.launch.py").write_text(python(launch))
    (folder / "params.yaml").write_text("model: 'cranes/winch.urdf'")
    (found,) = _faults(check_package(folder, Settings(select=("INE002",), trial=False)).packages[0])
    assert found.severity is severity


def test_what_the_model_editor_saved_weighs_less(tmp_path: Path) -> None:
    moments = "".join(f"<{name}>1</{name}>" for name in ("iyy", "izz"))
    inside = f"<inertial><mass>1</mass><inertia><ixx>-1</ixx>{moments}</inertia></inertial>"
    files = {
        "show/package.xml": PACKAGE_XML,
        "show/launch/show.launch.py": python(_LAUNCH),
        "model_editor_models/wall/model.sdf": (
            f'<sdf version="1.6"><model name="wall"><link name="l">{inside}</link></model></sdf>'
        ),
    }
    for name, text in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    settings = Settings(select=("INE002",), trial=False)
    found = [it for report in check_package(tmp_path, settings).packages for it in _faults(report)]
    assert [it.severity for it in found] == [Severity.WARNING]


_WORLD = """<sdf version="1.8"><world name="hall"><model name="trike"><link name="base_link"/>
<link name="wheel"/><joint name="axle" type="revolute"><parent>base_link</parent>
<child>wheel</child><axis><xyz>0 1 0</xyz></axis></joint>@</model></world></sdf>"""
_PLUGIN = '<plugin filename="ignition-gazebo-diff-drive-system" name="a::B"/>'
_START = f"""
world = os.path.join(get_package_share_directory('{NAME}'), 'worlds', 'hall.sdf')
return LaunchDescription([ExecuteProcess(cmd=['ign', 'gazebo', world])@])
"""
_PUBLISHER = ", Node(package='robot_state_publisher', parameters=[{'robot_description': TEXT}])"


@pytest.mark.parametrize(
    ("plugin", "publisher", "page", "severity"),
    [
        (_PLUGIN, "", "A trike", Severity.WARNING),
        ("", "", "A trike", Severity.ERROR),
        (_PLUGIN, _PUBLISHER, "A trike", Severity.ERROR),
        (_PLUGIN, "", "Spawn urdf/cart.urdf by hand", Severity.ERROR),
    ],
)
def test_a_description_beside_a_world_with_a_robot(
    plugin: str, publisher: str, page: str, severity: Severity, tmp_path: Path
) -> None:
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "README.md": page,
        "launch/hall.launch.py": python(_START.replace("@", publisher)),
        "worlds/hall.sdf": _WORLD.replace("@", plugin),
        "urdf/cart.urdf": f'<robot name="cart">{_link(_FAULTY)}</robot>',
    }
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    report = check_package(tmp_path / NAME, Settings(select=("INE002",), trial=False))

    (found,) = (it for package in report.packages for it in package.findings)
    assert found.severity is severity


@pytest.mark.parametrize(
    ("included", "severity"), [("model://crate", "warning"), ("model://winch", "error")]
)
def test_a_model_beside_the_launch_of_another_robot_has_warnings(
    included: str, severity: str, tmp_path: Path
) -> None:
    world = '<sdf version="1.8"><world name="a"><include><uri>@</uri></include></world></sdf>'
    files = {
        "package.xml": PACKAGE_XML,
        "CMakeLists.txt": CMAKE,
        "launch/show.launch.py": python(_LIBRARY),
        "worlds/a.sdf": world.replace("@", included),
        "models/winch/model.config": "<model><sdf>winch.urdf</sdf></model>",
        "models/winch/winch.urdf": f'<robot name="winch">{_link(_FAULTY)}</robot>',
    }
    for name, text in files.items():
        path = tmp_path / NAME / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    reports = check_package(tmp_path, Settings(select=("INE002",), trial=False)).packages
    found = [it for report in reports for it in _faults(report)]
    assert {str(it.severity) for it in found} == {severity}


_CRANE = """<launch><arg name="model" default="$(env CRANE)"/>
<param name="robot_description"
  command="$(find xacro)/xacro $(find crane_library)/urdf/crane_$(arg model).urdf.xacro"/></launch>
"""


@pytest.mark.parametrize(
    ("launch", "theirs", "severity"),
    [
        (_CRANE, "$(find yard)/urdf/winch.urdf", "warning"),
        # The other package has no such file: the name may be an old one of this package.
        (_CRANE, "$(find yard)/old/winch.urdf", "error"),
        (_CRANE, f"$(find {NAME})/urdf/winch.urdf", "error"),
        # The argument may be the file, or its name.
        (_CRANE.replace("crane_$(arg model)", "crane"), "a", "error"),
        (_CRANE.replace("crane_$(arg model).urdf.xacro", "$(arg model).urdf"), "a", "error"),
    ],
)
def test_what_lies_beside_a_launch_of_ros1_of_another_robot_has_warnings(
    launch: str, theirs: str, severity: str, tmp_path: Path
) -> None:
    winch = f'<robot name="winch">{_link(_FAULTY)}</robot>'
    manifest = "<package format='2'><name>@</name><buildtool_depend>catkin</buildtool_depend>"
    files = {
        f"{NAME}/package.xml": f"{manifest}</package>".replace("@", NAME),
        f"{NAME}/launch/show.launch": launch,
        f"{NAME}/drafts/winch.urdf": winch,
        "yard/package.xml": f"{manifest}</package>".replace("@", "yard"),
        "yard/launch/yard.launch": f"<launch><param name='a' command='cat {theirs}'/></launch>",
        "yard/urdf/winch.urdf": winch.replace(_FAULTY, _GOOD),
    }
    for name, text in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    reports = check_package(tmp_path, Settings(select=("INE002",), trial=False)).packages
    found = [it for report in reports for it in _faults(report)]
    assert {str(it.severity) for it in found} == {severity}
