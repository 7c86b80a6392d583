"""Transmissions, but no plugin that uses them.

Gazebo itself ignores transmissions. Without `gazebo_ros_control` there is no controller manager,
the spawner waits for one forever, and the joints move freely. It is an info if no launch file of
the package starts a controller: transmissions also serve real robots, and the plugin may be in
another file.

Fix: add `<gazebo><plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so"/></gazebo>`
with the `<robotNamespace>` of the controllers.
Source: gazebo_ros_control, `GazeboRosControlPlugin::Load`.
"""

from checker.ros.control.controllers import ControlSystem
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked


@rule("CTL006", "no-control-plugin", Severity.ERROR, Concern.INTERFACE)
def check(control: ControlSystem, context: Context) -> Findings:
    """Report transmissions of joints that nothing in Gazebo moves."""
    if control.unread_robot:
        yield unchecked(control.unread_robot)
        return
    if control.has_manager or context.release != "classic":
        return
    loose = [
        transmission
        for transmission in control.transmissions
        if not any(joint.name.value in control.otherwise_moved for joint in transmission.joints)
    ]
    for transmission in loose:
        yield finding(
            transmission,
            f"the robot has {len(control.transmissions)} transmissions, but no plugin "
            "gazebo_ros_control: nothing in Gazebo uses them",
            severity=None if control.spawned_controllers else Severity.INFO,
            key="no gazebo_ros_control",
        )


_MARK = "  <!-- ^ CTL006 -->"


def _transmission(mark: str = "") -> str:
    return f"""<transmission name="t">{mark}
  <type>transmission_interface/SimpleTransmission</type>
  <joint name="shoulder"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
  <actuator name="m"/>
</transmission>
"""


def _plugin(file: str, parameters: str = "") -> str:
    return f'<gazebo><plugin name="p" filename="{file}">{parameters}</plugin></gazebo>'


_DRIVE = "<leftJoint>shoulder</leftJoint>"

GOOD = [
    {"@urdf": True},
    {"@urdf": _transmission() + _plugin("libgazebo_ros_control.so")},
    {"@urdf": _transmission() + _plugin("gazebo_ros_control")},
    {"@urdf": _transmission() + _plugin("libacme_ros_control.so")},
    {"@urdf": _transmission() + _plugin("libgazebo_ros_diff_drive.so", _DRIVE)},
]
BAD = [
    {"@urdf": _transmission(_MARK)},
    {"@urdf": _transmission(_MARK) + _plugin("libgazebo_ros_p3d.so")},
]
