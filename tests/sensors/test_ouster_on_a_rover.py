"""An Ouster OS-1 on the SDF rover: what is right is not spoken of, what is wrong is found."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport, VerdictKind
from checker.settings import Settings

NAME = "husky_migration_sensor_config_1"
MODEL, BRIDGES = "model.sdf", "launch/vehicle_topics.launch"

LINK = """    <!-- Ouster OS1-64 on the top plate -->
    <link name="os1_link">
      <pose>-0.1 0 0.255 0 0 0</pose>
      <inertial>
        <pose>0 0 0.0365 0 0 0</pose>
        <mass>0.38</mass>
        <inertia>
          <ixx>3.3633e-4</ixx>
          <ixy>0</ixy>
          <ixz>0</ixz>
          <iyy>3.3633e-4</iyy>
          <iyz>0</iyz>
          <izz>3.3516e-4</izz>
        </inertia>
      </inertial>
      <collision name="os1_collision">
        <pose>0 0 0.0365 0 0 0</pose>
        <geometry>
          <cylinder>
            <radius>0.042</radius>
            <length>0.073</length>
          </cylinder>
        </geometry>
      </collision>
      <visual name="os1_visual">
        <pose>0 0 0.0365 0 0 0</pose>
        <geometry>
          <cylinder>
            <radius>0.042</radius>
            <length>0.073</length>
          </cylinder>
        </geometry>
        <material>
          <ambient>0.5 0.5 0.5 1</ambient>
          <diffuse>0.5 0.5 0.5 1</diffuse>
        </material>
      </visual>
      <sensor name="os1_lidar" type="gpu_lidar">
        <pose>0 0 0.0362 0 0 0</pose>
        <always_on>1</always_on>
        <update_rate>10</update_rate>
        <lidar>
          <scan>
            <horizontal>
              <samples>512</samples>
              <resolution>1</resolution>
              <min_angle>-3.141592653589793</min_angle>
              <max_angle>3.141592653589793</max_angle>
            </horizontal>
            <vertical>
              <samples>64</samples>
              <resolution>1</resolution>
              <min_angle>-0.28972465583</min_angle>
              <max_angle>0.28972465583</max_angle>
            </vertical>
          </scan>
          <range>
            <min>0.8</min>
            <max>120</max>
            <resolution>0.01</resolution>
          </range>
          <noise>
            <type>gaussian</type>
            <mean>0</mean>
            <stddev>0.01</stddev>
          </noise>
        </lidar>
      </sensor>
      <sensor name="os1_imu" type="imu">
        <pose>0.006253 -0.011775 0.007645 0 0 0</pose>
        <always_on>1</always_on>
        <update_rate>50</update_rate>
        {imu}
      </sensor>
    </link>
    <joint name="os1_joint" type="fixed">
      <parent>base_link</parent>
      <child>os1_link</child>
    </joint>
"""
URDF = """  <link name="${name}/os1_link">
    <inertial>
      <origin xyz="0 0 0.0365" rpy="0 0 0"/>
      <mass value="0.38"/>
      <inertia ixx="3.3633e-4" ixy="0" ixz="0" iyy="3.3633e-4" iyz="0" izz="3.3516e-4"/>
    </inertial>
    <visual>
      <origin xyz="0 0 0.0365" rpy="0 0 0"/>
      <geometry>
        <cylinder radius="0.042" length="0.073"/>
      </geometry>
    </visual>
  </link>
  <joint name="${name}/os1_joint" type="fixed">
    <parent link="${name}/base_link"/>
    <child link="${name}/os1_link"/>
    <origin xyz="-0.1 0 0.255" rpy="0 0 0"/>
  </joint>
"""
TOPICS = "/world/$(arg world_name)/model/$(arg name)/link/os1_link/sensor"
BRIDGE = """    <node pkg="ros_ign_bridge" type="parameter_bridge" name="{node}"
          args="{topic}@sensor_msgs/{ros}[ignition.msgs.{ign}">
      <remap from="{topic}" to="{to}"/>
    </node>
"""
POINTS = BRIDGE.format(
    node="ros_ign_bridge_os1_points",
    topic=f"{TOPICS}/os1_lidar/scan/points",
    ros="PointCloud2",
    ign="PointCloudPacked",
    to="points",
)
IMU = BRIDGE.format(
    node="ros_ign_bridge_os1_imu",
    topic=f"{TOPICS}/os1_imu/imu",
    ros="Imu",
    ign="IMU",
    to="os1/imu/data",
)
SHEET = """* 1x 3D lidar: Ouster OS1-64 with an IMU inside, modeled by `gpu_lidar` and `imu` plugins
  ([datasheet](https://ouster.com/products/os1-lidar-sensor/)).
"""

Rover = Callable[..., PackageReport]


def put_before(file: Path, mark: str, text: str) -> None:
    before = file.read_text("utf-8")
    assert before.count(mark) == 1, mark
    file.write_text(before.replace(mark, text + mark), "utf-8")


@pytest.fixture
def rover(samples: Path, tmp_path: Path) -> Rover:
    """Return what checks the rover with an OS-1 of which `wrong` replaces texts."""
    folder = tmp_path / NAME
    shutil.copytree(samples / NAME, folder)
    model = (folder / MODEL).read_text("utf-8")
    imu = model[model.index("<imu>") : model.index("</imu>") + len("</imu>")]
    put_before(folder / MODEL, "  </model>\n", LINK.format(imu=imu))
    put_before(folder / "urdf/robot_from_sdf.xacro", "</robot>\n", URDF)
    put_before(folder / BRIDGES, "    <!-- front camera: colour and depth -->\n", POINTS + IMU)
    put_before(folder / "specifications.md", "* 1x RGBD camera at the front", SHEET)
    config = folder / "model.config"
    text = config.read_text("utf-8")
    assert "one IMU and" in text
    text = text.replace("one planar lidar", "two lidars").replace("one IMU and", "two IMUs and")
    config.write_text(text, "utf-8")
    manifest = folder / "package.xml"
    text = manifest.read_text("utf-8")
    assert "a planar lidar, two cameras and an IMU" in text
    manifest.write_text(text.replace("a planar lidar", "two lidars").replace("an IMU", "two IMUs"))

    def checked(
        path: str = "", right: str = "", wrong: str = "", *, select: tuple[str, ...] = ()
    ) -> PackageReport:
        if path:
            file = folder / path
            text = file.read_text("utf-8")
            assert text.count(right) == 1, right
            file.write_text(text.replace(right, wrong), "utf-8")
        settings = Settings(select=select, trial=not select, cache=False)
        (package,) = check_package(folder, settings).packages
        return package

    return checked


def test_a_right_one_is_ready_and_nothing_is_said_about_it(rover: Rover) -> None:
    package = rover()
    assert not [f"{each.rule} {each.places[0]}: {each.message}" for each in package.findings]
    assert package.verdict is VerdictKind.READY


FAULTS = {
    "ten times as heavy": ("INE013", "<mass>0.38</mass>", "<mass>3.8</mass>"),
    "inertia of twice the radius": (
        "INE013",
        "<inertia>\n          <ixx>3.3633e-4</ixx>",
        "<inertia>\n          <ixx>3.3633e-3</ixx>",
    ),
    "samples of an old template": ("SEN004", "<samples>512<", "<samples>10000<"),
    "samples of another lidar": ("SEN004", "<samples>512<", "<samples>1800<"),
    "a rate that it has not": (
        "SEN007",
        "<update_rate>10</update_rate>\n        <lidar>\n          <scan>\n            <horizontal>"
        "\n              <samples>512",
        "<update_rate>15</update_rate>\n        <lidar>\n          <scan>\n            <horizontal>"
        "\n              <samples>512",
    ),
    "more than a turn": (
        "SEN003",
        "<min_angle>-3.141592653589793</min_angle>",
        "<min_angle>-3.1459</min_angle>",
    ),
    "half of the rows": ("SEN007", "<samples>64<", "<samples>32<"),
    "the view of another lidar": (
        "SEN007",
        "<min_angle>-0.28972465583</min_angle>",
        "<min_angle>-0.3926990817</min_angle>",
    ),
}


def reported(package: PackageReport) -> list[tuple[str, str, int]]:
    return [
        (each.rule, each.places[0].file, each.places[0].line)
        for each in package.findings
        if each.severity is not Severity.INFO
    ]


@pytest.mark.slow
@pytest.mark.parametrize(("rule", "right", "wrong"), FAULTS.values(), ids=FAULTS)
def test_a_wrong_figure_is_found_at_its_line(
    rover: Rover, tmp_path: Path, rule: str, right: str, wrong: str
) -> None:
    package = rover(MODEL, right, wrong, select=("INE013", "SEN", "ROS"))
    text = (tmp_path / NAME / MODEL).read_text("utf-8")
    line = text[: text.index(wrong)].count("\n") + 1
    assert reported(package) == [(rule, MODEL, line)]


@pytest.mark.parametrize("bridge", [POINTS, IMU], ids=["points", "IMU"])
def test_a_missing_bridge_is_found(rover: Rover, bridge: str) -> None:
    package = rover(BRIDGES, bridge, "", select=("ROS",))
    assert [rule for rule, _, _ in reported(package)] == ["ROS001"]
