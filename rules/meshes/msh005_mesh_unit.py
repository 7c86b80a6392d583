"""A mesh in millimetres, centimetres or inches that is read as metres, or the reverse.

The wheel is 200 m high, or too small to see; as a collision it throws the robot out of the world.
Sizes, densities, views and the trial do not take such a mesh into account.

Fix: write `<scale>0.001 0.001 0.001</scale>` for a mesh in millimetres, correct `<unit meter>` in
the COLLADA file, or remove a scale that was applied twice.
Source: geometry; Gazebo uses the unit of a COLLADA file and reads STL and OBJ as metres.
"""

from checker.finding import Fix, Safety
from checker.formats.corrections import number_text, rewrite
from checker.model.geometry.mesh_units import (
    UNIT_LIMITS,
    UNITS,
    MisscaledMesh,
    UnitLimits,
    misscaled_meshes,
)
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.xml_insertion import append_to, attribute_edits


@rule("MSH005", "mesh-unit", Severity.ERROR, Concern.ROBOT)
def check(
    robot: Robot,
    *,
    near: float = UNIT_LIMITS.near,
    beyond: float = UNIT_LIMITS.beyond,
    huge: float = UNIT_LIMITS.huge,
    tiny: float = UNIT_LIMITS.tiny,
    speck: float = UNIT_LIMITS.speck,
) -> Findings:
    """Compare the diagonal of each mesh, including its `<scale>`, with other known lengths.

    Too large: much longer than the robot without its meshes; or longer than it, and larger than the
    simple shapes of its link by the factor of a unit. Too small: smaller by such a factor than the
    link's shapes of the other kind (collisions for a visual, visuals for a collision), or too
    small to see.

    Options:
        near: Factor above 1 by which a ratio of lengths may differ from 39.4 (inches), 100 or 1000
            and still count as that unit.
        beyond: Ratio of a mesh to the robot without its meshes; more is too large. A third of it is
            too large if the link's simple shapes show the factor of a unit.
        huge: Metres; a shorter mesh is too large only if the simple shapes of its link show the
            factor of a unit.
        tiny: Metres; a mesh is too small only if all collisions, or all visuals, of its link
            together measure less.
        speck: Metres; a shorter mesh is too small whatever the other shapes of its link measure.
    """
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    for mesh in misscaled_meshes(robot, UnitLimits(near, beyond, huge, tiny, speck)):
        uri = mesh.use.uri
        why = (
            f"is the mesh in {mesh.unit} without a scale?"
            if mesh.is_large
            else f"is it scaled from {mesh.unit} twice?"
        )
        yield finding(
            uri,
            f"{uri.value} measures {mesh.size:.3g} m, but the {mesh.whose} measures "
            f"{mesh.rest:.3g} m: {why}",
            fix=_scaled(robot, mesh),
        )


def _scaled(robot: Robot, mesh: MisscaledMesh) -> Fix | None:
    """Return the fix that scales a mesh by its unit."""
    times = 1.0 / UNITS[mesh.unit] if mesh.is_large else UNITS[mesh.unit]
    geometry = mesh.use.shape.geometry
    element, scale = geometry.element, geometry.sizes["scale"]
    if scale[0].stated:
        return rewrite((number, number.value * times) for number in scale)
    text = " ".join([number_text(times)] * 3)
    if robot.conventions.is_urdf:
        return Fix(Safety.UNSAFE, attribute_edits(element, {"scale": text}))
    return Fix(Safety.UNSAFE, (append_to(element, [f"<scale>{text}</scale>"]),))


def _rover(visual: str, collision: str = "<box><size>0.6 0.4 0.3</size></box>") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <visual name="v"><geometry>{visual}</geometry></visual>
  <collision name="c"><geometry>{collision}</geometry></collision>
</link>
<link name="mast">
  <pose>0 0 1 0 0 0</pose>
  <visual name="v"><geometry><sphere><radius>0.01</radius></sphere></geometry></visual>
</link>
</model>
</sdf>
"""


def _mesh(scale: float, mark: str = "") -> str:
    scales = " ".join([str(scale)] * 3)
    return f"""<mesh>
    <uri>meshes/body.obj</uri>{mark}
    <scale>{scales}</scale>
  </mesh>"""


def _body(unit: float) -> str:
    """Return a body of about 0.6 × 0.4 × 0.3 m in a unit of so many metres."""
    x, y, z = (side / unit for side in (0.6, 0.4, 0.3))
    return f"v 0 0 0\nv {x} 0 0\nv 0 {y} 0\nv 0 0 {z}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


_MARK = "  <!-- ^ MSH005 -->"
_POINT = "<sphere><radius>0.005</radius></sphere>"

GOOD = [
    {"@fragment": _rover(_mesh(1)), "meshes/body.obj": _body(1.0)},
    {"@fragment": _rover(_mesh(0.001)), "meshes/body.obj": _body(0.001)},
    {"@fragment": _rover(_mesh(1), _POINT), "meshes/body.obj": _body(1.0)},
    {"@fragment": _rover(_mesh(0.01), _POINT), "meshes/body.obj": _body(1.0)},
]
BAD = [
    {"@fragment": _rover(_mesh(1, _MARK)), "meshes/body.obj": _body(0.001)},
    {"@fragment": _rover(_mesh(1, _MARK)), "meshes/body.obj": _body(0.0254)},
    {"@fragment": _rover(_mesh(0.001, _MARK)), "meshes/body.obj": _body(1.0)},
]
