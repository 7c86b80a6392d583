"""A launch file spawns a satellite receiver into a world without a position on Earth.

Without `<spherical_coordinates>` in the world the NavSat system gives no positions, and prints a
message at each step. WLD003 reports receivers that the world itself contains.

Fix: add `<spherical_coordinates>` with latitude, longitude, elevation and heading to the world.
Source: gz-sim, NavSat system; osrf/mbari_wec_gz issue 148.
"""

from checker.model.sensing.kind import SensorType
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("WLD014", "receiver-without-coordinates", Severity.WARNING, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report each launched world once into which a receiver is spawned."""
    for simulation in simulations.launched:
        receivers = [
            (spawned, sensor)
            for spawned in simulation.robots
            for sensor in spawned.robot.sensors
            if sensor.kind is SensorType.NAVSAT
        ]
        servers = [it for it in simulation.servers if it.starts] if receivers else []
        for server, world in ((it, world) for it in servers for world in it.worlds):
            if world.element.child("spherical_coordinates") is None:
                spawned, sensor = receivers[0]
                yield finding(
                    server,
                    f"receiver {sensor.name.value!r} gives no positions: world {world.name!r}, "
                    "into which it is spawned, has no <spherical_coordinates>",
                    key=world.name,
                    related=[
                        (world, "this world"),
                        (spawned.node, "spawned here"),
                        (sensor, "the receiver"),
                    ],
                )


_GAZEBO = 'launch_arguments=[("gz_args", "-r empty.sdf")]),'
_HALL = 'launch_arguments=[("gz_args", ["-r ", os.path.join(HERE, "worlds", "hall.sdf")])]),'
_WORLD = '<sdf version="1.9"><world name="hall">{}</world></sdf>'
_PLACE = "<spherical_coordinates><latitude_deg>48</latitude_deg></spherical_coordinates>"


def _hall(content: str, type: str = "navsat", mark: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "@launch": {_GAZEBO: f"{_HALL}{mark}"},
        "worlds/hall.sdf": _WORLD.format(content),
        "urdf/rover.urdf": f"""<robot name="rover"><link name="base_link"/>
  <gazebo reference="base_link"><sensor name="place" type="{type}"/></gazebo></robot>""",
    }


GOOD = [_hall(_PLACE), _hall("", "imu")]
BAD = [_hall("", mark="  # ^ WLD014")]
