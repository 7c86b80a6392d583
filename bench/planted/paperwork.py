"""Faults in the specification sheet and in the files that make a folder a package."""

from __future__ import annotations

from pathlib import Path

from bench.planted.edits import (
    Edit,
    Kind,
    cut,
    delete,
    has,
    kind,
    on_file,
    overwritten,
    removed,
    text,
    with_attribute,
    with_child,
    with_text,
    write,
    xml,
)

SHEET = "specifications.md"
PACKAGE = "package.xml"
CONFIG = "model.config"
BUILD = "CMakeLists.txt"


def sheet(pattern: str, replacement: str = "") -> Edit:
    """Return an edit of the specification sheet."""
    return text(SHEET, pattern, replacement)


def _linked(path: Path) -> None:
    (path.parent / "again.launch").symlink_to("gone.launch")


def _misnamed(path: Path) -> None:
    path.rename(path.with_name("my mesh (1).dae"))


SPECIFICATIONS = (
    kind("no specification sheet", "PKG003", delete(SHEET)),
    kind("no section about endurance", "DOC001", sheet(r"^## Endurance Characteristics$")),
    kind("no section about cost", "DOC001 DOC007", sheet(r"^## Cost and Scale$")),
    kind("no section about sensors", "DOC001", sheet(r"^## Sensors$")),
    kind("no section about motion", "DOC001", sheet(r"^## Motion Characteristics$")),
    kind("no section about control", "DOC001", sheet(r"^## Control$")),
    kind("an empty section", "DOC001 DOC002", sheet(r"(^## Control\n)(?:(?!#).*\n)+", r"\1")),
    kind("a placeholder", "DOC002 DOC007", sheet(r"USD [\d,]+", "USD TODO")),
    kind(
        "a placeholder in brackets",
        "DOC002",
        sheet(r"^## Control$", "## Control\\n<Robot Name> is ready."),
    ),
    kind(
        "a sensor that the model lacks",
        "DOC003",
        sheet(
            r"^(\*) 1 ?x (.*)$",
            r"\1 1 x \2\n\1 2 x Hokuyo UTM-30LX planar lidar, modeled by gpu_lidar plugin",
        ),
    ),
    kind(
        "a count of sensors that is too high",
        "DOC003 DOC004",
        sheet(r"^\* (\d) ?x (D435|RGBD)", r"* 7 x \2"),
    ),
    kind("a lidar that the sheet leaves out", "DOC004 DOC003", sheet(r"^\* 1 ?x .*(gpu_lidar).*$")),
    kind(
        "a camera that the sheet leaves out",
        "DOC004 DOC003",
        sheet(r"^\* \d ?x .*(rgbd_camera).*$"),
    ),
    kind("line numbers of something else", "DOC005", sheet(r"lines \d+-\d+", "lines 2-5")),
    kind("line numbers beyond the end", "DOC005", sheet(r"lines? \d+(-\d+)?", "lines 3000-3005")),
    kind(
        "another configuration",
        "DOC006",
        sheet(r"Sensor\s+Configuration 1", "Sensor Configuration 4"),
    ),
    kind(
        "another configuration's variable",
        "DOC006",
        sheet(r"_sensor_config_1`", "_sensor_config_3`"),
    ),
    kind(
        "another robot's variable",
        "DOC006 PKG012",
        sheet(r"name `\w+_sensor_config_1`", "name `x2_sensor_config_1`"),
    ),
    kind(
        "another mass",
        "DOC007 INE008",
        text(SHEET, r"weighs +(approximately |~)?[\d.]+ kg", "weighs 700 kg", everywhere=True),
    ),
    kind(
        "a mass in other units",
        "DOC007 INE008",
        text(SHEET, r"weighs +(approximately |~)?([\d.]+) kg", r"weighs \2 g", everywhere=True),
    ),
    kind("no mass", "DOC007", text(SHEET, r"weighs.*$", "rolls.", everywhere=True)),
    kind("no cost", "DOC007", text(SHEET, r"(USD *|\$)[\d,]+", "money", everywhere=True)),
    kind("a sensor without a link", "DOC008", sheet(r"^\* (D435.*|VLP-16.*|https://autonom.*)$")),
    kind(
        "a longer endurance",
        "BAT003 BAT005",
        sheet(r"(life of|limited to) \d+ (seconds|hour)", r"\1 9 hours"),
    ),
    kind(
        "a faster robot",
        "DRV004",
        sheet(r"(from|limited to)( -[\d.]+ m/s to)? [\d.]+ ?m/[sS]", r"\1 -9.5 m/s to 9.5 m/s"),
    ),
    kind(
        "a turning radius that the drive cannot keep",
        "DOC009",
        sheet(r"Turning radius of [\d.]+ m", "Turning radius of 0.2 m"),
    ),
    kind(
        "no proof of speed",
        "DRV005",
        has("launch/spawner.rb", r"<max_velocity>[2-9]"),
        text(SHEET, r"https?://(youtu|drive)\S*", "a video", everywhere=True),
    ),
    kind(
        "no proof of endurance",
        "BAT005",
        has(SHEET, r"10482 seconds"),
        text(SHEET, r"https?://(youtu|drive)\S*", "a video", everywhere=True),
    ),
)

MANIFEST = (
    kind(
        "another name in package.xml",
        "PKG002 PKG001",
        xml(PACKAGE, "/package/name", with_text("my_robot")),
    ),
    kind(
        "another number in package.xml",
        "PKG002",
        text(PACKAGE, r"_config_1</name>", "_config_7</name>"),
    ),
    kind("no package.xml", "PKG003", delete(PACKAGE)),
    kind("a package.xml that is not well-formed", "SDF001", cut(PACKAGE, 0.8)),
    kind("no licence", "PKG006", xml(PACKAGE, "/package/license", removed)),
    kind("no maintainer", "PKG006", xml(PACKAGE, "/package/maintainer", removed)),
    kind("no version", "PKG006", xml(PACKAGE, "/package/version", removed)),
    kind("no description", "PKG006", xml(PACKAGE, "/package/description", removed)),
    kind("a licence to be decided", "PKG006", xml(PACKAGE, "/package/license", with_text("TODO"))),
    kind(
        "the description of another package's template",
        "PKG006",
        xml(PACKAGE, "/package/description", with_text("The x1_sensor_config_6 package")),
    ),
    kind("a version that is none", "PKG006", xml(PACKAGE, "/package/version", with_text("first"))),
    kind(
        "a maintainer without an address",
        "PKG006",
        xml(PACKAGE, "/package/maintainer", with_attribute("email", None)),
    ),
    kind(
        "a format that does not exist",
        "PKG006",
        xml(PACKAGE, "/package", with_attribute("format", "9")),
    ),
    kind(
        "the description of another configuration",
        "PKG005 DOC006",
        xml(
            PACKAGE,
            "/package/description",
            with_text("The robot with sensor configuration #5: two planar lidars, 12 breadcrumbs."),
        ),
    ),
    kind("xacro that is not declared", "PKG007", xml(PACKAGE, "/package/*[.='xacro']", removed)),
)

FOLDER = (
    kind("no model.config", "PKG003 PKG009", delete(CONFIG)),
    kind("no model.sdf", "PKG003 PKG009 PKG004", delete("model.sdf")),
    kind("no spawner", "PKG003", delete("launch/spawner.rb")),
    kind("no launch file for topics", "PKG003 SPW009", delete("launch/vehicle_topics.launch")),
    kind(
        "no launch file for the description", "PKG003 SPW009", delete("launch/description.launch")
    ),
    kind("no build file", "PKG003", delete(BUILD)),
    kind("no model name in model.config", "PKG004", xml(CONFIG, "/model/name", removed)),
    kind("no model file in model.config", "PKG004", xml(CONFIG, "/model/sdf", removed)),
    kind("no author in model.config", "PKG004", xml(CONFIG, "/model/author", removed)),
    kind(
        "a model file that is not there",
        "PKG004 REF002",
        xml(CONFIG, "/model/sdf", with_text("robot.sdf")),
    ),
    kind(
        "another SDF version in model.config",
        "PKG004 SDF002",
        xml(CONFIG, "/model/sdf", with_attribute("version", "1.4")),
    ),
    kind(
        "another number in model.config",
        "PKG002",
        text(CONFIG, r"(onfig[ _])1</name>", r"\g<1>5</name>"),
    ),
    kind(
        "the sensors of another configuration",
        "PKG005 DOC006",
        text(
            CONFIG,
            "(<description>\\s*)[^<]*?(\\s*</description>)",
            r"\1Sensor configuration #1 with a thermal camera, a sonar and 12 breadcrumbs.\2",
        ),
    ),
    kind(
        "a dependency on Fuel that is broken",
        "REF004",
        xml(
            CONFIG,
            "/model",
            with_child(
                "<depend><model><uri>https://fuel.ignitionrobotics.org/openrobotics/models</uri></model></depend>"
            ),
        ),
    ),
    kind(
        "another project in the build file",
        "PKG002",
        text(BUILD, r"project\(\w+\)", "project(my_robot)"),
    ),
    kind("launch files that are not installed", "PKG008", text(BUILD, r"launch meshes", "meshes")),
    kind("meshes that are not installed", "PKG008", text(BUILD, r"launch meshes", "launch")),
    kind(
        "a model that is not installed",
        "PKG008",
        text(BUILD, "model.sdf model.config", "model.config"),
    ),
    kind(
        "a folder to install that is not there",
        "PKG009",
        text(BUILD, "launch meshes", "launch meshes worldz"),
    ),
    kind(
        "nothing installed",
        "PKG008 PKG009",
        text(BUILD, r"^install\((?:.*\n)+?\)$", everywhere=True),
    ),
    kind(
        "a build package that does not exist",
        "PKG010",
        text(
            BUILD,
            r"find_package\(catkin REQUIRED\)",
            "find_package(catkin REQUIRED COMPONENTS roslanch)",
        ),
    ),
    kind("a file of an editor", "PKG011", write("model.sdf~", "<sdf/>")),
    kind("a file of an operating system", "PKG011", write("meshes/.DS_Store", b"\0\0")),
    kind("a compiled file", "PKG011", write("launch/__pycache__/a.pyc", b"\0\0")),
    kind("a rejected patch", "PKG011", write("model.sdf.rej", "--- model.sdf")),
    kind("a build folder", "PKG011", write("build/CMakeCache.txt", "A=1")),
    kind(
        "a path of another submission",
        "PKG012 REF002 PKG007 URD002",
        text(
            "urdf/model.xacro|urdf/rocky.xacro",
            r"package://\w+_sensor_config_1",
            "package://x1_sensor_config_1",
        ),
    ),
    kind(
        "a file name with blanks", "PKG015 REF002 REF005 URD002", on_file("meshes/*.dae", _misnamed)
    ),
    kind("a link to nothing", "PKG016", on_file("launch/spawner.rb", _linked)),
    kind(
        "an example of another robot",
        "PKG019",
        write(
            "launch/example.ign",
            "<ignition version='1.0'><executable name='a'><command>roslaunch x4_sensor_config_2 "
            "a.launch</command></executable></ignition>",
        ),
    ),
    kind("a file that nothing uses", "REF005", write("meshes/old_arm.dae", "<COLLADA/>")),
    kind("a mesh cut off", "MSH001", cut("meshes/wheel*.dae")),
    kind(
        "a mesh that is a page of the web",
        "MSH001",
        overwritten("meshes/realsense*.dae", "<html><body>404</body></html>"),
    ),
    kind("a mesh that is empty", "MSH001", overwritten("meshes/realsense*.dae", "")),
    kind(
        "a pointer in place of a mesh",
        "MSH001",
        overwritten(
            "meshes/realsense*.dae",
            "version https://git-lfs.github.com/spec/v1\noid sha256:" + "0" * 64 + "\nsize 1234\n",
        ),
    ),
    kind(
        "a mesh whose texture is missing", "MSH006", delete("meshes/*.png"), delete("meshes/*.png")
    ),
)

KINDS: tuple[Kind, ...] = (*SPECIFICATIONS, *MANIFEST, *FOLDER)
