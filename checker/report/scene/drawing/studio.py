"""The MuJoCo model in which a robot is drawn: its shapes, soft light, a ground of pale tiles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from checker.physics.mesh.surface import Surface, surface_from_json
from checker.physics.trial.mjcf.names import numbers
from checker.report.scene.drawing.request import FIELD_OF_VIEW

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

GROUND_GROUP = 2
LIGHT = (-0.45, -0.35, -1.0)
"""Its direction: from in front of the robot, above and a little to its left."""
_ROOM = 12.0
"""Factor of the distance of the farthest camera that can be seen."""
_SHADOWED = 1.2
"""Factor of the camera's distance around the middle of the picture within which shadows fall; the
ground gets grainy where they end."""
_THINNEST = 1e-14
"""Share of the squared size below which a triangle has no area."""
_SMALLEST = 1e-12
"""Square metres that a surface must have."""
_PALETTE = "palette"
_STUDIO = f"""
<mujoco>
  <visual>
    <global fovy="{FIELD_OF_VIEW}"/>
    <quality shadowsize="1024" offsamples="0"/>
    <headlight ambient="0.45 0.45 0.45" diffuse="0.33 0.33 0.33" specular="0.05 0.05 0.05"/>
    <rgba haze="0.97 0.98 0.99 1"/>
  </visual>
  <asset>
    <texture name="sky" type="skybox" builtin="gradient" rgb1="0.97 0.98 0.99" rgb2="0.86 0.89 0.92"
             width="64" height="384"/>
    <texture name="tiles" type="2d" builtin="checker" rgb1="0.95 0.955 0.96" rgb2="0.89 0.9 0.91"
             width="256" height="256"/>
    <material name="ground" texture="tiles" texuniform="true" specular="0" shininess="0"/>
  </asset>
  <worldbody>
    <light type="directional" dir="{numbers(LIGHT)}" diffuse="0.36 0.36 0.35"
           specular="0.1 0.1 0.1"/>
  </worldbody>
</mujoco>
"""


def drawn_size(item: Mapping[str, Any]) -> tuple[int, int]:
    """Return width and height in which is drawn: larger, so that edges are smooth once reduced.

    That is quicker than to have OpenGL take several samples for each pixel.
    """
    return item["width"] * 5 // 4, item["height"] * 5 // 4


def model_of(item: Mapping[str, Any]) -> Any:
    """Return the model of the request; see `checker.report.scene.drawing.request`."""
    import mujoco

    spec = mujoco.MjSpec.from_string(_STUDIO)
    spec.visual.global_.offwidth, spec.visual.global_.offheight = drawn_size(item)
    _add_palette(spec)
    meshes = [surface_from_json(surface) for surface in item["meshes"]]
    solid = [_add_mesh(spec, f"m{number}", mesh) for number, mesh in enumerate(meshes)]
    bodies = [spec.worldbody.add_body(mocap=True) for _ in item["links"]]
    by_link = dict(zip(item["links"], bodies, strict=True))
    for geom in item["geoms"]:
        if solid[geom["mesh"]]:
            coloured = meshes[geom["mesh"]].vertex_colours is not None
            by_link[geom["link"]].add_geom(
                type=mujoco.mjtGeom.mjGEOM_MESH,
                meshname=f"m{geom['mesh']}",
                pos=geom["pose"][:3],
                quat=geom["pose"][3:],
                rgba=geom["colour"],
                material=_PALETTE if coloured else "",
                group=geom["group"],
                contype=0,
                conaffinity=0,
            )
    _add_ground(spec, item)
    return spec.compile()


def _add_ground(spec: Any, item: Mapping[str, Any]) -> None:
    """Add the ground, and state how far there is something to see."""
    import mujoco

    distances = [shot["camera"]["distance"] for shot in item["shots"]]
    spec.stat.extent, spec.stat.center = min(distances), item["shots"][0]["camera"]["lookat"]
    spec.visual.map.znear = 0.1
    spec.visual.map.zfar = _ROOM * max(distances) / min(distances)
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[0.0, 0.0, 1.0],
        pos=[0.0, 0.0, item["ground"]],
        material="ground",
        group=GROUND_GROUP,
        contype=0,
        conaffinity=0,
    )


def set_stage(model: Any, shot: Mapping[str, Any]) -> float:
    """Have tiles and light suit what one shot shows.

    Returns how far around the middle of the picture shadows may fall, metres.

    Args:
        model: The model from `model_of`.
        shot: The `tile` in metres and the `camera`.
    """
    import numpy as np

    # The texture is two tiles by two.
    model.mat_texrepeat[model.material("ground").id] = 0.5 / shot["tile"]
    camera = shot["camera"]
    direction = np.array(LIGHT) / np.linalg.norm(LIGHT)
    model.light_pos[0] = camera["lookat"] - direction * camera["distance"]
    return _SHADOWED * float(camera["distance"])


def _add_palette(spec: Any) -> None:
    """Add a texture of 65 536 colours: MuJoCo's meshes have no colours at their corners."""
    import mujoco
    import numpy as np

    number = np.arange(65536)
    red, green, blue = number >> 11 & 31, number >> 5 & 63, number & 31
    pixels = np.stack([red * 255 // 31, green * 255 // 63, blue * 255 // 31], axis=1)
    texture = spec.add_texture(name=_PALETTE, type=mujoco.mjtTexture.mjTEXTURE_2D)
    texture.width = texture.height = 256
    texture.nchannel = 3
    texture.data = pixels.astype(np.uint8).tobytes()
    material = spec.add_material(name=_PALETTE)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = _PALETTE


def _add_mesh(spec: Any, name: str, surface: Surface) -> bool:
    """Add a mesh, unless nothing of it has an area."""
    import mujoco
    import numpy as np

    vertices = surface.vertices.astype(np.float64)
    a, b, c = vertices[surface.faces].transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    size = float(np.ptp(vertices, axis=0).max())
    faces = surface.faces[area > _THINNEST * size * size]
    if not len(faces) or not float(area.sum()) > _SMALLEST:
        return False
    if surface.vertex_colours is not None:
        spot = np.repeat(_spots(surface.vertex_colours[faces].mean(axis=1)), 3, axis=0)
    mesh = spec.add_mesh(name=name, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
    # One triangle alone has too few corners for MuJoCo.
    mesh.uservert = np.vstack([vertices, vertices[:1]]).ravel()
    mesh.userface = faces.ravel().astype(np.int32)
    if surface.vertex_colours is not None:
        mesh.usertexcoord = spot.ravel()
        mesh.userfacetexcoord = np.arange(faces.size)
    return True


def _spots(colours: Array) -> Array:
    """Return the place of each colour in the palette (n × 2)."""
    import numpy as np

    red, green, blue = (colours[:, channel].astype(np.int64) for channel in range(3))
    number = (red >> 3) << 11 | (green >> 2) << 5 | blue >> 3
    return np.stack([(number % 256 + 0.5) / 256, (number // 256 + 0.5) / 256], axis=1)
