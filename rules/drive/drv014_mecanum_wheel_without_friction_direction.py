"""A Mecanum wheel that rolls like an ordinary wheel in Gazebo.

Gazebo has no rollers: a Mecanum wheel without `<fdir1>` has equal friction in all directions, and
the robot drives ahead but not sideways. It turns badly or not at all: one whose wheelbase is not
shorter than its track turned at 0.000 rad/s in Gazebo Fortress, where about 1 rad/s was commanded.
A friction direction at 45° in the base's frame, with two different coefficients, has the effect
of rollers.

Wheels with links below them are left out, since these may be rollers. Up to Fortress the frame is
that of `ignition:expressed_in`: with `gz:expressed_in` the direction turns with the wheel.

Fix: give the wheel's collision
`<fdir1 gz:expressed_in="base_link">1 -1 0</fdir1>`, `<mu>1</mu>` and `<mu2>0</mu2>` in
`<surface><friction><ode>`, up to Fortress with `ignition:expressed_in`; front right and rear left
wheels have `1 1 0`.
Source: Gazebo Sim's example of the MecanumDrive system; the turn was measured with
ign-physics 5 (DART), which reads `ignition:expressed_in` alone.
"""

from checker.formats.friction import FRAME_ATTRIBUTES, FrictionReader
from checker.model.locomotion.drive import body_velocity
from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_NEW, _OLD = FRAME_ATTRIBUTES
_OLDER = ("dome", "fortress")
"""Releases that know the attribute by its old name."""


@rule(
    "DRV014",
    "mecanum-wheel-without-friction-direction",
    Severity.WARNING,
    Concern.ROBOT,
)
def check(robot: Robot, context: Context) -> Findings:
    """Report wheels of a Mecanum drive whose collisions have no friction direction."""
    if robot.locomotion.kind is not DriveKind.MECANUM or not robot.is_for_gazebo:
        return
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    if any(body_velocity(plugin) for plugin in robot.plugins):
        return
    parents = {joint.scope + joint.parent.value for joint in robot.joints}
    reader = FrictionReader(robot)
    for wheel in (wheel for drive in robot.locomotion.wheel_drives for wheel in drive.wheels):
        names = {link.scoped_name for link in wheel.body}
        shapes = [(link, shape) for link in wheel.body for shape in link.collisions]
        frictions = [reader.friction_of(*each) for each in shapes]
        directed = any(friction.direction for friction in frictions)
        unread = (it.frame_attribute for it in frictions if it.frame_attribute is not None)
        for attribute in unread if context.release in _OLDER else ():
            if attribute.value == _NEW:
                message = f"{context.release.capitalize()} does not read {_NEW}: write {_OLD}"
                yield finding(attribute, message, key="frame")
        if shapes and not directed and not names & parents:
            yield finding(
                shapes[0][1],
                f"wheel {wheel.link.name.value!r} of a Mecanum drive has no <fdir1>: in Gazebo it "
                "rolls like an ordinary wheel, and the robot does not move sideways: add <fdir1> "
                "and <mu2>0</mu2>",
                key="rollers",
            )


def _robot(friction: str = "", below: str = "", plugin: str = "", mark: str = "") -> str:
    joints = ("front_left", "front_right", "back_left", "back_right")
    wheels = "".join(
        f"""
<link name="{name}">
  <collision name="tread">{mark}
    <geometry><sphere><radius>0.1</radius></sphere></geometry>{friction}
  </collision>
</link>
<joint name="{name}_joint" type="revolute">
  <parent>base_link</parent><child>{name}</child><axis><xyz>0 1 0</xyz></axis>
</joint>"""
        for name in joints
    )
    named = "".join(f"<{name}_joint>{name}_joint</{name}_joint>" for name in joints)
    return f"""{wheels}{below}{plugin}
<plugin filename="gz-sim-mecanum-drive-system" name="gz::sim::systems::MecanumDrive">
  {named}
</plugin>
"""


_ROLLERS = "".join(
    f'<link name="{name}_roller"/><joint name="{name}_roller_joint" type="revolute">'
    f"<parent>{name}</parent><child>{name}_roller</child><axis><xyz>1 1 0</xyz></axis></joint>"
    for name in ("front_left", "front_right", "back_left", "back_right")
)
_DIRECTED = """
    <surface><friction><ode>
      <mu>1</mu><mu2>0</mu2><fdir1 gz:expressed_in="base_link">1 -1 0</fdir1>
    </ode></friction></surface>"""
_WHOLE = (
    '<plugin filename="gz-sim-velocity-control-system" name="gz::sim::systems::VelocityControl"/>'
)
_MARK = "  <!-- ^ DRV014 -->"
GOOD = [
    {"@fragment": _robot(_DIRECTED), "@profile": "gazebo-harmonic"},
    {"@fragment": _robot(_DIRECTED.replace(_NEW, _OLD)), "@profile": "gazebo-fortress"},
    _robot(below=_ROLLERS),
    _robot(plugin=_WHOLE),
]
BAD = [
    _robot(mark=_MARK),
    {
        "@fragment": _robot(_DIRECTED.replace("</fdir1>", f"</fdir1>{_MARK}")),
        "@profile": "gazebo-fortress",
    },
]
