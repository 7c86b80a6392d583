"""Makes the meshes and thumbnails of the samples: a few closed solids, drawn from five sides.

Every file is written from the numbers below and from each sample's ``model.sdf``; running the
script again gives the same bytes. Lengths in metres, angles in radians.

    python samples/make_assets.py
"""

import sys
from pathlib import Path

sys.dont_write_bytecode = True  # samples/ holds packages, and no folder beside them

from asset_collada import collada
from asset_pictures import HEIGHT, VIEWS, WIDTH, draw, faces_of, png
from asset_solids import Colour, Meshes, box, cylinder, extrude, plate, track, wheel

HERE = Path(__file__).resolve().parent
HUSKY = HERE / "husky_migration_sensor_config_1"
CRAWLER = HERE / "subtcheck_crawler_sensor_config_1"
BUGGY = HERE / "subtcheck_buggy_sensor_config_1"
QUADRO = HERE / "subtcheck_quadro_sensor_config_1"
OUSTER = HERE / "ouster_description"
OLD_HUSKY = HERE / "husky_description"
BROKEN = HERE / "broken_rover_sensor_config_1"

BLACK: Colour = (0.08, 0.08, 0.09)
GREY: Colour = (0.35, 0.36, 0.38)
YELLOW: Colour = (0.93, 0.74, 0.10)
BLUE: Colour = (0.20, 0.35, 0.60)
RED: Colour = (0.70, 0.15, 0.12)


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
    for name, (solid, colour) in husky_meshes().items():
        (OLD_HUSKY / "meshes" / f"{name}.dae").write_text(collada(name, solid, colour), "utf-8")
    lidar = cylinder(0.042, 0.073, 24)
    (OUSTER / "meshes" / "os1_64.dae").write_text(collada("os1_64", lidar, GREY), "utf-8")
    folder = BROKEN / "meshes"
    body = box((-0.25, 0.25), (-0.15, 0.15), (-0.05, 0.05))
    tyre = wheel(0.1, 0.06, 16)
    (folder / "body.dae").write_text(collada("body", body, BLUE, "body_skin.png"), "utf-8")
    (folder / "Wheel.dae").write_text(collada("tyre", tyre, BLACK), "utf-8")
    (folder / "antenna.stl").write_bytes(b"")


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
    folders += [OUSTER / "meshes", OLD_HUSKY / "meshes"]
    for folder in (*folders, BROKEN / "materials" / "textures"):
        folder.mkdir(parents=True, exist_ok=True)
    write_meshes()
    write_pictures()
    for folder in folders:
        total = sum(file.stat().st_size for file in folder.iterdir())
        print(f"{folder.relative_to(HERE)}: {total} bytes")


if __name__ == "__main__":
    main()
