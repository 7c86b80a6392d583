"""Cameras and lidars that together render more than a simulation can.

One graphics card renders all pixels and rays of all robots, and the simulation waits for it: a
robot that needs hundreds of millions per second slows down the whole team's run.

Fix: reduce the resolution or the rate of the sensors that the report names first; the SubT standard
is 640×480 for depth, and 10 to 30 images per second.
Source: the accepted package that we checked with the highest load, four cameras of 3 megapixels at
15 Hz, needs 183 million pixels per second.
"""

import math
from collections.abc import Iterator

from checker.base.record import Record
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_NAMED = 5
"""Greatest number of sensors that the finding lists."""


class _Load(Record, eq=False):
    """The load of a sensor: its pixels or rays, and its rate."""

    sensor: Sensor
    amount: float
    rate: float
    unit: str

    @property
    def per_second(self) -> float:
        return self.amount * self.rate


@rule("SEN025", "render-load", Severity.INFO, Concern.INTERFACE)
def check(robot: Robot, *, most: float = 250e6) -> Findings:
    """Add up the pixels and rays per second; sensors without a rate do not count.

    Options:
        most: Pixels and rays per second that all cameras and lidars of a robot may render together;
            more is reported.
    """
    loads = sorted(_loads(robot), key=lambda load: load.per_second, reverse=True)
    total = sum(load.per_second for load in loads)
    if total > most:
        heaviest = loads[0]
        yield finding(
            heaviest.sensor,
            f"cameras and lidars render {total / 1e6:.3g} million pixels and rays per second, "
            f"{heaviest.per_second / 1e6:.3g} million of them for sensor "
            f"{heaviest.sensor.name.value!r}; expected {most / 1e6:g} million or fewer",
            key="render load",
            related=[(load.sensor, _words(load)) for load in loads[1:_NAMED]],
        )
    elif robot.missing_parts:
        yield unchecked(robot.missing_parts)


def _words(load: _Load) -> str:
    return f"{load.amount:,.0f} {load.unit} at {load.rate:g} Hz"


def _loads(robot: Robot) -> Iterator[_Load]:
    for sensor in robot.sensors:
        camera, lidar = sensor.camera, sensor.lidar
        if camera is not None and sensor.kind.takes_pictures:
            load = _Load(sensor, camera.pixels, sensor.update_rate.value, "pixels")
        elif lidar is not None and sensor.kind.is_lidar:
            load = _Load(sensor, lidar.rays, sensor.update_rate.value, "rays")
        else:
            continue
        # Other rules are for rates and sizes that are none.
        if load.amount > 0.0 and load.rate > 0.0 and math.isfinite(load.per_second):
            yield load


def _camera(name: str, width: int, height: int, rate: str, mark: str = "") -> str:
    return f"""
<sensor name="{name}" type="camera">{mark}
  {rate}
  <camera><image><width>{width}</width><height>{height}</height></image></camera>
</sensor>
"""


def _lidar(samples: int, rows: int, rate: int, mark: str = "") -> str:
    return f"""
<sensor name="lidar" type="gpu_lidar">{mark}
  <update_rate>{rate}</update_rate>
  <lidar><scan>
    <horizontal><samples>{samples}</samples></horizontal>
    <vertical><samples>{rows}</samples></vertical>
  </scan></lidar>
</sensor>
"""


_RATE = "<update_rate>30</update_rate>"
_MARK = "  <!-- ^ SEN025 -->"
_FULL = (1920, 1080, _RATE)
GOOD = [
    "".join(_camera(f"camera_{number}", *_FULL) for number in range(4)),
    # How often it renders is not said.
    _camera("front", 4096, 2160, ""),
    _lidar(1800, 64, 20),
    '<sensor name="imu" type="imu"><update_rate>1000</update_rate></sensor>',
]
BAD = [
    _camera("wide", 4096, 2160, _RATE, _MARK),
    _camera("wide", 3840, 2160, _RATE, _MARK) + _camera("front", *_FULL) + _lidar(1800, 64, 20),
    _lidar(100_000, 1000, 10, _MARK),
]
