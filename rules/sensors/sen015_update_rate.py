"""A sensor without a sensible update rate.

Without `<update_rate>`, or with 0, a sensor measures at every simulation step, a thousand times per
second. A camera or lidar then slows down the simulation, and no device is that fast. A negative
rate has no meaning; a 0 that is written for a cheap sensor, such as an IMU, is an info outside
SubT. Most IMUs in the SubT challenge measure 50 times per second; another rate is an info.

Fix: write the rate of the device, in hertz.
Source: SDFormat specification, sensor/update_rate; SubT model reviews; the robots of the challenge.
"""

from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.rule import Concern, Context, Findings, Severity, finding, rule

EXEMPT = (SensorType.CONTACT, SensorType.NAVSAT, SensorType.OTHER)
"""Sensors that measure on events, and those that SEN001 reports."""
CHEAP = (
    SensorType.IMU,
    SensorType.MAGNETOMETER,
    SensorType.AIR_PRESSURE,
    SensorType.ALTIMETER,
)
"""Sensors that neither render nor cast rays."""


@rule("SEN015", "update-rate", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context, *, imu_rate: float = 50.0) -> Findings:
    """Report rates that are missing, 0 or negative; in SubT also IMUs with an unusual one.

    Options:
        imu_rate: Hertz at which IMUs usually measure in the SubT profile; any other rate is an
            info.
    """
    for sensor in robot.sensors:
        if sensor.kind in EXEMPT:
            continue
        rate = sensor.update_rate
        if not rate.value > 0.0:
            yield finding(
                rate,
                f"{_name(sensor)} has {_rate(sensor)}; expected the device's rate in hertz",
                key=f"{sensor.kind} {rate.value:g} {rate.stated}",
                severity=Severity.INFO if _is_chosen(sensor, context) else None,
            )
        elif sensor.kind is SensorType.IMU and context.profile == "subt" and rate.value != imu_rate:
            yield finding(
                rate,
                f"{_name(sensor)} measures at {rate.value:g} Hz, but most IMUs of the SubT "
                f"challenge measure at {imu_rate:g} Hz",
                severity=Severity.INFO,
            )


def _is_chosen(sensor: Sensor, context: Context) -> bool:
    """Return whether a 0 is written for a sensor that costs nothing at every step."""
    rate = sensor.update_rate
    written = rate.stated and rate.value == 0.0
    return written and sensor.kind in CHEAP and context.profile != "subt"


def _name(sensor: Sensor) -> str:
    kind = "IMU" if sensor.kind is SensorType.IMU else sensor.kind.replace("_", " ")
    return f"{kind} {sensor.name.value!r}"


def _rate(sensor: Sensor) -> str:
    rate = sensor.update_rate
    if not rate.stated:
        return "no <update_rate>, so it measures at every step"
    if rate.value < 0.0:
        return f"<update_rate> {rate.value:g} Hz"
    return f"<update_rate> {rate.value:g}, so it measures at every step"


def _sensor(kind: str, rate: str) -> str:
    return f"""
<sensor name="it" type="{kind}">
  {rate}
</sensor>
"""


GOOD = [
    _sensor("imu", "<update_rate>50</update_rate>"),
    _sensor("camera", "<update_rate>8.6</update_rate>"),
    _sensor("contact", "<always_on>1</always_on>"),
    _sensor("contact", "<update_rate>0</update_rate>"),
]
BAD = [
    '<sensor name="it" type="gpu_lidar">  <!-- ^ SEN015 -->\n</sensor>',
    _sensor("camera", "<update_rate>0</update_rate>  <!-- ^ SEN015 -->"),
    _sensor("magnetometer", "<update_rate>-1</update_rate>  <!-- ^ SEN015 -->"),
    _sensor("imu", "<update_rate>250</update_rate>  <!-- ^ SEN015 -->"),
]
