"""A sensor in a world that does not load the system that simulates it.

Sensors are simulated by systems of the world: cameras and lidars need `gz-sim-sensors-system`, an
IMU `gz-sim-imu-system`. Without it the topic of the sensor does not exist, and Gazebo prints no
message. Into a world that names no plugin, Gazebo loads only physics, user commands and the scene
broadcaster, but a custom server configuration may load more. This is a warning for such a world,
and if a model is not available or a plugin is not Gazebo's own; otherwise it is an error.

Fix: add the plugin to the world.
Source: gz-sim, server.config and the tutorial "Sensors"; gazebosim/docs issue 433.
"""

from collections.abc import Iterator

from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.world import World, holds, sensor_system
from checker.rule import Concern, Context, Findings, Severity, finding, rule


@rule("WLD001", "sensor-without-system", Severity.ERROR, Concern.INTERFACE)
def check(world: World, context: Context) -> Findings:
    """Report each system that is missing once, with the sensors that need it."""
    missing: dict[str, list[tuple[Robot, Sensor]]] = {}
    for model, sensor in world.sensors():
        system = sensor_system(context.release, sensor)
        if system and not holds(world.systems, system):
            missing.setdefault(system, []).append((model, sensor))
    settled = world.is_settled and not world.takes_server_plugins
    for system, sensors in missing.items():
        library = f"{_prefix(context.release)}-{system}-system"
        yield finding(
            world,
            f"{_label(sensors)} no data: no plugin in world {world.name!r} loads {library}",
            severity=None if settled else Severity.WARNING,
            key=f"{world.name} {system}",
            related=_own_sensors(world, sensors),
        )


def _prefix(release: str) -> str:
    return "ignition-gazebo" if release == "fortress" else "gz-sim"


def _label(sensors: list[tuple[Robot, Sensor]]) -> str:
    model, sensor = sensors[0]
    first = f"sensor {sensor.name.value!r} of {model.name.value!r}"
    if len(sensors) == 1:
        return f"{first} gives"
    others = f"{len(sensors) - 1} other{'s' if len(sensors) > 2 else ''}"
    return f"{first} and {others} give"


def _own_sensors(world: World, sensors: list[tuple[Robot, Sensor]]) -> Iterator[tuple[Sensor, str]]:
    """Yield the sensors that are in the world's own file."""
    file = world.span.source.file
    for _, sensor in sensors:
        if sensor.span.source.file == file:
            yield sensor, "this sensor"


def _world(plugins: str, mark: str = "") -> str:
    return f"""
<sdf version="1.9">
  <world name="hall">{mark}
    <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics"/>
    {plugins}
    <model name="post">
      <static>true</static>
      <link name="head">
        <sensor name="imu" type="imu"/>
        <sensor name="camera" type="camera">
          <camera><horizontal_fov>1</horizontal_fov></camera>
        </sensor>
      </link>
    </model>
  </world>
</sdf>
"""


_IMU = '<plugin filename="gz-sim-imu-system" name="gz::sim::systems::Imu"/>'
_SENSORS = '<plugin filename="gz-sim-sensors-system" name="gz::sim::systems::Sensors"/>'
GOOD = [
    _world(_IMU + _SENSORS),
    _world(_IMU + '<plugin filename="libgz-sim8-sensors-system.so" name="x"/>'),
]
BAD = [
    _world(_SENSORS, "  <!-- ^ WLD001 -->"),
    _world(_IMU, "  <!-- ^ WLD001 -->"),
]
