"""A part heavier than all links that carry it.

A wheel, finger or sensor weighs less than the body that it is attached to, and no other part weighs
many times as much as all parts between it and the base. Such a mass was copied from another part,
or is in another unit. The robot then swings around the part: it tips over, drives at another speed
than commanded, and needs more torque than its motors have.

Fixed links count as one body; all bodies up to the base carry the part. In the robots from which
the limits were derived, wheels weigh up to 0.6 times as much as the bodies that carry them if the
masses are right, and from 1.6 times if they are wrong; other parts up to 8 times as much, the first
link of an arm on a light base.

Fix: weigh the part, or take its mass from its datasheet, in kg.
Source: comparison of the masses of about 150 robot descriptions.
"""

import re
from collections.abc import Iterator

from checker.base.record import Record
from checker.model.components import Link
from checker.model.tree import WORLD
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mass.mechanism import spanning_tree_of
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

_SMALL = re.compile(
    r"(?:\A|_)(?:finger|fingertip|jaw|claw|camera|lidar|laser|imu|gps|gnss|sonar|radar)(?:\d|_|\Z)",
    re.IGNORECASE,
)
"""Names of fingers and sensors."""


@rule("INE014", "heavier-than-supporting-links", Severity.WARNING, Concern.ROBOT)
def check(
    masses: MassProperties, *, small: float = 1.0, other: float = 10.0, least: float = 0.05
) -> Findings:
    """Report parts that are too heavy for the bodies between them and the base.

    Options:
        small: Mass of a wheel, finger or sensor, divided by that of all bodies that carry it; more
            is reported.
        other: The same of other parts.
        least: Mass in kg; lighter bases may be placeholders, and nothing is compared with them.
    """
    robot = masses.robot
    if robot.is_static or robot.is_prop or any(map(_has_no_mass, robot.links)):
        return
    wheels = {wheel.scoped_name for wheel in robot.wheels}
    for part in _parts(masses):
        turns = part.link in wheels and not part.is_fixed  # a fixed ball may be ballast
        is_small = turns or _is_small(part.link)
        ratio = small if is_small else other
        counts = is_small or not part.is_fixed
        if counts and part.carrying >= least and part.mass > ratio * part.carrying:
            yield from _say(masses, part, ratio)


def _has_no_mass(link: Link) -> bool:
    """Return whether a link's mass is invalid: what it carries is heavier for that reason alone."""
    return link.inertial is not None and link.inertial.mass.value <= 0.0


def _is_small(name: str) -> bool:
    return _SMALL.search(name.rpartition("::")[2]) is not None


class _Part(Record):
    """A link with what is fixed to it, or one that is fixed itself, alone; masses in kg."""

    link: str
    is_fixed: bool
    mass: float
    carrying: float


def _parts(masses: MassProperties) -> Iterator[_Part]:
    tree, bodies = spanning_tree_of(masses.robot), masses.robot.tree.rigid_bodies
    own = {name: max(inertia.mass, 0.0) for name, inertia in masses.links.items()}
    weight = {body: sum(own[name] for name in names) for body, names in bodies.links.items()}
    carrying: dict[str, float] = {}
    for name in tree.order:
        tie, body = tree.by.get(name), bodies.of_link[name]
        if tie is None or tie.parent == WORLD:
            carrying.setdefault(body, 0.0)
        elif (above := bodies.of_link[tie.parent]) != body:
            carrying[body] = carrying[above] + weight[above]
            yield _Part(name, False, weight[body], carrying[body])
        else:
            yield _Part(name, True, own[name], carrying[body] + weight[body] - own[name])


def _say(masses: MassProperties, part: _Part, ratio: float) -> Iterator[Finding]:
    link = masses.robot.links_by_name.get(part.link)
    if link is not None:
        more = "" if part.is_fixed else " with what is fixed to it"
        times = "" if ratio == 1.0 else f"{ratio:g} times "
        yield finding(
            link.inertial.mass if link.inertial is not None else link,
            f"link {link.name.value!r} weighs {part.mass:.3g} kg{more}, more than {times}the "
            f"{part.carrying:.3g} kg of all links that carry it",
        )


def _robot(name: str, base: float, mass: float, mark: str = "", kind: str = "revolute") -> str:
    return f"""
<sdf version="1.6"><model name="acme_rover_sensor_config_1">
<link name="base_link"><inertial><mass>{base}</mass></inertial></link>
<link name="{name}">
  <inertial>
    <mass>{mass}</mass>{mark}
  </inertial>
</link>
<joint name="j" type="{kind}">
  <parent>base_link</parent>
  <child>{name}</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
<link name="mast"><inertial><mass>0.1</mass></inertial></link>
<joint name="turn" type="revolute">
  <parent>base_link</parent>
  <child>mast</child>
  <axis><xyz>0 0 1</xyz></axis>
</joint>
</model></sdf>"""


_MARK = "  <!-- ^ INE014 -->"
GOOD = [
    _robot("left_wheel", 9.6, 5.0),
    _robot("shoulder_link", 0.63, 4.97),
    _robot("front_lidar", 4.0, 1.6, kind="fixed"),
    _robot("boom_link", 0.001, 5.0),
]
BAD = [
    _robot("left_wheel", 4.9, 9.1, _MARK),
    _robot("shoulder_link", 0.63, 497, _MARK),
    _robot("front_lidar", 4.0, 830, _MARK, kind="fixed"),
    _robot("left_finger", 0.5, 15, _MARK),
]
