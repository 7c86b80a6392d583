"""Visuals, sensors and rotors of a scene for MuJoCo: all but the collisions."""

from __future__ import annotations

import math
from collections.abc import Iterator

from lxml import etree

from checker.convert.xml_writer import unique
from checker.model.components import Link, Sensor
from checker.model.geometry.transform import Transform, rotation_from_quaternion
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.physics.mesh.surface import Surface
from checker.physics.trial.mjcf.names import is_finite_pose, numbers, quaternion
from checker.physics.trial.mjcf.scene import Scene
from checker.physics.trial.plan import Plan
from checker.report.scene.scene import DisplayScene, Item, Layer
from checker.report.scene.shapes import turn_to

_FORWARD = Transform(((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0)))
"""A rangefinder measures along its z axis, a lidar of Gazebo along x."""
_PICTURE = Transform(((0.0, 0.0, -1.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
"""A camera of MuJoCo looks along -z, its y axis up; one of Gazebo along x, its z axis up."""
_AREA = 1e-9
"""Square metres below which MuJoCo refuses a mesh as flat."""
_WIDEST = math.radians(170)
_MEASURES = {
    SensorType.IMU: ("accelerometer", "gyro", "framequat"),
    SensorType.MAGNETOMETER: ("magnetometer",),
    SensorType.ALTIMETER: ("framepos",),
}


class BodyParts:
    """Adds parts to the bodies of a scene, by the robot's names of links."""

    def __init__(self, root: etree._Element, scene: Scene) -> None:
        """Add nothing yet.

        Args:
            root: The document; its bodies have the scene's own names.
            scene: The scene.
        """
        self._root, self._scene = root, scene
        named = {body.get("name"): body for body in root.iter("body")}
        self._bodies = {link: named[name] for link, name in scene.bodies.items() if name in named}
        self._meshes: dict[tuple[int, int, tuple[float, ...]], str] = {}
        self._taken: dict[str, int] = {}

    def add_visuals(self, shown: DisplayScene, group: str) -> bool:
        """Add what the robot looks like, which touches nothing; return whether there is any."""
        seen = False
        for link in shown.links:
            for item in link.items:
                if item.layer is Layer.VISUAL and link.name in self._bodies:
                    for geom in self._looks(item, group):
                        self._bodies[link.name].append(geom)
                        seen = True
        return seen

    def _looks(self, item: Item, group: str) -> Iterator[etree._Element]:
        for surface in item.surfaces:
            if _area(surface, item.scale) < _AREA:
                continue
            yield etree.Element(
                "geom",
                {
                    "type": "mesh",
                    "mesh": self._mesh(surface, item.scale),
                    "group": group,
                    "contype": "0",
                    "conaffinity": "0",
                    "rgba": numbers(_colour(surface)),
                    **_place(item.pose),
                },
            )

    def _mesh(self, surface: Surface, scale: tuple[float, ...]) -> str:
        """Return the name of the mesh that a surface is, at a scale; each is stored once."""
        key = (id(surface.vertices), id(surface.faces), scale)
        if key not in self._meshes:
            self._meshes[key] = f"visual_{len(self._meshes)}"
            etree.SubElement(
                section(self._root, "asset"),
                "mesh",
                {
                    "name": self._meshes[key],
                    "inertia": "shell",
                    "scale": numbers(scale),
                    "vertex": numbers(surface.vertices.ravel().tolist()),
                    "face": " ".join(map(str, surface.faces.ravel().tolist())),
                },
            )
        return self._meshes[key]

    def add_sensors(self, robot: Robot, *, lidars: bool = True) -> None:
        """Add sensors: cameras, what an IMU feels and, unless left out, an axis of each lidar."""
        sensors = etree.SubElement(self._root, "sensor")
        for link in robot.links:
            for sensor in link.sensors:
                if sensor.kind.is_lidar and not lidars:
                    continue
                place = _place_of(robot, link, sensor)
                if place is not None and link.scoped_name in self._bodies:
                    self._add_sensor(sensors, self._bodies[link.scoped_name], sensor, place)

    def add_encoders(self) -> None:
        """Add the position and velocity of each joint with a servo to the sensors."""
        sensors = section(self._root, "sensor")
        for servo in self._root.iter("velocity"):
            for tag in ("jointpos", "jointvel"):
                etree.SubElement(sensors, tag, joint=servo.get("joint") or "")

    def _add_sensor(
        self, sensors: etree._Element, body: etree._Element, sensor: Sensor, place: Transform
    ) -> None:
        name = unique(sensor.name.value, self._taken)
        camera = sensor.camera
        if sensor.kind.takes_pictures and camera is not None:
            angle = min(camera.horizontal_fov.value, _WIDEST)
            wide, high = camera.width.value, camera.height.value
            if angle > 0.0 and min(wide, high) >= 1.0:
                up = 2 * math.atan(math.tan(angle / 2) * high / wide)
                fovy, at = numbers([math.degrees(up)]), _place(place @ _PICTURE)
                etree.SubElement(body, "camera", {"name": name, "fovy": fovy, **at})
            return
        turned = place @ _FORWARD if sensor.kind.is_lidar else place
        etree.SubElement(
            body, "site", {"name": name, "size": "0.01", "group": "4", **_place(turned)}
        )
        if sensor.kind.is_lidar:
            etree.SubElement(sensors, "rangefinder", name=name, site=name)
        for tag in _MEASURES.get(sensor.kind, ()):
            where = (
                {"site": name}
                if not tag.startswith("frame")
                else {
                    "objtype": "site",
                    "objname": name,
                }
            )
            etree.SubElement(sensors, tag, {"name": f"{name}/{tag}", **where})

    def add_rotors(self, plan: Plan) -> None:
        """Add a motor for each rotor, which is commanded its thrust, N."""
        scene = self._scene
        x, y, z, *turn = scene.root_in_robot
        in_root = Transform(rotation_from_quaternion(*turn), (x, y, z)).inverse
        for number, rotor in enumerate(plan.rotors):
            name = unique(f"rotor_{rotor.link or number}", self._taken)
            place = in_root @ Transform(turn_to(rotor.up), rotor.centre)
            site = {"name": name, "size": "0.01", "group": "4", **_place(place)}
            etree.SubElement(self._bodies[scene.root], "site", site)
            etree.SubElement(
                section(self._root, "actuator"),
                "motor",
                {
                    "name": name,
                    "site": name,
                    "ctrllimited": "true",
                    "ctrlrange": numbers([0.0, max(rotor.most, 1e-9)]),
                    # The air turns the copter against the rotor's spin.
                    "gear": numbers([0.0, 0.0, 1.0, 0.0, 0.0, -rotor.spin * rotor.moment]),
                },
            )


def section(root: etree._Element, path: str) -> etree._Element:
    """Return an element that every scene has.

    Raises:
        LookupError: This one has not.
    """
    element = root.find(path)
    if element is None:
        raise LookupError(path)
    return element


def _place(pose: Transform) -> dict[str, str]:
    return {"pos": numbers(pose.translation), "quat": numbers(quaternion(pose.rotation))}


def _place_of(robot: Robot, link: Link, sensor: Sensor) -> Transform | None:
    """Return where a sensor is in its link's frame; None if unknown."""
    place = robot.pose_in_link(link, sensor.pose)
    return place if place is not None and is_finite_pose(place) else None


def _colour(surface: Surface) -> tuple[float, ...]:
    """Return the one colour of a surface: of coloured corners the mean."""
    if surface.vertex_colours is None:
        return surface.colour
    mean = (surface.vertex_colours.mean(axis=0) / 255.0).tolist()
    return tuple(own * each for own, each in zip(surface.colour, mean, strict=True))


def _area(surface: Surface, scale: tuple[float, ...]) -> float:
    """Return the area of all triangles, m²."""
    import numpy as np

    points = surface.vertices.astype(np.float64) * np.array(scale)
    a, b, c = (points[surface.faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2
