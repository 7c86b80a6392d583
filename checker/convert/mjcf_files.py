"""The scene of the trial as files: the MJCF, and its meshes beside it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from lxml import etree

from checker.convert.xml_writer import unique
from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.mjcf.scene import Scene, build_scene
from checker.physics.trial.run import TIMESTEP

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Points = NDArray[np.float64]

FOLDER = "meshes"


def scene_of_trial(robot: Robot) -> Scene:
    """Return the scene that a robot is driven in."""
    plan = plan_of(robot)
    servos = (*plan.speeds, *plan.places)
    return build_scene(
        robot, servos=servos, belts=[belt.link for belt in plan.belts], timestep=TIMESTEP
    )


def mjcf_of(robot: Robot, scene: Scene) -> etree._Element:
    """Return the scene's document, in which bodies and joints have the robot's own names."""
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, huge_tree=True, remove_blank_text=True
    )
    root = etree.fromstring(scene.mjcf.encode(), parser)
    root.set("model", robot.name.value)
    bodies, joints = _own_names(scene.bodies), _own_names({**scene.free_joints, **scene.joints})
    taken = {"world": 0}
    for body in root.iter("body"):
        name = body.get("name") or ""
        body.set("name", unique(bodies.get(name) or name, taken))
    _rename_joints(root, joints)
    return root


def _own_names(names: Mapping[str, str]) -> dict[str, str]:
    """Return the robot's names by those of the scene."""
    return {name: part for part, name in names.items()}


def _rename_joints(root: etree._Element, joints: Mapping[str, str]) -> None:
    """Rename joints, and the servos with them."""
    taken: dict[str, int] = {}
    renamed: dict[str, str] = {}
    for joint in root.iter("joint", "freejoint"):
        name = joint.get("name") or ""
        first, _, second = name.partition("_")
        own = joints.get(first) or first
        renamed[name] = unique(f"{own}_{second}" if second else own, taken)
        joint.set("name", renamed[name])
    for servo in root.iter("velocity"):
        servo.set("joint", renamed[servo.get("joint") or ""])
        servo.set("name", servo.get("joint") or "")


def meshes_apart(mjcf: etree._Element) -> Iterator[tuple[str, str]]:
    """Let meshes be files instead of corners in the document; yield each file's path and text."""
    for mesh in mjcf.iter("mesh"):
        corners = mesh.get("vertex")
        if corners is None:
            continue
        del mesh.attrib["vertex"]
        path = f"{FOLDER}/{mesh.get('name')}.obj"
        mesh.set("file", path)
        yield path, _wavefront([float(word) for word in corners.split()])


def _wavefront(numbers: Sequence[float]) -> str:
    """Return the convex hull of corners (x, y, z after another, metres) as a Wavefront file."""
    import numpy as np
    from scipy.spatial import ConvexHull

    points = np.array(numbers).reshape(-1, 3)
    hull = ConvexHull(points)
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    for (a, b, c), plane in zip(hull.simplices.tolist(), hull.equations, strict=True):
        outwards = np.cross(points[b] - points[a], points[c] - points[a]) @ plane[:3] > 0
        first, second = (b, c) if outwards else (c, b)
        lines.append(f"f {a + 1} {first + 1} {second + 1}")
    return "\n".join((*lines, ""))
