"""Facts of models of MuJoCo, as MuJoCo compiles them."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from typing import Any

from checker.engine.part_facts import rounded
from checker.physics.compiled.model import Actuator, Compiled, CompiledModel, Joint
from checker.report.robot_facts import AxisFacts, JointFacts, LinkFacts, Numbers, RobotFacts


def model_overview(model: CompiledModel) -> dict[str, Any]:
    """Return the figures of a model; the world is no body of it, and a scene has no other."""
    compiled, name = model.compiled, _name(model)
    bodies = len(compiled.bodies) - 1
    known: dict[str, Any] = {"robot" if bodies else "scene": name, "file": model.model.file}
    if bodies:
        known |= {
            "links": bodies,
            "joints": len(compiled.joints),
            "actuators": len(compiled.actuators),
        }
    if not compiled.lacks_meshes:
        if bodies:
            known["mass_kg"] = rounded(sum(body.mass for body in compiled.bodies))
        known["simulated_s"] = rounded(compiled.time)
    return {name: value for name, value in known.items() if value is not None}


def _name(model: CompiledModel) -> str:
    return model.model.document.root.get("model") or posixpath.basename(model.model.file)


def model_facts(model: CompiledModel) -> RobotFacts:
    """Return the bodies and joints of a model, as links and joints of a robot."""
    overview = model_overview(model)
    name, file = _name(model), overview.pop("file")
    overview = {key: value for key, value in overview.items() if key not in ("robot", "scene")}
    bodies = model.compiled.bodies
    lacks_meshes = model.compiled.lacks_meshes
    links = tuple(
        LinkFacts(body.name, None if lacks_meshes else rounded(body.mass), _numbers(body.position))
        for body in bodies[1:]
    )
    joints = tuple(_joints(model.compiled))
    return RobotFacts(name, file, "mjcf", overview, links, joints, (), (), (), (), ())


def _joints(compiled: Compiled) -> Iterator[JointFacts]:
    movers = {actuator.joint: actuator for actuator in reversed(compiled.actuators)}
    for number, joint in enumerate(compiled.joints):
        child = compiled.bodies[joint.body]
        yield JointFacts(
            joint.name,
            joint.type,
            compiled.bodies[child.parent].name,
            child.name,
            True,
            (_axis(joint, movers.get(number)),) if joint.type in ("hinge", "slide") else (),
            (),
            movers[number].name if number in movers else "",
        )


def _axis(joint: Joint, mover: Actuator | None) -> AxisFacts:
    lower, upper = map(rounded, joint.range) if joint.limited else (None, None)
    force = max(map(abs, mover.force_range)) if mover and mover.force_limited else None
    unit = "m" if joint.type == "slide" else "rad"
    effort = None if force is None else rounded(force)
    return AxisFacts(_numbers(joint.axis), unit, lower, upper, None, effort)


def _numbers(values: tuple[float, ...]) -> Numbers:
    return tuple((rounded(value) or 0.0) + 0.0 for value in values)
