"""Faults in a model.sdf."""

from __future__ import annotations

from copy import deepcopy
from math import cos, sin
from random import Random

from lxml import etree

from bench.planted.edits import (
    Change,
    Edit,
    Kind,
    below,
    copied,
    kind,
    removed,
    repeated,
    scaled,
    shifted,
    text,
    with_attribute,
    with_child,
    with_tag,
    with_text,
    xml,
)

WHEEL = "//link[contains(@name,'wheel') and not(contains(@name,'steering'))]"
WHEEL_JOINT = "//joint[contains(@name,'wheel') and not(contains(@name,'steering'))]"
BASE = "//link[@name='base_link']"
CYLINDER = f"{WHEEL}/collision/geometry/cylinder"
CAMERA = "//sensor[contains(@type,'camera')]"
LIDAR = "//sensor[contains(@type,'lidar') or contains(@type,'ray')]"
LIDAR_3D = f"{LIDAR}[number(.//vertical/samples) > 1]"


def model(path: str, *changes: Change) -> Edit:
    """Return an edit of an element of model.sdf."""
    return xml("model.sdf", path, *changes)


def copied_mesh(element: etree._Element, _: Random) -> None:
    """Make the visual's mesh the shape of a collision too."""
    (visual, *_rest) = element.xpath("../visual[.//mesh]")
    geometry = element.find("geometry")
    assert geometry is not None
    geometry.append(deepcopy(visual.find("geometry/mesh")))
    element.replace(element.find("pose"), deepcopy(visual.find("pose")))


def plate_in_front(element: etree._Element, _: Random) -> None:
    """Put a plate 5 cm in front of a sensor."""
    words = (element.findtext("pose") or "0 0 0 0 0 0").split()
    x, y, z, roll, pitch, yaw = (float(word) for word in words)
    x, y = x + 0.05 * cos(pitch) * cos(yaw), y + 0.05 * cos(pitch) * sin(yaw)
    pose = f"{x} {y} {z - 0.05 * sin(pitch)} {roll} {pitch} {yaw}"
    parent = element.getparent()
    assert parent is not None
    parent.append(
        etree.fromstring(
            f"<visual name='plate_in_front'><pose>{pose}</pose><geometry><box>"
            "<size>0.005 0.3 0.3</size></box></geometry></visual>"
        )
    )


DOCUMENT = (
    kind("the model has another name", "PKG002", model("/sdf/model", with_attribute("name", "r2"))),
    kind(
        "an SDF version of the future", "SDF002", model("/sdf", with_attribute("version", "1.99"))
    ),
    kind("no SDF version", "SDF002 SDF004 SDF005", model("/sdf", with_attribute("version", None))),
    kind("an unknown element", "SDF003", model("//link", with_child("<colour>red</colour>"))),
    kind("a misspelt element", "SDF003 SDF005", model("//collision//size", with_tag("sise"))),
    kind("an unknown attribute", "SDF004", model("//visual", with_attribute("colour", "red"))),
    kind("a joint without a name", "SDF004 SDF005", model("//joint", with_attribute("name", None))),
    kind("a collision without geometry", "SDF005", model("//collision/geometry", removed)),
    kind("a joint without a child", "SDF005 KIN001", model("//joint/child", removed)),
    kind("a joint without a type", "SDF004 SDF005", model("//joint", with_attribute("type", None))),
    kind("a mass with a unit", "SDF006", text("model.sdf", r"<mass>([\d.]+)<", r"<mass>\1 kg<")),
    kind("a mass in words", "SDF006", model("//mass", with_text("heavy"))),
    kind(
        "a mass with a comma", "SDF006", text("model.sdf", r"<mass>(\d+)\.(\d+)<", r"<mass>\1,\2<")
    ),
    kind("a pose of five numbers", "SDF006", model("//link/visual/pose", with_text("0 0 0 0 0"))),
    kind("a pose with a letter", "SDF006", model("//collision/pose", with_text("0 0 O 0 0 0"))),
    kind(
        "an unknown joint type", "SDF006 KIN008", model("//joint", with_attribute("type", "hing"))
    ),
    kind("text between elements", "SDF007", model("//link", with_child("todo"))),
    kind(
        "a mass outside its inertial",
        "SDF008 SDF003",
        model("//link", with_child("<mass>1</mass>")),
    ),
    kind(
        "a link twice",
        "SDF009",
        model("//link[starts-with(@name,'rear') or @name='rotor_1']", repeated),
    ),
    kind("a visual twice", "SDF009", model("//visual", repeated)),
    kind("a sensor twice", "SDF009", model("//sensor", repeated)),
    kind("a joint twice", "SDF009", model("//joint", repeated)),
    kind(
        "a model in the model",
        "SDF010",
        model(
            "/sdf/model",
            with_child(
                "<model name='inner'><link name='inner_link'><inertial><mass>0.01</mass><inertia>"
                "<ixx>1e-5</ixx><iyy>1e-5</iyy><izz>1e-5</izz></inertia></inertial></link></model>"
            ),
        ),
    ),
    kind(
        "a reserved name", "SDF011 SDF009", model("//visual", with_attribute("name", "__plate__"))
    ),
    kind(
        "two models",
        "SDF012",
        model("/sdf", with_child("<model name='b'><link name='x'/></model>")),
    ),
    kind("no model", "SDF012", model("/sdf/model", removed)),
    kind("two masses", "SDF013", model("//mass", repeated)),
    kind("two geometries", "SDF013", model("//visual/geometry", repeated)),
    kind(
        "a pose in a frame of no name",
        "SDF014 KIN010",
        model("//visual/pose", with_attribute("frame", "a")),
    ),
    kind(
        "a material script",
        "SDF015",
        model(
            "//material[not(script)]",
            with_child("<script><uri>a.material</uri><name>Gazebo/Red</name></script>"),
        ),
    ),
    kind("a colour up to 255", "SDF016", model("//diffuse", with_text("255 0 0 1"))),
    kind("a tag that is not closed", "SDF001", text("model.sdf", "</inertial>", "")),
    kind("a bare ampersand", "SDF001", text("model.sdf", "<mass>", "<mass> & ")),
    kind(
        "an attribute without quotes",
        "SDF001",
        text("model.sdf", 'type="revolute"', "type=revolute"),
    ),
)

KINEMATICS = (
    kind("a joint of no parent", "KIN001", model("//joint/parent", with_text("body"))),
    kind("a joint of no child", "KIN001", model("//joint/child", with_text("tyre"))),
    kind("a joint of a link with itself", "KIN002", model("//joint", copied("parent", "child"))),
    kind(
        "a link with two parents",
        "KIN002",
        model(
            f"/sdf/model[{WHEEL_JOINT[2:]}]",
            with_child(
                "<joint name='second' type='fixed'><parent>front_left_wheel</parent>"
                "<child>rear_left_wheel</child></joint>"
            ),
        ),
    ),
    kind("a link that no joint holds", "KIN003 PLG004", model("//joint", removed)),
    kind("an axis of zeros", "KIN004", model("//axis/xyz", with_text("0 0 0"))),
    kind(
        "limits the wrong way round",
        "KIN005",
        model("//axis/limit", below("lower", with_text("1")), below("upper", with_text("-1"))),
    ),
    kind(
        "a wheel that hardly turns",
        "KIN006 KIN009",
        model(
            f"{WHEEL_JOINT}/axis/limit",
            below("lower", with_text("-0.1")),
            below("upper", with_text("0.1")),
        ),
    ),
    kind(
        "a joint fixed by its limits",
        "KIN009 KIN006",
        model("//axis/limit", below("lower", with_text("0")), below("upper", with_text("0"))),
    ),
    kind("a negative effort limit", "KIN007", model("//joint//effort", with_text("-5"))),
    kind("an effort limit of zero", "KIN007", model(f"{WHEEL_JOINT}//effort", with_text("0"))),
    kind("a velocity limit of zero", "KIN007", model(f"{WHEEL_JOINT}//velocity", with_text("0"))),
    kind(
        "a pose in degrees",
        "GEO016",
        model("//visual/pose", scaled(0), shifted(90, fields=slice(5, 6))),
    ),
    kind(
        "a wheel too slow for its drive",
        "KIN012",
        model(f"{WHEEL_JOINT}//velocity", with_text("0.5")),
    ),
    kind(
        "no base_link",
        "KIN011 ROS002 ROS001",
        text("model.sdf", "base_link([\"<'])", r"body\1", everywhere=True),
    ),
    kind(
        "negative damping",
        "KIN015",
        model(
            "//joint/axis[not(dynamics)]", with_child("<dynamics><damping>-1</damping></dynamics>")
        ),
    ),
    kind(
        "a link without gravity",
        "KIN016",
        model(f"{BASE}[not(gravity)]", with_child("<gravity>0</gravity>")),
    ),
    kind(
        "a joint type that Dome lacks",
        "KIN008 SDF006",
        model("//joint", with_attribute("type", "rolling")),
    ),
    kind(
        "an axis in an unknown frame",
        "KIN010 SDF003 SDF004",
        model("//axis[not(use_parent_model_frame)]/xyz", with_attribute("expressed_in", "x")),
    ),
    kind(
        "a wheel's axis askew",
        "GEO003",
        model(f"{WHEEL_JOINT}/axis/xyz", with_text("0 0.9284767 0.3713907")),
    ),
    kind("a wheel's axis forward", "GEO003", model(f"{WHEEL_JOINT}/axis/xyz", with_text("1 0 0"))),
    kind(
        "a wheel that turns backwards",
        "GEO013",
        model(f"{WHEEL_JOINT}/axis/xyz", with_text("0 -1 0")),
    ),
    kind(
        "a wheel's joint in front of its wheel",
        "KIN013 GEO003 GEO004",
        model(WHEEL_JOINT, with_child("<pose>0.06 0 0 0 0 0</pose>")),
    ),
)

INERTIA = (
    kind("a link without inertia", "INE001", model("//link/inertial", removed)),
    kind("an inertia without a mass", "INE001 SDF005", model("//mass", removed)),
    kind(
        "moments against the triangle",
        "INE002",
        model("//link/inertial/inertia", copied("izz", "ixx", 30), copied("iyy", "ixx")),
    ),
    kind("a negative mass", "INE002", model("//mass", with_text("-1"))),
    kind("a negative moment", "INE002", model("//inertia/iyy", scaled(-1))),
    kind("a mass of zero", "INE002 INE001 INE003 URD005", model("//mass", with_text("0"))),
    kind(
        "large products of inertia",
        "INE002",
        model("//inertia[not(ixy)]", with_child("<ixy>50</ixy>")),
    ),
    kind("a moment of zero", "INE003 INE002", model("//inertia/ixx", with_text("0"))),
    kind(
        "moments in other units",
        "INE004",
        model(
            f"{BASE}/inertial/inertia",
            below("ixx", scaled(100)),
            below("iyy", scaled(100)),
            below("izz", scaled(100)),
        ),
    ),
    kind(
        "moments that somebody made up",
        "INE007 INE004",
        model(
            f"{BASE}/inertial/inertia",
            below("ixx", with_text("1")),
            below("iyy", with_text("1")),
            below("izz", with_text("1")),
        ),
    ),
    kind(
        "a centre of mass outside its link",
        "INE005",
        model(
            "//link[inertial/mass > 0.15]/inertial[not(pose)]",
            with_child("<pose>3 0 0 0 0 0</pose>"),
        ),
    ),
    kind(
        "a centre of mass moved far",
        "INE005",
        model(f"{BASE}/inertial/pose", with_text("3 0 0 0 0 0")),
    ),
    kind("a base of feathers", "INE006 INE008 URD005", model(f"{BASE}//mass", with_text("0.001"))),
    kind("a base of gold", "INE006 INE008 URD005", model(f"{BASE}//mass", scaled(60))),
    kind("a wheel of gold", "INE006 URD005 INE008", model(f"{WHEEL}//mass", with_text("300"))),
    kind(
        "twice the mass of the sheet", "INE008 DOC007 URD005", model(f"{BASE}//mass", scaled(2.2))
    ),
    kind(
        "a robot that tips over",
        "INE009 INE005",
        model(f"{BASE}[../{WHEEL[2:]}]/inertial/pose", with_text("0.2 0 0.1 0 0 0")),
    ),
)

GEOMETRY = (
    kind(
        "an angle of 1.57", "GEO001", model(f"{WHEEL}/collision/pose", with_text("0 0 0 1.57 0 0"))
    ),
    kind(
        "an angle of 3.14",
        "GEO001",
        model("//visual/pose", scaled(0), shifted(3.14, fields=slice(5, 6))),
    ),
    kind(
        "nothing that touches the ground",
        "GEO002",
        *(model(f"{WHEEL}/collision", removed) for _ in range(4)),
        model(f"{BASE}[collision]/collision", removed),
    ),
    kind(
        "a wheel's cylinder upright",
        "GEO003",
        model(f"{WHEEL}/collision/pose", with_text("0 0 0 0 0 0")),
    ),
    kind(
        "a wheel's collision askew",
        "GEO003",
        model(f"{WHEEL}/collision/pose", with_text("0 0 0 1.4 0 0")),
    ),
    kind("one larger wheel", "GEO006 GEO004", model(f"{CYLINDER}/radius", scaled(1.3))),
    kind(
        "a wheel placed lower", "GEO006", model(f"{WHEEL}/pose", shifted(-0.05, fields=slice(2, 3)))
    ),
    kind(
        "a wheel placed farther out",
        "GEO005 GEO006",
        model(f"{WHEEL}/pose", scaled(1.6, fields=slice(1, 2))),
    ),
    kind(
        "a collision far from its visual",
        "GEO007",
        model(f"{WHEEL}/collision/pose", with_text("0.5 0 0 1.5707963267948966 0 0")),
    ),
    kind(
        "a collision beside its wheel",
        "GEO007",
        model(f"{WHEEL}/collision/pose", with_text("0 0.04 0 1.5707963267948966 0 0")),
    ),
    kind(
        "a visual in millimetres",
        "GEO007 MSH005 GEO014",
        model("//visual[geometry/mesh]", below("geometry/mesh/scale", with_text("1000 1000 1000"))),
    ),
    kind("a box without size", "GEO008", model("//box/size", with_text("0 0 0"))),
    kind("a negative radius", "GEO008", model("//cylinder/radius", scaled(-1))),
    kind("a cylinder of no length", "GEO008", model("//cylinder/length", with_text("0"))),
    kind("a wheel without friction", "GEO009", model(f"{WHEEL}//ode/mu", with_text("0"))),
    kind(
        "a wheel on a mesh",
        "GEO010",
        model(
            f"{WHEEL}[visual//mesh]/collision",
            below("geometry/cylinder", removed),
            copied_mesh,
        ),
    ),
    kind(
        "a chassis below the wheels",
        "GEO011",
        model(f"{BASE}[../{WHEEL[2:]}]/collision/pose", with_text("0 0 -0.3 0 0 0")),
    ),
    kind("a visual that floats", "GEO012", model(f"{BASE}/visual/pose", with_text("4 4 4 0 0 0"))),
    kind(
        "a robot of forty metres",
        "GEO014 GEO007",
        model(f"{BASE}/collision//box/size", with_text("40 1 0.1")),
    ),
    kind(
        "a wheel's visual of another size",
        "GEO007 GEO006 GEO004",
        model(f"{WHEEL}/visual/geometry/mesh/scale", scaled(3)),
    ),
)

MESHES = (
    kind(
        "a mesh that is not there",
        "REF002",
        model("//mesh/uri", with_text("meshes/body_final.dae")),
    ),
    kind(
        "a mesh in the wrong case",
        "REF002",
        model("//mesh/uri[contains(.,'.dae')]", with_text("meshes/Wheel.DAE")),
    ),
    kind(
        "a path of one machine",
        "REF001",
        text("model.sdf", r"<uri>meshes/", "<uri>file:///home/me/ws/meshes/"),
    ),
    kind(
        "a path from the root",
        "REF001",
        text("model.sdf", r"<uri>meshes/", "<uri>/opt/robot/meshes/"),
    ),
    kind(
        "a path out of the package",
        "REF003 REF002",
        text("model.sdf", r"<uri>meshes/", "<uri>../../meshes/"),
    ),
    kind(
        "a mesh of another package",
        "REF001",
        text("model.sdf", r"<uri>meshes/", "<uri>package://other_robot/meshes/"),
    ),
    kind(
        "a mesh format that nothing reads",
        "MSH003 REF002",
        text("model.sdf", r"<uri>meshes/(\w+)\.\w+<", r"<uri>meshes/\1.blend<"),
    ),
    kind(
        "a wheel's mesh in centimetres",
        "MSH005 GEO007 GEO014",
        model(f"{WHEEL}/visual//mesh/scale", scaled(100)),
    ),
    kind(
        "a mesh scaled away", "MSH005 GEO007 GEO008", model("//visual//mesh/scale", scaled(0.001))
    ),
    kind("a mesh of no scale", "GEO008 SDF006 MSH005", model("//mesh/scale", with_text("0 0 0"))),
    kind("a mesh scaled by words", "SDF006", model("//mesh/scale", with_text("half"))),
)

SENSORS = (
    kind("an unknown sensor", "SEN001", model(LIDAR, with_attribute("type", "sonar"))),
    kind(
        "a sensor that Dome does not simulate",
        "SEN001",
        model("//sensor[@type='imu']", with_attribute("type", "force_torque_6d")),
    ),
    kind("an older spelling", "SEN002 SEN001", model(LIDAR, with_attribute("type", "ray"))),
    kind(
        "scan angles the wrong way round",
        "SEN003",
        model(
            f"{LIDAR}//horizontal",
            below("min_angle", with_text("1")),
            below("max_angle", with_text("-1")),
        ),
    ),
    kind(
        "scan angles in degrees",
        "SEN003 SEN007",
        model(
            f"{LIDAR}//horizontal",
            below("min_angle", with_text("-180")),
            below("max_angle", with_text("180")),
        ),
    ),
    kind("no samples", "SEN004", model(f"{LIDAR}//horizontal/samples", with_text("0"))),
    kind(
        "half a sample", "SEN004 SDF006", model(f"{LIDAR}//horizontal/samples", with_text("10.5"))
    ),
    kind(
        "a scan of resolution zero",
        "SEN005",
        model(f"{LIDAR}//horizontal/resolution", with_text("0")),
    ),
    kind(
        "a range the wrong way round",
        "SEN006 SEN007",
        model(f"{LIDAR}//range", below("min", with_text("50")), below("max", with_text("1"))),
    ),
    kind(
        "a lidar that sees too far",
        "SEN006 SEN007",
        model(f"{LIDAR_3D}//range/max", with_text("400")),
    ),
    kind(
        "a lidar with other rings",
        "SEN007",
        model(f"{LIDAR_3D}//vertical/samples", with_text("128")),
    ),
    kind(
        "a lidar that looks too high",
        "SEN007",
        model(f"{LIDAR_3D}//vertical/max_angle", with_text("0.9")),
    ),
    kind(
        "a camera that sees more than all round",
        "SEN010 SEN008 SDF006 SEN011",
        model(f"{CAMERA}//horizontal_fov", with_text("7")),
    ),
    kind(
        "a camera with a view in degrees",
        "SEN010 SEN008 SDF006 SEN011",
        model(f"{CAMERA}//horizontal_fov", with_text("90")),
    ),
    kind(
        "a D435 with more pixels",
        "SEN010 SEN009 SEN025",
        model(
            "//sensor[contains(@type,'rgbd')]//image",
            below("width", with_text("4000")),
            below("height", with_text("3000")),
        ),
    ),
    kind(
        "a D435 with a wide view",
        "SEN010 SEN009",
        model("//sensor[contains(@type,'rgbd')]//horizontal_fov", with_text("2.6")),
    ),
    kind(
        "a D435 that is too fast",
        "SEN010 SEN015",
        model("//sensor[contains(@type,'rgbd')]/update_rate", with_text("400")),
    ),
    kind(
        "a clip the wrong way round",
        "SEN011",
        model(
            f"{CAMERA}//camera/clip", below("near", with_text("10")), below("far", with_text("1"))
        ),
    ),
    kind("a clip from zero", "SEN011", model(f"{CAMERA}//camera/clip/near", with_text("0"))),
    kind(
        "an IMU without noise",
        "SEN013",
        model(
            "//sensor[@type='imu']/imu[angular_velocity]",
            below("angular_velocity", removed),
            below("linear_acceleration", removed),
        ),
    ),
    kind(
        "a sensor of no rate",
        "SEN015",
        model("//sensor[@type='imu' or contains(@type,'camera')]/update_rate", with_text("0")),
    ),
    kind("a sensor of a negative rate", "SEN015", model(f"{CAMERA}/update_rate", with_text("-10"))),
    kind(
        "an IMU too fast for the simulation",
        "SEN015",
        model("//sensor[@type='imu']/update_rate", with_text("5000")),
    ),
    kind("a sensor off the robot", "SEN018", model(f"{CAMERA}/pose", with_text("5 0 0.2 0 0 0"))),
    kind("a plate in front of a camera", "SEN019", model(CAMERA, plate_in_front)),
    kind(
        "a camera that looks up",
        "SEN026",
        model(
            "//sensor[contains(@name,'front') and contains(@type,'camera')]/pose",
            with_text("0.2 0 0.3 0 -1.5707963267948966 0"),
        ),
    ),
    kind(
        "a camera that looks back",
        "SEN026",
        model(
            "//sensor[contains(@name,'front') and contains(@type,'camera')]/pose",
            with_text("0.4 0 0.4 0 0 3.141592653589793"),
        ),
    ),
    kind(
        "an unknown image format",
        "SEN027 SDF006",
        model(f"{CAMERA}//image/format", with_text("RGB8")),
    ),
    kind("rays that are drawn", "SEN021", model("//sensor/visualize", with_text("true"))),
    kind("no IMU", "SEN022 ROS002 DOC003 PKG005", model("//sensor[@type='imu']", removed)),
    kind("a camera too few", "ROS002 DOC003", model(f"{CAMERA}", removed)),
    kind(
        "a sensor with another name",
        "ROS001 ROS002",
        model("//sensor", with_attribute("name", "device")),
    ),
    kind("a light that is black", "SEN023", model("//light/diffuse", with_text("0 0 0 1"))),
    kind("a light off the robot", "SEN018 SEN020", model("//light/pose", with_text("4 0 0 0 0 0"))),
    kind(
        "a magnetometer that wants a plugin of its own",
        "SEN001 SEN002",
        model("//sensor[@type='magnetometer']", with_attribute("type", "compass")),
    ),
    kind(
        "a camera that records too much",
        "SEN025 SEN010 SEN009",
        model(
            CAMERA,
            below(".//image/width", with_text("7680")),
            below(".//image/height", with_text("4320")),
        ),
    ),
)

KINDS: tuple[Kind, ...] = (*DOCUMENT, *KINEMATICS, *INERTIA, *GEOMETRY, *MESHES, *SENSORS)
