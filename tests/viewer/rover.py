"""A rover that drives 2 m straight ahead in 2 s, then turns left by a quarter on the spot."""

from __future__ import annotations

import math

from tests.viewer.glb_file import BLUE, ORANGE, UPRIGHT, YELLOW, GlbFile

STRAIGHT, DURATION, STEP = 2.0, 4.0, 0.05
RADIUS, HEIGHT = 0.2, 0.4
BODY = "sdf/model[rover]/link[body]"
AXLE = "sdf/model[rover]/joint[axle]"
MAST = "sdf/model[rover]/link[mast]"


def pose_at(time: float) -> tuple[float, float]:
    """Return the rover's x (metres) and yaw (radians)."""
    return min(time, STRAIGHT), max(0.0, time - STRAIGHT) / (DURATION - STRAIGHT) * math.pi / 2


def rover(*, moving: bool = True, names: tuple[str, str] = ("body", "wheel")) -> bytes:
    """Return the rover's GLB.

    Args:
        moving: With an animation.
        names: Of the body and of the wheel in front of it, which hangs on the world when it moves.
    """
    file = GlbFile()
    world = file.node(name="world", rotation=UPRIGHT)
    links = [f"sdf/model[rover]/link[{name}]" for name in names]
    body, wheel, mast = (
        file.node(world, name=name, extras={"kind": "link", "name": name, "element": element})
        for name, element in (*zip(names, links, strict=True), ("mast", MAST))
    )
    file.nodes[world]["children"].remove(mast)
    file.nodes[body].setdefault("children", []).append(mast)
    file.nodes[mast]["translation"] = [-0.3, 0.0, 0.3]
    file.item(body, "visual", "hull", f"{links[0]}/visual[hull]", file.box((1, 0.6, 0.3), BLUE))
    file.item(
        body, "collision", "hull", f"{links[0]}/collision[hull]", file.box((1.1, 0.7, 0.3), ORANGE)
    )
    file.item(mast, "visual", "pole", f"{MAST}/visual[pole]", file.box((0.05, 0.05, 0.5), YELLOW))
    round_box = file.box((2 * RADIUS, 0.1, 2 * RADIUS), YELLOW)
    file.item(wheel, "visual", "tyre", f"{links[1]}/visual[tyre]", round_box)
    axis = file.box((0.02, 0.4, 0.02), YELLOW)
    file.item(body, "joint", "axle", AXLE, axis, translation=[0.4, 0, 0])
    if moving:
        _animate(file, body, wheel)
    else:
        file.nodes[body]["translation"] = [0.0, 0.0, HEIGHT]
        file.nodes[wheel]["translation"] = [0.7, 0.0, RADIUS]
    return file.written(robot=names[0], size=0.8, centre=[0, 0, HEIGHT])


def _animate(file: GlbFile, body: int, wheel: int) -> None:
    times = [STEP * sample for sample in range(round(DURATION / STEP) + 1)]
    poses = [pose_at(time) for time in times]
    clock = file.accessor([(time,) for time in times], "SCALAR")
    turns = [(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)) for _, yaw in poses]
    file.animate(body, "translation", clock, [(x, 0.0, HEIGHT) for x, _ in poses])
    file.animate(body, "rotation", clock, [*turns])
    front = [(x + 0.7 * math.cos(yaw), 0.7 * math.sin(yaw), RADIUS) for x, yaw in poses]
    rolled = [x / RADIUS / 2 for x, _ in poses]
    file.animate(wheel, "translation", clock, [*front])
    file.animate(wheel, "rotation", clock, [(0.0, math.sin(a), 0.0, math.cos(a)) for a in rolled])
