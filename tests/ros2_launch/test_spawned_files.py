"""Findings about plugins of Gazebo weigh less where Gazebo gets another description."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.rule_testing import write_example
from checker.settings import Settings

LINK = '<link name="base_link"/>'
PLUGIN = '<gazebo><plugin filename="{}" name="{}"/></gazebo>'
SIM = PLUGIN.format("gz_ros2_control-system", "gz_ros2_control::GazeboSimROS2ControlPlugin")
CLASSIC = PLUGIN.format("libgazebo_ros2_control.so", "control")
SOLID = """<link name="arm">
  <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
</link>
<joint name="swing" type="continuous"><parent link="base_link"/><child link="arm"/></joint>
"""
CONTROL = """<ros2_control name="arm" type="system">
  <hardware><plugin>arm_driver/Arm</plugin></hardware>
</ros2_control>
"""
CHOSEN = f"""<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
{LINK}
<xacro:arg name="sim" default="false"/>
<ros2_control name="arm" type="system">
  <hardware>
    <xacro:if value="$(arg sim)"><plugin>gz_ros2_control/GazeboSimSystem</plugin></xacro:if>
    <xacro:unless value="$(arg sim)"><plugin>arm_driver/Arm</plugin></xacro:unless>
  </hardware>
</ros2_control>
<xacro:if value="$(arg sim)">{SIM}</xacro:if>
</robot>
"""
SENSING = """<ros2_control name="arm" type="system">
  <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
  {}
</ros2_control>
"""
NAMING = SIM.replace(
    "/>", "><parameters>$(find acme_rover_bringup)/config/both.yaml</parameters></plugin>"
)
BOTH = """controller_manager:
  ros__parameters:
    imu_broadcaster: {type: imu_sensor_broadcaster/IMUSensorBroadcaster}
imu_broadcaster:
  ros__parameters: {sensor_name: imu, frame_id: base_link}
"""
LOADED = '<executable cmd="ros2 control load_controller imu_broadcaster"/>'
OTHER = """<package format="3">
  <name>arm_tests</name>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
FOLDER = "$(find-pkg-share acme_rover_bringup)/urdf"
NODE = '<node pkg="{}" exec="{}" args="{}"/>\n'
PUBLISHER = """<node pkg="robot_state_publisher" exec="robot_state_publisher">
  <param name="robot_description" type="str" value="$(command 'xacro {}')"/>
</node>
"""
TOPIC = "-topic robot_description"
CREATE = NODE.format("ros_gz_sim", "create", TOPIC)
ENTITY = NODE.format("gazebo_ros", "spawn_entity.py", f"{TOPIC} -entity arm")
MANAGER = NODE.format("controller_manager", "ros2_control_node", "")
SHOWN = "Gazebo gets another description"
DRIVEN = "none spawns it into Gazebo"


def launch(file: str, *nodes: str) -> str:
    publisher = PUBLISHER.format(f"{FOLDER}/{file}")
    return "".join(("<launch>\n", publisher, *nodes, "</launch>\n"))


def robot(*parts: str) -> str:
    return "".join(('<robot name="arm">\n', LINK, *parts, "</robot>\n"))


PLAIN = {"urdf/sim.urdf": robot(), "launch/sim.launch.xml": launch("sim.urdf", CREATE)}
REAL = {"urdf/arm.urdf": robot(CONTROL, SIM)}


@pytest.mark.parametrize(
    ("files", "expected", "clause"),
    [
        ({"launch/arm.launch.xml": launch("arm.urdf")}, Severity.WARNING, SHOWN),
        ({"launch/arm.launch.xml": launch("arm.urdf", CREATE)}, Severity.ERROR, ""),
        (
            {
                "launch/arm.launch.xml": launch("arm.urdf"),
                "launch/more.launch.xml": f"<launch>{CREATE}</launch>",
            },
            Severity.ERROR,
            "",
        ),
    ],
    ids=["shown", "spawned", "may be spawned"],
)
def test_no_tag(tmp_path: Path, files: dict[str, str], expected: Severity, clause: str) -> None:
    found = findings("R2C005", {**PLAIN, "urdf/arm.urdf": robot(SIM), **files}, tmp_path)
    assert [it[0] for it in found] == [expected]
    assert clause in found[0][1]


@pytest.mark.parametrize(("nodes", "count"), [((MANAGER,), 0), ((), 1), ((MANAGER, CREATE), 1)])
def test_other_hardware(tmp_path: Path, nodes: tuple[str, ...], count: int) -> None:
    files = {**REAL, "launch/arm.launch.xml": launch("arm.urdf", *nodes)}
    assert len(findings("R2C005", files, tmp_path)) == count


@pytest.mark.parametrize(("value", "count"), [("", 0), (" sim:=true", 1)])
def test_arguments_of_xacro_choose_the_hardware(tmp_path: Path, value: str, count: int) -> None:
    files = {
        "urdf/arm.urdf.xacro": CHOSEN,
        "launch/sim.launch.xml": launch("arm.urdf.xacro sim:=true", CREATE),
        "launch/arm.launch.xml": launch(f"arm.urdf.xacro{value}", MANAGER),
    }
    found = findings("R2C005", files, tmp_path)
    assert [severity for severity, _ in found] == [Severity.ERROR] * count


def test_manager_of_another_package(tmp_path: Path) -> None:
    files = {
        "urdf/arm.urdf.xacro": CHOSEN,
        "launch/sim.launch.xml": launch("arm.urdf.xacro sim:=true", CREATE),
        "../arm_tests/package.xml": OTHER,
        "../arm_tests/launch/arm.launch.xml": launch("arm.urdf.xacro sim:=true", MANAGER),
    }
    (found,) = report("R2C005", files, tmp_path).findings
    assert found.places[0].file.endswith("urdf/arm.urdf.xacro")
    assert found.places[1].file.endswith("../arm_tests/launch/arm.launch.xml")


@pytest.mark.parametrize(
    ("real", "more", "count"),
    [
        ("", {}, 0),
        (LOADED, {}, 1),
        ("", {"launch/all.launch.xml": f"<launch>{LOADED}</launch>"}, 1),
    ],
    ids=["of the other", "of both", "alone"],
)
def test_controller_of_another_robot(
    tmp_path: Path, real: str, more: dict[str, str], count: int
) -> None:
    files = {
        "urdf/arm.urdf": robot(SENSING.format(""), NAMING),
        "urdf/more.urdf": robot(SENSING.format('<sensor name="imu"/>'), NAMING),
        "config/both.yaml": BOTH,
        "launch/arm.launch.xml": launch("arm.urdf", CREATE, real),
        "launch/more.launch.xml": launch("more.urdf", CREATE, LOADED),
        **more,
    }
    assert len(findings("R2C009", files, tmp_path)) == count


def test_unknown_library(tmp_path: Path) -> None:
    own = robot(CONTROL, PLUGIN.format("gz-sim-no-such-system", "none"))
    files = {"urdf/arm.urdf": own, "launch/arm.launch.xml": launch("arm.urdf", MANAGER)}
    ((severity, message),) = findings("PLG002", files, tmp_path)
    assert severity is Severity.WARNING
    assert DRIVEN in message


@pytest.mark.parametrize(
    ("rule", "nodes", "expected"),
    [
        ("GEO002", (MANAGER,), Severity.INFO),
        ("GEO002", (MANAGER, CREATE), Severity.WARNING),
        ("R2C006", (MANAGER,), Severity.INFO),
        ("R2C006", (MANAGER, CREATE), Severity.WARNING),
    ],
)
def test_robot_of_hardware_alone(
    tmp_path: Path, rule: str, nodes: tuple[str, ...], expected: Severity
) -> None:
    own = robot(CONTROL, SOLID, SIM)
    files = {"urdf/arm.urdf": own, "launch/arm.launch.xml": launch("arm.urdf", *nodes)}
    ((severity, message),) = findings(rule, files, tmp_path)
    assert severity is expected
    assert (DRIVEN in message) is (expected is Severity.INFO)


@pytest.mark.parametrize(
    ("spawner", "expected"),
    [
        (NODE.format("controller_manager", "spawner", "lift"), Severity.ERROR),
        (f"<!-- {NODE.format('controller_manager', 'spawner', 'lift')} -->", Severity.WARNING),
    ],
)
def test_type_of_a_controller_that_a_comment_spawns(
    tmp_path: Path, spawner: str, expected: Severity
) -> None:
    files = {
        "urdf/arm.urdf": robot(CONTROL, NAMING),
        "config/both.yaml": BOTH.replace(
            "imu_sensor_broadcaster/IMUSensor", "effort_controllers/"
        ).replace("imu_broadcaster", "lift"),
        "launch/arm.launch.xml": launch("arm.urdf", CREATE, spawner),
    }
    ((severity, _),) = findings("R2C008", files, tmp_path)
    assert severity is expected


@pytest.mark.parametrize(
    ("more", "expected"), [((), []), ((CREATE,), [Severity.ERROR])], ids=["classic", "both"]
)
def test_classic(tmp_path: Path, more: tuple[str, ...], expected: list[Severity]) -> None:
    files = {
        **PLAIN,
        "urdf/old.urdf": robot(CLASSIC),
        "launch/old.launch.xml": launch("old.urdf", ENTITY),
        "launch/both.launch.xml": launch("old.urdf", *more),
    }
    assert [severity for severity, _ in findings("PLG001", files, tmp_path)] == expected


def findings(rule: str, files: dict[str, str], folder: Path) -> list[tuple[Severity, str]]:
    return [(it.severity, it.message) for it in report(rule, files, folder).findings]


def report(rule: str, files: dict[str, str], folder: Path) -> PackageReport:
    example = {"@bridge": True, "launch/rover.launch.py": None, "urdf/rover.urdf": None, **files}
    package = write_example(example, folder)
    settings = Settings(
        trial=False, select=(rule,), profile="ros2", profile_chosen=True, distro="jazzy"
    )
    (found,) = check_package(package, settings).packages
    return found
