"""A joint that needs more torque than its effort limit allows.

The simulated motor stops at its limit: the robot starts slower, does not reach its speed, or drops
its load. The torque is that of servos without limits. A joint whose effort limit specifications.md
explains is not checked, nor is a joint that no plugin, controller or transmission moves: a passive
hinge needs no motor. The drive plugins of Gazebo Classic turn wheels with the torque that they
state, 5 N·m by default, whatever the limit of the joint is.

The joints of an arm, which controllers move, go a small step from their start and back, one by one
and then together, within their velocity limits: where that needs more than the limit, the arm
cannot follow its controller even near its start. The gravity of the trial is that of the robot's
world, as in INE010; the Earth's where the world is not known.

Fix: give the joint, or the plugin that the message names, the effort (N·m, or N) of the real motor
with its gear, or correct the masses.
Source: the largest torque in the trial after the robot has settled, averaged over 0.1 s and without
the drive at full speed, and that of inverse dynamics on the paths of an arm's joints, compared with
the effort limit.
"""

import re

from checker.formats.urdf.description import joints_with_motor
from checker.model.components import Joint
from checker.model.locomotion.balancing import NOT_RUN
from checker.model.locomotion.classic import wheel_torques
from checker.model.locomotion.commanded_joints import commanded_joints
from checker.model.robot import Robot
from checker.model.specification.sheet import Specification
from checker.physics.trial.robot_trial import SettledTrial
from checker.physics.trial.trial import Measurement
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule
from checker.rulebook.example_parts import rover
from checker.source.text import Located


@rule(
    "TRI009",
    "effort-limit-exceeded",
    Severity.WARNING,
    Concern.ROBOT,
    judges=("torque", "move_torque"),
)
def check(
    driven: SettledTrial, specification: Specification | None, *, warning_above: float = 1.0
) -> Findings:
    """Report joints that need more torque or force than their effort limit.

    Options:
        warning_above: Multiple of a joint's effort limit; a joint that needs more torque or force
            is reported.
    """
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    limits = {limit.part: limit.value for limit in driven.trial.all("torque_limit")}
    motors = _with_motor(driven.robot)
    of_plugins = wheel_torques(driven.robot)
    needed = [(it, "") for it in driven.trial.all("torque") if it.part in motors]
    needed += [(it, _path(driven, it.part)) for it in driven.trial.all("move_torque")]
    weak: set[str] = set()
    for torque, path in needed:
        limit = limits.get(torque.part)
        if limit is None or abs(torque.value) <= warning_above * limit or torque.part in weak:
            continue
        weak.add(torque.part)
        joint = driven.robot.joints_by_name.get(torque.part)
        if torque.part in of_plugins:
            yield _of_plugin(torque, *of_plugins[torque.part])
        elif joint is None or not _is_explained(joint, specification):
            unit = _unit(driven, torque.part)
            remedy = f": write {_ABOVE * torque.value:.3g} if its motor gives that" if path else ""
            yield finding(
                driven.part(torque.part),
                f"joint {torque.part!r} needs {abs(torque.value):.3g} {unit}"
                f"{driven.robot.other_gravity}{path}, but its effort limit is "
                f"{limit:.3g} {unit}{remedy}",
                key="torque",
            )


def _of_plugin(needed: Measurement, tag: str, torque: Located[float]) -> Finding:
    """Report a wheel of a plugin that states its torque, or leaves it to the default."""
    limit = f"<{tag}> is {torque.value:.3g} N·m" + ("" if torque.stated else " by default")
    return finding(
        torque,
        f"joint {needed.part!r} needs {abs(needed.value):.3g} N·m, but the plugin's {limit}: "
        f"write <{tag}>{_ABOVE * abs(needed.value):.3g}</{tag}> if its motor gives that",
        key="torque",
    )


def _with_motor(robot: Robot) -> frozenset[str]:
    """Return the joints that something moves: a plugin, a controller, a motor, or a wheel's drive.

    The trial also holds joints that nothing moves; the limit of a passive hinge is no motor's.
    """
    wheels = {wheel.scoped_name for wheel in robot.wheels}
    turning = {tie.joint.scoped_name for tie in robot.tree.ties if tie.child in wheels}
    driven = {*robot.driven_joints, *joints_with_motor(robot), *commanded_joints(robot)}
    return frozenset(driven | turning)


def _path(driven: SettledTrial, joint: str) -> str:
    """Return where a joint is moved, and how far it stays behind within its effort limit."""
    step, error = (driven.trial.value(name, joint) or 0.0 for name in ("move_step", "move_error"))
    unit = "m" if _unit(driven, joint) == "N" else "rad"
    behind = f" and stays {error:.2g} {unit} behind" if error > _BEHIND * step else ""
    return f" for steps of {step:.2g} {unit} from its start{behind}"


_ABOVE = 1.05
"""Limit that a message names / the torque, so that rounding leaves it above."""
_BEHIND = 0.05
"""Share of a joint's step by which it lags visibly."""


_EFFORT = re.compile(
    r"\b(?:effort|torque)s?\W{1,3}limit|\blimit\w*\b[^.]{0,60}\b(?:effort|torque)", re.I
)
_PLACE_OF_IT = re.compile(r"\blines?\s+\d|\w\.(?:sdf|rb|xacro|urdf)\b", re.I)
_SHORTEST_WORD = 4


def _is_explained(joint: Joint, sheet: Specification | None) -> bool:
    """Return whether the sheet names the effort limit of such joints: then it is meant.

    A passage that only gives the place of the limit explains nothing.
    """
    if sheet is None:
        return False
    words = re.split(r"[\W_\d]+", f"{joint.name.value} {joint.child.value}".casefold())
    parts = {word for word in words if len(word) >= _SHORTEST_WORD} - _ANY_JOINT
    return any(
        _EFFORT.search(passage.text)
        and not _PLACE_OF_IT.search(passage.text)
        and any(part in passage.text.casefold() for part in parts)
        for passage in sheet.markdown.passages
    )


_ANY_JOINT = frozenset({"joint", "link", "front", "rear", "left", "right", "back", "base"})


def _unit(driven: SettledTrial, name: str) -> str:
    joint = driven.robot.joints_by_name.get(name)
    return "N" if joint is not None and joint.type.value == "prismatic" else "N·m"


def _rover(effort: float, mark: str = "") -> str:
    return rover(limit=f"<limit><effort>{effort}</effort></limit>", wheel_mark=mark)


def _classic(torque: str) -> dict[str, str]:
    """Return a rover with low limits of its joints, and with the drive of Gazebo Classic."""
    wheels, _, _ = _rover(0.1).partition("<plugin")
    return {
        "@profile": "gazebo-classic",
        "model.sdf": f"""{wheels}
<plugin filename="libgazebo_ros_diff_drive.so" name="drive">
  <left_joint>fl_joint</left_joint><left_joint>rl_joint</left_joint>
  <right_joint>fr_joint</right_joint><right_joint>rr_joint</right_joint>
  <wheel_separation>0.4</wheel_separation><wheel_separation>0.4</wheel_separation>
  <wheel_diameter>0.2</wheel_diameter><wheel_diameter>0.2</wheel_diameter>
  {torque}
</plugin>
</model>
</sdf>
""",
    }


_REFERENCE = "# Acme Rover\n* Torque limit of each wheel: model.sdf, lines 20 and 30\n"
_MARK = "  <!-- ^ TRI009 -->"
_SHEET = """# Acme Rover
The effort limit of the wheels is low, so that they do not slip.
"""


def _arm(effort: float, mark: str = "") -> str:
    """A boom of 2 kg that hangs down from a heavy base: only away from there it has a load."""
    return f"""
<sdf version="1.6">
<model name="acme_arm_sensor_config_1">
<link name="base_link">
  <pose>0 0 0.6 0 0 0</pose>
  <inertial><mass>80</mass><inertia><ixx>5</ixx><iyy>5</iyy><izz>5</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>1 1 1.2</size></box></geometry></collision>
</link>
<link name="boom">
  <pose>0 0.6 1.1 0 0 0</pose>
  <inertial><pose>0 0 -0.4 0 0 0</pose><mass>2</mass>
    <inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
</link>
<joint name="swing" type="revolute">{mark}
  <parent>base_link</parent><child>boom</child>
  <axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>1</upper><effort>{effort}</effort></limit>
  </axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::JointPositionController">
  <joint_name>swing</joint_name>
</plugin>
</model>
</sdf>
"""


def _lid(motor: str, mark: str = "") -> dict[str, object]:
    """Return a chest with a heavy lid that leans to the side, and what moves its hinge."""
    moment = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    return {
        "@urdf": True,
        "urdf/arm.urdf": f"""<robot name="chest">
<link name="base_link">
  <inertial><mass value="80"/>{moment}</inertial>
  <collision><geometry><box size="1 1 1"/></geometry></collision>
</link>
<link name="lid">
  <inertial><origin xyz="0.5 0 0"/><mass value="5"/>{moment}</inertial>
</link>
<joint name="hinge" type="revolute">{mark}
  <parent link="base_link"/><child link="lid"/><origin xyz="0 0 0.6"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="2" velocity="1"/>
</joint>
{motor}
</robot>
""",
    }


_MOTOR = """<transmission name="t">
  <type>transmission_interface/SimpleTransmission</type>
  <joint name="hinge"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
  <actuator name="m"/>
</transmission>"""


def _in_world(gravity: str, mark: str = "") -> str:
    world = f'<sdf version="1.6"><world name="w"><gravity>0 0 {gravity}</gravity>'
    arm = _arm(1.5, mark).replace('<sdf version="1.6">', world)
    return arm.replace("</sdf>", "</world></sdf>")


GOOD = [
    _lid(""),
    _rover(50.0),
    _rover(-1.0),
    {"model.sdf": _rover(0.1), "specifications.md": _SHEET},
    _arm(6.0),
    _in_world("-0.3"),
    _classic("<max_wheel_torque>20</max_wheel_torque>"),
]
BAD = [
    _lid(_MOTOR, _MARK),
    _rover(0.1, _MARK),
    _classic(f"<max_wheel_torque>0.1</max_wheel_torque>{_MARK}"),
    _arm(1.5, _MARK),
    _in_world("-9.8", _MARK),
    {"model.sdf": _rover(0.1, _MARK), "specifications.md": _REFERENCE},
]
