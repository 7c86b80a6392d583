"""A link of almost no mass between heavy parts of the robot.

Solvers that work joint by joint pass the weight of one side to the other through the light link,
and lose as many digits as the masses differ. The joint gives way, trembles, or needs very small
time steps. Links on fixed joints count as one body; a light link at the end of a chain is harmless.

Fix: give the link the mass of the bearing or motor that it represents, or fix it to an adjacent
link.
Source: general experience with iterative contact solvers; the ratio is a starting point.
"""

from collections.abc import Iterator

from checker.model.tree import WORLD, Tie
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mass.mechanism import SpanningTree, spanning_tree_of
from checker.rule import Concern, Finding, Findings, Severity, finding, rule


@rule("INE012", "large-mass-ratio", Severity.INFO, Concern.ROBOT)
def check(masses: MassProperties, *, ratio: float = 1e4, share: float = 0.001) -> Findings:
    """Report joints across which masses differ too much, with heavy parts on both sides.

    Options:
        ratio: Mass of the heavier body at a joint divided by that of the lighter one, each with all
            links fixed to it; more is reported.
        share: Share of the robot's mass; a joint is judged only if the parts on each side of it
            have more than that.
    """
    if masses.robot.is_static:
        return
    spanning_tree = spanning_tree_of(masses.robot)
    body = masses.robot.tree.rigid_bodies.of_link
    weight = dict.fromkeys(body.values(), 0.0)
    for name, inertia in masses.links.items():
        weight[body[name]] += max(inertia.mass, 0.0)
    below = _carried_masses(masses, spanning_tree)
    total = sum(weight.values())
    for name, tie in spanning_tree.by.items():
        if tie.parent == WORLD or body[tie.parent] == body[name]:
            continue
        if min(below[name], total - below[name]) > share * total:
            yield from _ratio_findings(tie, weight[body[name]], weight[body[tie.parent]], ratio)


def _carried_masses(masses: MassProperties, spanning_tree: SpanningTree) -> dict[str, float]:
    """Return the mass of each link with all parts that it carries, kg."""
    below = {name: max(masses.links[name].mass, 0.0) for name in spanning_tree.order}
    for name in reversed(spanning_tree.order):
        tie = spanning_tree.by.get(name)
        if tie is not None and tie.parent != WORLD:
            below[tie.parent] += below[name]
    return below


def _ratio_findings(tie: Tie, child: float, parent: float, ratio: float) -> Iterator[Finding]:
    light, heavy = sorted((child, parent))
    if light > 0.0 and heavy > ratio * light:
        yield finding(
            tie.joint,
            f"joint {tie.joint.name.value!r} connects {tie.parent!r} of {parent:.3g} kg with "
            f"{tie.child!r} of {child:.3g} kg, and there are heavy parts on both sides",
        )


def _chain(middle: float, mark: str = "", last: float = 5.0) -> str:
    def link(name: str, mass: float) -> str:
        return f'<link name="{name}"><inertial><mass>{mass}</mass></inertial></link>\n'

    def joint(parent: str, child: str) -> str:
        heavier = mark if parent == "base_link" or last * 1e4 > middle else ""
        return f"""
<joint name="{child}_joint" type="revolute">{heavier}
  <parent>{parent}</parent>
  <child>{child}</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
"""

    links = link("base_link", 20) + link("hinge", middle) + link("arm", last)
    parts = links + joint("base_link", "hinge") + joint("hinge", "arm")
    return f'<sdf version="1.6"><model name="acme_rover_sensor_config_1">{parts}</model></sdf>'


GOOD = [_chain(0.05), _chain(1e-5, last=1e-4)]
BAD = [_chain(1e-5, "  <!-- ^ INE012 -->")]
