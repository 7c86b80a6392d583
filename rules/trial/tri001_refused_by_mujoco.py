"""A model that MuJoCo refuses.

Gazebo loads such a model, so this is a warning: a tool as strict as MuJoCo does not load it.
Impossible masses, sizes, axes and limits, and meshes that are missing or open, are reported by the
INE, GEO, KIN, REF and MSH rules, and not again by this one.

Fix: correct the part that the message names. The result of the trial lists the repairs that the
trial needed.
Source: MuJoCo documentation, XML reference: checks of the compiler.
"""

import re

from checker.model.mesh import Mesh
from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_REPORTED = re.compile(r"\b(mass|moments?|axis|limit|size|mesh that|no mesh)\b")
"""Repairs of values that other rules report in more detail."""


@rule("TRI001", "refused-by-mujoco", Severity.WARNING, Concern.PORTABILITY)
def check(driven: RobotTrial) -> Findings:
    """Report why the model is refused, and each repair that the trial needed."""
    trial = driven.trial
    if driven.others:
        yield unchecked(driven.others)
    if trial.refused:
        yield finding(
            driven.part(trial.refused_part),
            f"MuJoCo refuses the model even with repairs: {trial.refused}",
            key="refused",
        )
    for repair in trial.repairs:
        reported = _REPORTED.search(repair.what) or _has_open_mesh(driven, repair.part)
        if repair.serious and not reported:
            yield finding(
                driven.part(repair.part),
                f"MuJoCo refuses the model without a repair: {repair.part!r} {repair.what}",
            )


def _has_open_mesh(driven: RobotTrial, name: str) -> bool:
    """Return whether a collision mesh of a link is open: MSH010 reports it."""
    link = driven.robot.links_by_name.get(name)
    meshes = map(driven.robot.mesh_of, link.collisions if link is not None else ())
    return any(isinstance(mesh, Mesh) and not mesh.watertight for mesh in meshes)


def _arm(mesh: str, mark: str = "") -> dict[str, str]:
    return {
        "@fragment": f"""
<sdf version="1.6">
<model name="acme_arm_sensor_config_1">
<link name="base_link">{mark}
  <inertial><mass>5</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.4 0.4 0.1</size></box></geometry></collision>
  <collision name="sheet">
    <geometry><mesh><uri>meshes/sheet.obj</uri></mesh></geometry>
  </collision>
</link>
</model>
</sdf>
""",
        "meshes/sheet.obj": mesh,
    }


_CORNERS = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 {}\n"
_FACES = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
_ON_BOTH_SIDES = "f 1 3 2\nf 1 2 3\n"
GOOD = [
    _arm(_CORNERS.format(0.1) + _FACES),
    _arm(_CORNERS.format(0) + "f 1 3 2\n"),
]
BAD = [_arm(_CORNERS.format(0) + _ON_BOTH_SIDES, "  <!-- ^ TRI001 -->")]
