"""Lens distortion that the simulator does not render.

Gazebo Dome renders an undistorted image regardless of `<distortion>`, but still publishes the
coefficients in `camera_info`: a program that rectifies the image distorts it.

Fix: write 0 for all coefficients, or remove `<distortion>`.
Source: SubT review findings about distortion that "is not supported". From memory of gz-sensors,
later releases render it.
"""

from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule


@rule("SEN012", "ignored-distortion", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context, *, releases: tuple[str, ...] = ("dome",)) -> Findings:
    """Report coefficients that are not 0 on releases that ignore them.

    Options:
        releases: Names of Gazebo releases, in lower case, that do not render distortion; on other
            releases nothing is reported.
    """
    if context.release not in releases:
        return
    for sensor in robot.sensors:
        if sensor.camera is None or not sensor.kind.takes_pictures:
            continue
        bent = {name: k for name, k in sensor.camera.distortion.items() if k.value != 0.0}
        if bent:
            figures = ", ".join(f"{name} = {k.value:g}" for name, k in bent.items())
            yield finding(
                next(iter(bent.values())),
                f"camera {sensor.name.value!r} has distortion {figures}, which Gazebo "
                f"{context.release.capitalize()} publishes but does not render; expected 0",
                key="distortion",
            )


def _camera(distortion: str) -> str:
    return f"""
<sensor name="front" type="camera">
  <camera>
    <distortion>
      {distortion}
      <center>0.5 0.5</center>
    </distortion>
  </camera>
</sensor>
"""


GOOD = [
    _camera("<k1>0.0</k1><k2>0</k2><p1>0</p1>"),
    '<sensor name="front" type="camera"><camera/></sensor>',
]
BAD = [_camera("<k1>0</k1>\n<k2>0.04</k2>  <!-- ^ SEN012 -->\n<p1>0.001</p1>")]
