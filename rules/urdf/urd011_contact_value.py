"""A friction or contact stiffness in a `gazebo` tag that is not a positive number.

A negative friction accelerates a sliding part, and a contact without stiffness lets the part sink
into the ground. Zero friction is right for a part that slides, so a caster, recognized by its name
or its spherical collision, is not reported. A stiffness so low that the link sinks far into the
ground under a quarter of the robot's weight carries nothing: the robot rests on other links. That
is so in Gazebo Classic; of kp and kd Gazebo Sim asks only that they are numbers (KIN019).

Fix: write a positive number: friction has no unit, kp is in N/m and kd in N·s/m.
Source: Gazebo Classic, "Using a URDF in Gazebo": mu1, mu2, kp, kd; Open Dynamics Engine, contacts;
gz-physics, SDFFeatures.cc of each engine (`physics_engines.json`).
"""

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.extensions import extension_text
from checker.model.values import parse_number
from checker.rule import Concern, Context, Findings, Severity, finding, rule

UNITS = {"mu1": "", "mu2": "", "kp": " N/m", "kd": " N·s/m"}
_GRAVITY = 9.8
_OF_CLASSIC = ("kp", "kd")
"""Tags whose value Gazebo Sim does not read."""
MAY_BE_ZERO = ("mu1", "mu2", "kd")
"""Tags that may be zero: a part may slide without friction, and a contact may have no damping."""


@rule("URD011", "contact-value", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription, context: Context, *, depth: float = 0.1) -> Findings:
    """Report mu1, mu2, kp and kd that are not positive, and a kp that carries nothing.

    Options:
        depth: Metres that a link sinks in under a quarter of the weight, from which on its kp is
            reported.
    """
    if description.for_rviz:
        return
    for tag in description.gazebo:
        for child in tag.element.children:
            if child.tag not in UNITS:
                continue
            where = f"<{child.tag}> of {tag.reference.value!r}"
            text = extension_text(child)
            value = parse_number(text.value.strip())
            if value is None:
                yield finding(text, f"{where} is {text.value[:40]!r}, expected a number")
            elif child.tag in _OF_CLASSIC and context.is_gazebo_sim:
                continue
            elif value <= 0:
                harmless = value == 0 and child.tag in MAY_BE_ZERO
                if harmless and _slides(description, tag.reference.value):
                    continue
                yield finding(
                    text,
                    f"{where} is {value:g}{UNITS[child.tag]}, expected a positive number",
                    severity=Severity.INFO if harmless else None,
                )
            elif child.tag == "kp" and _sunk(description, tag.reference.value, value) > depth:
                sunk = _sunk(description, tag.reference.value, value)
                yield finding(
                    text,
                    f"{where} is {value:g} N/m: under a quarter of the robot's weight it sinks in "
                    f"by {sunk:.2g} m, so it carries nothing; expected 1e6",
                )


def _sunk(description: UrdfDescription, name: str, stiffness: float) -> float:
    """Return how far a link sinks in, m; 0 if it touches nothing."""
    link = description.robot.links_by_name.get(name)
    weight = description.robot.mass * _GRAVITY
    return weight / 4 / stiffness if link is not None and link.collisions else 0.0


def _slides(description: UrdfDescription, name: str) -> bool:
    """Return whether a link is a caster: by its name, or since it stands on a sphere."""
    link = description.robot.links_by_name.get(name)
    shapes = [collision.geometry for collision in link.collisions] if link else []
    is_ball = bool(shapes) and all(shape.shape == "sphere" for shape in shapes)
    return "caster" in name.lower() or is_ball


def _tag(value: str) -> dict[str, str]:
    return {"@urdf": f'<gazebo reference="upper_arm">\n{value}\n</gazebo>'}


def _foot(stiffness: str, mark: str = "") -> dict[str, str]:
    """Return a foot of 8 kg with a contact stiffness."""
    inertia = '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>'
    return {
        "@urdf": f"""
<link name="foot">
  <inertial><mass value="8"/>{inertia}</inertial>
  <collision><geometry><box size="0.2 0.1 0.1"/></geometry></collision>
</link>
<joint name="ankle" type="fixed">
  <parent link="upper_arm"/>
  <child link="foot"/>
</joint>
<gazebo reference="foot"><kp>{stiffness}</kp></gazebo>{mark}
"""
    }


def _sim(example: dict[str, str]) -> dict[str, str]:
    return {**example, "@profile": "ros2"}


_MARK = "  <!-- ^ URD011 -->"
GOOD = [
    _foot("1000"),
    _sim(_foot("5")),
    _sim(_tag("<kd>-1</kd>")),
    _tag("<mu1>1.1</mu1><mu2>0.9</mu2><kp>1e6</kp><kd>100.0</kd>"),
    _tag("<material>Gazebo/Red</material>"),
    {
        "@urdf": """
<link name="caster_wheel"/>
<joint name="caster_joint" type="fixed">
  <parent link="upper_arm"/>
  <child link="caster_wheel"/>
</joint>
<gazebo reference="caster_wheel"><mu1>0</mu1><mu2>0</mu2></gazebo>
"""
    },
    _tag('<mu1 value="1.0"/><kp value="10000000.0"/>'),
]
BAD = [
    _foot("5", _MARK),
    _tag(f"<mu1>-1</mu1>{_MARK}"),
    _sim(_tag(f"<mu1>-1</mu1>{_MARK}")),
    _sim(_tag(f"<kp>hard</kp>{_MARK}")),
    _tag(f"<mu2>0</mu2>{_MARK}"),
    _tag(f"<kp>0</kp>{_MARK}"),
    _tag(f"<kd>much</kd>{_MARK}"),
    _tag(f'<kp value="-1.0"/>{_MARK}'),
]
