"""A sensor that does not read the topic of camera_info that it states.

Cameras, depth cameras and thermal cameras of Gazebo Sim publish camera_info on
`<camera_info_topic>`. An RGBD camera does not read it: its camera_info is always on
`<topic>/camera_info`, and so is that of a segmentation camera. A bridge from the stated topic
starts, but no message ever arrives.

Fix: write the topic that the message names into the bridge, and remove `<camera_info_topic>`.
Source: gz-sensors, RgbdCameraSensor::Load and SegmentationCameraSensor::Load, AdvertiseInfo.
"""

from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.ros.simulated_topics import likely_topics
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.text import Located

_INFO = "CameraInfo"


@rule("SEN030", "unread-camera-info-topic", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context) -> Findings:
    """Report the topics of camera_info that their sensors do not use."""
    if context.is_classic:
        return
    for topic in likely_topics(robot):
        sensor = topic.owner
        if not isinstance(sensor, Sensor) or _INFO not in topic.messages:
            continue
        stated = _stated(sensor)
        if stated is not None and stated.value.strip(" /") != topic.topic.strip("/"):
            yield finding(
                stated,
                f"{sensor.type.value} sensor {sensor.name.value!r} does not read "
                f"<camera_info_topic>: its camera_info is on {topic.topic}",
            )


def _stated(sensor: Sensor) -> Located[str] | None:
    camera = sensor.element.child("camera")
    tag = camera.child("camera_info_topic") if camera is not None else None
    return tag.text if tag is not None and tag.text.value.strip() else None


def _camera(kind: str, topic: str, mark: str = "") -> dict[str, str]:
    return {
        "@profile": "gazebo-harmonic",
        "@fragment": f"""
<sensor name="eye" type="{kind}">
  <topic>front</topic>
  <camera>
    <camera_info_topic>{topic}</camera_info_topic>{mark}
  </camera>
</sensor>
""",
    }


GOOD = [
    _camera("camera", "eye/info"),
    _camera("depth_camera", "eye/info"),
    _camera("rgbd_camera", "/front/camera_info"),
]
BAD = [_camera("rgbd_camera", "eye/camera_info", "  <!-- ^ SEN030 -->")]
