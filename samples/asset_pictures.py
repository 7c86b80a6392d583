"""Pictures of robots: their visuals, shaded and drawn from any side, as PNG files."""

import math
import struct
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path

from asset_solids import (
    Colour,
    Meshes,
    Solid,
    Vector,
    box,
    cross,
    cylinder,
    dot,
    minus,
    unit,
)
from lxml import etree

Matrix = tuple[Vector, Vector, Vector]
Face = tuple[tuple[Vector, Vector, Vector], Colour]

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
