"""The local costmap is in a frame that nothing publishes.

The controller waits for the transform from that frame to the base, and no goal is ever followed.
`map` comes from AMCL, SLAM or a node that localises. Navigation without these uses `odom` in both
costmaps; often only the global one is changed.

It is reported where the global costmap of the same launch is in another frame that is published,
and all nodes that the package starts are known. Costmaps whose frames agree are not checked: SLAM
may be started by hand.

Fix: write the frame that odometry publishes: `global_frame: odom`.
Source: navigation2, nav2_costmap_2d, `global_frame`; ros-navigation/navigation2#4351.
"""

from collections.abc import Iterator

from checker.launch.ros2.graph import Ros2Launch
from checker.ros.wiring.facts import NodeFacts, node_facts, program_of
from checker.ros.wiring.frames import STATE_PUBLISHER
from checker.ros.wiring.inputs import costmap_of
from checker.ros.wiring.parameters import Setting
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.rulebook.example_parts import DRIVEN_URDF, tf_bridge

_TRANSFORMS = "tf2_msgs/msg/TFMessage"


@rule("WIR010", "unpublished-costmap-frame", Severity.ERROR, Concern.INTERFACE)
def check(wiring: Wiring, launch: Ros2Launch) -> Findings:
    """Report a `global_frame` of the local costmap that no node, plugin or joint publishes."""
    frames = dict(_costmap_frames(wiring))
    local, whole = frames.get("local_costmap"), frames.get("global_costmap")
    published = {frame for each in wiring.transforms for frame in (each.parent, each.child)}
    if local is None or whole is None or not local.text or whole.text not in published:
        return
    if local.text in published or local.text == whole.text:
        return
    if unknown := _unknown_cause(wiring, launch):
        yield unchecked(f"what publishes frame {local.text} is not known: {unknown}")
        return
    yield finding(
        local.span,
        f"the local costmap is in frame {local.text!r}, which nothing in this launch publishes: "
        f"write {whole.text}, the frame of the global costmap",
        related=[(whole.span, "the frame of the global costmap")],
    )


def _costmap_frames(wiring: Wiring) -> Iterator[tuple[str, Setting]]:
    for node in wiring.nodes:
        name, settings = costmap_of(node)
        if node.knows_parameters and "global_frame" in settings:
            yield name, settings["global_frame"]


def _unknown_cause(wiring: Wiring, launch: Ros2Launch) -> str:
    """Return what may publish further frames, in any launch file of the package; else nothing."""
    reasons = [*wiring.unread]
    for graph in launch.entries:
        included = (node for include in graph.includes for node in include.nodes)
        for program in map(program_of, (*graph.nodes, *included)):
            facts = node_facts().get(program)
            if program != STATE_PUBLISHER and (facts is None or _publishes_frames(facts)):
                reasons.append(f"{program} may publish it")
    return next(iter(reasons), "")


def _publishes_frames(facts: NodeFacts) -> bool:
    return any(_TRANSFORMS in types for types in facts.publishes.values())


_LAUNCHED = "LaunchDescription([\n"
_SERVER = """
        Node(package="nav2_{0}", executable="{0}_server",
             parameters=[os.path.join(HERE, "config", "nav2.yaml")]),
"""
_AMCL = """
        Node(package="nav2_amcl", executable="amcl"),
"""


def _example(local: str, whole: str, more: str = "") -> dict[str, object]:
    servers = _SERVER.format("controller") + _SERVER.format("planner")
    frames = {"local_costmap": local, "global_costmap": whole}
    yaml = (
        f"{name}:\n  {name}:\n    ros__parameters:\n      global_frame: {frame}\n"
        for name, frame in frames.items()
    )
    return {
        "@bridge": tf_bridge(),
        "@launch": {_LAUNCHED: _LAUNCHED + servers + more},
        "urdf/rover.urdf": DRIVEN_URDF,
        "config/nav2.yaml": "".join(yaml),
    }


GOOD = [
    _example("odom", "odom"),
    _example("map", "map"),
    _example("odom", "map"),
    _example("odom", "map", _AMCL),
    _example("base_link", "odom"),
]
BAD = [_example("map  # ^ WIR010", "odom")]
