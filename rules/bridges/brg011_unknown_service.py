"""A bridge of a service that it does not support, or that does not exist in Gazebo.

The bridge passes few services: `ros_gz_interfaces/srv/ControlWorld` to Gazebo's
`/world/<world>/control`. For any other type it warns "Failed to create a bridge" and continues
without the service. Services that were added to the bridge after October 2024 are not known here:
they are infos. The name of the world is the one in its file: with another name, calls wait forever.

Fix: write the type as the message names it, and the name of the world in its file.
Source: ros_gz_bridge, mappings.py and `create_service_bridge`.
"""

from collections.abc import Iterator

from checker.base.words import and_list
from checker.launch.ros2.bridges.entry import BridgedService, gz_name
from checker.launch.ros2.graph import is_known
from checker.ros.bridge_types import meant_service, service_messages
from checker.ros.simulation import Simulation, Simulations
from checker.rule import Concern, Finding, Findings, Severity, finding, rule


@rule("BRG011", "unknown-service", Severity.ERROR, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report services of another type, with other messages, or of another world."""
    for simulation in simulations.all:
        for service in simulation.bridges.services:
            if service.is_own and is_known(service.name.value + service.ros_type.value):
                yield from _types(service)
                yield from _world(service, simulation)


def _types(service: BridgedService) -> Iterator[Finding]:
    ros_type = service.ros_type
    messages = service_messages(ros_type.value)
    if messages is None:
        meant = meant_service(ros_type.value)
        yield finding(
            ros_type,
            f"the bridge is not known to pass services of type {ros_type.value!r:.200}"
            + (f"; expected {meant}" if meant else ""),
            severity=None if meant else Severity.INFO,
        )
        return
    for stated, message in zip(service.gz_types, messages, strict=False):
        if is_known(stated.value) and gz_name(stated.value) != message:
            yield finding(
                stated,
                f"the bridge does not pass {stated.value!r:.200} for {ros_type.value}; expected "
                f"gz.msgs.{message}",
            )


def _world(service: BridgedService, simulation: Simulation) -> Iterator[Finding]:
    """Report a service of a world of another name than those that the launch file loads."""
    missing = simulation.missing_world(service.name.value)
    if missing:
        yield finding(
            service.name,
            f"the service is of the world {missing!r}, but the launch file loads "
            f"{and_list(sorted(simulation.world_names))}",
            severity=Severity.WARNING,
        )


_MARK = "  # ^ BRG011"
_CONTROL = "ros_gz_interfaces/srv/ControlWorld"


def _service(
    ros_type: str = _CONTROL, gz: str = "gz.msgs.WorldControl", name: str = "/world/empty/control"
) -> dict[str, object]:
    return {
        "@bridge": f"- service_name: {name}\n"
        f"  ros_type_name: {ros_type}\n  gz_req_type_name: {gz}\n"
        "  gz_rep_type_name: gz.msgs.Boolean\n"
    }


def _argument(text: str, mark: str = "") -> dict[str, object]:
    changed = f'arguments=["{text}"],{mark}\n'
    return {
        "@bridge": True,
        "@launch": {
            "arguments=[],": changed,
            '("gz_args", "-r empty.sdf")': '("gz_args", ["-r ", HERE, "/hall.sdf"])',
        },
        "hall.sdf": '<sdf version="1.9"><world name="hall"/></sdf>',
    }


GOOD = [
    _service(),
    _argument(f"/world/hall/control@{_CONTROL}"),
    _argument(f"/world/hall/control@{_CONTROL}@ignition.msgs.WorldControl@ignition.msgs.Boolean"),
]
BAD = [
    _service(f"ros_gz_interfaces/srv/control_world{_MARK}"),
    _service(f"std_srvs/srv/Empty{_MARK}"),
    _service(gz=f"gz.msgs.Boolean{_MARK}"),
    _service(name=f"/world/hall/control{_MARK}"),
    _argument(f"/world/default/control@{_CONTROL}", _MARK),
]
