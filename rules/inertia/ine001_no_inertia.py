"""A link without inertia: the simulator uses 1 kg and 1 kg·m² for it.

A sensor of 0.1 kg with a moment of 1 kg·m² resists every turn like a steel bar of two metres, and
adds an unintended kilogram to the total. This includes links on fixed joints. The mass of a link
does not matter if fixed joints connect it to the world, or if the model is static. Outside of
submissions it is a warning in a robot above 20 kg, where the default is little, and in a model
without joints and collisions, such as a camera in the air: nothing has to move it. In URDF a link
without `<inertial>` weighs nothing (URD007), and URD012 reports an incomplete `<inertial>`. From
SDF 1.11 on `<inertial auto="true">` makes the simulator compute it from collisions and densities.

Fix: state mass, pose and inertia of the link, from CAD or the formulas for boxes and cylinders. If
the link is only a frame, lump it into its parent.
Source: SDFormat specification, link/inertial: the defaults.
"""

from collections.abc import Iterator

from msgspec.structs import replace

from checker.formats.sdf.auto_inertia import is_automatic
from checker.formats.sdf.document import parse_version
from checker.model.components import Inertial, Link
from checker.model.robot import Robot
from checker.physics.mass.even_inertia import inertial_fix
from checker.physics.mass.mass_properties import MassProperties
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule

_MOMENTS = 6
_FIRST_AUTOMATIC = (1, 11)
"""SDF version since which the simulator computes an inertia."""

_DEFAULT_MASS = 1.0
"""What SDF takes for a mass that is not stated, kg."""
_HEAVY = 20
"""Times the default mass: beside a robot of more than that, the default is little."""


@rule("INE001", "no-inertia", Severity.ERROR, Concern.ROBOT)
def check(masses: MassProperties, context: Context) -> Findings:
    """Report moving links without inertial, without mass or without any moment of inertia.

    For an object that is not a robot, such as a barrel, it is reported as info.
    """
    robot = masses.robot
    if robot.conventions.has_massless_links:
        return
    automatic = (parse_version(context.reads) or (0, 0)) >= _FIRST_AUTOMATIC
    for link in robot.links:
        if link.scoped_name not in robot.tree.links_fixed_to_world and not robot.is_still(link):
            for found in _missing(robot, link, automatic=automatic):
                severity = None if context.is_subt else _severity(robot, link)
                yield replace(found, severity=severity or found.severity)


def _severity(robot: Robot, link: Link) -> Severity | None:
    """Return the severity where the default is little beside what the robot states or moves."""
    if robot.is_prop:
        return Severity.INFO
    if not robot.joints and not any(each.collisions for each in robot.links):
        return Severity.WARNING
    stated = sum(it.mass.value for each in robot.links if (it := each.inertial) and it.mass.stated)
    own = link.inertial.mass.value if link.inertial is not None else _DEFAULT_MASS
    is_light = own <= _DEFAULT_MASS or link in robot.wheels
    return None if is_light and stated < _HEAVY * _DEFAULT_MASS else Severity.WARNING


def _missing(robot: Robot, link: Link, *, automatic: bool) -> Iterator[Finding]:
    name = link.name.value
    inertial = link.inertial
    taken = "the simulator uses 1 kg·m² about each axis"
    if inertial is None:
        yield finding(
            link,
            f"link {name!r} has no <inertial>: the simulator uses 1 kg and 1 kg·m²",
            key="none",
            fix=inertial_fix(robot, link),
        )
    elif is_automatic(link.element.child("inertial")):
        yield from _left_to_the_simulator(link, inertial, automatic=automatic)
    elif (mass := link.element.child("inertial", "mass")) is not None and mass.get("value"):
        return  # written as in URDF: SDF004 reports it
    elif not any(moment.stated for moment in inertial.moments[:_MOMENTS]):
        yield finding(
            inertial.mass,
            f"link {name!r} states a mass of {inertial.mass.value:g} kg, but no <inertia>: {taken}",
            key="no moments",
            fix=inertial_fix(robot, link),
        )
    elif not inertial.mass.stated:
        yield finding(
            inertial, f"link {name!r} states no <mass>: the simulator uses 1 kg", key="no mass"
        )


def _left_to_the_simulator(link: Link, inertial: Inertial, *, automatic: bool) -> Iterator[Finding]:
    """Report what SDF 1.11 cannot compute, and targets that read older versions."""
    name = link.name.value
    if not automatic:
        message = f"link {name!r} has an automatic inertia, which only SDF 1.11 and later know"
        yield finding(inertial, message, key="automatic")
    elif not link.collisions:
        message = f"link {name!r} has an automatic inertia, but no <collision> to compute it from"
        yield finding(inertial, message, severity=Severity.WARNING, key="automatic")


_INERTIA = "<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia>"


def _arm(inertial: str, mark: str = "", above: str = "base_link", kind: str = "fixed") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link"><inertial><mass>5</mass>{_INERTIA}</inertial></link>
<link name="arm">{mark}
  {inertial}
</link>
<joint name="elbow" type="{kind}">
  <parent>{above}</parent>
  <child>arm</child>
  <axis><xyz>0 0 1</xyz></axis>
</joint>
</model>
</sdf>
"""


_MARK = "<!-- ^ INE001 -->"
_AUTOMATIC = (
    '<inertial auto="true"><density>500</density></inertial>'
    '<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>'
)
GOOD = [
    {"@profile": "gazebo-harmonic", "@fragment": _arm(_AUTOMATIC)},
    _arm(f"<inertial><mass>2</mass>{_INERTIA}</inertial>"),
    _arm("", above="world"),
    "<static>true</static>",
]
BAD = [
    _arm("", _MARK),
    _arm("", _MARK, above="world", kind="revolute"),
    {"@profile": "gazebo-fortress", "@fragment": _arm(_AUTOMATIC + _MARK)},
    {"@profile": "gazebo-jetty", "@fragment": _arm(f'<inertial auto="true"/>{_MARK}')},
    _arm(f"<inertial>\n<mass>2</mass>{_MARK}</inertial>"),
    _arm(f"<inertial>{_MARK}{_INERTIA}</inertial>"),
]
