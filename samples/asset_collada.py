"""Solids as Collada files."""

from collections.abc import Sequence

from asset_solids import Colour, Solid, Vector, normal

COLLADA = """<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <created>2024-01-01T00:00:00</created>
    <modified>2024-01-01T00:00:00</modified>
    <unit name="meter" meter="1"/>
    <up_axis>Z_UP</up_axis>
  </asset>{images}
  <library_effects>
    <effect id="paint-effect"><profile_COMMON><technique sid="common"><phong>
      <diffuse>{diffuse}</diffuse>
      <specular><color>0.1 0.1 0.1 1</color></specular>
    </phong></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials>
    <material id="paint" name="paint"><instance_effect url="#paint-effect"/></material>
  </library_materials>
  <library_geometries>
    <geometry id="{name}" name="{name}"><mesh>
      {positions}
      {normals}
      <vertices id="{name}-vertices">
        <input semantic="POSITION" source="#{name}-positions"/>
      </vertices>
      <triangles count="{count}" material="paint">
        <input semantic="VERTEX" source="#{name}-vertices" offset="0"/>
        <input semantic="NORMAL" source="#{name}-normals" offset="1"/>
        <p>{indices}</p>
      </triangles>
    </mesh></geometry>
  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene"><node id="{name}-node"><instance_geometry url="#{name}">
      <bind_material><technique_common>
        <instance_material symbol="paint" target="#paint"/>
      </technique_common></bind_material>
    </instance_geometry></node></visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""

IMAGE = """
  <library_images>
    <image id="skin"><init_from>{file}</init_from></image>
  </library_images>"""


SKIN = '<texture texture="skin" texcoord="UV"/>'


def source(identifier: str, vectors: Sequence[Vector]) -> str:
    """A Collada ``<source>`` of vectors, rounded to a micrometre."""
    numbers = " ".join(f"{round(value, 6) + 0.0:g}" for vector in vectors for value in vector)
    params = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
    return (
        f'<source id="{identifier}">'
        f'<float_array id="{identifier}-array" count="{3 * len(vectors)}">{numbers}</float_array>'
        f'<technique_common><accessor source="#{identifier}-array" count="{len(vectors)}"'
        f' stride="3">{params}</accessor></technique_common></source>'
    )


def collada(name: str, solid: Solid, colour: Colour, image: str = "") -> str:
    """The text of a Collada file.

    Args:
        name: Name of the geometry.
        solid: The surface; every triangle gets its own flat normal.
        colour: Red, green, blue in 0…1.
        image: A texture file to name, or nothing.
    """
    normals = [normal(solid, triangle) for triangle in solid.triangles]
    distinct = sorted({tuple(round(value, 6) + 0.0 for value in n) for n in normals})
    number = {n: i for i, n in enumerate(distinct)}
    indices = (
        f"{corner} {number[tuple(round(value, 6) + 0.0 for value in n)]}"
        for triangle, n in zip(solid.triangles, normals, strict=True)
        for corner in triangle
    )
    return COLLADA.format(
        name=name,
        images=IMAGE.format(file=image) if image else "",
        diffuse=SKIN if image else "<color>{:g} {:g} {:g} 1</color>".format(*colour),
        positions=source(f"{name}-positions", solid.vertices),
        normals=source(f"{name}-normals", [(n[0], n[1], n[2]) for n in distinct]),
        count=len(solid.triangles),
        indices=" ".join(indices),
    )
