"""An acceleration that robot_localization fuses together with gravity.

An IMU at rest measures 9.8 m/s² upwards. The filter takes gravity out of `imu0` only if
`imu0_remove_gravitational_acceleration` is true, and its default is false: what the sensor is
tilted by, the robot seems to accelerate by, and without `two_d_mode` it rises at once.

Drivers of real sensors may have removed gravity, so the rule looks only at workspaces whose launch
files start Gazebo, whose IMU measures it, or that have none.

Fix: write `imu0_remove_gravitational_acceleration: true`; or set the last row of `imu0_config` to
false. If the driver removes gravity already, write `false`, which this rule accepts.
Source: robot_localization, ros_filter.cpp and params/ekf.yaml; REP 145, `imu/data`:
"accelerations … include gravity".
"""

import re

from checker.package.package import Package
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Findings, Severity, finding, rule

_CONFIG = re.compile(r"(imu\d{1,3})_config\Z")
_ACCELERATIONS = slice(12, 15)
"""The last of the five rows."""


@rule("WIR029", "gravity-taken-as-motion", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report an IMU whose accelerations are used, where nothing is said of gravity."""
    if not package.workspace.may_start_gazebo:
        return
    for file in package.index.with_suffix(".yaml", ".yml"):
        for block in blocks_in(package, file.path, "_config"):
            for name, parameter in block.parameters.items():
                match = _CONFIG.match(name)
                if match is None or parameter.type != "bool_array":
                    continue
                used = [it.scalar for it in parameter.node.items[_ACCELERATIONS]]
                removal = f"{match[1]}_remove_gravitational_acceleration"
                if True in used and removal not in block.parameters:
                    yield finding(
                        parameter.key,
                        f"{block.node} takes gravity for motion: it uses accelerations of "
                        f"{match[1]}, and does not remove gravity by default: write "
                        f"`{removal}: true`",
                    )


def _filter(row: str, more: str = "", mark: str = "") -> dict[str, object]:
    text = f"""ekf_filter_node:
  ros__parameters:
    frequency: 30.0
    imu0: imu/data{more}
    imu0_config: [false, false, false,{mark}
                  true, true, true,
                  false, false, false,
                  false, false, true,
                  {row}]
"""
    return {"@ros2": True, "config/ekf.yaml": text}


_DRIVER = "        Node(package='acme_imu', executable='driver', name='imu'),"
GOOD = [
    {**_filter("true, true, true"), "@ros2": _DRIVER},
    _filter("false, false, false"),
    _filter("true, true, true", "\n    imu0_remove_gravitational_acceleration: true"),
]
_GAZEBO = "        Node(package='ros_gz_sim', executable='create', arguments=['-topic', 'a']),"
BAD = [{**_filter("true, false, false", mark="  # ^ WIR029"), "@ros2": _GAZEBO}]
