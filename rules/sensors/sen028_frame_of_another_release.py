"""A sensor that names the frame of its messages the way another release reads it.

Fortress reads `<ignition_frame_id>` and `<gz_frame_id>`, Harmonic `<gz_frame_id>`, Ionic and Jetty
`<frame_id>`. A sensor that has none of those that the target reads publishes in the frame
`model::link::sensor`, for which ROS rarely has a transform: this is a warning. An element that is
read, but that is not, or no longer, an element of SDFormat is an info: libsdformat prints a
warning, and the sensor uses the frame. In URDF this is not reported, because it has no other
element for the frame.

Fix: write the element of the release; a model for several releases contains several of them.
Source: gz-sim and gz-sensors, branches ign-gazebo6 to gz-sim10; SDFormat 1.12, sensor/frame_id.
"""

from collections.abc import Iterator

from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import FrameIds, frame_ids
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule
from checker.source.xml import Element

_OF_SDFORMAT = "optical_frame_id"
"""An element of SDFormat until 1.11."""


@rule("SEN028", "frame-of-another-release", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context) -> Findings:
    """Report names of frames that the target does not read, and those that it reads grudgingly."""
    frames = frame_ids(context.release)
    if frames is None:
        return
    release = context.release.capitalize()
    for sensor in robot.sensors:
        stated = {element.tag: element for element in _frame_elements(sensor, frames)}
        yield from _frames_not_read(sensor, stated, frames, release)
        if not robot.conventions.extension_tag:
            yield from _unknown_elements(stated, frames, release)


def _frame_elements(sensor: Sensor, frames: FrameIds) -> Iterator[Element]:
    camera = sensor.element.child("camera")
    for holder in (sensor.element, *((camera,) if camera is not None else ())):
        for child in holder.children:
            if child.tag in frames.read or child.tag in frames.others:
                yield child


def _frames_not_read(
    sensor: Sensor, stated: dict[str, Element], frames: FrameIds, release: str
) -> Iterator[Finding]:
    """Report a name that is not read, where no other names the frame."""
    if any(tag in frames.read and tag != _OF_SDFORMAT for tag in stated):
        return
    for tag, element in stated.items():
        if tag in frames.others:
            yield finding(
                element,
                f"{release} does not read <{tag}>, so sensor {sensor.name.value!r} publishes in "
                f"the frame of its own name; expected <{frames.read[0]}>",
                key=f"lost {tag}",
            )


def _unknown_elements(
    stated: dict[str, Element], frames: FrameIds, release: str
) -> Iterator[Finding]:
    """Report a name that is read, and of which libsdformat warns."""
    for tag, element in stated.items():
        if tag in frames.deprecated and "frame_id" not in stated:
            message = f"<{tag}> is deprecated since SDF 1.12; expected <frame_id>"
        elif tag in frames.read and tag not in (*frames.deprecated, "frame_id", _OF_SDFORMAT):
            message = f"<{tag}> is not an element of SDF: libsdformat warns, and {release} reads it"
        else:
            continue
        yield finding(element, message, severity=Severity.INFO, key=f"copied {tag}")


def _sensor(release: str, *tags: str, mark: str = "") -> dict[str, str]:
    frames = "\n".join(f"<{tag}>base_link</{tag}>" for tag in tags)
    inside = f'<sensor name="s" type="imu">\n{frames}{mark}\n</sensor>'
    return {"@profile": f"gazebo-{release}", "@fragment": inside}


_MARK = "  <!-- ^ SEN028 -->"
GOOD = [
    _sensor("jetty", "frame_id", "gz_frame_id"),
    _sensor("ionic", "frame_id"),
    '<sensor name="s" type="imu"><topic>imu</topic></sensor>',
]
BAD = [
    _sensor("harmonic", "frame_id", mark=_MARK),
    _sensor("harmonic", "ignition_frame_id", mark=_MARK),
    _sensor("harmonic", "gz_frame_id", mark=_MARK),
    _sensor("ionic", "gz_frame_id", mark=_MARK),
]
