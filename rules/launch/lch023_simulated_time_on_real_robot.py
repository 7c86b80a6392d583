"""Nodes of a real robot wait for simulated time, which nothing publishes.

With `use_sim_time`, the time of a node is that of the messages on /clock. A launch file that starts
the driver of a sensor and no simulator has none: the time stays zero, transforms and scans with the
time of the system are decades ahead, and mapping and navigation wait. So does one that starts
ros2_control_node with mock hardware: trajectories do not advance. Usually the default of the
argument was copied from a launch file for Gazebo.

It is reported where all that the launch file starts was read, and no launch file of the workspace
names a simulator, a bridge of /clock or the replay of a recording.

Fix: `use_sim_time` false, or `default_value='false'` of its argument.
Source: ROS 2 design, "Clock and Time"; ros2/rclcpp issue 940; ros/joint_state_publisher issue 103;
the packages of the drivers, by their names in the ROS index.
"""

import re

from checker.package.package import Package
from checker.ros.ros2_control.distributions import is_mock
from checker.ros.ros2_control.hardware import read_hardware
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ros2_control

_PARAMETER = "use_sim_time"
_DRIVERS = (
    *("realsense2_camera", "usb_cam", "v4l2_camera", "micro_ros_agent", "ouster_ros"),
    *("urg_node", "urg_node2", "rplidar_ros", "sllidar_ros2", "ldlidar", "ldlidar_stl_ros2"),
    *("velodyne_driver", "ydlidar_ros2_driver", "livox_ros_driver2", "sick_scan_xd"),
)
"""Packages that read a device, and do so with the time of the system."""
_MANAGER = "controller_manager/ros2_control_node"
_CLOCKS = re.compile(
    r"gazebo_ros|gazebo\.launch|ros_gz|ros_ign|gzserver|\bgz_sim|['\"](?:gz|ign|gazebo)\b|--clock"
    r"|['\"]/?clock\b|tcp_endpoint|webots|isaac|mujoco|mvsim|stage_ros|stageros|unity|carla|airsim"
    r"|coppelia|ros2 bag|rosbag",
    re.IGNORECASE,
)
"""What publishes the time of a simulation or of a recording, as launch files name it."""
_MAY_PUBLISH = re.compile(r"clock|sim|bridge|gz|ign|bag|replay|play|unity", re.IGNORECASE)
"""Names of programs, of whatever package, that may publish the time."""


@rule("LCH023", "simulated-time-on-real-robot", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring, package: Package) -> Findings:
    """Report the first node that waits for the time, beside the driver of a device or robot."""
    real = _MANAGER if _is_mock(wiring) else ""
    drivers = [it for it in wiring.nodes if it.node.package.value in _DRIVERS or it.program == real]
    if not drivers or wiring.unread or wiring.simulation is not None:
        return
    waiting = [it for it in wiring.nodes if it.node.package.value not in _DRIVERS and _waits(it)]
    others = any(it.facts is None and _MAY_PUBLISH.search(it.program) for it in wiring.every_node)
    texts = package.workspace.launch_texts.values()
    if not waiting or others or any(map(_CLOCKS.search, texts)):
        return
    first, driver = waiting[0], drivers[0]
    more = f" and {len(waiting) - 1} more" if len(waiting) > 1 else ""
    yield finding(
        first.settings[_PARAMETER].span,
        f"{first.label}{more} with use_sim_time: nothing publishes /clock beside "
        f"{driver.program}, so time stands still; expected false",
        related=[(driver.node.executable, "what runs beside no simulator")],
    )


def _is_mock(wiring: Wiring) -> bool:
    """Return whether the robots of a launch have mock hardware alone."""
    roots = [robot.document.root for _, robot in wiring.described]
    plugins = [it.plugin.value for root in roots for it in read_hardware(root)]
    return bool(plugins) and all(map(is_mock, plugins))


def _waits(node: WiredNode) -> bool:
    setting = node.settings.get(_PARAMETER)
    return node.knows_parameters and setting is not None and setting.text == "true"


_LAUNCH = """<launch>
  <arg name="sim" default="@"/>
  <node pkg="%" exec="driver"/>
  <node pkg="slam_toolbox" exec="async_slam_toolbox_node">
    <param name="use_sim_time" value="$(var sim)"/>&
  </node>
</launch>
"""


def _slam(sim: str, driver: str = "sllidar_ros2", mark: str = "") -> dict[str, object]:
    launch = _LAUNCH.replace("@", sim).replace("%", driver).replace("&", mark)
    return {
        "@bridge": True,
        "launch/rover.launch.py": None,
        "config/bridge.yaml": None,
        "launch/slam.launch.xml": launch,
    }


_MOCK = """<launch>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/arm.urdf')"/>
  </node>
  <node pkg="controller_manager" exec="ros2_control_node">
    <param name="use_sim_time" value="true"/>  <!-- ^ LCH023 -->
  </node>
</launch>
"""
_REPLAY = '<launch><executable cmd="ros2 bag play --clock drive"/></launch>'
GOOD = [
    _slam("false"),
    _slam("true", "acme_driver"),
    {**_slam("true"), "launch/replay.launch.xml": _REPLAY},
]
BAD = [
    _slam("true", mark="  <!-- ^ LCH023 -->"),
    {
        **_slam("true"),
        "launch/slam.launch.xml": _MOCK,
        "urdf/arm.urdf": f'<robot name="arm"><link name="base_link"/>{ros2_control()}</robot>',
    },
]
