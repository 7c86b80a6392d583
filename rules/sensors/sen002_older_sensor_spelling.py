"""A lidar with an older spelling of its type, or a type that is not simulated.

`ray` and `lidar` are lidars that run on the CPU. Ignition Gazebo does not simulate them, so they
publish nothing: this is an error. `gpu_ray` still works and is the older name of `gpu_lidar`: this
is an info. In a robot that launch files spawn into Gazebo Classic as well, `ray` is right where a
`gpu_lidar` is beside it; where all its plugins are for Classic, PLG001 reports the launch file.

Fix: write the type `gpu_lidar`, and `<lidar>` for `<ray>`.
Source: Model Migration Guide; src/Sensor.cc of sdformat, which reads `gpu_ray` as `gpu_lidar`; no
system of gz-sim simulates a lidar on the CPU (`gazebo_sensors.json`).
"""

from collections.abc import Iterator

from checker.finding import Fix
from checker.formats.sdf.document import sdf_version
from checker.model.components import Sensor
from checker.model.plugin_library import classic_plugin
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.package.package import Package
from checker.robots.simulator import classic_by_default
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import Concern, Context, Findings, Safety, Severity, finding, rule, unchecked
from checker.source.text import Span

_OLD = {"gpu_ray": "gpu_lidar", "ray": "lidar"}
_CLASSIC = "classic"
_FIRST_GPU_LIDAR = (1, 6)
"""SDF version since which `<lidar>` exists."""


@rule("SEN002", "older-sensor-spelling", Severity.ERROR, Concern.INTERFACE)
def check(
    robot: Robot, context: Context, package: Package, spawned: SpawnedFiles | None
) -> Findings:
    """Report older spellings of lidars, and lidars that the target release does not simulate."""
    if context.release == _CLASSIC or (
        not context.release and sdf_version(robot.document) < _FIRST_GPU_LIDAR
    ):
        return
    if reason := classic_by_default(robot, package):
        yield unchecked(reason)
        return
    for sensor in robot.sensors:
        type = sensor.type.value
        if context.release and sensor.kind is SensorType.CPU_LIDAR:
            if _is_for_classic(robot, spawned):
                continue
            yield finding(
                sensor.type,
                f"sensor {sensor.name.value!r} has the type {type!r}, which "
                f"Gazebo {context.release.capitalize()} does not simulate: expected 'gpu_lidar'",
                key=f"lost {type}",
                fix=_type_fix(sensor, "gpu_lidar", Safety.UNSAFE),
            )
        elif type in _OLD:
            yield finding(
                sensor.type,
                f"sensor {sensor.name.value!r} has the type {type!r}, "
                f"the older name of {_OLD[type]!r}",
                severity=Severity.INFO,
                key=f"old {type}",
                fix=_type_fix(sensor, _OLD[type], Safety.SAFE),
            )


def _is_for_classic(robot: Robot, spawned: SpawnedFiles | None) -> bool:
    """Return whether Gazebo Classic gets the robot, and lidars for it are no fault of the robot."""
    if spawned is None or not spawned.is_in_both(robot):
        return False
    plugins = robot.all_plugins
    alone = plugins and all(classic_plugin(it.filename.value) is not None for it in plugins)
    beside = any(sensor.kind is SensorType.GPU_LIDAR for sensor in robot.sensors)
    return beside or bool(alone and spawned.misplaced(robot))


def _type_fix(sensor: Sensor, type: str, safety: Safety) -> Fix:
    """Return the fix that writes another type, and `<lidar>` for `<ray>`."""
    edits = [sensor.type.span.replacement(type)]
    edits += [name.replacement("lidar") for name in _old_names(sensor)]
    return Fix(safety, tuple(edits))


def _old_names(sensor: Sensor) -> Iterator[Span]:
    # With a <lidar> beside it, a second one would be one too many.
    if sensor.element.child("lidar") is None:
        for element in sensor.element.all("ray")[:1]:
            yield element.name_span
            if element.end_name_span is not None:
                yield element.end_name_span


def _sensor(type: str, mark: str = "") -> str:
    return f"""
<sensor name="front_laser" type="{type}">{mark}
  <ray><range><min>0.1</min><max>100</max></range></ray>
</sensor>
"""


_SPAWN = """<launch>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf')"/>
  </node>
  <node pkg="{}" exec="{}" args="-topic robot_description"/>
</launch>
"""


def _in_both(*types: str) -> dict[str, object]:
    """Return a rover with lidars of some types that is spawned into Classic and into Gazebo."""
    sensors = "".join(map(_sensor, types))
    return {
        "@bridge": True,
        "@profile": "ros2",
        "launch/rover.launch.py": None,
        "launch/classic.launch.xml": _SPAWN.format("gazebo_ros", "spawn_entity.py"),
        "launch/gazebo.launch.xml": _SPAWN.format("ros_gz_sim", "create"),
        "urdf/rover.urdf": '<robot name="rover"><link name="base"/>'
        f'<gazebo reference="base">{sensors}</gazebo>\n</robot>',
    }


_MARK = "  <!-- ^ SEN002 -->"
GOOD = [
    _sensor("gpu_lidar"),
    _in_both("ray", "gpu_lidar"),
    '<sensor name="imu" type="imu"/>',
    {"@profile": "gazebo-classic", "@fragment": _sensor("ray")},
]
BAD = [
    {**_in_both("ray"), "@reported": ["urdf/rover.urdf:2"]},
    *(_sensor(type, _MARK) for type in ("gpu_ray", "ray", "lidar")),
    '<sensor name="front_laser" type="gpu_ray"><ray/></sensor>  <!-- ^ SEN002 -->',
]
