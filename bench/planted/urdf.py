"""Faults in a URDF file."""

from __future__ import annotations

from bench.planted.edits import (
    Change,
    Edit,
    Kind,
    emptied,
    kind,
    removed,
    repeated,
    scaled,
    text,
    with_attribute,
    with_child,
    with_tag,
    xml,
)

FILE = "urdf/*.urdf"
MOVED = "//link[collision][@name=/robot/joint[@type!='fixed']/child/@link]"
MOVING = "/robot/joint[@type='revolute' or @type='continuous']"


def urdf(path: str, *changes: Change) -> Edit:
    """Return an edit of an element of the file that is checked."""
    return xml(FILE, path, *changes)


def words(pattern: str, replacement: str = "") -> Edit:
    """Return an edit of the text of the file that is checked."""
    return text(FILE, pattern, replacement)


KINDS: tuple[Kind, ...] = (
    kind(
        "URDF: a joint of no parent",
        "KIN001 URD007",
        urdf("/robot/joint/parent", with_attribute("link", "body")),
    ),
    kind(
        "URDF: a joint of no child",
        "KIN001 URD007",
        urdf("/robot/joint/child", with_attribute("link", "tip")),
    ),
    kind(
        "URDF: a joint without a child", "URD004 KIN001 URD012", urdf("/robot/joint/child", removed)
    ),
    kind(
        "URDF: a joint without a parent",
        "URD004 KIN001 URD012",
        urdf("/robot/joint/parent", removed),
    ),
    kind(
        "URDF: a link with two parents",
        "KIN002",
        urdf("/robot/joint[last()]", repeated, with_attribute("name", "again")),
    ),
    kind(
        "URDF: a link that no joint holds",
        "KIN002 KIN003 URD007 URD008 URD006",
        urdf("/robot/joint[@name]", removed),
    ),
    kind(
        "URDF: a loop",
        "KIN002",
        urdf(
            "/robot[link/@name='base_link']",
            with_child(
                "<joint name='loop' type='fixed'>"
                "<parent link='base_link'/><child link='base_link'/></joint>"
            ),
        ),
    ),
    kind("URDF: a link twice", "SDF009 URD004", urdf("//link", repeated)),
    kind("URDF: a joint twice", "SDF009 URD004 KIN002", urdf("/robot/joint", repeated)),
    kind(
        "URDF: a link without a name", "URD004 URD012", urdf("//link", with_attribute("name", None))
    ),
    kind(
        "URDF: a joint without a type",
        "URD004 URD012",
        urdf("/robot/joint", with_attribute("type", None)),
    ),
    kind(
        "URDF: an unknown joint type",
        "KIN008 URD004 URD012",
        urdf("/robot/joint", with_attribute("type", "hinge")),
    ),
    kind(
        "URDF: a name of the robot that is missing",
        "URD004 URD012",
        urdf("/robot", with_attribute("name", None)),
    ),
    kind("URDF: no link at all", "URD004", urdf("/robot", emptied)),
    kind("URDF: a bare ampersand", "SDF001", words("<link ", "& <link ")),
    kind("URDF: a tag that is not closed", "SDF001", words("</visual>", "")),
    kind(
        "URDF: an axis of zeros", "KIN004", urdf(f"{MOVING}/axis", with_attribute("xyz", "0 0 0"))
    ),
    kind(
        "URDF: limits the wrong way round",
        "KIN005",
        urdf(
            "/robot/joint[@type='revolute']/limit",
            with_attribute("lower", "1"),
            with_attribute("upper", "-1"),
        ),
    ),
    kind(
        "URDF: a revolute joint without limits",
        "URD004 URD012 KIN006",
        urdf("/robot/joint[@type='revolute']/limit", removed),
    ),
    kind(
        "URDF: a limit without an effort",
        "URD004 URD012",
        urdf("/robot/joint[@type='revolute']/limit", with_attribute("effort", None)),
    ),
    kind(
        "URDF: a joint fixed by its limits",
        "KIN009",
        urdf(
            "/robot/joint[@type='revolute']/limit",
            with_attribute("lower", "0"),
            with_attribute("upper", "0"),
        ),
    ),
    kind(
        "URDF: limits in degrees",
        "GEO016",
        urdf(
            "/robot/joint[@type='revolute']/limit",
            with_attribute("lower", "-180"),
            with_attribute("upper", "180"),
        ),
    ),
    kind("URDF: a mimic of nothing", "KIN014", urdf(MOVING, with_child("<mimic joint='thumb'/>"))),
    kind(
        "URDF: negative damping",
        "KIN015",
        urdf("/robot/joint/dynamics", with_attribute("damping", "-1")),
    ),
    kind(
        "URDF: a link without inertia",
        "INE001 URD007",
        urdf(
            f"{MOVED}[inertial/mass/@value > 0.02]/inertial",
            removed,
        ),
    ),
    kind(
        "URDF: an inertia without a mass",
        "INE001 URD004 URD007 URD012",
        urdf("//inertial/mass", removed),
    ),
    kind(
        "URDF: moments against the triangle",
        "INE002",
        urdf("//link[inertial/mass/@value > 0.01]//inertia", scaled(9, of="izz")),
    ),
    kind(
        "URDF: a negative mass",
        "INE002",
        urdf("//link[@name!='ee_link']//mass", with_attribute("value", "-1")),
    ),
    kind(
        "URDF: a mass of zero",
        "INE002 INE001 INE003 URD007",
        urdf(
            "//link[@name!='ee_link']//mass[number(@value) > 0.001]", with_attribute("value", "0")
        ),
    ),
    kind(
        "URDF: a moment of zero",
        "INE003 INE002",
        urdf("//link[inertial/mass/@value > 0.01]//inertia", with_attribute("ixx", "0")),
    ),
    kind(
        "URDF: moments in other units",
        "INE004",
        urdf(
            "//link[collision and inertial/mass/@value > 0.5]//inertia",
            scaled(1000, of="ixx"),
            scaled(1000, of="iyy"),
            scaled(1000, of="izz"),
        ),
    ),
    kind(
        "URDF: a centre of mass outside its link",
        "INE005",
        urdf(
            "//link[collision and inertial/mass/@value > 0.5]/inertial/origin",
            with_attribute("xyz", "3 0 0"),
        ),
    ),
    kind(
        "URDF: a link of gold",
        "INE006",
        urdf("//link[collision]//mass[number(@value) > 0.01]", scaled(3000, of="value")),
    ),
    kind(
        "URDF: a mass with a unit",
        "URD004 URD012",
        words(r'mass value="([^"]+)"', r'mass value="\1 kg"'),
    ),
    kind(
        "URDF: an origin of two numbers",
        "URD004 URD012",
        urdf("//visual/origin | //joint/origin", with_attribute("xyz", "0 0")),
    ),
    kind(
        "URDF: an origin with a letter",
        "URD004 URD012",
        urdf("/robot/joint/origin", with_attribute("xyz", "0 0 O")),
    ),
    kind(
        "URDF: an origin with commas",
        "URD004 URD012",
        urdf("/robot/joint/origin", with_attribute("xyz", "0,0,0")),
    ),
    kind(
        "URDF: a mesh that is not there",
        "REF002",
        words(r"/([\w-]+)\.(dae|stl)\"", r'/\1_final.\2"'),
    ),
    kind(
        "URDF: a path of one machine",
        "REF001 URD002",
        urdf("//mesh", with_attribute("filename", "file:///home/me/ws/arm.dae")),
    ),
    kind(
        "URDF: a mesh in the wrong case",
        "REF002",
        words(r"/meshes/(.*)\.(dae|stl)\"", r'/Meshes/\1.\2"'),
    ),
    kind(
        "URDF: a mesh without a name",
        "URD004 URD012 REF002",
        urdf("//mesh", with_attribute("filename", None)),
    ),
    kind(
        "URDF: a mesh in millimetres",
        "MSH005 GEO007 GEO014",
        urdf("//mesh", with_attribute("scale", "1000 1000 1000")),
    ),
    kind("URDF: a geometry of no shape", "URD004 URD012", urdf("//geometry/*", removed)),
    kind(
        "URDF: an unknown shape",
        "URD004 URD012 SDF003",
        urdf("//collision/geometry/*", with_tag("cone")),
    ),
    kind("URDF: a box of no size", "GEO008", urdf("//box", with_attribute("size", "0 0 0"))),
    kind("URDF: a negative radius", "GEO008", urdf("//*[@radius]", scaled(-1, of="radius"))),
    kind("URDF: a misspelt collision", "URD015", urdf("//collision", with_tag("colision"))),
    kind(
        "URDF: a misspelt inertial",
        "URD015 URD007",
        urdf("//link[inertial/mass/@value > 0.02]/inertial", with_tag("inertia")),
    ),
    kind("URDF: a misspelt limit", "URD015 URD004", urdf("/robot/joint/limit", with_tag("limits"))),
    kind("URDF: a misspelt attribute", "URD015", words(r"<origin([^>]*) xyz=", r"<origin\1 xzy=")),
    kind(
        "URDF: a material that nothing defines",
        "URD010",
        urdf("//visual[not(material)]", with_child("<material name='ghost'/>")),
    ),
    kind(
        "URDF: a colour up to 255", "URD012", urdf("//color", with_attribute("rgba", "255 0 0 1"))
    ),
    kind(
        "URDF: a Gazebo tag of no link",
        "URD006",
        urdf("/robot", with_child("<gazebo reference='ghost'><mu1>1</mu1></gazebo>")),
    ),
    kind(
        "URDF: a transmission of no joint",
        "URD008",
        urdf("//transmission/joint", with_attribute("name", "ghost")),
    ),
    kind("URDF: a transmission without a type", "URD008", urdf("//transmission/type", removed)),
    kind(
        "URDF: a transmission without an interface",
        "URD008",
        urdf("//transmission//hardwareInterface", removed),
    ),
    kind(
        "URDF: a version that does not exist",
        "URD013",
        urdf("/robot", with_attribute("version", "7.0")),
    ),
    kind(
        "URDF: an angle of 1.57",
        "GEO001",
        urdf(
            "/robot/joint/origin[@rpy='0 0 0' or @rpy='0.0 0.0 0.0']",
            with_attribute("rpy", "0 0 1.57"),
        ),
    ),
    kind(
        "URDF: an angle in degrees",
        "GEO016",
        urdf("/robot/joint/origin", with_attribute("rpy", "0 90 0")),
    ),
    kind(
        "URDF: a wheel's axis askew",
        "GEO003",
        urdf("/robot/joint[@name='wheel_left_joint']/axis", with_attribute("xyz", "1 0 0")),
    ),
    kind(
        "URDF: one larger wheel",
        "GEO006",
        urdf("//link[contains(@name,'wheel')]/collision//cylinder", scaled(1.4, of="radius")),
    ),
    kind(
        "URDF: a wheel without collision",
        "GEO002 GEO006 GEO009 INE009 URD007",
        urdf("//link[contains(@name,'wheel')]/collision", removed),
    ),
)
