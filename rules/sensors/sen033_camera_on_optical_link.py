"""A camera is attached to an optical link, and looks to its side.

Gazebo's cameras look along the x axis of their link, with z up. An optical link is turned for
images: its z axis points ahead, and its x axis to the right. A camera on it without a pose of its
own looks to the right, and its image lies on its side.

It is reported where the link's name contains `optical`, its joint turns it by `-1.5708 0 -1.5708`,
and the camera looks at a right angle to the link's z axis.

Fix: attach the sensor to the camera's link, and name the optical link as the frame of its messages:
`<gz_frame_id>` or `<optical_frame_id>` in Gazebo Sim, `<frame_name>` of the plugin in Classic.
Source: REP 103, suffix frames; SDFormat specification, `<camera>`: it looks along x.
"""

import math

from checker.model.geometry.transform import Transform, dot
from checker.model.robot import Robot
from checker.model.sensing.mounts import mounted_sensors
from checker.rule import Concern, Findings, Severity, finding, rule

_ACROSS = math.sin(math.radians(20))
"""Cosine up to which two directions count as at a right angle."""
_ALONG = math.cos(math.radians(20))
"""Cosine from which two directions count as one."""
_X, _Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
_DOWN = (0.0, -1.0, 0.0)
"""Up, in an optical frame."""


@rule("SEN033", "camera-on-optical-link", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report cameras that look at a right angle to the z axis of the optical link they are on."""
    if robot.shown_only:
        return
    joints = {joint.child.value: joint for joint in robot.joints}
    for mounted in mounted_sensors(robot):
        name, looking = mounted.owner.name.value, mounted.looking
        joint = joints.get(name)
        if "optical" not in name.lower() or joint is None or not mounted.sensor.kind.takes_pictures:
            continue
        pose, parent = robot.pose_of(name), robot.pose_of(joint.parent.value)
        if pose is None or parent is None or looking is None or not _is_optical(pose, parent):
            continue
        if abs(dot(looking, pose.rotate(_Z))) < _ACROSS:
            yield finding(
                mounted.sensor,
                f"camera {mounted.sensor.name.value!r} looks to the side: it is on {name!r}, whose "
                f"z axis points ahead, and cameras look along x: attach it to "
                f"{joint.parent.value!r}, and name {name!r} as its frame",
                key=name,
                related=[(joint, "turns the link")],
            )


def _is_optical(pose: Transform, parent: Transform) -> bool:
    """Return whether a link has z where its parent has x, and its y axis down."""
    ahead = dot(pose.rotate(_Z), parent.rotate(_X)) > _ALONG
    return ahead and dot(pose.rotate(_DOWN), parent.rotate(_Z)) > _ALONG


def _camera(turn: str, pose: str = "", mark: str = "") -> dict[str, object]:
    return {
        "@urdf": f"""  <link name="optical_eye"/>
  <joint name="eye_joint" type="fixed">
    <parent link="upper_arm"/><child link="optical_eye"/><origin rpy="{turn}"/>
  </joint>
  <gazebo reference="optical_eye">
    <sensor name="eye" type="camera">{mark}
      {pose}
    </sensor>
  </gazebo>""",
    }


_TURNED = "-1.5708 0 -1.5708"
_MARK = "  <!-- ^ SEN033 -->"
GOOD = [
    _camera("0 0 0"),
    _camera(_TURNED, "<pose>0 0 0 0 -1.5708 1.5708</pose>"),
]
BAD = [_camera(_TURNED, mark=_MARK)]
