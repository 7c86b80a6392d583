"""An IMU whose noise differs from the SubT standard.

An IMU without noise measures better than any device, and can track the robot's position for a whole
run. All robots of the SubT challenge have the same noise on each axis, so that no team profits from
its datasheet.

Fix: copy the figures of the message into `<angular_velocity>` and `<linear_acceleration>`, for x, y
and z.
Source: SubT maintainers require one noise model for all IMUs (`subt_standards.json`, imu).
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.resources import table
from checker.finding import Fix
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.imu import QUANTITIES, Imu
from checker.model.sensing.kind import SensorType
from checker.model.sensing.noise import Noise
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, rule
from checker.source.xml_insertion import append_to, insert_into

_GAUSSIAN = ("gaussian", "gaussian_quantized")
_UNITS = {"angular_velocity": "rad/s", "linear_acceleration": "m/s²"}

_Figures = Mapping[str, float]


@rule("SEN013", "imu-noise", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, *, tolerance: float = 0.01) -> Findings:
    """Compare the noise of IMUs with the standard.

    Options:
        tolerance: Share by which each figure of the noise may differ from the standard's; the mean
            must be exactly 0.
    """
    standards = {quantity: _standard(quantity) for quantity in QUANTITIES}
    for sensor in robot.sensors:
        if sensor.kind is not SensorType.IMU:
            continue
        imu = sensor.imu
        if imu is None or not imu.noises:
            yield finding(
                sensor if imu is None else imu,
                f"IMU {sensor.name.value!r} has no noise; expected the SubT standard: "
                + ", ".join(
                    f"{q} stddev {standards[q]['stddev']:g} {_UNITS[q]}" for q in QUANTITIES
                ),
                key="no noise",
                fix=_whole(imu, standards),
            )
            continue
        for quantity in QUANTITIES:
            yield from _axis_differences(sensor, imu, quantity, standards[quantity], tolerance)


def _standard(quantity: str) -> _Figures:
    entry: Mapping[str, Any] = table("subt_standards")["imu"][quantity]
    return {tag: float(value) for tag, value in entry.items() if tag != "type"}


def _axis_differences(
    sensor: Sensor, imu: Imu, quantity: str, standard: _Figures, tolerance: float
) -> Iterator[Finding]:
    """Yield the differences; axes with the same difference are one finding."""
    differences: dict[str, str] = {}
    for axis in "xyz":
        noise = imu.noises.get((quantity, axis))
        differences[axis] = _difference(noise, standard, tolerance)
    for axis, difference in differences.items():
        if not difference:
            continue
        noise = imu.noises.get((quantity, axis))
        axes = ", ".join(letter for letter in "xyz" if differences[letter] == difference)
        yield finding(
            noise or imu,
            f"IMU {sensor.name.value!r} has {quantity} ({_UNITS[quantity]}) on {axes} with "
            f"{difference}",
            key=f"{sensor.link}/{sensor.name.value} {quantity} {difference}",
            fix=None if noise is None else _figures_fix(noise, standard, tolerance),
        )


def _difference(noise: Noise | None, standard: _Figures, tolerance: float) -> str:
    """Return how noise differs from the standard; empty if it does not."""
    if noise is None:
        return "no noise, expected the SubT standard"
    if noise.type.value not in _GAUSSIAN:
        return f"noise of type {noise.type.value!r}, expected 'gaussian'"
    figures, wrong = noise.figures, _wrong(noise, standard, tolerance)
    return ", ".join(f"{tag} {figures[tag].value:g} (expected {wrong[tag]:g})" for tag in wrong)


def _wrong(noise: Noise, standard: _Figures, tolerance: float) -> _Figures:
    return {
        tag: expected
        for tag, expected in standard.items()
        if not math.isclose(noise.figures[tag].value, expected, rel_tol=tolerance)
    }


def _figures_fix(noise: Noise, standard: _Figures, tolerance: float) -> Fix:
    wrong = _wrong(noise, standard, tolerance)
    stated = {tag: value for tag, value in wrong.items() if noise.figures[tag].stated}
    edits = [noise.figures[tag].span.replacement(f"{value:g}") for tag, value in stated.items()]
    missing = [f"<{tag}>{value:g}</{tag}>" for tag, value in wrong.items() if tag not in stated]
    if missing:
        edits.append(append_to(noise.element, missing))
    if noise.type.value not in _GAUSSIAN and noise.type.stated:
        edits.append(noise.type.span.replacement("gaussian"))
    return Fix(Safety.UNSAFE, tuple(edits))


def _whole(imu: Imu | None, standards: Mapping[str, _Figures]) -> Fix | None:
    """Return the fix that writes all noise; none if the file already has parts of it."""
    if imu is None or any(imu.element.child(quantity) for quantity in standards):
        return None
    lines: list[str] = []
    for quantity, standard in standards.items():
        lines.append(f"<{quantity}>")
        for axis in "xyz":
            lines.extend((f"  <{axis}>", '    <noise type="gaussian">'))
            lines.extend(f"      <{tag}>{value:g}</{tag}>" for tag, value in standard.items())
            lines.extend(("    </noise>", f"  </{axis}>"))
        lines.append(f"</{quantity}>")
    return Fix(Safety.UNSAFE, (insert_into(imu.element, lines),))


_TURNING = """<mean>0</mean><stddev>0.009</stddev>
<bias_mean>0.00075</bias_mean><bias_stddev>0.005</bias_stddev>
<dynamic_bias_stddev>0.00002</dynamic_bias_stddev>
<dynamic_bias_correlation_time>400.0</dynamic_bias_correlation_time>
<precision>0.00025</precision>
"""
_PUSHING = """<mean>0</mean><stddev>0.021</stddev>
<bias_mean>0.05</bias_mean><bias_stddev>0.0075</bias_stddev>
<dynamic_bias_stddev>0.000375</dynamic_bias_stddev>
<dynamic_bias_correlation_time>175.0</dynamic_bias_correlation_time>
<precision>0.005</precision>
"""


def _imu(turning: str, pushing: str = _PUSHING, mark: str = "", kind: str = "gaussian") -> str:
    def axes(figures: str, mark: str, kind: str) -> str:
        noise = f'<noise type="{kind}">{mark}\n{figures}</noise>'
        return "".join(f"<{axis}>{noise}</{axis}>\n" for axis in "xyz")

    return f"""
<sensor name="imu_sensor" type="imu">
  <imu>
    <angular_velocity>{axes(turning, mark, kind)}</angular_velocity>
    <linear_acceleration>{axes(pushing, "", "gaussian")}</linear_acceleration>
  </imu>
</sensor>
"""


_MARK = "  <!-- ^ SEN013 -->"

GOOD = [
    _imu(_TURNING),
    _imu(_TURNING, kind="gaussian_quantized"),
    '<sensor name="compass" type="magnetometer"/>',
]
BAD = [
    '<sensor name="imu_sensor" type="imu"/>  <!-- ^ SEN013 -->',
    """
<sensor name="imu_sensor" type="imu">
  <imu>  <!-- ^ SEN013 -->
    <enable_orientation>0</enable_orientation>
  </imu>
</sensor>
""",
    _imu(_TURNING.replace("0.009", "2e-4"), mark=_MARK),
    _imu(_TURNING.replace("<precision>0.00025</precision>", ""), mark=_MARK),
    _imu(_TURNING, mark=_MARK, kind="none"),
    _imu(_TURNING).replace("<imu>", f"<imu>{_MARK}").replace("<x>", "<w>").replace("</x>", "</w>"),
]
