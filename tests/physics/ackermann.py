"""Faults of a robot with steered wheels: its steering, its drive plugin, its wheels."""

from __future__ import annotations

from tests.physics.fault import SPAWNER, Cut, Fault, Swap

SAMPLE = "subtcheck_buggy_sensor_config_1"

KNUCKLE = '<link name="left_knuckle">'
STEERING = '<joint name="left_steering_joint" type="revolute">'
WHEEL = '<link name="rear_left_wheel">'
WHEEL_JOINT = '<joint name="rear_left_wheel_joint" type="revolute">'

FAULTS = (
    Fault(
        "steering limit of zero",
        (Swap("<steering_limit>0.5", "<steering_limit>0", file=SPAWNER),),
        ("TRI006",),
        "AckermannSteering",
    ),
    Fault(
        "wheel base three times too long",
        (Swap("<wheel_base>0.5", "<wheel_base>1.5", file=SPAWNER),),
        ("GEO005", "TRI006"),
        "AckermannSteering",
    ),
    Fault(
        "kingpins three times too wide",
        (Swap("<kingpin_width>0.3", "<kingpin_width>0.9", file=SPAWNER),),
        ("GEO005", "TRI006"),
        "AckermannSteering",
    ),
    Fault(
        "wheel separation halved",
        (Swap("<wheel_separation>0.4", "<wheel_separation>0.2", file=SPAWNER),),
        ("GEO005",),
        "wheel_separation",
    ),
    Fault(
        "wheel radius halved in the plugin",
        (Swap("<wheel_radius>0.1", "<wheel_radius>0.05", file=SPAWNER),),
        ("GEO004",),
        "wheel_radius",
    ),
    Fault(
        "steering joints swapped",
        (
            Swap(">left_steering_joint<", ">kept<", file=SPAWNER),
            Swap(">right_steering_joint<", ">left_steering_joint<", file=SPAWNER),
            Swap(">kept<", ">right_steering_joint<", file=SPAWNER),
        ),
        ("GEO013",),
        "steering_joint",
    ),
    Fault(
        "steering axis reversed",
        (Swap("<xyz>0 0 1", "<xyz>0 0 -1", STEERING),),
        ("GEO013", "TRI005", "TRI006"),
        "left_steering_joint",
    ),
    Fault(
        "steering axis along x",
        (Swap("<xyz>0 0 1", "<xyz>1 0 0", STEERING),),
        ("GEO003", "GEO013", "TRI006"),
        "left_steering_joint",
    ),
    Fault(
        "steering joint that cannot move",
        (
            Swap("<lower>-0.6", "<lower>0", STEERING),
            Swap("<upper>0.6", "<upper>0", STEERING),
        ),
        ("KIN009", "TRI006"),
        "left_steering_joint",
    ),
    Fault(
        "steering effort of 1e-3 N·m",
        (Swap("<effort>20", "<effort>0.001", STEERING),),
        ("TRI009",),
        "left_steering_joint",
    ),
    Fault(
        "wheels that meet the hull when they steer",
        (Swap("<size>0.64 0.2 0.12", "<size>0.64 0.32 0.12"),),
        ("TRI015",),
        "front_left_wheel",
    ),
    Fault(
        "wheel without collision",
        (Cut('<collision name="rear_left_wheel_collision">', "</collision>"),),
        ("GEO002",),
        "rear_left_wheel",
    ),
    Fault(
        "wheel a fifth too large",
        (Swap("<radius>0.1<", "<radius>0.12<", WHEEL),),
        ("GEO004", "GEO006"),
        "rear_left_wheel",
    ),
    Fault(
        "wheel's axis reversed",
        (Swap("<xyz>0 1 0", "<xyz>0 -1 0", WHEEL_JOINT),),
        ("GEO013",),
        "rear_left_wheel",
    ),
    Fault(
        "knuckle without mass",
        (Swap("<mass>0.4", "<mass>0", KNUCKLE),),
        ("INE002",),
        "left_knuckle",
    ),
    Fault(
        "knuckle of 40 kg",
        (Swap("<mass>0.4", "<mass>40", KNUCKLE),),
        ("INE006",),
        "left_knuckle",
    ),
    Fault(
        "effort of 0.1 N·m",
        (Swap("<effort>20", "<effort>0.1", WHEEL_JOINT),),
        ("TRI009",),
        "rear_left_wheel_joint",
    ),
)
