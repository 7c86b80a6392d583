"""Two nodes with the same name.

ROS identifies a node by its full name. roslaunch refuses a file that starts two nodes with the same
name. If two files start them, the second node shuts down the first, which then publishes nothing.
The same applies to a file of subt_ros that is included twice for the same robot, such as
`mapping_server_relays.launch` by a file and again by one that it includes.

Fix: give each node its own name, put the nodes into groups with different `ns`, or remove one
`<include>`.
Source: ROS names (wiki.ros.org/Names), roslaunch XML specification; review findings about cameras
whose `optical_frame_publisher` was copied with its name.
"""

import posixpath
from collections import defaultdict
from collections.abc import Container, Hashable, Iterator

from checker.base.words import free_number
from checker.finding import Fix
from checker.launch.ros1.assumed_files import unknown_nodes
from checker.launch.ros1.graph import LaunchGraph, Node, UnresolvedInclude
from checker.launch.ros1.substitution import is_known
from checker.launch.spawner.reader import SAMPLE_NAME
from checker.rule import Concern, Finding, Findings, Severity, finding, rename, rule, unchecked
from checker.source.xml import Element

_SHOWN = 20
"""Greatest number of further nodes with the name that a finding lists."""


@rule("ROS008", "duplicate-node-name", Severity.ERROR, Concern.INTERFACE)
def check(launch: LaunchGraph) -> Findings:
    """Report every name that more than one node has."""
    for reason in launch.unread:
        yield unchecked(reason)
    named: dict[str, list[Node]] = defaultdict(list)
    for node in launch.nodes:
        if node.name and is_known(node.full_name):
            named[node.full_name].append(node)
    for name, nodes in named.items():
        first, *others = sorted(nodes, key=_is_foreign, reverse=True)
        if others:
            shown = name.replace(SAMPLE_NAME, "<name>")
            count = f"{len(others) + 1} nodes"
            yield finding(
                others[0],
                f"{count} have the name {shown}: give each its own; the first is {_program(first)}",
                related=[
                    (first, "the first node with this name"),
                    *((node, "another node with this name") for node in others[1 : _SHOWN + 1]),
                ],
                fix=_numbered(first, others[0], named),
            )
    yield from _included_twice(launch)


def _numbered(first: Node, other: Node, taken: Container[str]) -> Fix | None:
    """Return the fix that puts a number behind the name of the second node."""
    element = other.span.holder
    name = element.attribute("name") if isinstance(element, Element) else None
    if name is None or element is first.span.holder or name.value != other.name:
        return None
    return rename(name, f"{name.value}_{free_number(other.full_name, taken)}")


def _included_twice(launch: LaunchGraph) -> Iterator[Finding]:
    """Compare includes whose nodes are not known by their names."""
    alike: dict[Hashable, list[UnresolvedInclude]] = defaultdict(list)
    for include in launch.assumed_includes:
        if (nodes := unknown_nodes(include)) is not None:
            alike[nodes].append(include)
    for includes in alike.values():
        if len(includes) > 1:
            own = [include for include in includes if not _is_foreign(include)]
            for include in own or includes:
                yield finding(
                    include,
                    f"{posixpath.basename(include.file)} is included {len(includes)} times, "
                    "expected once: the nodes that it starts have the same names",
                )


def _is_foreign(started: Node | UnresolvedInclude) -> bool:
    """Return whether it is in a file of another package, which the author cannot change."""
    return started.span.place().file.startswith("../")


def _program(node: Node) -> str:
    return f"{node.type!r} of {node.package!r}"


def _launch(*nodes: str) -> dict[str, str]:
    lines = "\n".join(nodes)
    text = f'<launch>\n<arg name="name"/>\n<group ns="$(arg name)">\n{lines}\n</group>\n</launch>\n'
    return {"launch/vehicle_topics.launch": text}


def _node(name: str, rest: str = "") -> str:
    return f'<node pkg="subt_ros" type="optical_frame_publisher" name="{name}"/>{rest}'


_GIVEN = '<arg name="name" value="$(arg name)"/>'
_FOLDER = "$(find subt_ros)/launch/models_common"
_MORE = "launch/more.launch"
_MARK = "  <!-- ^ ROS008 -->"


def _relays(name: str = "mapping_server_relays", mark: str = "") -> str:
    return f'<include file="{_FOLDER}/{name}.launch">{mark}{_GIVEN}</include>'


def _included_example(content: str) -> str:
    return f'<launch>\n<arg name="name"/>\n{content}\n</launch>\n'


_INCLUDE = f'<include file="$(dirname)/more.launch">{_GIVEN}</include>'

GOOD = [
    _launch(_node("front"), _node("rear")),
    _launch(_node("image"), f'<group ns="rear">{_node("image")}</group>'),
    _launch(_node("$(anon image)"), _node("$(anon image)")),
    _launch(f'<group if="0">{_node("image")}</group>', _node("image")),
    {**_launch(_relays(), _INCLUDE), _MORE: _included_example(_node("image"))},
    _launch(_relays(), f'<group ns="payload">{_relays()}</group>'),
    _launch(_relays(), _relays("set_rate_relay")),
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
    {**_launch(_relays(mark=_MARK), _INCLUDE), _MORE: _included_example(_relays(mark=_MARK))},
    {**_launch(_node("image"), _INCLUDE), _MORE: _included_example(_node("image", _MARK))},
    _launch(_relays(mark=_MARK), _relays(mark=_MARK)),
]
