"""The scene of the trial as files: the MJCF with the driven robot, and its meshes."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from lxml import etree

from checker.convert.mjcf_parts import BodyParts, section
from checker.convert.xml_writer import unique
from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.mjcf.names import numbers
from checker.physics.trial.mjcf.scene import GROUND, Scene, build_scene
from checker.physics.trial.plan import Plan
from checker.physics.trial.recording import Changes, Recording
from checker.physics.trial.run import TIMESTEP
from checker.report.scene.scene import DisplayScene

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Points = NDArray[np.float64]

FOLDER = "meshes"
_ROOM = 1e-9
COLLISIONS, VISUALS = "3", "2"
"""Groups of geoms; MuJoCo's viewer shows 0 to 2 at first."""


def scene_of_trial(robot: Robot) -> tuple[Scene, Plan]:
    """Return the scene that a robot is driven in, and what it is commanded."""
    plan = plan_of(robot)
    servos = (*plan.speeds, *plan.places)
    belts = [belt.link for belt in plan.belts]
    return build_scene(robot, servos=servos, belts=belts, timestep=TIMESTEP), plan


def mjcf_of(
    robot: Robot, scene: Scene, plan: Plan, recording: Recording, shown: DisplayScene
) -> etree._Element:
    """Return the scene's document, in which bodies and joints have the robot's own names.

    Args:
        robot: What was driven.
        scene: The scene of the trial.
        plan: The commands of the trial.
        recording: The gains and states of the trial; an empty one leaves them out.
        shown: What the robot looks like.
    """
    root = document_of(robot, scene)
    parts = BodyParts(root, scene)
    seen = parts.add_visuals(shown, VISUALS)
    parts.add_sensors(robot)
    parts.add_encoders()
    parts.add_rotors(plan)
    for geom in root.iter("geom") if seen else ():
        if geom.get("group") is None and geom.get("name") != GROUND:
            geom.set("group", COLLISIONS)
    _tune(root, scene, plan, recording)
    _point_belts(root, recording)
    _add_states(root, scene, plan, recording)
    add_studio(root)
    give_own_names(root, scene)
    return root


def document_of(robot: Robot, scene: Scene) -> etree._Element:
    """Return the document of a scene, with the robot's name."""
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, huge_tree=True, remove_blank_text=True
    )
    root = etree.fromstring(scene.mjcf.encode(), parser)
    root.set("model", robot.name.value)
    return root


def give_own_names(root: etree._Element, scene: Scene) -> dict[str, str]:
    """Give bodies, joints and what uses these the robot's names; return those of the joints.

    They are by the names in the scene.
    """
    bodies, joints = _own_names(scene.bodies), _own_names({**scene.free_joints, **scene.joints})
    taken = {"world": 0}
    for body in root.iter("body"):
        name = body.get("name") or ""
        body.set("name", unique(bodies.get(name) or name, taken))
    return _rename_joints(root, joints)


def _own_names(names: Mapping[str, str]) -> dict[str, str]:
    """Return the robot's names by those of the scene."""
    return {name: part for part, name in names.items()}


def _rename_joints(root: etree._Element, joints: Mapping[str, str]) -> dict[str, str]:
    """Rename joints, and servos and sensors with them."""
    taken: dict[str, int] = {}
    renamed: dict[str, str] = {}
    for joint in root.iter("joint", "freejoint"):
        name = joint.get("name") or ""
        first, _, second = name.partition("_")
        own = joints.get(first) or first
        renamed[name] = unique(f"{own}_{second}" if second else own, taken)
        joint.set("name", renamed[name])
    for user in root.iter("velocity", "position", "jointpos", "jointvel"):
        joint_name = renamed[user.get("joint") or ""]
        user.set("joint", joint_name)
        user.set("name", joint_name if user.tag in ("velocity", "position") else "")
        if not user.get("name"):
            user.set("name", f"{joint_name}/{user.tag.removeprefix('joint')}")
    return renamed


def _tune(root: etree._Element, scene: Scene, plan: Plan, recording: Recording) -> None:
    """Give each servo the gains of the trial, and its slider the range of its commands."""
    lines = {**plan.speeds, **plan.places}
    servos = {element.get("name"): element for element in section(root, "actuator")}
    for number, servo in enumerate(recording.servos):
        element = servos.get(scene.actuators.get(servo.joint))
        # The answering process may be compromised, and name something else.
        if element is None or servo.joint not in lines:
            continue
        del element.attrib["kv"]
        if servo.stiffness:
            element.tag = "position"
            element.set("kp", numbers([servo.stiffness]))
        element.set("kv", numbers([servo.damping]))
        if servo.limit:
            element.set("forcelimited", "true")
            element.set("forcerange", numbers([-servo.limit, servo.limit]))
        commands = [value for _, value in lines[servo.joint]]
        if servo.joint in plan.moves:
            commands = [values[number] for _, values in recording.commands]
        most = max(map(abs, commands), default=0.0) or 1.0
        element.set("ctrllimited", "true")
        element.set("ctrlrange", numbers([-most, most]))


def _point_belts(root: etree._Element, recording: Recording) -> None:
    """Write the direction of each belt, a nanometre a second: MuJoCo keeps room for no zero."""
    geoms = {geom.get("name"): geom for geom in root.iter("geom")}
    for belt in recording.belts:
        if (geom := geoms.get(belt.geom)) is not None:
            turn = (_ROOM * part for part in belt.direction)
            geom.set("surfacevel", numbers((*turn, 0.0, 0.0, 0.0)))


def _add_states(root: etree._Element, scene: Scene, plan: Plan, recording: Recording) -> None:
    """Add a key for each state of the trial, with the commands that follow."""
    if not recording.states:
        return
    section(root, "option").set("timestep", repr(recording.timestep))
    keys = etree.SubElement(root, "keyframe")
    for name, state in recording.states.items():
        commands = _values_at(recording.commands, state.step, len(scene.actuators))
        thrusts = _values_at(recording.thrusts, state.step, len(plan.rotors))
        etree.SubElement(
            keys,
            "key",
            name=name,
            time=repr(state.step * recording.timestep),
            qpos=numbers(state.positions),
            qvel=numbers(state.velocities),
            ctrl=numbers((*commands, *thrusts)),
        )


def _values_at(changes: Changes, step: int, count: int) -> tuple[float, ...]:
    """Return the values of a step; zeros before the first change."""
    held = (0.0,) * count
    for begins, values in changes:
        if begins > step:
            break
        held = values
    return held


def add_studio(root: etree._Element) -> None:
    """Add a sky, a ground with squares of a metre, and a light."""
    assets = section(root, "asset")
    etree.SubElement(
        assets,
        "texture",
        {"type": "skybox", "builtin": "gradient", "width": "256", "height": "256"},
        rgb1="0.86 0.9 0.94",
        rgb2="0.98 0.98 0.98",
    )
    etree.SubElement(
        assets,
        "texture",
        {"name": "squares", "type": "2d", "builtin": "checker", "width": "256", "height": "256"},
        rgb1="0.62 0.64 0.66",
        rgb2="0.54 0.56 0.58",
    )
    etree.SubElement(
        assets,
        "material",
        name="squares",
        texture="squares",
        texrepeat="0.5 0.5",
        texuniform="true",
    )
    section(root, f"worldbody/geom[@name='{GROUND}']").set("material", "squares")
    light = etree.Element("light", pos="0 0 10", dir="0.2 0.3 -1", type="directional")
    section(root, "worldbody").insert(0, light)


def controls_of(mjcf: etree._Element, scene: Scene, plan: Plan, recording: Recording) -> str:
    """Return the commands of the trial as CSV: each row is valid from its time to that of the next.

    The columns are the actuators of the MJCF, and `belt:` with the name of a geom whose surface
    moves (m/s), for which MJCF has no actuator.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    changes = (recording.commands, recording.thrusts, recording.speeds)
    counts = (len(scene.actuators), len(plan.rotors), len(recording.belts))
    names = [actuator.get("name") for actuator in section(mjcf, "actuator").iterchildren("*")]
    writer.writerow(["time", *names, *(f"belt:{belt.geom}" for belt in recording.belts)])
    for step in sorted({step for each in changes for step, _ in each}):
        row = [_values_at(each, step, count) for each, count in zip(changes, counts, strict=True)]
        time = repr(step * recording.timestep)
        writer.writerow([time, *(repr(value) for values in row for value in values)])
    return text.getvalue()


def meshes_apart(mjcf: etree._Element) -> Iterator[tuple[str, str]]:
    """Write meshes to files instead of into the document; yield each file's path and text."""
    for mesh in mjcf.iter("mesh"):
        corners, faces = mesh.get("vertex"), mesh.get("face")
        if corners is None:
            continue
        del mesh.attrib["vertex"]
        path = f"{FOLDER}/{mesh.get('name')}.obj"
        mesh.set("file", path)
        points = [float(word) for word in corners.split()]
        if faces is None:
            yield path, _hull(points)
        else:
            del mesh.attrib["face"]
            yield path, _wavefront(points, [int(word) for word in faces.split()])


def _wavefront(numbers: Sequence[float], faces: Sequence[int]) -> str:
    """Return triangles as a Wavefront file: corners, and three numbers of corners each."""
    corners = zip(*[iter(numbers)] * 3, strict=True)
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in zip(*[iter(faces)] * 3, strict=True)]
    return "\n".join((*lines, ""))


def _hull(numbers: Sequence[float]) -> str:
    """Return the convex hull of corners (x, y, z after another, metres) as a Wavefront file."""
    import numpy as np
    from scipy.spatial import ConvexHull

    points = np.array(numbers).reshape(-1, 3)
    hull = ConvexHull(points)
    faces: list[int] = []
    for (a, b, c), plane in zip(hull.simplices.tolist(), hull.equations, strict=True):
        outwards = np.cross(points[b] - points[a], points[c] - points[a]) @ plane[:3] > 0
        faces += (a, b, c) if outwards else (a, c, b)
    return _wavefront(numbers, faces)
