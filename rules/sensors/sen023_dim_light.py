"""A light that is black, or too dim because its attenuation is for Gazebo Classic.

With the same settings, lights are darker in Ignition Gazebo than in Gazebo Classic: with an
attenuation for Classic, the robot's cameras see almost nothing in a mine. The brightness is divided
by constant + linear·d + quadratic·d²; Classic's usual constant of 0.5 and more weakens it from the
start.

Fix: lower `<constant>` to about 0.1 and `<linear>` to 0, and set `<quadratic>` for the distance at
which the light fades, such as 0.0025.
Source: Model Migration Guide of SubT (light brightness is lower in ign-gazebo: adjust the
parameters under `<attenuation>`); lights of accepted robots are divided by 0.04 to 0.21 at 1 m,
those that Gazebo Classic makes by 0.51 (general knowledge).
"""

from checker.model.robot import Robot
from checker.model.values import ValueReader
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.xml import Element

_NOT_DARKER = ("", "classic")
"""Releases to which this does not apply: no particular release, and Gazebo Classic."""


@rule("SEN023", "dim-light", Severity.INFO, Concern.ROBOT)
def check(
    robot: Robot,
    context: Context,
    *,
    distance: float = 1.0,
    largest_divisor: float = 0.5,
    least_range: float = 5.0,
) -> Findings:
    """Report lights with an attenuation as in Gazebo Classic, and lights of no colour.

    Options:
        distance: Metres from the light at which its divisor, constant + linear·d + quadratic·d², is
            computed.
        largest_divisor: Greatest divisor of the light at that distance; a light with a greater one
            is reported as dim.
        least_range: Metres; a light with a smaller `<range>` counts as a signal, not a lamp, and is
            skipped.
    """
    if context.release in _NOT_DARKER:
        return
    for link in robot.links:
        for light in link.lights:
            diffuse = light.element.child("diffuse")
            if diffuse is not None and not any(_colour(diffuse)):
                yield finding(diffuse, f"light {light.name.value!r} is black, so it has no effect")
                continue
            attenuation = light.attenuation
            if attenuation is None or light.type == "directional" or not attenuation.is_stated:
                continue
            if attenuation.range.value < least_range:
                continue
            divisor = attenuation.divisor(distance)
            if divisor <= largest_divisor:
                continue
            yield finding(
                attenuation,
                f"the brightness of light {light.name.value!r} is divided by {divisor:.3g} at "
                f"{distance:g} m, as in Gazebo Classic; Ignition Gazebo renders it darker, "
                f"expected {largest_divisor:g} or less",
                key=f"divided by {divisor:.3g}",
            )


def _colour(diffuse: Element) -> tuple[float, ...]:
    """Return red, green and blue."""
    return tuple(number.value for number in ValueReader().numbers_in(diffuse.text)[:3])


def _light(attenuation: str, kind: str = "spot") -> str:
    return f"""
<light name="lamp" type="{kind}">
  <attenuation>{attenuation}
  </attenuation>
</light>
"""


_CLASSIC = "<constant>0.9</constant><linear>0.01</linear><quadratic>0.001</quadratic>"
_MARK = "  <!-- ^ SEN023 -->"
GOOD = [
    _light("<constant>0.1</constant><linear>0</linear><quadratic>0.0025</quadratic>"),
    # Says only how far it shines: what weakens it is left to the simulator.
    _light("<range>20</range>"),
    _light(_CLASSIC, "directional"),
    # A signal lamp.
    _light(f"<range>2</range>{_CLASSIC}"),
    '<light name="lamp" type="point"/>',
    '<light name="lamp" type="point"><diffuse>0 0 1</diffuse></light>',
]
BAD = [
    _light(f"{_MARK}<range>50</range>{_CLASSIC}"),
    _light(f"{_MARK}<constant>0.5</constant><linear>0.01</linear><quadratic>0.001</quadratic>"),
    _light(f"{_MARK}<constant>0.1</constant>"),
    f'<light name="lamp" type="spot"><diffuse>0 0 0 1</diffuse>{_MARK}</light>',
]
