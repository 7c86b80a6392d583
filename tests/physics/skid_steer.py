"""Faults of a skid-steered robot: its wheels, its chassis, its drive plugin, its meshes."""

from __future__ import annotations

from tests.physics.fault import SPAWNER, Broken, Cut, Fault, Swap

SAMPLE = "husky_migration_sensor_config_1"

BASE = '<link name="base_link">'
WHEEL = '<link name="front_left_wheel_link">'
JOINT = '<joint name="front_left_wheel_joint" type="revolute">'
WHEELS = (
    '<link name="front_left_wheel_link">',
    '<link name="front_right_wheel_link">',
    '<link name="rear_left_wheel_link">',
    '<link name="rear_right_wheel_link">',
)
COLLISION = '<collision name="front_left_wheel_collision">'
CYLINDER = """<cylinder>
            <radius>0.1651</radius>
            <length>0.1143</length>
          </cylinder>"""
URI = "<uri>meshes/wheel.dae</uri>"
MESH = f"<mesh>{URI}</mesh>"
INCH = '<unit name="inch" meter="0.0254"/>'
METRE = '<unit name="meter" meter="1"/>'

INERTIA = (
    Fault(
        "inertia a thousand times too large",
        (
            Swap("<ixx>1.141421", "<ixx>1141.421"),
            Swap("<iyy>3.592369", "<iyy>3592.369"),
            Swap("<izz>4.000367", "<izz>4000.367"),
        ),
        ("INE004",),
        "base_link",
    ),
    Fault(
        "identity as a wheel's inertia",
        (
            Swap("<ixx>0.020548", "<ixx>1", WHEEL),
            Swap("<iyy>0.035435", "<iyy>1", WHEEL),
            Swap("<izz>0.020548", "<izz>1", WHEEL),
        ),
        ("INE004", "INE007"),
        "front_left_wheel_link",
    ),
    Fault(
        "a wheel's inertia of 1e-6",
        (
            Swap("<ixx>0.020548", "<ixx>1e-6", WHEEL),
            Swap("<iyy>0.035435", "<iyy>1e-6", WHEEL),
            Swap("<izz>0.020548", "<izz>1e-6", WHEEL),
        ),
        ("INE004", "INE007"),
        "front_left_wheel_link",
    ),
    Fault(
        "triangle inequality broken",
        (Swap("<iyy>0.035435", "<iyy>0.35435", WHEEL),),
        ("INE002",),
        "front_left_wheel_link",
    ),
    Fault(
        "product of inertia larger than the moments",
        (Swap("<ixz>0.015419", "<ixz>15.419", BASE),),
        ("INE002",),
        "base_link",
    ),
    Fault(
        "zero moment of inertia",
        (Swap("<iyy>0.035435", "<iyy>0", WHEEL),),
        ("INE002", "INE003"),
        "front_left_wheel_link",
    ),
    Fault(
        "no inertial",
        (Cut("<pose>0.256 0.2854 0.033 0 0 0</pose>\n      <inertial>", "</inertial>"),),
        ("INE001",),
        "front_left_wheel_link",
    ),
    Fault(
        "negative mass",
        (Swap("<mass>2.6", "<mass>-2.6", WHEEL),),
        ("INE002",),
        "front_left_wheel_link",
    ),
    Fault(
        "wheel of 2637 kg",
        (Swap("<mass>2.6", "<mass>2637", WHEEL),),
        ("INE006",),
        "front_left_wheel_link",
    ),
    Fault(
        "body of one gram",
        (Swap("<mass>45.6", "<mass>0.001"),),
        ("INE004", "INE006"),
        "base_link",
    ),
    Fault(
        "mass a hundred times too large",
        (Swap("<mass>45.6", "<mass>4560"),),
        ("INE006",),
        "base_link",
    ),
    Fault(
        "mass a tenth more than specified",
        (Swap("<mass>45.6", "<mass>51.2"),),
        ("INE008",),
        "kg",
    ),
    Fault(
        "centre of mass five metres away",
        (Swap("<pose>0.001239 0 0.141878 0 0 0", "<pose>5 0 0.141878 0 0 0"),),
        ("INE005",),
        "base_link",
    ),
    Fault(
        "centre of mass one metre up",
        (Swap("<pose>0.001239 0 0.141878 0 0 0", "<pose>0.001239 0 1.141878 0 0 0"),),
        ("INE005",),
        "base_link",
    ),
    Fault(
        "centre of mass so high that it tips over",
        (Swap("<pose>0.001239 0 0.141878 0 0 0", "<pose>0.001239 0 0.8 0 0 0"),),
        ("INE009",),
        "centre of mass",
    ),
    Fault(
        "centre of mass behind the wheels",
        (Swap("<pose>0.001239 0 0.141878 0 0 0", "<pose>-0.42 0 0.141878 0 0 0"),),
        ("INE009", "TRI002"),
        "centre of mass",
    ),
)

WHEEL_GEOMETRY = (
    Fault(
        "wheel without collision",
        (Cut(COLLISION, "</collision>"),),
        ("GEO002",),
        "front_left_wheel",
    ),
    Fault(
        "wheel 2 cm high",
        (Swap("<pose>0.256 0.2854 0.033", "<pose>0.256 0.2854 0.053"),),
        ("GEO006",),
        "front_left_wheel",
    ),
    Fault(
        "wheel 0.1 m to the side",
        (Swap("<pose>0.256 0.2854 0.033", "<pose>0.256 0.3854 0.033"),),
        ("GEO017",),
        "front_left_wheel",
    ),
    Fault(
        "wheels 0.1 m up",
        tuple(Swap("0.033 0 0 0</pose>", "0.133 0 0 0</pose>", wheel) for wheel in WHEELS),
        ("GEO011", "GEO015", "TRI013"),
        "wheel",
    ),
    Fault(
        "wheels above the chassis",
        tuple(Swap("0.033 0 0 0</pose>", "0.213 0 0 0</pose>", wheel) for wheel in WHEELS),
        ("GEO011",),
        "base_link",
    ),
    Fault(
        "wheel's collision twice as large",
        (Swap("<radius>0.1651", "<radius>0.3302", COLLISION),),
        ("GEO004", "GEO006", "GEO007"),
        "front_left_wheel",
    ),
    Fault(
        "wheel of radius zero",
        (Swap("<radius>0.1651", "<radius>0", COLLISION),),
        ("GEO008",),
        "front_left_wheel",
    ),
    Fault(
        "cylinder upright",
        (Swap("1.5707963267948966 0 0", "0 0 0", COLLISION),),
        ("GEO003",),
        "front_left_wheel",
    ),
    Fault(
        "cylinder three degrees askew",
        (Swap("1.5707963267948966 0 0", "1.6232 0 0", COLLISION),),
        ("GEO003",),
        "front_left_wheel",
    ),
    Fault(
        "wheel turned by 1.57",
        (Swap("1.5707963267948966 0 0", "1.57 0 0", COLLISION),),
        ("GEO001",),
        "front_left_wheel",
    ),
    Fault(
        "wheel that collides as a mesh",
        (Swap(CYLINDER, MESH, COLLISION), Swap("1.5707963267948966 0 0", "0 0 0", COLLISION)),
        ("GEO010",),
        "front_left_wheel",
    ),
    Fault(
        "no friction",
        (Swap("<mu>1<", "<mu>0<", WHEEL), Swap("<mu2>1<", "<mu2>0<", WHEEL)),
        ("GEO009",),
        "front_left_wheel",
    ),
    Fault(
        "friction of a hundred",
        (Swap("<mu>1<", "<mu>100<", WHEEL), Swap("<mu2>1<", "<mu2>100<", WHEEL)),
        ("GEO009",),
        "front_left_wheel",
    ),
    Fault(
        "two wheels in one place",
        (Swap("<pose>0.256 -0.2854 0.033", "<pose>0.256 0.2854 0.033"),),
        ("GEO013", "GEO015", "TRI013"),
        "front_right_wheel",
    ),
)

CHASSIS = (
    Fault(
        "chassis below the wheels",
        (Swap("<pose>0 0 0.1025", "<pose>0 0 -0.05"),),
        ("GEO011",),
        "base_link",
    ),
    Fault(
        "chassis without collision",
        (Cut('<collision name="base_link_collision">', '<visual name="base', inclusive=False),),
        ("GEO002", "GEO007"),
        "base_link",
    ),
    Fault(
        "gravity switched off",
        (Swap(BASE, f"{BASE}\n<gravity>0</gravity>"),),
        ("KIN016",),
        "base_link",
    ),
)

JOINTS = (
    Fault(
        "axis along x",
        (Swap("<xyz>0 1 0", "<xyz>1 0 0", JOINT),),
        ("GEO003",),
        "front_left_wheel",
    ),
    Fault(
        "axis reversed",
        (Swap("<xyz>0 1 0", "<xyz>0 -1 0", JOINT),),
        ("GEO013",),
        "front_left_wheel",
    ),
    Fault(
        "fixed joint of a wheel",
        (Swap(JOINT, JOINT.replace("revolute", "fixed")),),
        ("KIN009", "TRI003", "TRI004"),
        "front_left_wheel",
    ),
    Fault(
        "wheel that turns half a radian",
        (
            Swap("<lower>-1e+16", "<lower>-0.5", JOINT),
            Swap("<upper>1e+16", "<upper>0.5", JOINT),
        ),
        ("TRI003", "TRI004", "TRI009"),
        "front_left_wheel",
    ),
    Fault(
        "damping of 100 N·m·s/rad",
        (Swap("<limit>", "<dynamics><damping>100</damping></dynamics><limit>", JOINT),),
        ("TRI009",),
        "front_left_wheel",
    ),
    Fault(
        "negative damping",
        (Swap("<limit>", "<dynamics><damping>-1</damping></dynamics><limit>", JOINT),),
        ("KIN015",),
        "front_left_wheel",
    ),
    Fault(
        "effort of 1 N·m",
        (Swap("<effort>120", "<effort>1", JOINT),),
        ("TRI009",),
        "front_left_wheel",
    ),
    Fault(
        "wheel that turns at 1 rad/s at most",
        (Swap("<velocity>10", "<velocity>1", JOINT),),
        ("KIN012", "TRI003"),
        "front_left_wheel",
    ),
)

PLUGIN = (
    Fault(
        "wheel radius twice as large in the plugin",
        (Swap("<wheel_radius>0.1651", "<wheel_radius>0.3302", "DiffDrive", SPAWNER),),
        ("GEO004",),
        "wheel_radius",
    ),
    Fault(
        "no wheel radius in the plugin",
        (Swap("<wheel_radius>0.1651</wheel_radius>", "", "DiffDrive", SPAWNER),),
        ("GEO004",),
        "wheel_radius",
    ),
    Fault(
        "wheel separation halved",
        (Swap("0.5708 * 1.2", "0.5708 * 0.5", file=SPAWNER),),
        ("GEO005",),
        "wheel_separation",
    ),
    Fault(
        "left and right joints swapped",
        (
            Swap("left_joint>", "kept_joint>", file=SPAWNER, everywhere=True),
            Swap("right_joint>", "left_joint>", file=SPAWNER, everywhere=True),
            Swap("kept_joint>", "right_joint>", file=SPAWNER, everywhere=True),
        ),
        ("GEO013",),
        "wheel_joint",
    ),
    Fault(
        "one wheel missing",
        (Swap("<left_joint>rear_left_wheel_joint</left_joint>", "", file=SPAWNER),),
        ("KIN006", "TRI004", "TRI006"),
        "DiffDrive",
    ),
)

MESHES = (
    Fault("empty mesh", (Broken("meshes/wheel.dae"),), ("MSH001",), "wheel.dae"),
    Fault("mesh cut off", (Broken("meshes/wheel.dae", 0.5),), ("MSH001",), "wheel.dae"),
    Fault(
        "mesh in inches that are metres",
        (Swap(METRE, INCH, file="meshes/wheel.dae"),),
        ("MSH005", "GEO007"),
        "wheel",
    ),
    Fault(
        "mesh scaled by a thousand",
        (Swap(URI, f"{URI}<scale>1000 1000 1000</scale>", WHEEL),),
        ("MSH005", "GEO007"),
        "wheel",
    ),
)

FAULTS = (*INERTIA, *WHEEL_GEOMETRY, *CHASSIS, *JOINTS, *PLUGIN, *MESHES)
