"""Faults in the document, the joints and the masses of a model.sdf."""

from __future__ import annotations

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


def model(path: str, *changes: Change) -> Edit:
    """Return an edit of an element of model.sdf."""
    return xml("model.sdf", path, *changes)


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

KINDS: tuple[Kind, ...] = (*DOCUMENT, *KINEMATICS, *INERTIA)
