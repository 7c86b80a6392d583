"""A limit in MoveIt's joint_limits.yaml that is written as an integer.

MoveIt 2 declares these limits as decimal numbers, and ROS 2 does not convert: "parameter … has
invalid type: expected [double] got [integer]". RViz, MoveIt Servo and nodes of your own end with
it; move_group ends, or plans without the limit of that joint. MoveIt's setup assistant wrote
integers itself until April 2024.

A value is judged that MoveIt reads: a velocity, acceleration or jerk whose `has_…_limits` is true,
and positions. Packages of ROS 1 are not judged, whose parameters are converted.

Fix: write the value with a decimal point.
Source: moveit/moveit2#2776, #2803, #3604; MoveIt 2, robot_model_loader.cpp.
"""

from collections.abc import Iterator

from checker.launch.ros2.package_launch import is_ros2_only
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule
from checker.source.yaml import YamlNode, read_root

_FILE = "joint_limits.yaml"
_VALUES = {
    "max_velocity": "has_velocity_limits",
    "max_acceleration": "has_acceleration_limits",
    "max_jerk": "has_jerk_limits",
}
_ALWAYS = ("min_position", "max_position")


@rule("URD034", "integer-joint-limit", Severity.ERROR, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report integers among the limits that MoveIt reads."""
    if not is_ros2_only(package) or not package.workspace.launches_with("moveit"):
        return
    for file in package.index.with_suffix(_FILE):
        root = read_root(package.read(file.path))
        limits = root.get("joint_limits") if root is not None else None
        for name, limit in limits.entries if limits is not None else ():
            for key, value in _read_values(limit):
                if isinstance(value.scalar, int) and not isinstance(value.scalar, bool):
                    right = f"{value.scalar}.0"
                    yield finding(
                        value,
                        f"{key} of joint {name.scalar!r} is the integer {value.scalar}, where "
                        f"MoveIt expects a decimal number and ends: write {right}",
                        key=file.path,
                        fix=replace_text(value, right),
                    )


def _read_values(limit: YamlNode) -> Iterator[tuple[str, YamlNode]]:
    for key, value in limit.entries:
        name = str(key.scalar)
        used = limit.get(_VALUES.get(name, ""))
        if name in _ALWAYS or (used is not None and used.scalar is True):
            yield name, value


_LAUNCH = """        Node(package='moveit_ros_move_group', executable='move_group', parameters=[
            {'robot_description_planning': in_package('config', 'joint_limits.yaml')}]),"""


def _limits(lines: str) -> dict[str, object]:
    return {
        "@ros2": _LAUNCH,
        f"config/{_FILE}": f"joint_limits:\n  shoulder:\n    has_velocity_limits: true\n{lines}\n",
    }


_MARK = "  # ^ URD034"
GOOD = [
    _limits("    max_velocity: 3.0"),
    _limits("    has_acceleration_limits: false\n    max_acceleration: 0"),
]
BAD = [
    _limits(f"    max_velocity: 3{_MARK}"),
    _limits(f"    max_velocity: 3.0\n    max_position: 2{_MARK}"),
]
