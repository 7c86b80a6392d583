"""A satellite receiver in a world without a position on Earth.

Without `<spherical_coordinates>` the NavSat system gives no positions, and prints a message at each
step.

Fix: add `<spherical_coordinates>` with latitude, longitude, elevation and heading to the world.
Source: gz-sim, NavSat system; osrf/mbari_wec_gz issue 148.
"""

from checker.model.world import World
from checker.rule import Concern, Findings, Severity, finding, rule

_TYPES = ("navsat", "gps")


@rule("WLD003", "missing-spherical-coordinates", Severity.WARNING, Concern.INTERFACE)
def check(world: World) -> Findings:
    """Report the first receiver of a world without coordinates."""
    if world.element.child("spherical_coordinates") is not None:
        return
    receivers = [(model, it) for model, it in world.sensors() if it.type.value in _TYPES]
    for model, sensor in receivers[:1]:
        yield finding(
            world,
            f"world {world.name!r} has no <spherical_coordinates>, which sensor "
            f"{sensor.name.value!r} of {model.name.value!r} needs for positions",
            key=world.name,
        )


def _world(content: str, mark: str = "") -> str:
    return f"""
<sdf version="1.9">
  <world name="hall">{mark}
    {content}
    <model name="buoy"><link name="body"><sensor name="gps" type="navsat"/></link></model>
  </world>
</sdf>
"""


GOOD = [
    _world(
        "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>"
        "<latitude_deg>48</latitude_deg><longitude_deg>11</longitude_deg></spherical_coordinates>"
    ),
]
BAD = [_world("", "  <!-- ^ WLD003 -->")]
