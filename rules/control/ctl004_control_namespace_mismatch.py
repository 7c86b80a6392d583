"""Parts of the control are in different namespaces, or none publishes joint states.

Gazebo's plugin runs the controller manager in its own namespace and reads the controllers'
parameters there. A spawner in another namespace waits forever for its manager, and parameters in
another namespace are not found: the controllers are not loaded, and the joints move freely.
Without a joint_state_controller (a warning) no node receives the joint positions: RViz shows no
transforms of the moving links.

Fix: use one namespace in the YAML file, in `<robotNamespace>` and in the spawner's `ns`, and spawn
a controller of type `joint_state_controller/JointStateController`.
Source: gazebo_ros_control, `GazeboRosControlPlugin::Load`; controller_manager, `spawner`.
"""

from checker.finding import Fix, Safety
from checker.launch.ros1.graph import resolve_name
from checker.ros.control.controllers import ControlSystem
from checker.ros.control.nodes import Spawned
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule, unchecked
from checker.source.xml import Element


@rule("CTL004", "control-namespace-mismatch", Severity.ERROR, Concern.INTERFACE)
def check(control: ControlSystem) -> Findings:
    """Report spawners, parameters and plugins whose namespaces differ, and missing joint states.

    Missing joint states are a warning, as is what launch files that are not read may put right.
    """
    yield from _parameters_elsewhere(control)
    if control.unread_robot:
        yield unchecked(control.unread_robot)
        return
    yield from _manager_elsewhere(control)
    yield from _untold_states(control)


def _parameters_elsewhere(control: ControlSystem) -> Findings:
    for spawned in control.spawned_controllers:
        configured = control.namesakes.get(spawned.name)
        if configured is None or spawned.full_name in control.configured_controllers:
            continue
        yield finding(
            spawned,
            f"the controllers are not loaded: they are started in namespace {spawned.namespace!r}, "
            f"but their parameters are in {configured.namespace!r}: use one namespace",
            severity=Severity.WARNING if control.unread else None,
            key=f"{spawned.namespace} {configured.namespace}",
            related=[(configured, f"loaded in namespace {configured.namespace!r}")],
            fix=_moved(spawned, configured.namespace),
        )


def _moved(spawned: Spawned, namespace: str) -> Fix | None:
    """Return the fix that starts a spawner in a namespace, where the node states its own."""
    node = spawned.node.span.holder
    stated = node.attribute("ns") if isinstance(node, Element) else None
    if stated is None or resolve_name(stated.value, "/") != spawned.namespace:
        return None
    return replace_text(stated, namespace, Safety.UNSAFE)


def _manager_elsewhere(control: ControlSystem) -> Findings:
    """Compare with plugins that state their namespace; the spawned model decides for others."""
    stated = [plugin.namespace for plugin in control.plugins if plugin.namespace is not None]
    if not stated or len(stated) < len(control.plugins):
        return
    managed = {namespace.value for namespace in stated}
    for spawned in control.spawned_controllers:
        if spawned.namespace not in managed:
            yield finding(
                spawned,
                f"controllers are started in namespace {spawned.namespace!r}, but "
                f"gazebo_ros_control runs their manager in "
                f"{', '.join(map(repr, sorted(managed)))}: "
                "use one namespace",
                severity=Severity.WARNING if control.unread else None,
                key=f"manager {spawned.namespace}",
                related=[(stated[0], "the namespace of the controller manager")],
            )


def _untold_states(control: ControlSystem) -> Findings:
    hidden = any(fault.hides for fault in control.faults)
    if not control.spawned_controllers or control.publishes_states or hidden:
        return
    configured = [
        controller
        for controller in control.controllers
        if controller.kind == "JointStateController"
    ]
    unknown = any(spawned.name not in control.namesakes for spawned in control.spawned_controllers)
    if configured or unknown:
        return
    if control.unread:
        yield from map(unchecked, control.unread)
        return
    source = control.namesakes[control.spawned_controllers[0].name].span.source
    yield finding(
        source.whole(),
        f"no controller of {source.file} publishes the joint states: expected one of type "
        "joint_state_controller/JointStateController",
        severity=Severity.WARNING,
    )


_CONFIG, _LAUNCH = "config/control.yaml", "launch/control.launch"
_SHOULDER = """
  shoulder_controller:
    type: effort_controllers/JointPositionController
    joint: shoulder
"""
_STATES = """
  state_controller:
    type: joint_state_controller/JointStateController
"""


def _launch(where: str, names: str = "state_controller shoulder_controller") -> str:
    mark = "  <!-- ^ CTL004 -->" if "arms" in where else ""
    return f"""<launch>
  <rosparam file="$(find acme_arm_description)/config/control.yaml"/>
  <group ns="/">
    <node name="spawner" pkg="controller_manager" type="spawner" {where} args="{names}"/>{mark}
  </group>
</launch>
"""


def _plugin(parameters: str) -> str:
    return f"""<gazebo><plugin name="control" filename="libgazebo_ros_control.so">
{parameters}
</plugin></gazebo>"""


_STATE_PLUGIN = '<plugin name="s" filename="libgazebo_ros_joint_state_publisher.so"/>'

GOOD = [
    {"@urdf": True},
    {"@urdf": _plugin("<robotNamespace>arm</robotNamespace>")},
    {"@urdf": True, _LAUNCH: _launch("").replace('ns="/"', 'ns="arm"')},
    {
        "@urdf": _plugin("<robotNamespace>/</robotNamespace>"),
        _CONFIG: f"{_STATES}{_SHOULDER}".replace("\n  ", "\n"),
        _LAUNCH: _launch(""),
    },
    {
        "@urdf": f"{_plugin('<robotNamespace>/arm/</robotNamespace>')}"
        f"<gazebo>{_STATE_PLUGIN}</gazebo>",
        _CONFIG: f"arm:{_SHOULDER}",
        _LAUNCH: _launch('ns="arm"', "shoulder_controller"),
    },
]
BAD = [
    {
        "@urdf": True,
        _CONFIG: f"# ^ CTL004\narm:{_SHOULDER}",
        _LAUNCH: _launch('ns="arm"', "shoulder_controller"),
    },
    {"@urdf": True, _LAUNCH: _launch('ns="arms"')},
    {
        "@urdf": _plugin("<robotNamespace>/robot</robotNamespace>"),
        "@reported": ["launch/control.launch:4"],
    },
]
