"""A lidar whose scan resolution is not 1.

The resolution multiplies the samples: with 0.1 the sensor publishes a tenth of the points that it
measures, and with 0.03 a row of 920 samples becomes one of 28. Despite its name it is not an angle
or a distance; the resolution of distances is in `<range>`.

Fix: write `<resolution>1</resolution>`, and as many samples as the device has.
Source: reviews of SubT models, which required 1 instead of 0.1 and 0.03; sdformat, lidar.sdf.
"""

from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule


@rule("SEN005", "lidar-scan-resolution", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, *, expected: float = 1.0) -> Findings:
    """Report lidars whose rows have an unexpected resolution.

    Options:
        expected: Points published for each sample of a row; any other `<resolution>` in the file is
            reported, and the fix writes this one.
    """
    for sensor in robot.sensors:
        if sensor.lidar is None or not sensor.kind.is_lidar:
            continue
        resolution = sensor.lidar.horizontal.resolution
        if resolution.stated and resolution.value != expected:
            yield finding(
                resolution,
                f"lidar {sensor.name.value!r} has the scan resolution {resolution.value:g}, "
                f"expected {expected:g}",
                key=f"{resolution.value:g}",
                fix=replace_text(resolution, f"{expected:g}"),
            )


def _lidar(resolution: str) -> str:
    return f"""
<sensor name="front_laser" type="gpu_lidar">
  <lidar>
    <scan>
      <horizontal>
        <samples>1800</samples>
        {resolution}
      </horizontal>
    </scan>
    <range><resolution>0.01</resolution></range>
  </lidar>
</sensor>
"""


_MARK = "  <!-- ^ SEN005 -->"
GOOD = [_lidar(""), _lidar("<resolution>1</resolution>"), _lidar("<resolution>1.0</resolution>")]
BAD = [
    _lidar("<resolution>0.1</resolution>" + _MARK),
    _lidar("<resolution>0.03</resolution>" + _MARK),
]
