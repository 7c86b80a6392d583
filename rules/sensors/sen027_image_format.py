"""An image format that the simulator does not support.

A camera of Gazebo Dome publishes only R8G8B8: with another format it prints an error, and the
pixels do not match the topic. With a name that SDFormat does not know, the file does not load.

Fix: write `<format>R8G8B8</format>`; for grey images, convert them on the robot.
Source: `camera_formats.json`; what libsdformat 12 refuses; the formats of each release are from
memory of gz-sensors.
"""

from collections.abc import Mapping, Sequence

from checker.base.resources import table
from checker.base.words import Suggestions
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.rule import (
    Concern,
    Context,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    respelling,
    rule,
)

_SHOWN = 40


@rule("SEN027", "image-format", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context) -> Findings:
    """Report unknown formats, and formats of colour cameras that the release lacks."""
    formats = table("camera_formats")
    names: Mapping[str, str] = formats["names"]
    rendered = formats["rendered"].get(context.release, names.values())
    suggestions = Suggestions(names)
    for sensor in robot.sensors:
        camera = sensor.camera
        if camera is None or not sensor.kind.takes_pictures or not camera.format.stated:
            continue
        format_name, severity = camera.format.value, Severity.WARNING
        if format_name not in names:
            severity = Severity.ERROR
            fault = f", which SDFormat does not know{suggestions.hint(format_name)}"
        elif sensor.kind is SensorType.CAMERA and names[format_name] not in rendered:
            release = f"Gazebo {context.release.capitalize()}"
            fault = f"; cameras of {release} support {_format_list(rendered, names)}"
        else:
            continue
        message = f"camera {sensor.name.value!r} has format {format_name[:_SHOWN]!r}{fault}"
        fix = respelling(camera.format, suggestions) if format_name not in names else None
        if sensor.kind is SensorType.CAMERA and len(rendered) == 1:
            fix = replace_text(camera.format, _format_list(rendered, names), Safety.UNSAFE)
        yield finding(camera.format, message, severity=severity, key=format_name, fix=fix)


def _format_list(formats: Sequence[str], names: Mapping[str, str]) -> str:
    """Return the formats by the names that people write: `R8G8B8` for `RGB_INT8`."""
    usual = {meant: name for name, meant in reversed(list(names.items()))}
    return ", ".join(usual[key] for key in formats)


def _camera(format_: str, kind: str = "camera") -> str:
    return f"""
<sensor name="front" type="{kind}">
  <camera>
    <image>
      {format_}
    </image>
  </camera>
</sensor>
"""


_MARK = "  <!-- ^ SEN027 -->"

GOOD = [
    _camera("<format>R8G8B8</format>"),
    _camera("<format>RGB_INT8</format>"),
    _camera(""),
    _camera("<format>R_FLOAT32</format>", "depth_camera"),
    _camera("<format>L16</format>", "thermal"),
]
BAD = [
    _camera(f"<format>B8G8R8</format>{_MARK}"),
    _camera(f"<format>L8</format>{_MARK}"),
    _camera(f"<format>RGB888</format>{_MARK}"),
    _camera(f"<format>R8G8B</format>{_MARK}", "rgbd_camera"),
]
