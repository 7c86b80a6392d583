"""A joint_state_publisher beside a controller that publishes the measured joint states.

joint_state_publisher publishes positions of all joints that nothing measures: zero, or those of its
sliders. Where a joint_state_controller publishes the measured ones on the same topic,
robot_state_publisher gets both in turn: in RViz the joints jump to and fro, and MoveIt plans from
wrong positions. It often remains from a launch file that shows the robot without controllers.

It is reported for nodes that start with the defaults of all arguments. With `source_list`,
joint_state_publisher collects what others publish: then nothing is reported. WIR016 reports the
same in ROS 2.

Fix: remove joint_state_publisher, or start it where no controller publishes the joints.
Source: joint_state_publisher; ros_controllers, joint_state_controller.
"""

from checker.ros.control.controllers import ControlLaunch, ControlSystem
from checker.ros.control.nodes import StatePublisher
from checker.rule import Concern, Findings, Severity, finding, rule

_COLLECTS = "source_list"


@rule("CTL009", "invented-joint-states", Severity.WARNING, Concern.INTERFACE)
def check(control: ControlSystem) -> Findings:
    """Report each joint_state_publisher whose topic a controller publishes as well."""
    for launch in control.launches:
        measured = {spawned.states_topic: spawned for spawned in control.publishers(launch)}
        for each in launch.state_publishers:
            if each.topic not in measured or not each.is_source or _may_collect(each, launch):
                continue
            controller = measured[each.topic]
            yield finding(
                each,
                f"node {each.node.name!r} and controller {controller.name!r} both publish "
                f"{each.topic}: the joints jump between two positions; remove {each.node.type}",
                related=[(controller.span, "starts the controller")],
            )


def _may_collect(publisher: StatePublisher, launch: ControlLaunch) -> bool:
    """Return whether a node may have a list of topics; a `<rosparam>` in it may contain one."""
    name = publisher.node.full_name
    lists = {name, f"{name}/{_COLLECTS}", f"/{_COLLECTS}"}
    return not lists.isdisjoint(launch.parameters)


_LAUNCH = "launch/control.launch"
_NODE = 'name="sliders" pkg="joint_state_publisher" type="joint_state_publisher"'


def _launch(publisher: str) -> dict[str, object]:
    return {
        "@urdf": True,
        _LAUNCH: f"""<launch>
  <arg name="show" default="false"/>
  <rosparam file="$(find acme_arm_description)/config/control.yaml"/>
  <node name="spawner" pkg="controller_manager" type="spawner" ns="arm"
        args="state_controller shoulder_controller"/>
  {publisher}
</launch>
""",
    }


_LIST = '<rosparam param="source_list">[hand/joint_states]</rosparam>'
_MARK = "  <!-- ^ CTL009 -->"
GOOD = [
    _launch(""),
    _launch(f"<node {_NODE}/>"),
    _launch(f'<node {_NODE} ns="arm" if="$(arg show)"/>'),
    _launch(f'<node {_NODE} ns="arm">{_LIST}</node>'),
]
BAD = [
    _launch(f'<node {_NODE} ns="arm"/>{_MARK}'),
    _launch(f'<group ns="arm">\n<node {_NODE}/>{_MARK}\n</group>'),
]
