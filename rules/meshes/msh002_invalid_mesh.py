"""A mesh file that breaks the rules of its format, although Gazebo can load it.

Blender, MuJoCo and most other loaders refuse it. A COLLADA file with `id="<STL_BINARY>"`, for
example, is not XML; Gazebo's parser reads all of it, so this is an info.

Fix: export the mesh again; in a COLLADA file replace `<` in ids by a letter.
Source: the formats' specifications; tinyxml2, which allows `<` in values. Several accepted packages
contain three such files for a lidar.
"""

from checker.model.mesh import NOT_XML, Mesh
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("MSH002", "invalid-mesh", Severity.WARNING, Concern.PORTABILITY)
def check(robot: Robot) -> Findings:
    """Report what the reader had to repair or skip in a mesh."""
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    for use in robot.mesh_uses:
        for defect in use.file.defects if isinstance(use.file, Mesh) else ():
            message = f"{use.uri.value} is not valid: {defect}"
            severity = Severity.INFO if defect.startswith(NOT_XML) else None
            yield finding(use.uri, message, severity=severity, key=defect)


def _visual(suffix: str, mark: str = "") -> str:
    return f"""
<visual name="v"><geometry><mesh>
  <uri>meshes/part.{suffix}</uri>{mark}
</mesh></geometry></visual>
"""


def _collada(name: str) -> str:
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="{name}"><mesh>
  <source id="{name}-points">
    <float_array id="{name}-numbers" count="9">0 0 0 1 0 0 0 1 0</float_array>
    <technique_common><accessor source="#{name}-numbers" count="3" stride="3">
      <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
    </accessor></technique_common>
  </source>
  <vertices id="{name}-corners"><input semantic="POSITION" source="#{name}-points"/></vertices>
  <triangles count="1">
    <input semantic="VERTEX" source="#{name}-corners" offset="0"/><p>0 1 2</p>
  </triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="all"><node id="n">
  <instance_geometry url="#{name}"/>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#all"/></scene>
</COLLADA>"""


_MARK = "  <!-- ^ MSH002 -->"
_FACET = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
_SOLID = f"solid part\n{_FACET}endloop\nendfacet\n"

GOOD = [
    {"@fragment": _visual("dae"), "meshes/part.dae": _collada("STL_BINARY")},
    {"@fragment": _visual("stl"), "meshes/part.stl": _SOLID + "endsolid part\n"},
]
BAD = [
    {"@fragment": _visual("dae", _MARK), "meshes/part.dae": _collada("<STL_BINARY>")},
    {"@fragment": _visual("stl", _MARK), "meshes/part.stl": _SOLID},
]
