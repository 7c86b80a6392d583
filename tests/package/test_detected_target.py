"""A package of ROS 2 is judged for the simulator and the distribution that its content tells."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from checker.engine.judge import Judge
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.package.workspace import Workspace
from checker.rule_testing import write_example
from checker.settings import Settings

SPAWN = "        Node(package='gazebo_ros', executable='spawn_entity.py'),"
RAY = """<robot name="arm">
  <gazebo><plugin filename="{}" name="p"/></gazebo>
</robot>
"""
CLASSIC_PLUGIN = RAY.format("libgazebo_ros_ray_sensor.so")
GZ_PLUGIN = RAY.format("gz-sim-diff-drive-system")
ROS_GZ = "        Node(package='ros_gz_sim', executable='create'),"
GZ_SIM = "        ExecuteProcess(cmd=['gz sim', '-r']),"
IGNITION_PLUGIN = RAY.format("ignition-gazebo-diff-drive-system")
IGNITION_CLOCK = "  # '/clock@rosgraph_msgs/msg/Clock[ignition.msgs.Clock'"
LIDAR = '<robot name="arm"><gazebo><sensor name="eye" type="gpu_lidar"/></gazebo></robot>'
EXPORTED = '<launch><node name="s" pkg="gazebo_ros" type="spawn_model"/></launch>'
URDF = "urdf/arm.urdf.xacro"
DEPENDS = (
    "<package><name>acme_arm</name><buildtool_depend>ament_cmake</buildtool_depend>"
    "<exec_depend>gz_ros2_control</exec_depend></package>"
)
SETTINGS = '{"python.analysis.extraPaths": ["/opt/ros/humble/lib/python3.10/site-packages"]}'
MESH = '<mesh filename="file:///opt/ros/{}/share/eye/eye.dae"/>'


def opened(folder: Path, files: Mapping[str, object]) -> Package:
    package = write_example(files, folder)
    return Workspace((folder,)).at(package)


def judged(folder: Path, files: Mapping[str, object], distro: str = "") -> tuple[str, str]:
    settings = Settings(distro=distro).for_package(opened(folder, files))
    return settings.profile, settings.distro


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"@ros2": True}, ("ros2", "")),
        ({"@ros2": SPAWN}, ("ros2-classic", "humble")),
        ({"@ros2": f"        # {SPAWN}"}, ("ros2", "")),
        ({"@ros2": True, URDF: CLASSIC_PLUGIN}, ("ros2-classic", "humble")),
        ({"@ros2": True, URDF: f"<!-- {CLASSIC_PLUGIN} --><robot/>"}, ("ros2", "")),
        ({"@ros2": SPAWN, URDF: GZ_PLUGIN}, ("ros2-classic", "humble")),
        ({"@ros2": SPAWN, "urdf/other.urdf": GZ_PLUGIN, URDF: None}, ("ros2", "")),
        ({"@ros2": SPAWN, URDF: f"{CLASSIC_PLUGIN}{GZ_PLUGIN}"}, ("ros2", "")),
        ({"@ros2": f"{SPAWN}{ROS_GZ}", URDF: GZ_PLUGIN}, ("ros2", "")),
        ({"@ros2": SPAWN, "package.xml": DEPENDS}, ("ros2-classic", "humble")),
        ({"@ros2": True, "package.xml": DEPENDS, URDF: CLASSIC_PLUGIN}, ("ros2", "")),
        ({"@ros2": True, URDF: IGNITION_PLUGIN}, ("ros2", "humble")),
        ({"@ros2": ROS_GZ, URDF: IGNITION_PLUGIN}, ("ros2", "humble")),
        ({"@ros2": ROS_GZ, URDF: f"{IGNITION_PLUGIN}{LIDAR}"}, ("ros2", "humble")),
        ({"@ros2": f"{ROS_GZ}{IGNITION_CLOCK}", URDF: LIDAR}, ("ros2", "humble")),
        ({"@ros2": f"{SPAWN}{ROS_GZ}", URDF: IGNITION_PLUGIN}, ("ros2", "humble")),
        ({"@ros2": f"{ROS_GZ}{IGNITION_CLOCK}", URDF: GZ_PLUGIN}, ("ros2", "")),
        ({"@ros2": SPAWN, URDF: LIDAR}, ("ros2-classic", "humble")),
        ({"@ros2": GZ_SIM, URDF: IGNITION_PLUGIN}, ("ros2", "")),
        ({"@ros2": True, URDF: GZ_PLUGIN}, ("ros2", "")),
        ({"@ros2": True, "launch/gazebo.launch": EXPORTED}, ("ros2", "")),
        ({"@ros2": SPAWN, "Dockerfile": "FROM ros:jazzy\n"}, ("ros2", "jazzy")),
        ({"@ros2": SPAWN, "Dockerfile": "FROM ros:foxy\n"}, ("ros2-classic", "humble")),
        ({"@ros2": True, "Dockerfile": "FROM acme/base:${TAG:-humble}\n"}, ("ros2", "humble")),
        ({"@ros2": True, "Dockerfile": "FROM acme:${ACME_ROS_DISTRO:-iron}\n"}, ("ros2", "iron")),
        ({"@ros2": True, "compose.yaml": "image: acme:${TAG:-humble}\n"}, ("ros2", "humble")),
        ({"@ros2": True, "compose.yaml": "image: acme:${TAG:-hum}\n"}, ("ros2", "")),
        ({"@ros2": True, "README.md": "For ROS 2 Humble.\n"}, ("ros2", "humble")),
        ({"@ros2": True, "README_zh.md": "For ROS 2 Humble.\n"}, ("ros2", "humble")),
        ({"@ros2": True, URDF: MESH.format("humble")}, ("ros2", "humble")),
        ({"@ros2": True, URDF: MESH.format("kinetic")}, ("ros2", "")),
        ({"@ros2": True, URDF: MESH.format("iron") + MESH.format("humble")}, ("ros2", "")),
        (
            {"@ros2": True, URDF: MESH.format("humble"), "README.md": "ROS 2 Jazzy"},
            ("ros2", "jazzy"),
        ),
        ({"@ros2": True, "../.vscode/settings.json": SETTINGS}, ("ros2", "humble")),
        ({"@ros2": True, ".vscode/settings.json": SETTINGS}, ("ros2", "humble")),
        ({"@ros2": True, "../install/setup.sh": "P=/opt/ros/iron\n"}, ("ros2", "iron")),
        ({"@ros2": True, "../a.bash": "/opt/ros/iron /opt/ros/humble\n"}, ("ros2", "")),
        ({"@ros2": SPAWN, "../a.sh": ". /opt/ros/jazzy/setup.sh\n"}, ("ros2-classic", "humble")),
        (
            {"@ros2": True, "README.md": "ROS 2 Iron, ROS 2 Jazzy", "../a.sh": "/opt/ros/iron"},
            ("ros2", ""),
        ),
        ({"@ros2": f"{SPAWN}{GZ_SIM}", URDF: CLASSIC_PLUGIN}, ("ros2", "humble")),
        ({"@ros2": f"{SPAWN}{GZ_SIM}", URDF: "<robot/>"}, ("ros2", "")),
        ({"@ros2": True, "README.md": "ROS 2 Humble or ROS 2 Jazzy\n"}, ("ros2", "")),
        (
            {
                "@ros2": True,
                "README.md": "For ROS 2 Jazzy, not ROS 2 Humble:\napt install ros-jazzy-xacro\n",
            },
            ("ros2", "jazzy"),
        ),
        ({"@ros2": True, "../docker/arm.Dockerfile": "FROM ros:lyrical\n"}, ("ros2", "lyrical")),
        ({"@ros2": True, "README.md": "Keep rolling, an iron rule.\n"}, ("ros2", "")),
        ({"@ros2": True, "README.md": "![](badge/ROS%202-Humble-blue)\n"}, ("ros2", "humble")),
        ({"@ros2": True, "README.md": "![](badge/ROS%202-Humble%20|%20Jazzy-blue)"}, ("ros2", "")),
    ],
)
def test_content_tells(
    files: Mapping[str, object], expected: tuple[str, str], tmp_path: Path
) -> None:
    assert judged(tmp_path, files) == expected


def test_the_user_counts_more(tmp_path: Path) -> None:
    files = {"@ros2": SPAWN, "Dockerfile": "FROM ros:humble\n"}
    assert judged(tmp_path, files, "jazzy") == ("ros2", "jazzy")
    assert judged(tmp_path / "other", files, "humble") == ("ros2-classic", "humble")


def test_the_repository_around_tells(tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("Tested with ROS 2 Humble.\n")
    assert judged(tmp_path, {"@ros2": True}) == ("ros2", "humble")


WORLD = """<sdf version="1.6"><world name="hall">
  <plugin filename="{}" name="p"/>
</world></sdf>
"""


@pytest.mark.parametrize(
    ("plugin", "launched", "expected"),
    [
        ("libignition-gazebo-physics-system.so", "'x'", "gazebo-fortress"),
        ("libgazebo_ros_state.so", "'x'", "gazebo-classic"),
        ("libignition-gazebo-physics-system.so", "'hall.sdf'", "gazebo-classic"),
    ],
)
def test_a_world_of_ignition_is_not_for_classic(
    plugin: str, launched: str, expected: str, tmp_path: Path
) -> None:
    files = {"@ros2": f"{SPAWN}\n        Node(package='p', executable={launched}),"}
    write_example({**files, "worlds/hall.sdf": WORLD.format(plugin)}, tmp_path)
    with open_input(tmp_path) as given:
        (world,) = (it for it in given.packages if it.name == "hall.sdf")
        assert Settings().for_package(world).profile == expected


@pytest.mark.parametrize(
    ("plugin", "classic", "later", "expected"),
    [
        ("libgazebo_ros_factory.so", "'x'", "'x'", "gazebo-classic"),
        ("libgazebo_ros_factory.so", "'hall.sdf'", "'hall.sdf'", "gazebo-classic"),
        ("libgazebo_ros_factory.so", "'x'", "'hall.sdf'", "gazebo-harmonic"),
        ("libown.so", "'hall.sdf'", "'x'", "gazebo-classic"),
        ("libown.so", "'x'", "'x'", "gazebo-harmonic"),
        ("gz-sim-physics-system", "'hall.sdf'", "'hall.sdf'", "gazebo-harmonic"),
    ],
)
def test_a_world_of_classic_beside_launch_files_of_both(
    plugin: str, classic: str, later: str, expected: str, tmp_path: Path
) -> None:
    files = {
        "@ros2": f"{SPAWN}\n        Node(package='p', executable={classic}),",
        "launch/gz.launch.py": f"{ROS_GZ}\n        Node(package='p', executable={later}),",
    }
    write_example({**files, "worlds/hall.sdf": WORLD.format(plugin)}, tmp_path)
    with open_input(tmp_path) as given:
        (world,) = (it for it in given.packages if it.name == "hall.sdf")
        assert Settings().for_package(world).profile == expected


AMENT = """<package format="3">
  <name>{}</name><version>1.0.0</version><description>A lift</description>
  <maintainer email="a@example.org">A</maintainer><license>BSD</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
SHARE = "share = get_package_share_directory('{}')\n"


@pytest.mark.parametrize(
    ("launches", "own", "expected"),
    [
        ({"bringup": "lift '/opt/ros/humble'"}, "", ("ros2", "humble")),
        ({"bringup": "lift 0"}, "", ("ros2", "")),
        ({"bringup": "hoist '/opt/ros/jazzy'"}, "", ("ros2", "jazzy")),
        ({"a": "hoist '/opt/ros/jazzy'", "b": "hoist '/opt/ros/humble'"}, "", ("ros2", "")),
        ({"bringup": "lift 'ign gazebo'"}, "", ("ros2", "humble")),
        ({"bringup": "lift 'gzserver'"}, "", ("ros2-classic", "humble")),
        ({"bringup": "lift 'gzserver'"}, GZ_PLUGIN, ("ros2", "")),
        ({"bringup": "lift '/opt/ros/humble'"}, GZ_PLUGIN, ("ros2", "humble")),
        ({"bringup": "lift 'gzserver'"}, MESH.format("iron"), ("ros2-classic", "iron")),
        ({"bringup": "lift_gui 'gzserver'"}, "", ("ros2", "")),
        ({"lift_bringup": "lift_gui 'gzserver'"}, "", ("ros2-classic", "humble")),
        (
            {"a": "lift_gui 'gzserver'", "b": "lift_gui 'gzserver'"},
            "",
            ("ros2-classic", "humble"),
        ),
        ({"a": "lift_gui 'gzserver'", "b": "lift_gui 'ign gazebo'"}, "", ("ros2", "")),
        ({"old": "lift 'gzserver'", "new": "lift '/opt/ros/jazzy'"}, "", ("ros2", "")),
        ({"a": "lift '/opt/ros/jazzy'", "b": "lift '/opt/ros/jazzy'"}, "", ("ros2", "jazzy")),
    ],
)
def test_what_launches_a_description_tells(
    launches: Mapping[str, str], own: str, expected: tuple[str, str], tmp_path: Path
) -> None:
    texts = {"lift": ("urdf/lift.urdf", f"<robot name='lift'>{own}</robot>")}
    for name, words in launches.items():
        launched, _, rest = words.partition(" ")
        texts[name] = ("launch/lift.launch.py", f"{SHARE.format(launched)}words = {rest}\n")
    for name, (path, text) in texts.items():
        file = tmp_path / name / path
        file.parent.mkdir(parents=True)
        file.write_text(text)
        (tmp_path / name / "package.xml").write_text(AMENT.format(name))
    settings = Settings().for_package(Workspace((tmp_path,)).at(tmp_path / "lift"))
    assert (settings.profile, settings.distro) == expected
    told = "which launches it" in settings.target_reason or "beside it" in settings.target_reason
    assert told is (expected[1] != "")


@pytest.mark.parametrize(
    ("words", "expected", "reason"),
    [
        ("", "ros2-classic", "names gzserver in lift, which it launches"),
        ("'ign gazebo'", "ros2", "names ign gazebo"),
    ],
)
def test_what_a_package_launches_tells(
    words: str, expected: str, reason: str, tmp_path: Path
) -> None:
    texts = {"lift": "words = 'gzserver'\n", "tour": f"{SHARE.format('lift')}words = {words}\n"}
    for name, text in texts.items():
        file = tmp_path / name / "launch/start.launch.py"
        file.parent.mkdir(parents=True)
        file.write_text(text)
        (tmp_path / name / "package.xml").write_text(AMENT.format(name))
    settings = Settings().for_package(Workspace((tmp_path,)).at(tmp_path / "tour"))
    assert settings.profile == expected
    assert settings.target_reason.endswith(reason)


def test_the_default_distribution_is_named(tmp_path: Path) -> None:
    (tmp_path / "lift").mkdir()
    (tmp_path / "lift/package.xml").write_text(AMENT.format("lift"))
    settings = Settings().for_package(Workspace((tmp_path,)).at(tmp_path / "lift"))
    assert settings.target_reason == "ROS 2 Jazzy, as no other was found: --distro chooses one"


CONTROL = '<ros2_control name="arm" type="system"/>'


@pytest.mark.parametrize(
    ("inside", "expected"),
    [
        ("", ("urdf", "")),
        (f"<!-- {CONTROL} -->", ("urdf", "")),
        ('<gazebo><plugin filename="libgazebo_ros_control.so" name="p"/></gazebo>', ("urdf", "")),
        (CONTROL, ("ros2", "")),
        (f"<gazebo>{CONTROL}</gazebo>", ("ros2", "")),
        ('<gazebo><plugin filename="gz-sim-imu-system" name="p"/></gazebo>', ("ros2", "")),
        (
            '<gazebo><plugin filename="ignition-gazebo-imu-system" name="p"/></gazebo>',
            ("ros2", "humble"),
        ),
        (
            f'{CONTROL}<gazebo><plugin filename="libgazebo_ros2_control.so" name="p"/></gazebo>',
            ("ros2-classic", "humble"),
        ),
    ],
)
def test_urdf_without_a_package_tells_by_its_content(
    inside: str, expected: tuple[str, str], tmp_path: Path
) -> None:
    (tmp_path / "arm.urdf").write_text(f'<robot name="arm">{inside}</robot>')
    workspace = Workspace((tmp_path.parent,))
    for package in (Package(tmp_path, workspace, "arm.urdf"), Package(tmp_path, workspace)):
        settings = Settings().for_package(package)
        assert (settings.profile, settings.distro) == expected


def test_a_file_for_ros_2_in_a_package_of_ros_1_counts_by_its_content(tmp_path: Path) -> None:
    plugin = '<gazebo><plugin filename="libgazebo_ros2_control.so" name="p"/></gazebo>'
    folder = write_example({"@urdf": plugin}, tmp_path)
    package = Package(folder / "urdf", Workspace((tmp_path,)), "arm.urdf")
    assert Settings().for_package(package).profile == "ros2-classic"


CATKIN = """<package format="2">
  <name>{0}</name><version>1.0.0</version><description>{0}</description>
  <maintainer email="a@example.org">A</maintainer><license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend><exec_depend>gazebo_ros</exec_depend>
</package>
"""
BOX = '<sdf version="1.6"><model name="box"><link name="base_link"/></model></sdf>'


def of_catkin(folder: Path, name: str = "acme_worlds", **files: str) -> Package:
    """Return a package of worlds and models without anything of a submission."""
    own = {"package.xml": CATKIN.format(name), "worlds/yard.world": BOX, "box/model.sdf": BOX}
    for path, text in {**own, **files}.items():
        (folder / name / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / name / path).write_text(text)
    return Workspace((folder,)).at(folder / name)


def test_worlds_and_models_in_a_package_of_ros_1_are_no_submission(tmp_path: Path) -> None:
    package = of_catkin(tmp_path)
    workspace = package.workspace
    world = Package(package.root / "worlds", workspace, "yard.world")
    model = Package(package.root / "box", workspace)
    robot = of_catkin(tmp_path, "acme_box", **{"model.sdf": BOX})
    chosen = [Settings().for_package(each).profile for each in (package, world, model, robot)]
    assert chosen == ["urdf", "sdf", "sdf", "sdf"]


def test_what_names_subt_or_lies_beside_submissions_is_for_it(tmp_path: Path) -> None:
    named = of_catkin(tmp_path / "a", **{"README.md": "Models for the SubT Challenge"})
    suppressing = of_catkin(tmp_path / "b", **{"README.md": "Checked by subt-check."})
    of_catkin(tmp_path / "c", "acme_rover_sensor_config_1")
    beside = of_catkin(tmp_path / "c")
    chosen = [Settings().for_package(each).profile for each in (named, suppressing, beside)]
    assert chosen == ["subt", "urdf", "subt"]


def test_a_model_is_judged_as_the_package_around_it(tmp_path: Path) -> None:
    model = '<sdf version="1.6"><model name="rover"><link name="base_link"/></model></sdf>'
    folder = write_example({"@ros2": SPAWN, "models/rover/model.sdf": model}, tmp_path)
    package = Package(folder / "models" / "rover", Workspace((tmp_path,)))
    assert Settings().for_package(package).profile == "gazebo-classic"


def test_the_report_says_by_what(tmp_path: Path) -> None:
    settings = Settings().for_package(opened(tmp_path, {"@ros2": SPAWN}))
    assert settings.target_reason == (
        "Gazebo Classic 11, whose support ended in January 2025: "
        "launch/arm.launch.py:20 names gazebo_ros"
    )


MODEL = '<sdf version="1.6"><model name="rover"><link name="base_link"/></model></sdf>'


def models_of(folder: Path, readme: str) -> list[Settings]:
    """Return the settings for a model and a world of a repository with this README."""
    for path in ("models/rover/model.sdf", "worlds/yard.world"):
        (folder / path).parent.mkdir(parents=True)
        (folder / path).write_text(MODEL)
    (folder / "README.md").write_text(readme)
    with open_input(folder) as opened:
        return [Settings().for_package(each) for each in opened.packages]


def test_models_without_a_package_are_for_classic_where_the_readme_names_only_that(
    tmp_path: Path,
) -> None:
    first, second = models_of(tmp_path, "# Rover\n\nexport GAZEBO_MODEL_PATH=models\n")
    assert first.profile == second.profile == "gazebo-classic"
    assert first.target_reason.endswith("../../README.md:3 names GAZEBO_MODEL_PATH")


@pytest.mark.parametrize(
    "readme", ["Needs Ignition Fortress.", "`ign gazebo yard.world`", "depends on ignition-gazebo6"]
)
def test_models_without_a_package_are_for_fortress_where_the_readme_names_only_that(
    readme: str, tmp_path: Path
) -> None:
    first, second = models_of(tmp_path, f"# Rover\n\n{readme}\n")
    assert first.profile == second.profile == "gazebo-fortress"
    assert first.target_reason.startswith("Gazebo Fortress: ../../README.md:3 names ")


@pytest.mark.parametrize(
    "readme", ["Open it in Gazebo.", "gzserver, or gz sim", "GZ_SIM_X", "ign gazebo, or gz sim"]
)
def test_models_without_a_package_are_for_the_usual_gazebo(readme: str, tmp_path: Path) -> None:
    assert {each.profile for each in models_of(tmp_path, readme)} == {"gazebo-harmonic"}


@pytest.mark.parametrize(
    ("files", "profile"),
    [
        ({"@ros2": SPAWN}, "gazebo-classic"),
        ({"@ros2": True, "scripts/spawn.py": "from gazebo_msgs.srv import A"}, "gazebo-classic"),
        ({"@ros2": SPAWN, URDF: GZ_PLUGIN}, "gazebo-harmonic"),
    ],
)
def test_models_without_a_package_are_for_classic_where_all_packages_beside_are(
    files: Mapping[str, object], profile: str, tmp_path: Path
) -> None:
    write_example(files, tmp_path / "src")
    models = tmp_path / "models" / "rover"
    models.mkdir(parents=True)
    (models / "model.sdf").write_text(MODEL)
    with open_input(tmp_path) as opened:
        (model,) = (it for it in opened.packages if it.name == "rover")
        assert Settings().for_package(model).profile == profile


@pytest.mark.parametrize(
    ("plugin", "expected"),
    [
        ("libignition-gazebo-physics-system.so", "gazebo-fortress"),
        ("libown.so", "gazebo-classic"),
    ],
)
def test_a_world_of_ignition_beside_packages_of_classic(
    plugin: str, expected: str, tmp_path: Path
) -> None:
    write_example({"@ros2": SPAWN}, tmp_path / "src")
    (tmp_path / "hall.sdf").write_text(WORLD.format(plugin))
    with open_input(tmp_path) as opened:
        (world,) = (it for it in opened.packages if it.name == "hall.sdf")
        assert Settings().for_package(world).profile == expected


@pytest.mark.parametrize(
    ("near", "expected"),
    [
        *(("", "humble"), ("ROS 2 Jazzy", "jazzy"), ("Humble? ros:iron", "iron")),
        *(("ROS 2 Humble, ROS 2 Jazzy", "humble"), ("ROS 2 Iron, ROS 2 Jazzy", "")),
    ],
)
def test_the_readme_of_the_folder_that_is_given_tells(
    near: str, expected: str, tmp_path: Path
) -> None:
    (tmp_path / "README.md").write_text("For ROS 2 Humble.\n")
    source = tmp_path / "ws" / "src"
    source.mkdir(parents=True)
    (source / "README.md").write_text(near)
    write_example({"@ros2": True}, source)
    with open_input(tmp_path) as opened:
        assert Settings().for_package(opened.packages[0]).distro == expected


def test_nothing_above_the_folder_that_is_given_tells(tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("For ROS 2 Humble.\n")
    source = tmp_path / "ws" / "src"
    source.mkdir(parents=True)
    write_example({"@ros2": True}, source)
    with open_input(source) as opened:
        assert Settings().for_package(opened.packages[0]).distro == ""


ROS_1 = """<package format="2">
  <name>{}</name><buildtool_depend>catkin</buildtool_depend>
</package>
"""
SPAWN_OF_ROS_1 = """<launch>
  <node name="s" pkg="gazebo_ros" type="spawn_model" args="-urdf -model lift"/>
</launch>
"""


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({}, ""),
        ({"launch/rviz.launch": "<launch/>"}, ""),
        (
            {"launch/a.launch": SPAWN_OF_ROS_1},
            "Gazebo Classic with ROS 1: launch/a.launch:2 names gazebo_ros",
        ),
        (
            {"launch/a.launch": SPAWN_OF_ROS_1, "README.md": "# Lift\nFor ROS Noetic.\n"},
            "Gazebo Classic with ROS Noetic: launch/a.launch:2 names gazebo_ros, "
            "README.md:2 names ROS Noetic",
        ),
        (
            {
                "../lift_gazebo/package.xml": ROS_1.format("lift_gazebo"),
                "../lift_gazebo/launch/lift.launch": SPAWN_OF_ROS_1.replace("-model lift", "lift"),
            },
            "Gazebo Classic with ROS 1: launch/lift.launch:2 names gazebo_ros in lift_gazebo, "
            "which launches it",
        ),
    ],
)
def test_a_package_of_ros_1_states_what_starts_gazebo(
    files: Mapping[str, str], expected: str, tmp_path: Path
) -> None:
    own = {"package.xml": ROS_1.format("lift"), "urdf/lift.urdf": "<robot name='lift'/>"}
    for path, text in {**own, **files}.items():
        place = tmp_path / "lift" / path
        (tmp_path / "lift").mkdir(exist_ok=True)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    settings = Settings().for_package(Workspace((tmp_path,)).at(tmp_path / "lift"))
    assert (settings.profile, settings.target_reason) == ("urdf", expected)


@pytest.mark.parametrize(
    ("distro", "launch", "reason"),
    [
        ("humble", "cmd=['gz', 'sim']", "ROS 2 Humble and Gazebo Harmonic: ../a.sh:1 names "),
        ("humble", "cmd=['ign', 'gazebo']", "ROS 2 Humble: ../a.sh:1 names /opt/ros/humble"),
        ("jazzy", "cmd=['gz', 'sim']", "ROS 2 Jazzy: ../a.sh:1 names /opt/ros/jazzy"),
    ],
)
def test_a_launch_file_runs_gz_sim_on_humble(
    distro: str, launch: str, reason: str, tmp_path: Path
) -> None:
    files = {"@ros2": f"        ExecuteProcess({launch}),", "../a.sh": f". /opt/ros/{distro}\n"}
    assert Settings().for_package(opened(tmp_path, files)).target_reason.startswith(reason)


@pytest.mark.parametrize(
    ("readme", "more", "gazebo", "release"),
    [
        ("ROS 2 Humble and Gazebo Harmonic", {}, "harmonic", "harmonic"),
        ("ROS 2 Humble\n![](badge/Gazebo-Harmonic-orange)", {}, "harmonic", "harmonic"),
        ("ROS 2 Humble, apt install gz-harmonic", {}, "harmonic", "harmonic"),
        ("ROS 2 Humble and Gazebo Fortress", {}, "", "fortress"),
        ("ROS 2 Humble, Gazebo Fortress or Gazebo Harmonic", {}, "", "fortress"),
        ("ROS 2 Humble and Gazebo Jetty", {}, "", "fortress"),
        ("ROS 2 Humble, see gazebosim.org/docs/harmonic", {}, "", "fortress"),
        ("ROS 2 Humble and Gazebo Harmonic", {URDF: IGNITION_PLUGIN}, "", "fortress"),
        ("ROS 2 Jazzy and Gazebo Harmonic", {}, "", "harmonic"),
    ],
)
def test_a_readme_names_another_gazebo_than_that_of_the_distribution(
    readme: str, more: Mapping[str, object], gazebo: str, release: str, tmp_path: Path
) -> None:
    files = {"@ros2": True, "README.md": f"{readme}\n", **more}
    settings = Settings().for_package(opened(tmp_path, files))
    assert settings.gazebo == gazebo
    assert Judge.from_settings(settings).context.release == release
    if gazebo:
        assert settings.target_reason.startswith("ROS 2 Humble and Gazebo Harmonic: README.md:")


@pytest.mark.parametrize(("readme", "distro"), [("", "galactic"), ("Needs ROS 2 Humble", "jazzy")])
def test_the_readme_of_a_package_in_another_folder_counts_before_its_scripts(
    readme: str, distro: str, tmp_path: Path
) -> None:
    home, away = tmp_path / "src" / "arm", tmp_path / "vendor" / "eye"
    for folder in (home, away):
        folder.mkdir(parents=True)
        text = DEPENDS.replace("acme_arm", folder.name)
        (folder / "package.xml").write_text(text)
    (away / "run.sh").write_text("source /opt/ros/galactic/setup.bash\n")
    (away.parent / "README.md").write_text(f"# Eye\n\n{readme}\n")
    with open_input(tmp_path) as found:
        reasons = {it.name: Settings().for_package(it).target_reason for it in found.packages}
    assert distro.capitalize() in reasons["arm"]
