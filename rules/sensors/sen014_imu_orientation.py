"""An IMU that publishes its true orientation.

Unless `<imu><enable_orientation>` is 0, the message contains the orientation of the robot in the
world without any error. This is ground truth, which teams must not use; the IMU works, so this is a
warning.

Fix: write `<enable_orientation>0</enable_orientation>` into `<imu>`; Gazebo does not read it
directly below `<sensor>`.
Source: SubT maintainers add it to every model; SDFormat specification, imu/enable_orientation.
"""

from checker.finding import Fix
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.rule import Concern, Context, Findings, Safety, Severity, finding, rule
from checker.source.xml_insertion import insert_into, removal

_OFF = "<enable_orientation>0</enable_orientation>"


@rule("SEN014", "imu-orientation", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context) -> Findings:
    """Report IMUs whose orientation is not switched off; only under SubT's rules is it mended."""
    for sensor in robot.sensors:
        if sensor.kind is not SensorType.IMU:
            continue
        imu = sensor.imu
        if imu is not None and not imu.enable_orientation.value:
            continue
        yield finding(
            imu.enable_orientation if imu is not None else sensor,
            f"IMU {sensor.name.value!r} publishes its true orientation{_cause(sensor)}; expected "
            "<enable_orientation>0 in <imu>",
            key="orientation",
            fix=_fix(sensor) if context.profile == "subt" else None,
        )


def _cause(sensor: Sensor) -> str:
    if sensor.element.child("enable_orientation") is not None:
        return ": <enable_orientation> is not read below <sensor>"
    stated = sensor.imu is not None and sensor.imu.enable_orientation.stated
    return "" if stated else ", which is the default"


def _fix(sensor: Sensor) -> Fix:
    imu = sensor.imu
    within = imu.element.child("enable_orientation") if imu is not None else None
    if imu is None:
        edit = insert_into(sensor.element, ["<imu>", f"  {_OFF}", "</imu>"])
    elif within is None:
        edit = insert_into(imu.element, [_OFF])
    elif within.text.stated:
        edit = within.text.span.replacement("0")
    else:
        edit = within.written.whole_span.replacement(_OFF)
    misplaced = (removal(element) for element in sensor.element.all("enable_orientation"))
    return Fix(Safety.SAFE, (edit, *misplaced))


GOOD = [
    """
<sensor name="imu" type="imu">
  <imu>
    <enable_orientation>0</enable_orientation>
  </imu>
</sensor>
<sensor name="front" type="camera"/>
""",
    """
<sensor name="imu" type="imu">
  <imu><enable_orientation>false</enable_orientation></imu>
</sensor>
""",
]
BAD = [
    '<sensor name="imu" type="imu"/>  <!-- ^ SEN014 -->',
    """
<sensor name="imu" type="imu">
  <imu>  <!-- ^ SEN014 -->
    <angular_velocity/>
  </imu>
</sensor>
""",
    """
<sensor name="imu" type="imu">
  <enable_orientation>0</enable_orientation>
  <imu>  <!-- ^ SEN014 -->
  </imu>
</sensor>
""",
    """
<sensor name="imu" type="imu">
  <imu>
    <enable_orientation>1</enable_orientation>  <!-- ^ SEN014 -->
  </imu>
</sensor>
""",
]
