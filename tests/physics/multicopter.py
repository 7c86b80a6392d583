"""Faults of a multicopter: its rotors, the plugins that turn them, its balance."""

from __future__ import annotations

from tests.physics.fault import SPAWNER, Cut, Fault, Swap

SAMPLE = "subtcheck_quadro_sensor_config_1"

MOTOR = "<!-- Rotor 0, front right"
ENTRY = "<rotorConfiguration>"
ROTOR = '<link name="rotor_0">'
JOINT = '<joint name="rotor_0_joint" type="revolute">'

FAULTS = (
    Fault(
        "thrust too low to fly",
        (
            Swap("<motorConstant>1.2e-05", "<motorConstant>5e-06", file=SPAWNER, everywhere=True),
            Swap("<forceConstant>1.2e-05", "<forceConstant>5e-06", file=SPAWNER, everywhere=True),
        ),
        ("DRV010", "TRI010"),
        "weight",
    ),
    Fault(
        "rotor constant of one motor wrong",
        (Swap("<motorConstant>1.2e-05", "<motorConstant>2.4e-05", MOTOR, SPAWNER),),
        ("DRV010",),
        "rotor_0",
    ),
    Fault(
        "rotor constant wrong in the controller",
        (Swap("<forceConstant>1.2e-05", "<forceConstant>1.2", ENTRY, SPAWNER),),
        ("DRV010", "TRI010"),
        "MulticopterVelocityControl",
    ),
    Fault(
        "moment constant of one motor wrong",
        (Swap("<momentConstant>0.016", "<momentConstant>0.16", MOTOR, SPAWNER),),
        ("DRV010",),
        "rotor_0",
    ),
    Fault(
        "rotor ten times too fast",
        (Swap("<maxRotVelocity>900", "<maxRotVelocity>9000", file=SPAWNER, everywhere=True),),
        ("DRV010",),
        "maxRotVelocity",
    ),
    Fault(
        "rotor that turns the wrong way",
        (Swap(">ccw<", ">cw<", MOTOR, SPAWNER),),
        ("DRV010",),
        "rotor_0",
    ),
    Fault(
        "direction wrong in the controller",
        (Swap("<direction>1", "<direction>-1", ENTRY, SPAWNER),),
        ("DRV010",),
        "rotor_0",
    ),
    Fault(
        "motor number twice",
        (Swap("<motorNumber>0", "<motorNumber>1", MOTOR, SPAWNER),),
        ("DRV010",),
        "motorNumber",
    ),
    Fault(
        "motor number left out",
        (Swap("<motorNumber>3", "<motorNumber>7", file=SPAWNER),),
        ("DRV010",),
        "motorNumber",
    ),
    Fault(
        "rotor joint that does not exist",
        (Swap("<jointName>rotor_0_joint", "<jointName>rotor_9_joint", MOTOR, SPAWNER),),
        ("DRV010", "PLG004"),
        "rotor_9_joint",
    ),
    Fault(
        "rotor without motor",
        (Cut("<!-- Rotor 3, rear right", "<!-- Flight control", SPAWNER, inclusive=False),),
        ("DRV010", "TRI010"),
        "otor_3",
    ),
    Fault(
        "rotor in the place of another",
        (Swap("<pose>0.18 -0.18 0.06", "<pose>0.18 0.18 0.06"),),
        ("GEO015", "DRV010", "TRI010"),
        "rotor_0",
    ),
    Fault(
        "rotor's axis along x",
        (Swap("<xyz>0 0 1", "<xyz>1 0 0", JOINT),),
        ("DRV010", "GEO003", "KIN013", "TRI010"),
        "rotor_0",
    ),
    Fault(
        "fixed joint of a rotor",
        (Swap(JOINT, JOINT.replace("revolute", "fixed")),),
        ("DRV010", "KIN009"),
        "rotor_0",
    ),
    Fault(
        "centre of mass outside the rotors",
        (Swap("<pose>0.004102 0 -0.005833", "<pose>0.4 0 -0.005833"),),
        ("INE005",),
        "base_link",
    ),
    Fault(
        "ten times too heavy",
        (Swap("<mass>1.92", "<mass>19.2"),),
        ("INE008", "DRV010", "TRI010"),
        "weigh",
    ),
    Fault(
        "identity as inertia of the body",
        (
            Swap("<ixx>0.0136158", "<ixx>1"),
            Swap("<ixz>-0.000045938", "<ixz>0"),
            Swap("<iyy>0.0140025", "<iyy>1"),
            Swap("<izz>0.019325", "<izz>1"),
        ),
        ("INE004", "INE007"),
        "base_link",
    ),
    Fault(
        "rotor of 5 kg",
        (Swap("<mass>0.02<", "<mass>5<", ROTOR),),
        ("INE006",),
        "rotor_0",
    ),
    Fault(
        "propeller's mesh in millimetres without a unit",
        (
            Swap(
                '<unit name="meter" meter="1"/>',
                '<unit name="kilometer" meter="1000"/>',
                file="meshes/propeller.dae",
            ),
        ),
        ("MSH005",),
        "propeller",
    ),
)
