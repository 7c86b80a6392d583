"""A joint that cannot hold the weight of the parts it carries.

In the robot's initial pose, gravity needs more torque than the joint's effort limit: the gimbal or
arm sags as soon as the simulation runs, whatever its controller does. Joints above parts that are
on the ground are left out, because the ground carries part of the weight. The gravity is that of
the world with the robot, in its file or in a launch file of ROS 2; of several, the greatest. Where
the world is not known, it is the Earth's.

Fix: write the motor's stall torque (after its gear) as the effort limit, or correct the masses and
centres of mass of the parts that the joint carries.
Source: statics; SDFormat specification, axis/limit/effort.
"""

import math
from collections.abc import Iterator

from checker.model.components import Joint
from checker.physics.mass.mass_properties import MassProperties
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_NOISE = 1e-3
"""N·m or N: less is rounding."""


@rule("INE010", "weight-over-effort-limit", Severity.WARNING, Concern.ROBOT)
def check(masses: MassProperties, *, factor: float = 1.0) -> Findings:
    """Report driven joints whose effort limit is too small for the parts they carry.

    In URDF transmissions drive joints, so all joints with a limit count.

    Options:
        factor: Torque (N·m; for a sliding joint, force in N) that a joint needs against gravity,
            divided by its effort limit; more is reported.
    """
    robot = masses.robot
    unknown = masses.unbalanced or robot.unread_plugins
    if masses.robot.is_static:
        return
    if unknown:
        yield unchecked(unknown)
        return
    stated = robot.conventions.states_devices
    for joint, torque, limit in _limited_joints(masses):
        driven = not stated or joint.scoped_name in robot.driven_joints
        if driven and abs(torque) > max(factor * limit, _NOISE):
            unit = "N" if joint.type.value == "prismatic" else "N·m"
            yield finding(
                joint.axes[0].effort,
                f"joint {joint.name.value!r} has to hold {abs(torque):.3g} {unit} against gravity"
                f"{robot.other_gravity}, but its effort limit is {limit:.3g} {unit}",
                covered_by=("KIN007",) if limit == 0.0 else (),
            )


def _limited_joints(masses: MassProperties) -> Iterator[tuple[Joint, float, float]]:
    """Yield joints with an effort limit: the joint, what it holds, and the limit."""
    for joint, torque in masses.gravity_torques.items():
        limit = joint.axes[0].effort.value if joint.axes else math.inf
        if 0.0 <= limit < math.inf:
            yield joint, torque, limit


def _arm(effort: str, mark: str = "", plugin: str = "JointPositionController") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <inertial><mass>20</mass></inertial>
  <collision name="c"><geometry><box><size>1 1 0.2</size></box></geometry></collision>
</link>
<link name="arm">
  <pose>0 0 0.5 0 0 0</pose>
  <inertial><pose>0.5 0 0 0 0 0</pose><mass>2</mass></inertial>
</link>
<joint name="shoulder" type="revolute">
  <parent>base_link</parent>
  <child>arm</child>
  <axis>
    <xyz>0 1 0</xyz>
    <limit><lower>-1</lower><upper>1</upper>
      <effort>{effort}</effort>{mark}
    </limit>
  </axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::{plugin}">
  <joint_name>shoulder</joint_name>
</plugin>
</model>
</sdf>
"""


def _in_world(gravity: str, mark: str = "") -> str:
    world = f'<sdf version="1.6"><world name="w"><gravity>0 0 {gravity}</gravity>'
    arm = _arm("8", mark).replace('<sdf version="1.6">', world)
    return arm.replace("</sdf>", "</world></sdf>")


def _spawned(gravity: str, mark: str = "") -> dict[str, object]:
    """Return a boom of 2 kg, 0.5 m from its joint, that a launch file spawns into a world."""
    world = f'<sdf version="1.9"><world name="w"><gravity>0 0 {gravity}</gravity></world></sdf>'
    gazebo = '("gz_args", ["-r ", os.path.join(HERE, "worlds", "moon.sdf")])'
    moment = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    urdf = f"""<robot name="rover">
<link name="base_link">
  <inertial><mass value="20"/>{moment}</inertial>
  <collision><geometry><box size="1 1 0.2"/></geometry></collision>
</link>
<link name="boom"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>{moment}</inertial></link>
<joint name="shoulder" type="revolute">
  <parent link="base_link"/><child link="boom"/><origin xyz="0 0 0.5"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="8" velocity="1"/>{mark}
</joint>
</robot>
"""
    changes = {'("gz_args", "-r empty.sdf")': gazebo}
    files = {"worlds/moon.sdf": world, "urdf/rover.urdf": urdf}
    return {"@bridge": True, "@launch": changes, **files}


_MARK = "  <!-- ^ INE010 -->"
GOOD = [
    _arm("12"),
    _arm("-1"),
    _arm("1", plugin="JointStatePublisher"),
    _in_world("-1.62"),
    _spawned("-1.62"),
]
BAD = [_arm("8", _MARK), _in_world("-9.8", _MARK), _spawned("-9.8", _MARK)]
