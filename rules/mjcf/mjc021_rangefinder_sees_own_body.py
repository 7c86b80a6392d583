"""A rangefinder that always measures the robot that carries it.

MuJoCo lets the beam pass the shapes of the site's own body alone. The shapes of another body, which
no joint lets move against this one, stand in front of it in each pose: the housing of a lidar, for
example, where the sites are in a body of their own inside. What is behind them is never measured.

A beam that meets such a body farther away is not reported: it may be a post that the sensor has to
see past.

Fix: move the site into the body with these shapes, or out of them, before the shape that the beam
leaves last.
Source: MuJoCo 4.0.0, `mj_ray` with the site's body excluded; tried.
"""

from itertools import groupby

from checker.physics.compiled.model import CompiledModel, OwnHit
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("MJC021", "rangefinder-sees-own-body", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel, *, nearest: float = 0.05) -> Findings:
    """Report the first rangefinder of a body, with the number of the others.

    Options:
        nearest: Metres up to which what the beam meets counts as the sensor's own housing.
    """
    bodies = model.compiled.bodies
    near = sorted((it for it in model.compiled.own_hits if it.distance <= nearest), key=_pair)
    for (body, hit), group in groupby(near, key=_pair):
        hits = sorted(group, key=lambda it: it.line)
        more = f" and {len(hits) - 1} more" if hits[1:] else ""
        yield finding(
            model.span(hits[0].line),
            f"rangefinder {hits[0].name!r}{more}: the beam ends {hits[0].distance:.2g} m away at "
            f"body {bodies[hit].name!r}, in each pose; expected the site in this body, not in "
            f"{bodies[body].name!r}, or outside its shapes",
            key=f"{body} {hit}",
            related=[(model.span(bodies[hit].line), "the body that is in the way")],
        )


def _pair(hit: OwnHit) -> tuple[int, int]:
    return hit.body, hit.hit


def _rover(site: str, joint: str = "", mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<worldbody><body name="base"><freejoint/><geom size="0.1 0.1 0.1" type="box"/>
<geom type="cylinder" size="0.03 0.02" pos="0 0 0.12"/>
<body name="scan" pos="0 0 0.12">{joint}<geom size="0.001" mass="0.01"/>
<site name="front" pos="{site}" zaxis="1 0 0"/></body></body></worldbody>
<sensor><rangefinder name="beam" site="front"/>{mark}
</sensor>"""
    }


GOOD = [
    _rover("0.04 0 0"),
    _rover("-0.1 0 0"),
    _rover("0 0 0", '<joint axis="0 0 1"/>'),
]
BAD = [_rover("0 0 0", mark="  <!-- ^ MJC021 -->")]
