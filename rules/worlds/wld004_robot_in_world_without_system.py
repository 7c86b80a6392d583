"""A robot that a launch file spawns into a world without a system that the robot needs.

Gazebo's systems belong to the world. UserCommands spawns the robot for `create`, Physics moves it,
and sensors give data only if their system runs: cameras and lidars need `gz-sim-sensors-system`, an
IMU `gz-sim-imu-system`. A world that names no plugin gets physics, user commands and the scene
broadcaster, and so does Gazebo's own `empty.sdf`: no sensor works there but those for contacts. No
message is printed at the launch; nothing is published on the topics.

It is an error if all plugins of the world and its robots are known. It is a warning if a model is
not available or a plugin is not Gazebo's, and if the world names no plugin, because a custom server
configuration may load more.

Fix: name the missing plugin in the world, or launch a world that has it.
Source: gz-sim, server.config, `SimulationRunner::LoadServerPlugins` and worlds/empty.sdf (from
memory); gazebosim/docs issue 433.
"""

from collections.abc import Iterator

from checker.base.record import Record
from checker.model.components import Sensor
from checker.model.world import EMPTY_SYSTEMS, World, holds, sensor_system
from checker.ros.servers import GazeboServer
from checker.ros.simulation import Simulation, Simulations
from checker.ros.spawned import SpawnedRobot
from checker.rule import Concern, Context, Findings, Severity, Where, finding, rule

_CONFIGURATIONS = ("GZ_SIM_SERVER_CONFIG_PATH", "IGN_GAZEBO_SERVER_CONFIG_PATH")
"""Variables that name another choice of systems for worlds that name none."""


class _Loaded(Record, eq=False):
    """A world that a server loads, and the systems that run in it."""

    server: GazeboServer
    world: World | None
    systems: frozenset[str]

    @property
    def called(self) -> str:
        """Name in messages."""
        return f"world {self.world.name!r}" if self.world is not None else self.server.own_world


@rule("WLD004", "robot-in-world-without-system", Severity.ERROR, Concern.INTERFACE)
def check(simulations: Simulations, context: Context) -> Findings:
    """Report each system that a launched world lacks once, with the robots' parts that need it."""
    for simulation in simulations.launched:
        for loaded in _loaded(simulation, context.release):
            for spawned in simulation.robots:
                yield from _missing_systems(simulation, loaded, spawned, context.release)


def _loaded(simulation: Simulation, release: str) -> Iterator[_Loaded]:
    changes = simulation.graph.environment if simulation.graph is not None else ()
    configured = any(change.name in _CONFIGURATIONS for change in changes)
    for server in simulation.servers:
        if server.own_world:
            systems = EMPTY_SYSTEMS | simulation.spawned_systems
            yield _Loaded(server, None, systems)
        for world in server.worlds:
            if not world.plugins and configured:
                continue
            systems = world.all_systems(release) | simulation.spawned_systems
            yield _Loaded(server, world, systems)


def _missing_systems(
    simulation: Simulation, loaded: _Loaded, spawned: SpawnedRobot, release: str
) -> Findings:
    severity = Severity.ERROR if _is_certain(simulation, loaded, spawned) else Severity.WARNING
    for system, effect, sensors in _effects(loaded, spawned, release):
        library = f"{'ignition-gazebo' if release == 'fortress' else 'gz-sim'}-{system}-system"
        yield finding(
            loaded.server,
            f"{effect}: {loaded.called} does not load {library}",
            severity=severity,
            key=f"{loaded.called} {system}",
            related=_related_places(loaded, spawned, sensors),
        )


def _effects(
    loaded: _Loaded, spawned: SpawnedRobot, release: str
) -> Iterator[tuple[str, str, list[Sensor]]]:
    """Yield each system that is missing, its effect, and the sensors that need it."""
    name = spawned.name or spawned.robot.name.value
    if not holds(loaded.systems, "user-commands"):
        yield "user-commands", f"{name!r} is not spawned", []
        return
    if not holds(loaded.systems, "physics") and not spawned.robot.is_static:
        yield "physics", f"{name!r} does not move", []
    silent: dict[str, list[Sensor]] = {}
    for sensor in spawned.robot.sensors:
        system = sensor_system(release, sensor)
        if system and not holds(loaded.systems, system):
            silent.setdefault(system, []).append(sensor)
    for system, sensors in silent.items():
        gives = "give" if len(sensors) > 1 else "gives"
        yield system, f"{_label(sensors)} of {name!r} {gives} no data", sensors


def _related_places(
    loaded: _Loaded, spawned: SpawnedRobot, sensors: list[Sensor]
) -> Iterator[tuple[Where, str]]:
    if loaded.world is not None:
        yield loaded.world, "this world"
    yield spawned.node, "spawned here"
    for sensor in sensors:
        yield sensor, "this sensor"


def _label(sensors: list[Sensor]) -> str:
    first = f"sensor {sensors[0].name.value!r}"
    others = len(sensors) - 1
    return f"{first} and {others} other{'s' if others > 1 else ''}" if others else first


def _is_certain(simulation: Simulation, loaded: _Loaded, spawned: SpawnedRobot) -> bool:
    """Return whether nothing else can load a system: all is known, and the world has plugins."""
    world = loaded.world
    if world is None or not world.is_settled or world.takes_server_plugins:
        return False
    return (
        not simulation.unknown_robots
        and not any(each.robot.missing_parts for each in simulation.robots)
        and loaded.server.starts is True
        and spawned.node.starts is True
    )


_EMPTY_WORLD = '("gz_args", "-r empty.sdf")'
_WORLD = '("gz_args", ["-r ", os.path.join(HERE, "worlds", "hall.sdf")])'


def _hall(*systems: str) -> str:
    plugins = "\n    ".join(
        f'<plugin filename="gz-sim-{system}-system" name=""/>' for system in systems
    )
    return f'<sdf version="1.9">\n  <world name="hall">\n    {plugins}\n  </world>\n</sdf>\n'


def _example(world: str, mark: str = "", gazebo: str = _WORLD) -> dict[str, object]:
    old = f"launch_arguments=[{_EMPTY_WORLD}]),"
    new = f"launch_arguments=[{gazebo}]),{mark}"
    return {"@bridge": True, "@launch": {old: new}, "worlds/hall.sdf": world}


def _with_variable(example: dict[str, object], name: str, value: str) -> dict[str, object]:
    """Return the example with a variable of Gazebo's that its launch file sets."""
    start, imported = "LaunchDescription([\n", "from launch.actions import "
    variable = f'SetEnvironmentVariable("{name}", {value}),\n'
    changes = {start: start + variable, imported: f"{imported}SetEnvironmentVariable, "}
    launch = example["@launch"]
    return {**example, "@launch": {**launch, **changes}} if isinstance(launch, dict) else example


def _by_name(world: str, folder: str, mark: str = "") -> dict[str, object]:
    """Return the example with a world that Gazebo finds by its name below the resource path."""
    example = _example(world, mark, gazebo='("gz_args", "-r hall.sdf")')
    return _with_variable(example, "GZ_SIM_RESOURCE_PATH", f'os.path.join(HERE, "{folder}")')


_MARK = "  # ^ WLD004"
_ALL = ("physics", "user-commands", "sensors")
GOOD = [
    _example(_hall(*_ALL)),
    _example(_hall(), gazebo='("gz_args", "-g")'),
    _example(_hall("physics"), gazebo='("gz_args", "-r somewhere.sdf")'),
    _with_variable(_example(_hall()), _CONFIGURATIONS[0], "HERE"),
    _by_name(_hall("physics"), "models"),
]
BAD = [
    _example(_hall("physics", "user-commands"), _MARK),
    _example(_hall("physics", "sensors"), _MARK),
    _example(_hall("user-commands", "sensors"), _MARK),
    _example('<sdf version="1.9"><world name="hall"/></sdf>', _MARK),
    _example(_hall(), _MARK, gazebo=_EMPTY_WORLD),
    _by_name(_hall("physics", "user-commands"), "worlds", _MARK),
]
