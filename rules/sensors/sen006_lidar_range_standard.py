"""A lidar whose range resolution or noise differs from the SubT standard.

All robots of a competition have sensors of the same quality: ranges in steps of 0.01 m with a noise
of 0.01 m, unless the device's own figures are known. A lidar without noise is more precise than any
real one.

Fix: write `<range><resolution>0.01</resolution>` and a Gaussian `<noise>` with the `<stddev>` 0.01.
Source: reviews of SubT models, which required 0.01 instead of 0.003 and 0.03 for Ouster lidars
(`subt_standards.json`, `devices.json`). The published model of the Ouster OS-1 has 0.008.
"""

from checker.base.resources import table
from checker.base.words import or_list
from checker.model.components import Sensor
from checker.model.devices.devices import Device, SensorDevices
from checker.model.robot import Robot
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule
from checker.source.text import Located

_PROFILE = "subt"
_WORDS = {
    "range_resolution": "the range resolution",
    "noise_stddev": "noise with the standard deviation",
}


@rule("SEN006", "lidar-range-standard", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot,
    devices: SensorDevices,
    context: Context,
    *,
    tolerance: float = 0.01,
    grave: float = 5.0,
) -> Findings:
    """Report missing noise and wrong figures; an info if no device is known.

    Options:
        tolerance: Share by which range resolution and noise may differ from the device's own
            figures, else from SubT's 0.01 m.
        grave: Multiple of the expected figure; a figure above it is a warning even if no datasheet
            confirms the expected one.
    """
    if context.profile != _PROFILE:
        return
    for sensor in robot.sensors:
        lidar = sensor.lidar
        if lidar is None or not sensor.kind.is_lidar:
            continue
        known = devices.device_of(sensor)
        device = known.device if known is not None else None
        noise = lidar.noise
        figures = {"range_resolution": lidar.range_resolution}
        if noise is not None and noise.type.value != "none":
            figures["noise_stddev"] = noise.stddev
        else:
            yield finding(
                lidar if noise is None else noise.type,
                f"lidar {sensor.name.value!r} has "
                + (f"no noise in its <{lidar.element.tag}>" if noise is None else "noise 'none'")
                + ", expected a standard deviation of "
                f"{or_list(_expected_figures(device, 'noise_stddev'))} m",
                key="no noise",
            )
        for figure, value in figures.items():
            expected = _expected_figures(device, figure)
            if value.stated and not any(abs(value.value - e) <= tolerance * e for e in expected):
                yield _finding(sensor, device, figure, value, expected, grave)


def _expected_figures(device: Device | None, figure: str) -> list[float]:
    """Return the accepted figures of a device, else the standard."""
    values = device.values if device is not None else {}
    expected = [float(values.get(figure, table("subt_standards")["lidar"][figure]))]
    own = values.get("seed_defaults", {}).get(figure)
    return expected if own is None else [*expected, float(own)]


def _finding(
    sensor: Sensor,
    device: Device | None,
    figure: str,
    value: Located[float],
    expected: list[float],
    grave: float,
) -> Finding:
    own = device if device is not None and figure in device.values else None
    sure = own is not None and not own.is_from_memory(figure)
    sure = sure or value.value > grave * max(expected)
    return finding(
        value,
        f"lidar {sensor.name.value!r} has {_WORDS[figure]} {value.value:g} m, "
        f"expected {or_list(expected)} m" + (f" ({own.name})" if own is not None else ""),
        severity=None if sure else Severity.INFO,
        key=f"{figure} {value.value:g} {own.id if own is not None else ''}",
    )


_NOISE = "<noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise>"


def _lidar(resolution: str = "0.01", noise: str = _NOISE, mark: str = "", name: str = "os1") -> str:
    return f"""
<sensor name="{name}" type="gpu_lidar">
  <lidar>{mark}
    <range><min>0.8</min><max>120</max>
      <resolution>{resolution}
    </range>
    {noise}
  </lidar>
</sensor>
"""


_END, _MARK = "</resolution>", "  <!-- ^ SEN006 -->"
_FINE = "0.01" + _END
GOOD = [
    _lidar(_FINE),
    _lidar(_FINE, _NOISE.replace("0.01", "0.008")),
    _lidar("0.03" + _END, name="rplidar_s1"),
    _lidar(_FINE, name="scanner"),
    _lidar(_FINE).replace("<resolution>0.01</resolution>", ""),
]
BAD = [
    _lidar("0.003" + _END + _MARK),
    _lidar("0.001" + _END + _MARK, name="scanner"),
    _lidar(_FINE, _NOISE.replace("0.01", "0.03") + _MARK),
    _lidar("0.1" + _END + _MARK, name="scanner"),
    _lidar(_FINE, "", _MARK),
    _lidar(_FINE, "<noise><type>none</type></noise>" + _MARK),
]
