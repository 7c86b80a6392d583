"""Makes the meshes and thumbnails of the samples: a few closed solids, drawn from five sides.

Every file is written from the numbers below and from each sample's ``model.sdf``; running the
script again gives the same bytes. Lengths in metres, angles in radians.

    python samples/make_assets.py
"""

import math
import struct
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from lxml import etree

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]
Colour = tuple[float, float, float]
Face = tuple[tuple[Vector, Vector, Vector], Colour]

HERE = Path(__file__).resolve().parent
HUSKY = HERE / "husky_migration_sensor_config_1"
CRAWLER = HERE / "subtcheck_crawler_sensor_config_1"
BUGGY = HERE / "subtcheck_buggy_sensor_config_1"
QUADRO = HERE / "subtcheck_quadro_sensor_config_1"
BROKEN = HERE / "broken_rover_sensor_config_1"

BLACK: Colour = (0.08, 0.08, 0.09)
GREY: Colour = (0.35, 0.36, 0.38)
YELLOW: Colour = (0.93, 0.74, 0.10)
BLUE: Colour = (0.20, 0.35, 0.60)
RED: Colour = (0.70, 0.15, 0.12)


@dataclass(frozen=True)
class Solid:
    """A closed surface of triangles whose corners run counter-clockwise seen from outside."""

    vertices: tuple[Vector, ...]
    triangles: tuple[tuple[int, int, int], ...]


def extrude(
    profile: Sequence[tuple[float, float]],
    low: float,
    high: float,
    axis: str = "z",
    pieces: Sequence[Sequence[int]] = (),
) -> Solid:
    """Pulls a counter-clockwise outline along an axis.

    Args:
        profile: Corners in the plane of the two other axes, in the cyclic order x, y, z.
        low: Lower end along the axis, in metres.
        high: Upper end along the axis, in metres.
        axis: ``x``, ``y`` or ``z``.
        pieces: Convex parts of a hollow outline, as corner numbers; empty for a convex one.
    """
    count = len(profile)
    turn = {"z": (0, 1, 2), "x": (2, 0, 1), "y": (1, 2, 0)}[axis]

    def place(u: float, v: float, w: float) -> Vector:
        local = (u, v, w)
        return local[turn[0]], local[turn[1]], local[turn[2]]

    vertices = [place(u, v, low) for u, v in profile] + [place(u, v, high) for u, v in profile]
    triangles: list[tuple[int, int, int]] = []
    for i in range(count):
        j = (i + 1) % count
        triangles += [(i, j, count + j), (i, count + j, count + i)]
    for piece in pieces or [range(count)]:
        for b, c in pairwise(piece[1:]):
            triangles += [(piece[0], c, b), (count + piece[0], count + b, count + c)]
    return Solid(tuple(vertices), tuple(triangles))


def box(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Solid:
    """A box between two corners."""
    return extrude([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])], z[0], z[1])


def plate(length: float, width: float, height: float, bevel: float) -> Solid:
    """An upright plate with bevelled corners, standing on its origin."""
    a, b = length / 2, width / 2
    c, d = a - bevel, b - bevel
    outline = [(-c, -b), (c, -b), (a, -d), (a, d), (c, b), (-c, b), (-a, d), (-a, -d)]
    return extrude(outline, 0.0, height)


def cylinder(radius: float, length: float, segments: int = 32) -> Solid:
    """A cylinder about the z axis."""
    turns = (2 * math.pi * k / segments for k in range(segments))
    outline = [(radius * math.cos(t), radius * math.sin(t)) for t in turns]
    return extrude(outline, -length / 2, length / 2)


def track(length: float, radius: float, width: float, segments: int = 16) -> Solid:
    """A track along the x axis: a belt around two wheels.

    Args:
        length: Between the middles of the wheels, in metres.
        radius: Of a wheel with its belt, in metres.
        width: Along the y axis, in metres.
        segments: Of each half circle.
    """
    turns = [math.pi * k / segments for k in range(segments + 1)]
    front = [(radius * math.cos(t), length / 2 + radius * math.sin(t)) for t in turns]
    rear = [(-z, -x) for z, x in front]
    return extrude([*front, *rear], -width / 2, width / 2, "y")


def wheel(radius: float, width: float, segments: int = 32) -> Solid:
    """A wheel about the y axis with rounded shoulders; ``segments`` is a multiple of four."""
    half = width / 2
    rings = [
        (0.9 * radius, -half),
        (radius, -0.7 * half),
        (radius, 0.7 * half),
        (0.9 * radius, half),
    ]
    vertices: list[Vector] = [(0.0, -half, 0.0), (0.0, half, 0.0)]
    for r, y in rings:
        turns = (2 * math.pi * k / segments for k in range(segments))
        vertices += [(r * math.cos(t), y, r * math.sin(t)) for t in turns]
    triangles: list[tuple[int, int, int]] = []
    last = 2 + (len(rings) - 1) * segments
    for k in range(segments):
        n = (k + 1) % segments
        triangles += [(0, 2 + k, 2 + n), (1, last + n, last + k)]
        for ring in range(len(rings) - 1):
            a, b = 2 + ring * segments, 2 + (ring + 1) * segments
            triangles += [(a + k, b + k, b + n), (a + k, b + n, a + n)]
    return Solid(tuple(vertices), tuple(triangles))


def minus(a: Vector, b: Vector) -> Vector:
    """The vector from ``b`` to ``a``."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """The cross product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Vector, b: Vector) -> float:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(a: Vector) -> Vector:
    """The same direction with length one."""
    length = math.sqrt(dot(a, a))
    return a[0] / length, a[1] / length, a[2] / length


def normal(solid: Solid, triangle: tuple[int, int, int]) -> Vector:
    """The outward unit normal of a triangle."""
    a, b, c = (solid.vertices[i] for i in triangle)
    return unit(cross(minus(b, a), minus(c, a)))


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


Meshes = dict[str, tuple[Solid, Colour]]


def husky_meshes() -> Meshes:
    """The meshes of the Husky, by file name without ``.dae``."""
    # outlines that lie in the plane (z, x) for axis y, (y, z) for axis x
    hull = [(0.0, -0.41), (0.04, -0.45), (0.205, -0.45), (0.205, 0.45), (0.04, 0.45), (0.0, 0.41)]
    rail = [(-0.24, 0), (-0.21, 0), (-0.21, 0.15), (0.21, 0.15), (0.21, 0), (0.24, 0)]
    rail += [(0.24, 0.18), (-0.24, 0.18)]
    rail_pieces = [(0, 1, 2, 7), (2, 3, 6, 7), (3, 4, 5, 6)]
    bar = [(0, -0.25), (0.03, -0.25), (0.05, -0.2), (0.05, 0.2), (0.03, 0.25), (0, 0.25)]
    # open to the front at the height of the scanner's window
    scanner = [(0, -0.0525), (0.162, -0.0525), (0.162, 0.0525), (0.132, 0.0525), (0.132, -0.035)]
    scanner += [(0.098, -0.035), (0.098, 0.0525), (0, 0.0525)]
    scanner_pieces = [(0, 1, 4, 5), (1, 2, 3, 4), (0, 5, 6, 7)]
    return {
        "base_link": (extrude(hull, -0.215, 0.215, "y"), BLACK),
        "top_chassis": (plate(0.79, 0.55, 0.04, 0.06), YELLOW),
        "top_plate": (plate(0.45, 0.46, 0.01, 0.02), GREY),
        "bumper": (extrude(bar, -0.04, 0.04), BLACK),
        "user_rail": (extrude(rail, -0.015, 0.015, "x", rail_pieces), BLACK),
        "lms1xx_mount": (plate(0.12, 0.12, 0.01, 0.02), GREY),
        "sick-lms1xx": (extrude(scanner, -0.051, 0.051, "y", scanner_pieces), BLUE),
        "wheel": (wheel(0.1651, 0.1143), BLACK),
    }


def crawler_meshes() -> Meshes:
    """The meshes of the crawler."""
    hull = [(0.0, -0.24), (0.04, -0.28), (0.12, -0.25), (0.12, 0.25), (0.04, 0.28), (0.0, 0.24)]
    return {
        "hull": (extrude(hull, -0.165, 0.165, "y"), YELLOW),
        "track": (track(0.46, 0.09, 0.1), BLACK),
    }


def buggy_meshes() -> Meshes:
    """The meshes of the buggy."""
    hull = [(-0.01, -0.3), (0.02, -0.32), (0.11, -0.28), (0.11, 0.26), (0.03, 0.32), (-0.01, 0.3)]
    return {
        "hull": (extrude(hull, -0.1, 0.1, "y"), RED),
        "wheel": (wheel(0.1, 0.06), BLACK),
    }


def quadro_meshes() -> Meshes:
    """The meshes of the quadrotor."""
    body = [(-0.03, -0.08), (0.0, -0.1), (0.03, -0.08), (0.03, 0.08), (0.0, 0.1), (-0.03, 0.08)]
    blade = [(-0.119, -0.005), (0.0, -0.012), (0.119, -0.005)]
    propeller = [*blade, *((-x, -y) for x, y in blade)]
    return {
        "body": (extrude(body, -0.1, 0.1, "y"), YELLOW),
        "propeller": (extrude(propeller, -0.004, 0.004), BLACK),
    }


def good_samples() -> dict[Path, Meshes]:
    """The meshes of each good sample, by its folder."""
    return {
        HUSKY: husky_meshes(),
        CRAWLER: crawler_meshes(),
        BUGGY: buggy_meshes(),
        QUADRO: quadro_meshes(),
    }


def write_meshes() -> None:
    """Writes the Collada files of all samples."""
    for sample, meshes in good_samples().items():
        for name, (solid, colour) in meshes.items():
            (sample / "meshes" / f"{name}.dae").write_text(collada(name, solid, colour), "utf-8")
    folder = BROKEN / "meshes"
    body = box((-0.25, 0.25), (-0.15, 0.15), (-0.05, 0.05))
    tyre = wheel(0.1, 0.06, 16)
    (folder / "body.dae").write_text(collada("body", body, BLUE, "body_skin.png"), "utf-8")
    (folder / "Wheel.dae").write_text(collada("tyre", tyre, BLACK), "utf-8")
    (folder / "antenna.stl").write_bytes(b"")


WIDTH, HEIGHT = 320, 240
# file name → direction from the robot to the eye, and what is up in the picture
VIEWS: dict[str, tuple[Vector, Vector]] = {
    "1": ((1.0, 0.9, 0.7), (0.0, 0.0, 1.0)),
    "2": ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)),
    "3": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "4": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "5": ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
}
LIGHT = unit((0.4, 0.5, 1.0))


def pose_of(element: etree._Element) -> tuple[Matrix, Vector]:
    """Rotation and position of an element's ``<pose>`` (roll, pitch, yaw about fixed axes)."""
    x, y, z, roll, pitch, yaw = (float(word) for word in element.findtext("pose", "0 " * 6).split())
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    rotation = (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )
    return rotation, (x, y, z)


def move(frame: tuple[Matrix, Vector], point: Vector) -> Vector:
    """A point of the frame in the frame around it."""
    (a, b, c), (x, y, z) = frame
    return dot(a, point) + x, dot(b, point) + y, dot(c, point) + z


def solid_of(visual: etree._Element, meshes: Meshes) -> Solid:
    """The shape of a visual of a good sample: one of its meshes, a cylinder or a box."""
    uri = visual.findtext("geometry/mesh/uri")
    if uri:
        return meshes[Path(uri).stem][0]
    radius, length = (visual.findtext(f"geometry/cylinder/{size}") for size in ("radius", "length"))
    if radius and length:
        return cylinder(float(radius), float(length))
    x, y, z = (float(word) / 2 for word in visual.findtext("geometry/box/size", "").split())
    return box((-x, x), (-y, y), (-z, z))


def faces_of(model: Path, meshes: Meshes) -> Iterator[Face]:
    """Every triangle of every visual of a model file."""
    for link in etree.parse(model).getroot().iter("link"):
        for visual in link.findall("visual"):
            solid = solid_of(visual, meshes)
            red, green, blue = visual.findtext("material/diffuse", "0.5 0.5 0.5 1").split()[:3]
            colour = (float(red), float(green), float(blue))
            places = [
                move(pose_of(link), move(pose_of(visual), vertex)) for vertex in solid.vertices
            ]
            for a, b, c in solid.triangles:
                yield (places[a], places[b], places[c]), colour


def shade(face: Face) -> bytes:
    """The face's colour under the lamp, as three bytes."""
    (a, b, c), colour = face
    bright = 0.45 + 0.55 * max(0.0, dot(unit(cross(minus(b, a), minus(c, a))), LIGHT))
    return bytes(min(255, round(255 * (0.12 + 0.88 * part) * bright)) for part in colour)


def fill(corners: list[Vector], paint: bytes, picture: bytearray, depth: list[float]) -> None:
    """Paints one triangle of picture coordinates where nothing nearer is painted yet."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    if abs(area) < 1e-9:
        return
    for row in range(max(0, math.floor(min(ay, by, cy))), min(HEIGHT, math.ceil(max(ay, by, cy)))):
        for column in range(math.floor(min(ax, bx, cx)), math.ceil(max(ax, bx, cx))):
            x, y = column + 0.5, row + 0.5
            v = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area
            w = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area
            near = az + v * (bz - az) + w * (cz - az)
            spot = row * WIDTH + column
            if v >= 0 and w >= 0 and v + w <= 1 and near > depth[spot]:
                depth[spot] = near
                picture[3 * spot : 3 * spot + 3] = paint


def extent(faces: Sequence[Face]) -> tuple[Vector, float]:
    """The middle of the faces' box, and its diagonal in metres."""
    corners = [corner for triangle, _ in faces for corner in triangle]
    low = [min(corner[i] for corner in corners) for i in range(3)]
    high = [max(corner[i] for corner in corners) for i in range(3)]
    x, y, z = ((a + b) / 2 for a, b in zip(low, high, strict=True))
    return (x, y, z), math.dist(low, high)


def draw(faces: Sequence[Face], eye: Vector, up: Vector) -> bytes:
    """A picture without perspective that the robot fills, as rows of RGB bytes."""
    ahead = unit(eye)
    right = unit(cross(up, ahead))
    above = cross(ahead, right)
    picture = bytearray(b"\xf2\xf4\xf6" * (WIDTH * HEIGHT))
    depth = [-math.inf] * (WIDTH * HEIGHT)
    middle, size = extent(faces)
    scale = HEIGHT / (1.1 * size)
    for face in faces:
        corners = []
        for corner in face[0]:
            offset = minus(corner, middle)
            across, high = scale * dot(offset, right), scale * dot(offset, above)
            corners.append((WIDTH / 2 + across, HEIGHT / 2 - high, dot(offset, ahead)))
        fill(corners, shade(face), picture, depth)
    return bytes(picture)


def png(rows: bytes, width: int, height: int) -> bytes:
    """A PNG file of RGB bytes."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        checksum = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + checksum

    lines = b"".join(b"\0" + rows[3 * width * r : 3 * width * (r + 1)] for r in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    body = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


def write_pictures() -> None:
    """Writes the thumbnails, and the broken sample's texture and cut-off thumbnail."""
    for sample, meshes in good_samples().items():
        faces = list(faces_of(sample / "model.sdf", meshes))
        for name, (eye, up) in VIEWS.items():
            picture = png(draw(faces, eye, up), WIDTH, HEIGHT)
            (sample / "thumbnails" / f"{name}.png").write_bytes(picture)
    panel = png(b"\x30\x58\x98" * 64, 8, 8)
    (BROKEN / "materials" / "textures" / "panel.png").write_bytes(panel)
    (BROKEN / "thumbnails" / "1.png").write_bytes(panel[:20])


def main() -> None:
    """Writes all assets and says how much they weigh."""
    samples = (*good_samples(), BROKEN)
    folders = [sample / part for sample in samples for part in ("meshes", "thumbnails")]
    for folder in (*folders, BROKEN / "materials" / "textures"):
        folder.mkdir(parents=True, exist_ok=True)
    write_meshes()
    write_pictures()
    for folder in folders:
        total = sum(file.stat().st_size for file in folder.iterdir())
        print(f"{folder.relative_to(HERE)}: {total} bytes")


if __name__ == "__main__":
    main()
