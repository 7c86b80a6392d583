"""Nothing publishes the static transforms.

The place of a sensor on the robot is published once, separately from the poses that change. Without
it sensor data cannot be placed on the robot. Fixed joints of the package's own description are not
in the SDF model: the conversion merges their links, and only `robot_state_publisher` publishes
them. They are read from the expanded description, with all included files and the arguments of the
launch file; if it cannot be expanded, from the unexpanded file.

Fix: bridge `/model/<name>/pose_static`, and start `robot_state_publisher` if the description has
fixed frames that the model lacks.
Source: a review that required `robot_state_publisher`; parameters of PosePublisher (gz-sim): with
`<static_publisher>` static poses have their own topic.
"""

from collections.abc import Iterator

from checker.finding import Place
from checker.launch.ros1.graph import LaunchGraph
from checker.model.robot import Robot
from checker.package.inheritance import Found
from checker.package.package import Package
from checker.robots.urdf_files import UrdfFiles
from checker.ros.robot_description import fixed_frames, robot_descriptions
from checker.ros.transforms import state_publishers, static_transforms
from checker.rule import Concern, Findings, HasSpan, Severity, finding, rule, unchecked
from checker.source.xml import XmlDocument

_TOPICS = "launch/vehicle_topics.launch"
_TRUE = ("true", "1")


@rule("ROS012", "no-static-transforms", Severity.WARNING, Concern.INTERFACE)
def check(
    package: Package,
    robot: Robot,
    launch: LaunchGraph,
    urdf: UrdfFiles | None,
    *,
    published_elsewhere: str = "optical",
    shown: int = 8,
) -> Findings:
    """Report static poses that are not bridged, and fixed frames that only a description has.

    Options:
        published_elsewhere: Text in names of frames that optical_frame_publisher publishes; fixed
            frames with it in their names are skipped; none if it is empty.
        shown: Greatest number of missing frames whose joints in the description the finding lists.
    """
    if state_publishers(launch):
        return
    reasons = [reason for reason in launch.unread if reason != launch.unknown_commands]
    for reason in reasons:
        yield unchecked(reason)
    if reasons:
        return
    held = package.part(_TOPICS)
    where = package.place(held.path) if isinstance(held, Found) else package.folder_place()
    if not static_transforms(launch):
        yield from _static_poses(robot, where)
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    parts = (*robot.sensors, *robot.frames)
    known = {*robot.links_by_name, *(part.name.value for part in parts)}
    frames = {
        name: joint
        for name, joint in _fixed_frames(package, launch, urdf)
        if name not in known and not (published_elsewhere and published_elsewhere in name)
    }
    if frames:
        number = f"{len(frames)} fixed frames" if len(frames) > 1 else "a fixed frame"
        yield finding(
            where,
            f"the description has {number} that the model lacks ({_listing(list(frames))}), but no "
            "robot_state_publisher is started",
            key="description",
            related=[(joint, "fixed here") for joint in list(frames.values())[:shown]],
        )


def _static_poses(robot: Robot, where: Place) -> Findings:
    publishers = [plugin for plugin in robot.all_plugins if plugin.class_name == "PosePublisher"]
    apart = [
        value
        for plugin in publishers
        for value in plugin.at("static_publisher")
        if value.value.lower() in _TRUE
    ]
    if apart:
        yield finding(
            where,
            "no bridge for /model/<name>/pose_static, on which PosePublisher publishes static "
            "poses",
            key="pose_static",
            related=[(apart[0], "this makes them a separate topic")],
        )
    elif robot.unread_plugins and not publishers:
        yield unchecked(robot.unread_plugins)


def _fixed_frames(
    package: Package, launch: LaunchGraph, urdf: UrdfFiles | None
) -> Iterator[tuple[str, HasSpan]]:
    """Yield the fixed frames of the robot's description."""
    descriptions = urdf.descriptions if urdf is not None else ()
    expanded = {description.file: description.document for description in descriptions}
    for description in robot_descriptions(launch):
        for file in description.files:
            prefix = f"../{file.package}/" if file.package not in ("", package.name) else ""
            path = f"{prefix}{file.path}"
            document = expanded.get(path) or package.xml(path)
            if isinstance(document, XmlDocument):
                yield from fixed_frames(document).items()


def _listing(names: list[str]) -> str:
    return ", ".join(names[:3]) + (", …" if len(names) > 3 else "")


_HERE = "acme_rover_sensor_config_1"
_PUBLISHER = """
<plugin filename="ignition-gazebo-pose-publisher-system"
        name="ignition::gazebo::systems::PosePublisher">
  <static_publisher>{}</static_publisher>
</plugin>
"""
_STATIC = """<node pkg="ros_ign_bridge" type="parameter_bridge" name="pose_static"
  args="/model/$(arg name)/pose_static@tf2_msgs/TFMessage[ignition.msgs.Pose_V"/>"""
_RSP = '<node pkg="robot_state_publisher" type="robot_state_publisher" name="$(anon rsp)"/>'


def _files(
    line: str, frame: str = "base_link", static: str = "true", mast: str = ""
) -> dict[str, str]:
    return {
        "@fragment": _PUBLISHER.format(static),
        _TOPICS: f'<launch>\n<arg name="name"/>\n<arg name="world_name"/>\n{line}\n</launch>\n',
        "launch/description.launch": f"""<launch>
<arg name="name"/>
<param name="$(arg name)/robot_description" command="$(find xacro)/xacro '$(find
{_HERE})/urdf/robot.xacro' name:=$(arg name)"/>
</launch>
""",
        "urdf/robot.xacro": f"""<robot name="rover" xmlns:xacro="http://ros.org/wiki/xacro">
<joint name="j" type="fixed">
<parent link="$(arg name)/base_link"/><child link="$(arg name)/{frame}"/>
</joint>
{mast}</robot>
""",
    }


_MAST = """<xacro:arg name="name" default="rover"/>
<xacro:arg name="mast" default="{}"/>
<xacro:macro name="mount" params="of">
<link name="$(arg name)/${{of}}_mount"/>
<joint name="${{of}}" type="fixed">
<parent link="$(arg name)/base_link"/><child link="$(arg name)/${{of}}_mount"/>
</joint>
</xacro:macro>
<link name="$(arg name)/base_link"/>
<xacro:if value="$(arg mast)"><xacro:mount of="mast"/></xacro:if>
"""
_BAD = {"@reported": [f"{_TOPICS}:1"]}

GOOD = [
    _files(_STATIC),
    _files("", static="false"),
    _files(_STATIC, frame="${side}_mount"),
    _files(_STATIC, frame="camera_optical_frame"),
    _files(_RSP, frame="mast"),
    _files(_STATIC, mast=_MAST.format(0)),
]
BAD = [
    {**_files(""), **_BAD},
    {**_files(_STATIC, frame="mast"), **_BAD},
    {**_files(_STATIC, mast=_MAST.format(1)), **_BAD},
]
