"""A thermal camera with other settings than the SubT standard.

Only the system ThermalSensor, inside `<sensor>`, gives a thermal camera its 8-bit image and its
temperature range. Without it, or with other settings, a pixel value represents another temperature
than detectors expect.

Fix: write `<format>L8` and, inside `<sensor>`, the plugin `ignition-gazebo-thermal-sensor-system`
with min_temp 253.15, max_temp 673.15 and resolution 1.6.
Source: SubT review findings (`subt_standards.json`, thermal). SEN011 checks the clip distances,
SEN010 the pixels.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.resources import table
from checker.model.components import Plugin, Sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule

_CLASS = "ThermalSensor"
_EIGHT_BITS = ("L8", "L_INT8")
_UNITS = {"min_temp": " K", "max_temp": " K", "resolution": " K"}


@rule("SEN016", "thermal-camera", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context, *, tolerance: float = 0.01) -> Findings:
    """Compare thermal cameras with SubT's.

    Options:
        tolerance: Share by which `<min_temp>`, `<max_temp>` and `<resolution>` may differ from
            SubT's figures.
    """
    if context.profile != "subt":
        return
    standard = table("subt_standards")["thermal"]
    for sensor in robot.sensors:
        if sensor.kind is not SensorType.THERMAL_CAMERA:
            continue
        yield from _format(sensor)
        plugin = next(
            (candidate for candidate in sensor.plugins if candidate.class_name == _CLASS), None
        )
        if plugin is None:
            yield finding(
                sensor,
                f"thermal camera {sensor.name.value!r} has no plugin of class {_CLASS}; expected "
                f"{standard['plugin_filename']!r}",
                key="no plugin",
            )
        else:
            yield from _figures(sensor, plugin, standard, tolerance)


def _format(sensor: Sensor) -> Iterator[Finding]:
    camera = sensor.camera
    if camera is not None and camera.format.value not in _EIGHT_BITS:
        stated = f"format {camera.format.value!r}" if camera.format.stated else "no <format>"
        yield finding(
            camera.format,
            f"thermal camera {sensor.name.value!r} has {stated}, expected 'L8'",
            key=stated,
        )


def _figures(
    sensor: Sensor, plugin: Plugin, standard: Mapping[str, Any], tolerance: float
) -> Iterator[Finding]:
    for tag, unit in _UNITS.items():
        expected = standard[tag]
        value = plugin.number(tag)
        if value is None:
            stated = f"no {tag}"
        elif math.isclose(value.value, expected, rel_tol=tolerance):
            continue
        else:
            stated = f"{tag} {value.value:g}{unit}"
        yield finding(
            value or plugin,
            f"thermal camera {sensor.name.value!r} has {stated}, expected {expected:g}{unit}",
            key=stated,
        )


def _camera(image: str, plugin: str, mark: str = "") -> str:
    return f"""
<sensor name="thermal_camera" type="thermal">{mark}
  <camera>
    <image>
      <width>320</width><height>256</height>
      {image}
    </image>
  </camera>
  {plugin}
</sensor>
"""


def _plugin(figures: str, mark: str = "") -> str:
    return f"""
  <plugin filename="ignition-gazebo-thermal-sensor-system" name="gz::ThermalSensor">{mark}
    {figures}
  </plugin>
"""


_FIGURES = "<min_temp>253.15</min_temp><max_temp>673.15</max_temp>\n<resolution>1.6</resolution>"
_MARK = "  <!-- ^ SEN016 -->"

GOOD = [
    _camera("<format>L8</format>", _plugin(_FIGURES)),
    _camera("<format>L_INT8</format>", _plugin(_FIGURES)),
    '<sensor name="front" type="camera"><camera/></sensor>',
]
BAD = [
    _camera("<format>L8</format>", "", _MARK),
    _camera(f"<format>L16</format>{_MARK}", _plugin(_FIGURES)),
    """
<sensor name="thermal_camera" type="thermal_camera">  <!-- ^ SEN016 -->
  <camera>
    <image>  <!-- ^ SEN016 -->
      <width>320</width>
    </image>
  </camera>
</sensor>
""",
    _camera("<format>L8</format>", _plugin(f"{_FIGURES.replace('1.6', '3.0')}{_MARK}")),
    _camera(
        "<format>L8</format>",
        _plugin(_FIGURES.replace("<resolution>1.6</resolution>", ""), _MARK),
    ),
]
