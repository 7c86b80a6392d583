"""A configuration carries more than the first one, but weighs the same.

Sensors and breadcrumbs have mass: a configuration that adds them without mass accelerates and
climbs as if it carried nothing.

Only a configuration with its own model is compared, with the first available one. A configuration
that uses the model of a sibling weighs the same by design. The sibling's mass may be that of the
full robot; only its specification sheet can state that. Only separate devices count as sensors,
such as cameras and lidars, not the chips on a flight controller.

Fix: add the mass of the new parts to the link that carries them, or say in specifications.md that
the mass of the first configuration includes it.
Source: Model Migration Guide, step 4; experience of model reviews.
"""

from collections import Counter
from collections.abc import Iterator

from checker.model.first_configuration import FirstConfiguration
from checker.model.robot import Robot
from checker.physics.mass.mass_properties import MassProperties
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_DEVICES = ("camera", "lidar", "ray", "rgbd", "depth", "thermal", "sonar")


@rule("INE011", "payload-without-mass", Severity.INFO, Concern.ROBOT)
def check(
    masses: MassProperties, first: FirstConfiguration, *, breadcrumbs: bool = True
) -> Findings:
    """Report an own model that adds devices or breadcrumbs, but no mass.

    Options:
        breadcrumbs: Whether breadcrumbs that the first configuration does not carry count as added
            parts.
    """
    robot, base = masses.robot, first.robot
    if robot.span.source.file.startswith("../"):
        return
    missing = robot.unweighed or base.unweighed
    if missing:
        yield unchecked(missing)
        return
    added = list(_added_devices(robot, base))
    if breadcrumbs and _carries_breadcrumbs(robot) and not _carries_breadcrumbs(base):
        added.append("breadcrumbs")
    if added and abs(robot.mass - base.mass) <= 1e-6 * abs(base.mass):
        yield finding(
            robot,
            f"the model adds {', '.join(added)} to {first.name}, but weighs the same, "
            f"{base.mass:.4g} kg",
        )


def _added_devices(robot: Robot, base: Robot) -> Iterator[str]:
    """Yield what the robot has more of than the base, if it lacks nothing of the base."""
    own, others = _devices(robot), _devices(base)
    if not others - own:
        for kind, number in sorted((own - others).items()):
            yield f"{number} {kind}"


def _devices(robot: Robot) -> Counter[str]:
    types = (sensor.type.value.removeprefix("gpu_") for sensor in robot.sensors)
    return Counter(kind for kind in types if any(word in kind for word in _DEVICES))


def _carries_breadcrumbs(robot: Robot) -> bool:
    return any(plugin.class_name == "Breadcrumbs" for plugin in robot.plugins)


def _model(number: int, *sensors: str, mass: float = 50.0, mark: str = "") -> str:
    heads = "".join(
        f'<sensor name="{kind}_{place}" type="{kind}"/>' for place, kind in enumerate(sensors)
    )
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_{number}">{mark}
<link name="base_link"><inertial><mass>{mass}</mass></inertial>{heads}</link>
</model>
</sdf>
"""


def _second(fragment: str) -> dict[str, str]:
    return {
        "@name": "acme_rover_sensor_config_2",
        "@fragment": fragment,
        "../acme_rover_sensor_config_1/package.xml": "<package/>",
        "../acme_rover_sensor_config_1/model.sdf": _model(1, "camera", "imu"),
        "../acme_rover_sensor_config_1/launch/spawner.rb": (
            "def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)\n"
            "  \"<spawn name='#{_name}'/>\"\nend\n"
        ),
    }


GOOD = [
    _second(_model(2, "camera", "gpu_lidar", "imu", mass=50.8)),
    _second(_model(2, "camera", "imu", "air_pressure")),
    _second(_model(2, "gpu_lidar", "imu")),
]
BAD = [_second(_model(2, "camera", "gpu_lidar", "imu", mark="  <!-- ^ INE011 -->"))]
