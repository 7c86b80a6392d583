"""Meshes that are only seen, and that collide beside the simple shapes of their body.

Each shape collides unless it states `contype="0" conaffinity="0"`: a group alone hides it in the
viewer. MuJoCo takes the convex hull of the mesh, which is larger than the simple shapes: the robot
stands on it, neighbouring bodies push each other apart, and each step takes longer.

It is reported for meshes of group 1 or 2, or of a class called visual, in a body with other shapes
that collide.

Fix: write `contype="0" conaffinity="0"` in the class of the visual meshes, or in each of them.
Source: XMLreference, body/geom/contype and group; MuJoCo 4.0.0, tried.
"""

from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("MJC022", "visual-collides", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report the first visual mesh that collides, with the number of the others."""
    bodies = [body for body in model.compiled.bodies if body.colliding_visuals]
    if not bodies:
        return
    number = sum(len(body.colliding_visuals) for body in bodies)
    more = f", as do {number - 1} more in the model" if number > 1 else ""
    yield finding(
        model.span(bodies[0].colliding_visuals[0]),
        f"the visual mesh of body {bodies[0].name!r} collides beside its other shapes{more}: "
        'write contype="0" conaffinity="0"',
        key="visual collides",
    )


def _arm(visual: str, simple: str = "", mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<default><default class="visual"><geom group="0"/></default></default>
<asset><mesh name="arm" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>
<worldbody><geom type="plane" size="9 9 1"/><body name="arm" pos="0 0 2"><freejoint/>
<geom size="0.1" {simple}/>
<geom type="mesh" mesh="arm" mass="0" {visual}/>{mark}
</body></worldbody>"""
    }


_OFF = 'contype="0" conaffinity="0"'
_MARK = "<!-- ^ MJC022 -->"
GOOD = [
    _arm(f'group="2" {_OFF}'),
    _arm(f'class="visual" {_OFF}'),
    _arm('group="2"', _OFF),  # the mesh is the only shape that collides
    _arm('group="3"'),
    _arm('group="2" contype="2" conaffinity="4"'),  # no other shape has these bits
]
BAD = [
    _arm('group="2"', mark=_MARK),
    _arm('group="1"', mark=_MARK),
    _arm('class="visual"', mark=_MARK),
]
