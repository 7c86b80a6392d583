"""Two nodes with the same name.

ROS identifies a node by its full name. roslaunch refuses a file that starts two nodes with the same
name. If two files start them, the second node shuts down the first, whose topics are then silent.

Fix: give each node its own name, or put the nodes into groups with different `ns`.
Source: ROS names (wiki.ros.org/Names), roslaunch XML specification; review findings about cameras
whose `optical_frame_publisher` was copied with its name.
"""

from collections import defaultdict

from checker.expand.launch.graph import LaunchGraph, Node
from checker.expand.launch.substitution import is_known
from checker.expand.spawner.reader import SAMPLE_NAME
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_SHOWN = 20
"""Greatest number of further nodes with the name that a finding lists."""


@rule("ROS008", "node-name-twice", Severity.ERROR, Concern.INTERFACE)
def check(launch: LaunchGraph) -> Findings:
    """Report every name that more than one node has."""
    for reason in launch.unread:
        yield unchecked(reason)
    named: dict[str, list[Node]] = defaultdict(list)
    for node in launch.nodes:
        if node.name and is_known(node.full_name):
            named[node.full_name].append(node)
    for name, (first, *others) in named.items():
        if others:
            shown = name.replace(SAMPLE_NAME, "<name>")
            count = f"{len(others) + 1} nodes"
            yield finding(
                others[0],
                f"{count} have the name {shown}, expected one; the first is {_program(first)}",
                related=[
                    (first, "the first node with this name"),
                    *((node, "another node with this name") for node in others[1 : _SHOWN + 1]),
                ],
            )


def _program(node: Node) -> str:
    return f"{node.type!r} of {node.package!r}"


def _launch(*nodes: str) -> dict[str, str]:
    lines = "\n".join(nodes)
    text = f'<launch>\n<arg name="name"/>\n<group ns="$(arg name)">\n{lines}\n</group>\n</launch>\n'
    return {"launch/vehicle_topics.launch": text}


def _node(name: str, rest: str = "") -> str:
    return f'<node pkg="subt_ros" type="optical_frame_publisher" name="{name}"/>{rest}'


_MARK = "  <!-- ^ ROS008 -->"

GOOD = [
    _launch(_node("front"), _node("rear")),
    _launch(_node("image"), f'<group ns="rear">{_node("image")}</group>'),
    _launch(_node("$(anon image)"), _node("$(anon image)")),
    _launch(f'<group if="0">{_node("image")}</group>', _node("image")),
]
BAD = [
    _launch(_node("image"), _node("rear"), _node("image", _MARK)),
    _launch(
        '<node ns="rear" pkg="p" type="t" name="image"/>',
        f'<group ns="rear">{_node("image")}{_MARK}</group>',
    ),
    _launch(
        _node("image"),
        f'<node>{_MARK}\n  pkg="subt_ros" type="optical_frame_publisher" name="image">\n</node>',
    ),
]
