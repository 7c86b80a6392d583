"""Faults in a spawner.rb."""

from __future__ import annotations

from bench.planted.edits import Edit, Kind, has, kind, text

FILE = "launch/spawner.rb"
DIFF_DRIVE = "libignition-gazebo-diff-drive-system.so"
BATTERY = "libignition-gazebo-linearbatteryplugin-system.so"


def ruby(pattern: str, replacement: str = "") -> Edit:
    """Return an edit of the text of the spawner."""
    return text(FILE, pattern, replacement)


def plugin(name: str) -> Edit:
    """Return an edit that makes a plugin a comment."""
    start = rf"""<(plugin [^>]*name=["'][\w:]*{name}["']>(?:.*\n)+?.*)</plugin>"""
    return ruby(start, r"<!--\1</plugin-->")


def value(tag: str, new: str) -> Edit:
    """Return an edit of the value of an element."""
    return ruby(rf"<{tag}>[^<]*</{tag}>", f"<{tag}>{new}</{tag}>")


def gone(tag: str) -> Edit:
    """Return an edit that takes an element away."""
    return ruby(rf"<{tag}>[^<]*</{tag}>")


RUBY = (
    kind("a function without end", "SPW001", ruby(r"^end$")),
    kind("a here-document without end", "SPW001 SPW003 SPW004", ruby(r"^  SDF$")),
    kind("a string without end", "SPW001", ruby(r"\\n\"$", r"\\n")),
    kind("a bracket too many", "SPW001", ruby(r"_yaw\)$", "_yaw))")),
    kind("an insertion without end", "SPW001 SPW004", ruby(r"#\{_z \+ ([\d.]+)\}", r"#{_z + \1")),
    kind("no function spawner", "SPW003", ruby("^def spawner", "def spawn_robot")),
    kind("no function rosExecutables", "SPW003", ruby("^def rosExecutables", "def executables")),
    kind("an argument too few", "SPW003 SPW002 SPW005", ruby(", _yaw\\)", ")")),
    kind("an unknown name in the SDF", "SPW002 SPW005", ruby(r"#\{_z", "#{_height")),
    kind("a tag that is not closed", "SPW004", ruby("</include>", "")),
    kind("a plugin that is not closed", "SPW004", ruby("</plugin>", "")),
    kind("a tag closed by another", "SPW004", ruby("</world>", "</word>")),
    kind(
        "a variable left over", "SPW011", ruby(r"^def spawner(.*)$", r"def spawner\1; wheels = 4")
    ),
)

SPAWN = (
    kind("x and y exchanged", "SPW005", ruby(r"#\{_x\} #\{_y\}", "#{_y} #{_x}")),
    kind("the yaw left out", "SPW005", ruby(r"#\{_pitch\} #\{_yaw\}", "#{_pitch} 0")),
    kind("no spawn pose", "SPW005 SPW012", ruby("<pose>.*</pose>")),
    kind("a spawn pose in words", "SPW005 SDF006", ruby("<pose>.*</pose>", "<pose>here</pose>")),
    kind("a robot that falls two metres", "SPW010", ruby(r"_z \+ [\d.]+", "_z + 2.5")),
    kind("a robot in the ground", "SPW010", ruby(r"_z \+ [\d.]+", "_z - 0.4")),
    kind("a hard-coded name", "SPW006", ruby(r"<name>#\{_name\}</name>", "<name>X1</name>")),
    kind("a hard-coded model", "SPW006 SPW012", ruby(r"<uri>#\{_modelURI\}", "<uri>model://x1")),
    kind(
        "a hard-coded name in a topic",
        "SPW006 PLG008 ROS001 ROS002",
        ruby(r"<topic>/model/#\{_name\}", "<topic>/model/X1"),
    ),
    kind(
        "a topic without the robot's name",
        "PLG008 ROS001 ROS002",
        ruby(r"<topic>/model/#\{_name\}/", "<topic>/"),
    ),
    kind("no world", "SPW012", gone("world")),
    kind("no performer", "SPW012", gone("is_performer")),
    kind("a name that may change", "SPW012", value("allow_renaming", "true")),
    kind(
        "the old spawn wrapper",
        "SPW007",
        ruby(
            """<spawn name=(["'])#\\{_name\\}["']>""",
            r"<plugin name=\1ignition::launch::GazeboFactory\1 "
            r"filename=\1libignition-launch-gazebo-factory.so\1>",
        ),
        ruby("</spawn>", "</plugin>"),
    ),
    kind("no PosePublisher", "SPW008 ROS002", plugin("PosePublisher")),
    kind("no poses of links", "SPW008", value("publish_link_pose", "false")),
    kind("the true pose always", "SPW008", value("publish_nested_model_pose", "true")),
    kind("poses one by one", "SPW008 ROS003", value("use_pose_vector_msg", "false")),
    kind("no static poses", "SPW008 ROS002", value("static_publisher", "false")),
)

DRIVE = (
    kind("no drive", "DRV001 ROS002", plugin("DiffDrive")),
    kind("no flight control", "DRV001 ROS002", plugin("MulticopterVelocityControl")),
    kind("no greatest speed", "DRV002", gone("max_velocity")),
    kind("no greatest acceleration", "DRV002", gone("max_acceleration")),
    kind("no speed limit in flight", "DRV002", gone("maximumLinearVelocity")),
    kind("slower backwards", "DRV003 DRV004", value("min_velocity", "-0.2")),
    kind("a limit of the wrong sign", "DRV003 DRV002 DRV004", value("min_velocity", "2")),
    kind("limits the wrong way round", "DRV003 DRV002 DRV004", value("max_acceleration", "-3.0")),
    kind(
        "faster than the sheet says",
        "DRV004 KIN012 DRV005",
        value("min_velocity", "-5.0"),
        value("max_velocity", "5.0"),
    ),
    kind(
        "faster in flight than the sheet says", "DRV004", value("maximumLinearVelocity", "9 9 1.5")
    ),
    kind(
        "much faster than was proved",
        "DRV005 DRV004 KIN012",
        value("min_velocity", "-20"),
        value("max_velocity", "20"),
    ),
    kind(
        "stronger than the sheet says",
        "DRV004",
        has("specifications.md", "acceleration range"),
        value("min_acceleration", "-9"),
        value("max_acceleration", "9"),
    ),
    kind("no tyre slip", "DRV007", plugin("WheelSlip")),
    kind(
        "a wheel without slip",
        "DRV007 DRV009",
        ruby(r"<wheel link_name=.rear_left_wheel.>(?:.*\n)+?.*</wheel>"),
    ),
    kind(
        "slip of no wheel",
        "PLG004 DRV009",
        ruby("link_name=(.)rear_left_wheel", r"link_name=\1rear_left_tyre"),
    ),
    kind("slip at ten times the load", "DRV009", value("wheel_normal_force", "1143")),
    kind(
        "slip at another radius",
        "DRV009 GEO004",
        ruby(
            "<wheel_radius>0.1275</wheel_radius>\\n(.*)</wheel>",
            "<wheel_radius>0.5</wheel_radius>\\n\\1</wheel>",
        ),
    ),
    kind("a slip that is negative", "DRV009", value("slip_compliance_lateral", "-0.172")),
    kind(
        "a drive on another radius",
        "GEO004",
        ruby(
            "<wheel_radius>[\\d.]+</wheel_radius>\\n(.*<topic>)",
            "<wheel_radius>0.3</wheel_radius>\\n\\1",
        ),
    ),
    kind("half the wheel separation", "GEO005", ruby(r"#\{(0.\d+) \* 2.0\}", r"\1")),
    kind("a drive on a joint of another name", "PLG004", value("left_joint", "left_wheel")),
    kind(
        "a drive on a joint of the other side",
        "DRV001 PLG004 GEO005 PLG006 GEO013 DRV010 DRV007 PLG005",
        value("left_joint", "front_right_wheel_joint"),
    ),
    kind(
        "a wheel that is not driven",
        "KIN006",
        ruby("<left_joint>front_left_wheel_joint</left_joint>"),
    ),
    kind(
        "a rotor that turns the other way",
        "DRV010",
        ruby("'ccw', 'ccw', 'cw', 'cw'", "'ccw', 'ccw', 'cw', 'ccw'"),
    ),
    kind(
        "rotors that all turn one way",
        "DRV010",
        ruby("'ccw', 'ccw', 'cw', 'cw'", "'cw', 'cw', 'cw', 'cw'"),
    ),
    kind(
        "a rotor of another direction in the control",
        "DRV010",
        ruby(r"\[1, 1, -1, -1\]", "[1, 1, -1, 1]"),
    ),
    kind("rotors of the same number", "DRV010", ruby(r"\[0, 1, 2, 3\]", "[0, 1, 2, 2]")),
    kind(
        "a rotor of no joint",
        "PLG004 DRV010",
        ruby("'rotor_3_joint'\\]\n  rotor_b", "'rotor_4_joint']\n  rotor_b"),
    ),
    kind("a rotor too weak to lift", "DRV010", value("motorConstant", "1e-07")),
    kind("a control that counts on other rotors", "DRV010", value("forceConstant", "1e-05")),
    kind(
        "a flight control that hears another command",
        "ROS001 ROS002",
        ruby("<commandSubTopic>cmd_vel<", "<commandSubTopic>twist<"),
    ),
)

POWER = (
    kind("no battery", "BAT001", plugin("LinearBatteryPlugin")),
    kind("a battery without charge", "BAT001 BAT003 BAT004", value("initial_charge", "0")),
    kind(
        "a battery that lasts ten times as long",
        "BAT003 BAT005",
        ruby(r"<initial_charge>([\d.]+)<", r"<initial_charge>9\1<"),
        ruby(r"<capacity>([\d.]+)<", r"<capacity>9\1<"),
    ),
    kind("a figure that is still to be filled in", "SPW014", value("power_load", "TODO")),
    kind("a battery that never drains", "BAT004", value("power_load", "0")),
    kind("a battery that nothing starts", "BAT004", value("start_on_motion", "false")),
    kind("a battery that lasts a minute", "BAT003", value("power_load", "990")),
    kind("no gas detector", "SEN017 ROS002", plugin("GasDetector")),
    kind(
        "a gas detector that publishes elsewhere",
        "ROS001 ROS002 SEN017",
        ruby("gas_detected</topic>", "gas</topic>"),
    ),
)

LIBRARIES = (
    kind(
        "an unknown library",
        "PLG002",
        ruby(
            r"filename=(.)libignition-gazebo-([\w-]+)-system",
            r"filename=\1libignition-gazebo-\2-systm",
        ),
    ),
    kind(
        "a library without lib",
        "PLG002",
        ruby(
            r"filename=(.)libignition-gazebo-([\w-]+)-system.so",
            r"filename=\1ignition-gazebo-\2.dll",
        ),
    ),
    kind(
        "a library of a later release",
        "PLG002",
        ruby(r"filename=(.)libignition-gazebo-([\w-]+)-system", r"filename=\1gz-sim-\2-system"),
    ),
    kind(
        "a class of another library",
        "PLG003",
        ruby("systems::PosePublisher", "systems::WheelSlip"),
    ),
    kind(
        "a misspelt class", "PLG003", ruby("systems::LinearBatteryPlugin", "systems::LinearBattery")
    ),
    kind(
        "a class without its namespace",
        "PLG003",
        ruby("ignition::gazebo::systems::PosePublisher", "PosePublisher"),
    ),
    kind("a drive of Gazebo Classic", "PLG001", ruby(DIFF_DRIVE, "libgazebo_ros_diff_drive.so")),
    kind(
        "a misspelt parameter",
        "PLG005 DRV002",
        ruby("<max_velocity>(.*)</max_velocity>", r"<max_vel>\1</max_vel>"),
    ),
    kind(
        "a parameter of ROS",
        "PLG005 GEO005",
        ruby("<wheel_separation>(.*)</wheel_separation>", r"<wheelSeparation>\1</wheelSeparation>"),
    ),
    kind(
        "a misspelt parameter of the battery",
        "PLG005",
        ruby("<capacity>(.*)</capacity>", r"<capasity>\1</capasity>"),
    ),
)

COMMANDS = (
    kind(
        "a launch file that is not there", "SPW009", ruby("vehicle_topics.launch", "topics.launch")
    ),
    kind(
        "a launch file of another robot",
        "SPW009 PKG012 PKG007",
        ruby(
            r"roslaunch --wait \w+ description", "roslaunch --wait x1_sensor_config_6 description"
        ),
    ),
    kind(
        "a command without the robot's name",
        "SPW013",
        ruby(r" name:=#\{_name\}</command>", "</command>"),
    ),
    kind(
        "a command with a fixed name",
        "SPW013 SPW006 ROS005 ROS013",
        ruby(r" name:=#\{_name\}( .*)?</command>", r" name:=X1\1</command>"),
    ),
    kind(
        "nothing starts the topics",
        "SPW009",
        ruby(r"<command>roslaunch --wait \w+ vehicle_topics[^<]*<", "<command>rosnode list<"),
    ),
    kind(
        "nothing starts the description",
        "SPW009",
        ruby(r"<command>roslaunch --wait \w+ description[^<]*<", "<command>rosnode list<"),
    ),
    kind("roslaunch misspelt", "SPW009 SPW013", ruby("roslaunch --wait", "roslanch --wait")),
)

KINDS: tuple[Kind, ...] = (*RUBY, *SPAWN, *DRIVE, *POWER, *LIBRARIES, *COMMANDS)
