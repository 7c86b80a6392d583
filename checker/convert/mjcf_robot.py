"""A robot as MJCF for scenes of its users, which needs no trial: `<mujoco>` with one robot."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from lxml import etree
from msgspec.structs import replace

from checker.base.cache import Cache
from checker.base.errors import CheckerError
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.convert.mjcf_drives import Drive, drives_of, place_gains, speed_gain
from checker.convert.mjcf_files import VISUALS, document_of, give_own_names
from checker.convert.mjcf_parts import BodyParts, section
from checker.convert.mjcf_plain import finish, is_fixed, raise_by, without_trial
from checker.convert.xml_writer import numbers
from checker.model.locomotion.commanded_joints import followers
from checker.model.locomotion.legs import looks_legged
from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.home import Home, Load, at_home
from checker.physics.trial.mjcf.layout import HELD
from checker.physics.trial.mjcf.scene import Scene, build_scene
from checker.physics.trial.plan import Plan
from checker.physics.trial.run import TIMESTEP
from checker.report.scene.scene import DisplayScene

KEY = "home"
_SETTLING_SECONDS = 2.0
_GRAVITY = 9.81
_LEGS = 4
"""Legs that share the weight of a robot that walks, about."""
_STIFF = "0.005 1"
"""Time constant in which a joint follows the one that it copies, s, and its damping ratio."""
_DIGITS = 6
"""Decimals of a pose and of gains: micrometres."""
_NEAR = 1e-3
"""Metres by which a fixed robot may reach below the ground of its scene."""


class RobotMjcf(Record, eq=False):
    """A robot as MJCF.

    Attributes:
        tree: The robot; its meshes are in the document.
        notes: What was left out.
    """

    tree: etree._Element
    notes: tuple[str, ...]


def robot_mjcf(robot: Robot, shown: DisplayScene, cache: Cache) -> RobotMjcf:
    """Return a robot with actuators, a key for its start pose, and all that it looks like.

    Raises:
        CheckerError: MuJoCo can have no model of it.
    """
    plan = plan_of(robot)
    drives = drives_of(robot, plan)
    scene = build_scene(robot, servos=list(drives), timestep=TIMESTEP)
    if scene.unusable:
        raise CheckerError(f"{robot.name.value} cannot be written as MJCF: {scene.unusable}")
    return _Writer(robot, scene, plan, drives).written(shown, cache)


class _Writer:
    def __init__(self, robot: Robot, scene: Scene, plan: Plan, drives: Mapping[str, Drive]) -> None:
        self.robot, self.scene, self.plan, self.drives = robot, scene, plan, drives
        self.root = document_of(robot, scene)
        self.parts = BodyParts(self.root, scene)
        self.bodies = {body.get("name"): body for body in self.root.iter("body")}
        self.freed = self._free()
        renamed = give_own_names(self.root, scene)
        self.joints = {
            name: renamed[joint] for name, joint in scene.joints.items() if joint in renamed
        }
        self.elements = {joint.get("name") or "": joint for joint in self.root.iter("joint")}
        self.endless: Sequence[str] = ()
        self.followers = {
            name: it
            for name, it in followers(robot).items()
            if name in self.joints and it.joint in self.joints
        }

    def written(self, shown: DisplayScene, cache: Cache) -> RobotMjcf:
        """Return the robot; MuJoCo computes what its joints carry, and where it comes to rest."""
        self.endless = without_trial(self.root, self.scene.spawn_height)
        self._couple()
        starts = self._starts()
        home = self._home(starts, cache)
        self._exclude(home)
        self._actuate(home)
        self.parts.add_rotors(self.plan)
        if home.lift > _NEAR:
            raise_by(self.root, home.lift)
        settled = self._home(starts, cache, _SETTLING_SECONDS)
        commands = [*self._commands(settled, starts, home.loads)]
        self._release_motors()
        self._add_key(settled, commands)
        self.parts.add_sensors(self.robot, lidars=False)
        self.parts.add_visuals(shown, VISUALS)
        finish(self.root)
        return RobotMjcf(self.root, tuple(self._notes()))

    def _free(self) -> bool:
        """Let go of what the trial holds, if it stands on legs; return whether the base is free."""
        if self.scene.free_joints:
            return True
        world = section(self.root, "worldbody")
        for link, name in self.scene.bodies.items():
            body = self.bodies[name]
            if (
                body in world
                and link not in self.robot.tree.ties_above
                and looks_legged(self.robot)
            ):
                body.insert(0, etree.Element("freejoint", name=link))
                return True
        return False

    def _couple(self) -> None:
        equality = etree.SubElement(self.root, "equality")
        for name, it in self.followers.items():
            line = numbers((it.offset, it.ratio, 0.0, 0.0, 0.0))
            both = {"joint1": self.joints[name], "joint2": self.joints[it.joint]}
            etree.SubElement(equality, "joint", both, polycoef=line, solref=_STIFF)

    def _starts(self) -> dict[str, float]:
        """Return where joints start, by their names in the document."""
        starts = {name: self.plan.starts.get(name, 0.0) for name in self.joints}
        for name, it in self.followers.items():
            starts[name] = it.offset + it.ratio * starts[it.joint]
        return {self.joints[name]: start for name, start in starts.items()}

    def _home(self, starts: Mapping[str, float], cache: Cache, seconds: float = 0.0) -> Home:
        text = etree.tostring(self.root, encoding="unicode")
        home = at_home(text, starts, cache, seconds=seconds)
        trouble = home.reason if isinstance(home, WorkerFailed) else home.refused
        if isinstance(home, WorkerFailed) or trouble:
            name = self.robot.name.value
            raise CheckerError(f"{name} cannot be written as MJCF: MuJoCo's answer: {trouble}")
        return home

    def _exclude(self, home: Home) -> None:
        """Leave out contacts of parts that touch at the start, and with a base that is fixed.

        MuJoCo leaves out those between a body and its parent, unless the parent is fixed.
        """
        pairs = dict.fromkeys(home.touching)
        for body in self.root.iter("body"):
            base = body.getparent()
            if base is None or not is_fixed(base) or body.find("joint") is None:
                continue
            if base.find("geom") is not None and body.find("geom") is not None:
                pairs[base.get("name") or "", body.get("name") or ""] = None
        contact = etree.SubElement(self.root, "contact")
        names = {body.get("name") for body in self.root.iter("body")}
        for first, second in pairs:
            # The answering process may be compromised, and name something else.
            if {first, second} <= names:
                etree.SubElement(contact, "exclude", body1=first, body2=second)

    def _actuate(self, home: Home) -> None:
        """Turn each servo into the drive of its joint, with gains for its load.

        Until it is known how the robot stands, a servo holds the joint of a motor too.
        """
        loads = dict(self._loads(home))
        actuators = section(self.root, "actuator")
        servos = {servo.get("joint"): servo for servo in actuators}
        for name, joint in self.joints.items():
            servo = servos.get(joint)
            if servo is None or name not in loads:
                continue
            actuators.append(servo)  # In the order of the joints.
            del servo.attrib["kv"]
            speed = self.drives[name] is Drive.VELOCITY
            servo.tag = (Drive.VELOCITY if speed else Drive.POSITION).value
            effort = self._effort(name)
            made = (
                self._for_speed(name, loads[name]) if speed else self._for_place(name, loads[name])
            )
            servo.attrib.update(dict(made))
            if math.isfinite(effort):
                servo.set("forcerange", numbers((-effort, effort)))

    def _effort(self, name: str) -> float:
        effort = self.robot.joints_by_name[name].axes[0].effort.value
        return effort if effort > 0.0 else math.inf

    def _for_place(self, name: str, load: Load) -> Iterator[tuple[str, str]]:
        joint = self.elements[self.joints[name]]
        kind, passive = joint.get("type") or "", float(joint.get("damping") or 0.0)
        friction = float(joint.get("frictionloss") or 0.0)
        gains = place_gains(load, kind, self._effort(name), passive, friction)
        yield "kp", f"{gains.stiffness:.4g}"
        yield "kv", f"{gains.damping:.4g}"
        if places := joint.get("range") or ("-3.14159 3.14159" if kind == "hinge" else ""):
            yield "ctrlrange", places

    def _for_speed(self, name: str, load: Load) -> Iterator[tuple[str, str]]:
        yield "kv", f"{speed_gain(load, self._effort(name)):.4g}"
        if fastest := self._fastest(name):
            yield "ctrlrange", numbers((-fastest, fastest))

    def _release_motors(self) -> None:
        """Replace the servos that hold the joints of motors."""
        motors = self._motor_joints()
        for servo in section(self.root, "actuator"):
            if servo.get("joint") not in motors:
                continue
            servo.tag = Drive.MOTOR.value
            for attribute in ("kp", "kv", "ctrlrange"):
                servo.attrib.pop(attribute, "")
            if force := servo.attrib.pop("forcerange", ""):
                servo.set("ctrlrange", force)

    def _fastest(self, name: str) -> float:
        """Return the greatest speed that a joint may be commanded; 0 if nothing states one."""
        stated = self.robot.joints_by_name[name].axes[0].velocity.value
        if 0.0 < stated < math.inf:
            return stated
        return max((abs(speed) for _, speed in self.plan.speeds.get(name, ())), default=0.0)

    def _loads(self, home: Home) -> Iterator[tuple[str, Load]]:
        """Yield what the motor of each joint moves, with what copies it and stands on it."""
        wheels = sum(drive is Drive.VELOCITY for drive in self.drives.values())
        walks = self.freed and looks_legged(self.robot)
        for name in self.drives:
            load = home.loads.get(self.joints.get(name, ""))
            if load is None:
                continue
            inertia, felt, weight = load.inertia, load.felt, load.weight
            for copy, it in self.followers.items():
                other = home.loads.get(self.joints[copy])
                if it.joint == name and other is not None:
                    inertia += it.ratio**2 * other.inertia
                    felt += it.ratio**2 * other.felt
                    weight += abs(it.ratio) * other.weight
            if self.freed and self.drives[name] is Drive.VELOCITY:
                inertia += home.mass / wheels * load.radius**2
            if walks:
                weight += home.mass / _LEGS * _GRAVITY * load.radius
            yield name, replace(load, inertia=inertia, felt=felt, weight=weight)

    def _motor_joints(self) -> set[str | None]:
        return {self.joints.get(name) for name, it in self.drives.items() if it is Drive.MOTOR}

    def _commands(
        self, settled: Home, starts: Mapping[str, float], loads: Mapping[str, Load]
    ) -> Iterator[float]:
        """Yield the commands that keep the robot as it is: of motors the forces of the servos."""
        motors = self._motor_joints()
        actuators = section(self.root, "actuator")
        for force, actuator in zip(settled.forces, actuators, strict=True):
            joint = actuator.get("joint") or ""
            if joint in motors:
                yield force if self.freed else loads[joint].held
            else:
                yield starts[joint] if actuator.tag == Drive.POSITION else 0.0

    def _add_key(self, home: Home, commands: Iterable[float]) -> None:
        key = etree.SubElement(etree.SubElement(self.root, "keyframe"), "key", name=KEY)
        for name, values in (("qpos", home.positions), ("ctrl", commands)):
            if stated := numbers(round(value, _DIGITS) for value in values):
                key.set(name, stated)

    def _notes(self) -> Iterator[str]:
        yield from (f"{repair.part} {repair.what}" for repair in self.scene.repairs)
        if self.plan.belts:
            yield "MJCF has no actuator for belts: the tracks do not drive"
        left = [joint.name.value for joint in self.robot.joints if joint.mimics]
        if lost := len(left) - len(self.followers):
            yield f"{lost} joints copy a joint that does not move"
        if self.endless:
            listed = ", ".join(self.endless)
            yield f"Joints whose limits are beyond two turns have none in the MJCF: {listed}."
        yield from (note for note in self.scene.notes if not note.startswith(HELD))
        if not self.freed and any(note.startswith(HELD) for note in self.scene.notes):
            yield "The robot is fixed to the world, since it has neither wheels, legs nor a drive."
