"""A robot_state_publisher listens to a topic on which no joint states are published.

The node turns joint states into transforms. If it listens to another topic than the
joint_state_controller publishes, the moving links have no transforms: RViz shows them at the
origin, and programs that use tf fail.

Fix: remap `joint_states` to the topic in the namespace of the controllers, or start the node in
that namespace.
Source: robot_state_publisher (subscribes to `joint_states`); joint_state_controller (publishes
`joint_states` in the controller manager's namespace).
"""

from collections.abc import Iterable

from checker.finding import Fix, Safety
from checker.ros.control.controllers import ControlLaunch, ControlSystem
from checker.ros.control.nodes import StateListener
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.xml import Element
from checker.source.xml_insertion import append_to, attribute_edits


@rule("CTL007", "joint-states-not-published", Severity.ERROR, Concern.INTERFACE)
def check(control: ControlSystem) -> Findings:
    """Report listeners whose topic no joint_state_controller publishes."""
    if control.publishes_states:
        return
    everywhere = _topics(control, control.launches)
    for launch in control.launches:
        of_nodes = {publisher.topic for publisher in launch.state_publishers}
        topics = of_nodes | (_topics(control, [launch]) or everywhere)
        deaf = [listener for listener in launch.listeners if listener.topic not in topics]
        if deaf and control.unread:
            yield from map(unchecked, control.unread)
            return
        for listener in deaf if topics else ():
            yield finding(
                listener,
                f"{listener.node.type} {listener.node.name!r} listens to {listener.topic}, but "
                f"the joint states are published on {', '.join(sorted(topics))}",
                fix=_remapped(listener, *topics) if len(topics) == 1 else None,
            )


def _remapped(listener: StateListener, topic: str) -> Fix | None:
    """Return the fix that lets a node listen to a topic: in its remap, else in a new one."""
    element = listener.span.holder
    if not isinstance(element, Element):
        return None
    if element.tag == "remap":
        return Fix(Safety.UNSAFE, attribute_edits(element, {"to": topic}))
    line = f'<remap from="joint_states" to="{topic}"/>'
    return Fix(Safety.UNSAFE, (append_to(element, [line]),))


def _topics(control: ControlSystem, launches: Iterable[ControlLaunch]) -> frozenset[str]:
    return frozenset(
        spawned.states_topic for launch in launches for spawned in control.publishers(launch)
    )


_LAUNCH = "launch/control.launch"
_VIEW = """<launch>
  <node name="sliders" pkg="joint_state_publisher_gui" type="joint_state_publisher_gui"/>
  <node name="states" pkg="robot_state_publisher" type="robot_state_publisher"/>
</launch>
"""


def _launch(listener: str) -> str:
    return f"""<launch>
  <rosparam file="$(find acme_arm_description)/config/control.yaml"/>
  <node name="spawner" pkg="controller_manager" type="spawner" ns="arm"
        args="state_controller shoulder_controller"/>
  {listener}
</launch>
"""


_NODE = 'name="states" pkg="robot_state_publisher" type="robot_state_publisher"'

GOOD = [
    {"@urdf": True},
    {"@urdf": True, "launch/view.launch": _VIEW},
    {"@urdf": True, _LAUNCH: _launch(f'<node {_NODE} ns="arm"/>')},
    {
        "@urdf": True,
        _LAUNCH: _launch(
            f"""<node {_NODE}/>
  <node name="relay" pkg="topic_tools" type="relay" args="arm/joint_states joint_states"/>"""
        ),
    },
    {
        "@urdf": True,
        _LAUNCH: "<launch/>",
        "launch/states.launch": f"<launch><node {_NODE}/></launch>",
    },
]
BAD = [
    {"@urdf": True, _LAUNCH: _launch(f"<node {_NODE}/>  <!-- ^ CTL007 -->")},
    {
        "@urdf": True,
        _LAUNCH: _launch(
            f"""<node {_NODE}>
    <remap from="joint_states" to="/robot/joint_states"/>  <!-- ^ CTL007 -->
  </node>"""
        ),
    },
    {
        "@urdf": True,
        _LAUNCH: _launch(""),
        "launch/states.launch": f"<launch>\n<node {_NODE}/>  <!-- ^ CTL007 -->\n</launch>",
    },
]
