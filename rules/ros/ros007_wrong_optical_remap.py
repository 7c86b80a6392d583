"""An optical_frame_publisher whose remaps are missing, swapped or copied.

The node reads the topics that its remaps name. Without a remap, or with that of another camera, it
waits for a topic that is not published, or publishes one camera's image under the name of another.

Fix: remap `input/image` and `input/camera_info` to the topics of one camera's bridges, and
`output/image` and `output/camera_info` to new names; with `args="depth"` only the images.
Source: a SubT review that required corrected remaps in four copied publishers; the remaps of 99
packages.
"""

import posixpath
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from checker.finding import Fix, Safety
from checker.launch.ros1.bridge import Bridge, Direction
from checker.launch.ros1.graph import LaunchGraph, resolve_name
from checker.launch.spawner.reader import SAMPLE_NAME
from checker.ros.transforms import IMAGES, INFOS, OpticalFrame, optical_frames
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located
from checker.source.xml import Element
from checker.source.xml_insertion import append_to

_TYPES = {"input/image": "Image", "input/camera_info": "CameraInfo"}
_RENAMES = "topic_tools"
"""Package of nodes that publish topics under other names."""

_Given = Mapping[str, Sequence[Bridge]]


@rule("ROS007", "wrong-optical-remap", Severity.ERROR, Concern.INTERFACE)
def check(launch: LaunchGraph) -> Findings:
    """Report optical_frame_publishers that do not read a bridged topic."""
    for reason in launch.unread:
        yield unchecked(reason)
    frames = [frame for frame in optical_frames(launch.nodes) if not frame.node.assumed_from]
    by_topic: dict[str, list[Bridge]] = defaultdict(list)
    for bridge in (*launch.bridges, *(launch.dormant_bridges if launch.unread else ())):
        if bridge.direction is not Direction.TO_IGN:
            by_topic[bridge.ros_topic].append(bridge)
    complete = not launch.unseen_bridges and not (launch.unread and launch.dormant_includes)
    renamed = any(node.package == _RENAMES for node in launch.nodes)
    for frame in frames:
        for fault, fix in _faults(frame, by_topic, sure=complete and not renamed):
            yield finding(frame.node, f"{_label(frame.node.full_name)} {fault}", fix=fix)
    yield from _copies(frames)
    if launch.unseen_bridges and any(_takes_unknown(frame, by_topic) for frame in frames):
        yield unchecked(launch.unseen_bridges[0])


def _takes_unknown(frame: OpticalFrame, by_topic: _Given) -> bool:
    topics = (frame.remapped.get(name) for name in _TYPES)
    return any(topic is not None and topic not in by_topic for topic in topics)


def _faults(
    frame: OpticalFrame, by_topic: _Given, *, sure: bool
) -> Iterator[tuple[str, Fix | None]]:
    """Yield what is wrong with one publisher, and its fix.

    Args:
        frame: The publisher.
        by_topic: Bridges by the ROS topic that they publish.
        sure: Whether only the bridges publish topics.
    """
    missing = [name for name in frame.needed if name not in frame.remapped]
    if missing:
        yield f"has no remap for {' and '.join(missing)}", _with_infos(frame, by_topic)
    for name, message in _TYPES.items():
        topic = frame.remapped.get(name)
        if topic is None or "$(" in topic:
            continue
        output = frame.remapped.get(name.replace("input", "output"), "")
        if output == topic:
            yield f"publishes {name} on the topic that it reads, {_label(topic)}", None
        elif topic not in by_topic and output in by_topic:
            yield f"has {name} and {name.replace('input', 'output')} swapped", _swapped(frame, name)
        elif topic not in by_topic and sure:
            yield f"reads {name} from {_label(topic)}, which no bridge publishes", None
        elif topic in by_topic and not any(_is(bridge, message) for bridge in by_topic[topic]):
            yield f"reads {name} from {_label(topic)}, which is not a {message}", None
    if _of_two_cameras(frame, by_topic):
        yield "reads image and camera_info of different sensors", None


def _targets(frame: OpticalFrame) -> dict[str, Located[str]]:
    """Return what the remaps of the node itself give for each name."""
    node = frame.node.span.holder
    remaps = node.all("remap") if isinstance(node, Element) else []
    pairs = ((remap.get("from") or "", remap.attribute("to")) for remap in remaps)
    return {source: target for source, target in pairs if target is not None}


def _swapped(frame: OpticalFrame, name: str) -> Fix | None:
    """Return the fix that exchanges what is read and what is published."""
    targets = _targets(frame)
    pair = [targets.get(each) for each in (name, name.replace("input", "output"))]
    edits = [
        one.span.replacement(other.value)
        for one, other in (pair, pair[::-1])
        if one is not None and other is not None
    ]
    return Fix(Safety.UNSAFE, tuple(edits)) if edits else None


def _with_infos(frame: OpticalFrame, by_topic: _Given) -> Fix | None:
    """Return the fix that adds the remaps of camera_info, beside those of the images."""
    targets, node = _targets(frame), frame.node.span.holder
    folders = [posixpath.dirname(targets[name].value) for name in IMAGES if name in targets]
    topics = [posixpath.join(folder, "camera_info") for folder in folders]
    is_known = bool(topics) and resolve_name(topics[0], frame.node.namespace) in by_topic
    if set(targets) != set(IMAGES) or not is_known or not isinstance(node, Element):
        return None
    pairs = zip(INFOS, topics, strict=True)
    lines = [f'<remap from="{name}" to="{topic}"/>' for name, topic in pairs]
    return Fix(Safety.UNSAFE, (append_to(node, lines),)) if len(set(topics)) == 2 else None


def _label(name: str) -> str:
    return name.replace(SAMPLE_NAME, "<name>")


def _is(bridge: Bridge, message: str) -> bool:
    return bridge.ros_type.rsplit("/", 1)[-1] == message


def _of_two_cameras(frame: OpticalFrame, by_topic: _Given) -> bool:
    images, infos = (
        {
            (topic.link, topic.sensor)
            for bridge in by_topic.get(frame.remapped.get(name, ""), ())
            if (topic := bridge.sensor) is not None and topic.suffix
        }
        for name in _TYPES
    )
    return bool(images and infos) and not images & infos


def _copies(frames: Sequence[OpticalFrame]) -> Findings:
    """Report publishers that read or publish the same image as an earlier one."""
    first: dict[tuple[str, str], OpticalFrame] = {}
    for frame in frames:
        for name, does in (("input/image", "reads"), ("output/image", "publishes")):
            topic = frame.remapped.get(name, "")
            earlier = first.setdefault((name, topic), frame) if topic else frame
            if earlier is not frame:
                yield finding(
                    frame.node,
                    f"{_label(frame.node.full_name)} {does} {_label(topic)}, as "
                    f"{_label(earlier.node.full_name)} does: remove one of them",
                    related=[(earlier.node, "the first of them")],
                )
                break


_TOPICS = "launch/vehicle_topics.launch"
_PREFIX = "/world/w/model/m/link/l/sensor"


def _bridges(camera: str) -> str:
    return f"""<node pkg="ros_ign_image" type="image_bridge" name="{camera}_image"
  args="{_PREFIX}/{camera}/image">
  <remap from="{_PREFIX}/{camera}/image" to="{camera}/image_raw"/>
</node>
<node pkg="ros_ign_bridge" type="parameter_bridge" name="{camera}_info"
  args="{_PREFIX}/{camera}/camera_info@sensor_msgs/CameraInfo[ignition.msgs.CameraInfo">
  <remap from="{_PREFIX}/{camera}/camera_info" to="{camera}/camera_info"/>
</node>"""


def _optical(*remaps: str, args: str = "", mark: str = "") -> str:
    """Make a publisher of remaps to an image, its output, a camera_info and its output."""
    names = ("input/image", "output/image", "input/camera_info", "output/camera_info")
    lines = [
        f'<remap from="{name}" to="{topic}"/>'
        for name, topic in zip(names, remaps, strict=False)
        if topic
    ]
    head = f'<node pkg="subt_ros" type="optical_frame_publisher" name="o{mark}" args="{args}">'
    return "\n".join((head + ("  <!-- ^ ROS007 -->" if mark else ""), *lines, "</node>"))


def _launch(*nodes: str) -> dict[str, str]:
    return {_TOPICS: "\n".join(("<launch>", *nodes, "</launch>"))}


_BOTH = _bridges("a") + _bridges("b")
_FINE = ("a/image_raw", "a/optical/image_raw", "a/camera_info", "a/optical/camera_info")
_RELAY = '<node pkg="topic_tools" type="relay" name="relay" args="a/image_raw c/image_raw"/>'

GOOD = [
    _launch(_BOTH, _optical(*_FINE)),
    _launch(_BOTH, _optical(*_FINE[:2], args="depth")),
    _launch(_BOTH, _RELAY, _optical("c/image_raw", *_FINE[1:])),
]
BAD = [
    _launch(_BOTH, _optical(*_FINE[:2], mark="1")),
    _launch(_BOTH, _optical("", *_FINE[1:], mark="1")),
    _launch(_BOTH, _optical(_FINE[1], _FINE[0], *_FINE[2:], mark="1")),
    _launch(_BOTH, _optical(_FINE[0], _FINE[0], *_FINE[2:], mark="1")),
    _launch(_BOTH, _optical("c/image_raw", *_FINE[1:], mark="1")),
    _launch(_BOTH, _optical("a/camera_info", *_FINE[1:], mark="1")),
    _launch(_BOTH, _optical(*_FINE[:2], "b/camera_info", _FINE[3], mark="1")),
    _launch(_BOTH, _optical(*_FINE), _optical(_FINE[0], "b/optical", *_FINE[2:], mark="1")),
]
