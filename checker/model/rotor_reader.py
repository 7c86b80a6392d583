"""Reads rotors and the controller of a multicopter out of their plugins."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.model.components import Plugin
from checker.model.limits_reader import symmetric_limits
from checker.model.locomotion import CopterControl, MotionLimits, Rotor, RotorEntry
from checker.model.transform import Vector
from checker.model.values import parse_number, stated_number
from checker.source.text import Located
from checker.source.xml import Element

if TYPE_CHECKING:
    from checker.model.robot import Robot

_DIRECTIONS = {"ccw": 1, "cw": -1}

# Defaults of the gz-sim system MulticopterMotorModel.
_MOTOR_CONSTANT = 8.54858e-06
_MOMENT_CONSTANT = 0.016
_MAX_VELOCITY = 838.0


def read_rotor(robot: Robot, plugin: Plugin) -> Rotor:
    """Read a MulticopterMotorModel."""
    scope = f"{plugin.nested_in}::" if plugin.nested_in else ""
    name = _text(plugin, "jointName")
    joint = robot.joints_by_name.get(scope + name.value)
    link = robot.links_by_name.get(scope + _text(plugin, "linkName").value)
    centre: Vector | None = None
    axis: Vector | None = None
    if joint is not None:
        pose = robot.pose_of_joint(joint)
        centre = None if pose is None else pose.translation
        axis = robot.axis_in_model(joint, joint.axes[0]) if joint.axes else None
    return Rotor(
        plugin,
        name,
        joint,
        link,
        plugin.number("motorNumber"),
        _DIRECTIONS.get(_text(plugin, "turningDirection").value.lower(), 0),
        _number_or(plugin, "motorConstant", _MOTOR_CONSTANT),
        _number_or(plugin, "momentConstant", _MOMENT_CONSTANT),
        _number_or(plugin, "maxRotVelocity", _MAX_VELOCITY),
        centre,
        axis,
    )


def read_copter(plugin: Plugin) -> CopterControl:
    """Read a MulticopterVelocityControl."""
    rotors = (
        rotor
        for holder in plugin.element.all("rotorConfiguration")
        for rotor in holder.all("rotor")
    )
    return CopterControl(
        plugin,
        tuple(_entry(rotor) for rotor in rotors),
        _limits(plugin, "maximumLinearVelocity", "maximumLinearAcceleration"),
        _limits(plugin, "maximumAngularVelocity", ""),
    )


def _entry(rotor: Element) -> RotorEntry:
    name = rotor.child("jointName")
    return RotorEntry(
        name.text if name is not None else Located("", rotor.span, stated=False),
        stated_number(rotor, "direction"),
        stated_number(rotor, "forceConstant"),
        stated_number(rotor, "momentConstant"),
        rotor.span,
    )


def _limits(plugin: Plugin, velocity: str, acceleration: str) -> tuple[MotionLimits, ...]:
    """Return the limits along x, y and z."""
    velocities = _vector(plugin, velocity)
    accelerations = _vector(plugin, acceleration) if acceleration else (None, None, None)
    return tuple(
        symmetric_limits(plugin.span, v, a) for v, a in zip(velocities, accelerations, strict=True)
    )


def _vector(plugin: Plugin, tag: str) -> tuple[Located[float] | None, ...]:
    text = _text(plugin, tag)
    numbers = [parse_number(word) for word in text.value.split()[:3]]
    numbers += [None] * (3 - len(numbers))
    return tuple(None if n is None else Located(n, text.span) for n in numbers)


def _number_or(plugin: Plugin, path: str, default: float) -> Located[float]:
    return plugin.number(path) or Located(default, plugin.span, stated=False)


def _text(plugin: Plugin, tag: str) -> Located[str]:
    return next(plugin.at(tag), Located("", plugin.span, stated=False))
