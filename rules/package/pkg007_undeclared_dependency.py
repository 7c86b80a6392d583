"""A package that is used, but not declared as a dependency.

A package that package.xml does not name is not installed with the robot: launch files of another
submission, the bridge to ROS, or the package of a node are then missing where the robot runs.
Comments do not count, nor launch files of ROS 1 in a package of ROS 2. In ROS 2 this holds for the
packages of nodes, components, included launch files, parameter files, `xacro` commands, `$(find …)`
and `package://` in robot descriptions, and for `rclpy`, messages and a few modules of ROS, such as
`cv_bridge`, that nodes in Python import; other modules in Python are not checked. So it does for
packages of ROS and of the workspace that CMakeLists.txt requires without a condition, and for those
of controllers and Gazebo's hardware, unless another package of the workspace declares them, or only
comments name the file with the controllers. Hardware that another package of the workspace exports
is of that package. One of the workspace that the build requires is an
error: colcon, which takes the order from package.xml, builds both at once, and a build from scratch
stops.
Dependencies of a declared metapackage such as ros_gz count as declared. What a declared package of
the workspace needs where it runs is installed with it, and is an info. The same happens if
package.xml misspells the package of a team or plugin: it is reported if a package of a similar name
is available, and the misspelt one is not. A name that no ROS distribution has is to be corrected,
not declared, if it is near to one of them; so is one whose messages a node imports, if it exists
nowhere in a repository of several packages, and nothing there brings it. LCH015 reports what a
launch file starts of a package that the distribution no longer has. What a description names that
no launch file loads, beside one that is loaded, does not count. If a package is not available,
and this package has every file that it uses of it, or its name in another order, the name is taken
as the former name of this package: an info, and a warning where roslaunch stops at its `$(find …)`.

Fix: do not declare a package that exists nowhere: remove its import, or add the package. For each
other package that is used, add `<exec_depend>` (in format 1 `<run_depend>`), `<depend>` for those
that the build uses, too; write the package's own name instead of its former one.
Source: REP 149, exec_depend; rosdep installs what package.xml names; package.xml of ros_gz,
navigation2, nav2_bringup, ros2_control, ros2_controllers, gazebo_ros_pkgs, moveit, rtabmap_ros,
turtlebot3 and its simulations, and of the variants of ROS (ros_core, ros_base, desktop, perception)
for Humble to Rolling; in model reviews, authors added the dependency on configuration 1.
"""

import posixpath
import re
from collections.abc import Iterator, Mapping

from checker.base.resources import table
from checker.base.words import and_list
from checker.finding import Fix
from checker.launch.ros2.graph import Ros2Launch
from checker.launch.ros2.package_launch import built_by_ament
from checker.launch.ros2.used_packages import every_use
from checker.package.dependencies import Use, duplicate_files, former_names
from checker.package.distribution_sign import former_distribution
from checker.package.inheritance import SPAWNER, SUBMISSION_NAME
from checker.package.kind import PackageKind
from checker.package.manifests import DEPENDENCY_TAGS, Dependency, PackageManifest, Paperwork
from checker.package.mentions import has_word
from checker.package.model_file import own_model
from checker.package.nowhere import is_nowhere
from checker.package.package import Package
from checker.package.references import PROVIDED
from checker.package.released import (
    ReleasedNames,
    distributions_with,
    is_listed,
    is_of_system,
)
from checker.package.submissions import is_slip_for, robot_of
from checker.package.teams import teams
from checker.robots.urdf_files import UrdfFiles
from checker.ros.ros2_control.distributions import distribution_of
from checker.ros.ros2_control.plugin_packages import plugin_uses, uses_beside
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    rename,
    rule,
    unchecked,
)
from checker.source.xml import XmlDocument
from checker.source.xml_insertion import append_to, insert_behind

_IMPORT = "from "
_STARTED = ("node ", "file launch/")
_RELEASE = re.compile(r"\Aros[12]\Z")
_ROS_CORE = (
    r"(?:actionlib|diagnostic|geometry|nav|sensor|shape|std|stereo|trajectory|visualization)_msgs"
    r"|std_srvs|rclcpp(?:_action|_lifecycle)?|rclpy|launch(?:_ros|_xml|_yaml)?|ros2launch|pluginlib"
)
_ROS_BASE = (
    rf"{_ROS_CORE}|tf2(?:_eigen|_geometry_msgs|_kdl|_msgs|_py|_ros|_sensor_msgs|_tools)?|urdf"
    "|kdl_parser|robot_state_publisher"
)
_DESKTOP = (
    rf"{_ROS_BASE}|joy|rviz2|rviz_default_plugins|teleop_twist_(?:joy|keyboard)"
    "|depthimage_to_laserscan|pcl_conversions|angles"
)
_PERCEPTION = rf"{_ROS_BASE}|laser_filters|laser_geometry|cv_bridge|image_geometry"
_PACKAGES_OF_PACKAGES = {
    "rclcpp": "(?:builtin|rcl)_interfaces|(?:rosgraph|statistics)_msgs",
    "rclpy": "(?:builtin|rcl)_interfaces|(?:action|rosgraph|unique_identifier)_msgs",
    "ros_core": _ROS_CORE,
    "ros_base": _ROS_BASE,
    "desktop": _DESKTOP,
    "perception": _PERCEPTION,
    "desktop_full": rf"{_DESKTOP}|{_PERCEPTION}|ros_gz_.*",
    "rtabmap_ros": "rtabmap_(?:conversions|demos|examples|launch|msgs|odom|python|rviz_plugins"
    "|slam|sync|util|viz)",
    "turtlebot3": "turtlebot3_(?:bringup|cartographer|description|example|navigation2|node|teleop)",
    "turtlebot3_simulations": "turtlebot3_(?:fake_node|gazebo)",
    "ros_gz": "ros_gz_.*",
    "ros_ign": "ros_ign_.*",
    "gazebo_ros_pkgs": "gazebo_.*",
    "navigation2": "nav2_(?!bringup|minimal|loopback).*",
    "nav2_bringup": "nav2_.*|slam_toolbox|navigation2|launch_ros",
    "ros2_control": "controller_manager|hardware_interface|joint_limits|ros2controlcli",
    "ros2_controllers": ".*_controllers?|.*_broadcaster",
    "moveit": "moveit_.*",
    "vision_opencv": "cv_bridge|image_geometry",
    "joint_state_publisher_gui": "joint_state_publisher",
}
"""Packages of packages and client libraries, and the names of what each depends on."""


@rule("PKG007", "undeclared-dependency", Severity.WARNING, Concern.PAPERWORK)
def check(
    package: Package,
    paperwork: Paperwork,
    context: Context,
    launch: Ros2Launch | None,
    files: UrdfFiles | None,
) -> Findings:
    """Compare used packages with package.xml.

    Packages of the ROS distribution are infos, in ROS 2 a warning.
    """
    if reason := paperwork.unread("package.xml"):
        yield unchecked(reason)
    manifest = paperwork.manifest
    if manifest is None:
        return
    others: dict[str, Use] = {}
    bringing = _brought_by_workspace(package, manifest)
    ament = built_by_ament(package)
    unloaded = {it.file for it in files.descriptions if it.unloaded} if files is not None else ()
    uses = [
        use
        for use in every_use(package, launch)
        if not (use.builds and manifest.depends_on(use.package_name))
        if not (ament and _is_of_folder(package, use.package_name))
        if use.place.file not in unloaded
    ]
    uses += _plugins(package, context) if ament else ()
    former = former_names(package, uses)
    copied = {use.place for use in duplicate_files(package)}  # PKG012: to be replaced, not declared
    for use in uses:
        name = use.package_name
        if name in (package.name, manifest.name.value) or use.place in copied:
            continue
        if name in former or _has_words_of(package, name):
            if not manifest.depends_on(name):
                yield finding(
                    use.place,
                    _renaming_message(package, use, has_files=name in former),
                    severity=None if name in former and _stops(use) else Severity.INFO,
                    key=name,
                    covered_by=("LCH001", "REF002"),
                )
            continue
        beside = name not in PROVIDED and package.workspace.package(name) is not None
        if SUBMISSION_NAME.search(name) or beside:
            if not _needed_at_run_time(manifest, name):
                yield _at_hand(package, manifest, use, bringing)
        elif not manifest.depends_on(name) and not _brought(manifest, name):
            others.setdefault(name, use)
    distro = "" if former_distribution(package) else context.distro
    yield from _no_such_package(others, distro, is_stated=context.distro_is_known)
    yield from _not_imported(package, others)
    yield from _distribution(package, manifest, others, bringing, context.release)
    yield from _lender(package, manifest)
    yield from _misspelt(package, manifest)


def _is_of_folder(package: Package, name: str) -> bool:
    """Return whether a name is that of a package's folder alone: PKG023 reports it."""
    holder = package.workspace.package(name) if name not in PROVIDED else None
    return holder is not None and holder.declared_name != name


def _plugins(package: Package, context: Context) -> Iterator[Use]:
    """Yield packages of controllers and hardware that no package of the workspace declares."""
    own = [*uses_beside(package)]
    uses = [*plugin_uses(package), *own]
    manifests = [Paperwork(other).manifest for other in package.other_packages if uses]
    for use in uses:
        name = use.package_name
        declared = any(it and (it.depends_on(name) or _brought(it, name)) for it in manifests)
        if not declared and (use in own or distribution_of(context) in distributions_with(name)):
            yield use


def _stops(use: Use) -> bool:
    """Return whether roslaunch evaluates a use, and stops where the package does not exist."""
    return use.how.startswith("$(find") and use.place.file.endswith(".launch")


def _renaming_message(package: Package, use: Use, *, has_files: bool) -> str:
    own = package.declared_name
    why = f", and {own} has all files that are used of it" if has_files else ""
    then = ": roslaunch stops here unless another repository has it" if _stops(use) else ""
    return f"{use.package_name} is not available{why}: expected {own}, if it was renamed{then}"


def _has_words_of(package: Package, name: str) -> bool:
    """Return whether a package that exists nowhere is named by the words of this one.

    It is the name that this package had, for example for ROS 1.
    """
    exists = package.workspace.package(name) is not None or distributions_with(name)
    return not exists and _words_of(name) == _words_of(package.declared_name)


def _words_of(name: str) -> list[str]:
    return sorted(_RELEASE.sub("ros", word) for word in re.split("[_-]", name))


def _needed_at_run_time(manifest: PackageManifest, name: str) -> bool:
    return any(
        dependency.at_run_time and dependency.package.value == name
        for dependency in manifest.dependencies
    )


def _at_hand(
    package: Package, manifest: PackageManifest, use: Use, bringing: Mapping[str, str]
) -> Finding:
    """Report one use; what depends on this package cannot be declared: nothing builds a circle."""
    name = use.package_name
    message = f"package {name} is used here ({use.how}), and package.xml does not depend on it"
    if _leads_back(package, name, manifest.name.value):
        message = f"{message}, and needs {manifest.name.value} itself"
        return finding(use.place, message, severity=Severity.INFO, key=name)
    fix, severity = _declaration_fix(package, manifest, use), None
    if use.builds and built_by_ament(package) and name not in bringing:
        message, severity = f"{message}: colcon builds both at once, and stops", Severity.ERROR
    elif name in bringing and not (use.builds or SUBMISSION_NAME.search(name)):
        message, severity = f"{message}; {bringing[name]} brings it", Severity.INFO
    return finding(use.place, message, severity=severity, key=name, fix=fix)


def _leads_back(package: Package, name: str, own: str) -> bool:
    """Return whether a package depends on this one, or its launch files name this one."""
    seen, waiting = set[str](), [name]
    while waiting:
        other = package.workspace.package(waiting.pop())
        if other is None or other.name in seen:
            continue
        seen.add(other.name)
        manifest = Paperwork(other).manifest
        named = any(has_word(text, own) for text in other.launch_texts.values())
        if named or (manifest is not None and manifest.depends_on(own)):
            return True
        waiting += (it.package.value for it in manifest.dependencies) if manifest else ()
    return False


def _brought(manifest: PackageManifest, name: str) -> bool:
    """Return whether a package of packages that is declared brings it."""
    return any(
        re.fullmatch(pattern, name) and manifest.depends_on(whole)
        for whole, pattern in _PACKAGES_OF_PACKAGES.items()
    )


def _brought_by_workspace(package: Package, manifest: PackageManifest) -> Mapping[str, str]:
    """Return what declared packages of the workspace need where they run, each with one of them."""
    bringing: dict[str, str] = {}
    waiting = [it.package.value for it in manifest.dependencies if _is_certain(it)]
    seen = {package.name, manifest.name.value}
    while waiting:
        name = waiting.pop()
        other = package.workspace.package(name) if name not in seen else None
        seen.add(name)
        needs = Paperwork(other).manifest if other is not None else None
        for dependency in filter(_is_certain, needs.dependencies) if needs is not None else ():
            bringing.setdefault(dependency.package.value, name)
            waiting.append(dependency.package.value)
    return bringing


def _is_certain(dependency: Dependency) -> bool:
    return dependency.at_run_time and not dependency.is_conditional


def _distribution(
    package: Package,
    manifest: PackageManifest,
    uses: Mapping[str, Use],
    bringing: Mapping[str, str],
    release: str,
) -> Iterator[Finding]:
    """Report packages of ROS: first those that nothing brings, then the others as an info."""
    ament = built_by_ament(package)
    # Packages with another name on the target must be renamed first: ROS011.
    renamed = table("renamed_packages")["releases"].get(release, {})
    brought = {name: by for name in uses if (by := _brings(bringing, name))}
    for names in (sorted(uses.keys() - brought), sorted(brought)):
        lacking = [uses[name] for name in names if name not in renamed]
        by = and_list(sorted({brought[name] for name in names if name in brought}))
        if names:
            word = "dependency" if len(names) == 1 else "dependencies"
            yield finding(
                manifest if ament else package.folder_place(),
                f"package.xml lacks the {word} {and_list(names)}"
                + (f": installing {by} brings {'it' if len(names) == 1 else 'them'}" if by else ""),
                severity=Severity.INFO if by or not ament else None,
                related=[(uses[name].place, f"{name} is used here") for name in names],
                fix=_declaration_fix(package, manifest, *lacking) if lacking else None,
            )


def _brings(bringing: Mapping[str, str], name: str) -> str:
    """Return which declared package brings one, itself or by a package of packages; else empty."""
    wholes = (it for it, names in _PACKAGES_OF_PACKAGES.items() if re.fullmatch(names, name))
    return next((bringing[it] for it in (name, *wholes) if it in bringing), "")


def _no_such_package(uses: dict[str, Use], distro: str, *, is_stated: bool) -> Iterator[Finding]:
    """Report, and take out, misspelt names of packages: rosdep would not find what is declared.

    Nor would it find what the distribution does not have: LCH015 says so of what is started.
    """
    names, removed = ReleasedNames(distro), table("removed_packages")["names"]
    for name, use in [*uses.items()] if distro else ():
        released = distributions_with(name)
        of_others = is_stated and is_listed(distro) and released and distro not in released
        is_removed = distro in removed.get(name, {}).get("missing_in", ())
        if of_others or (use.how.startswith(_STARTED) and is_removed):
            del uses[name]
            continue
        known = released or is_of_system(name)
        meant = None if known else names.correction_of(name)
        if meant is not None:
            del uses[name]
            message = f"there is no package {name!r}; did you mean {meant!r}?"
            yield finding(use.place, message, key=name, covered_by=("LCH015",))


def _not_imported(package: Package, uses: dict[str, Use]) -> Iterator[Finding]:
    """Report, and take out, imports from packages that exist nowhere: none can be declared."""
    for name, use in [*uses.items()]:
        if use.how.startswith(_IMPORT) and is_nowhere(package, name):
            del uses[name]
            yield finding(
                use.place,
                f"this repository has no package {name}, and ROS has none: "
                f"{posixpath.basename(use.place.file)} stops at this import; remove it, or add the "
                "package",
                key=name,
            )


def _lender(package: Package, manifest: PackageManifest) -> Iterator[Finding]:
    """Report a configuration without model and spawner that does not state whose model it uses."""
    is_submission = SUBMISSION_NAME.search(package.name) and package.kind is PackageKind.ROBOT
    if not is_submission or own_model(package) is not None or package.exists(SPAWNER):
        return
    if not any(
        SUBMISSION_NAME.search(dependency.package.value) for dependency in manifest.dependencies
    ):
        yield finding(manifest, "the package has no model and depends on no package that has one")


def _misspelt(package: Package, manifest: PackageManifest) -> Iterator[Finding]:
    """Report a team's or plugin's package that is not there, while one of a near name is."""
    prefixes = (f"{package.name.split('_')[0]}_", *(f"{team.prefix}_" for team in teams()))
    for dependency in manifest.dependencies:
        name = dependency.package.value
        is_plugin = "plugin" in name
        is_of_teams = is_plugin or SUBMISSION_NAME.search(name) or name.startswith(prefixes)
        if not is_of_teams or package.workspace.package(name) or distributions_with(name):
            continue
        for other in package.workspace.packages:
            slip = is_slip_for(name, other) or (is_plugin and _is_own(package, name, other))
            # `rover_msgs` of another repository is not a slip for `rover`.
            if slip and other != package.name and not name.startswith(f"{other}_"):
                message = f"there is no package {name}; did you mean {other!r}?"
                fix = rename(dependency.package, other)
                yield finding(dependency.package, message, key=name, fix=fix)
                break


def _is_own(package: Package, name: str, other: str) -> bool:
    """Return whether another package is named after this robot, and otherwise as the given one."""
    robot = robot_of(package.name)
    words, others = name.split("_"), other.split("_")
    differing = [pair for pair in zip(words, others, strict=False) if len(set(pair)) > 1]
    is_near = len(words) == len(others) and len(differing) == 1
    return is_near and other.startswith(f"{robot}_") and not name.startswith(f"{robot}_")


def _declaration_fix(package: Package, manifest: PackageManifest, *uses: Use) -> Fix | None:
    """Return the fix that adds dependencies after those that package.xml has."""
    document = package.xml("package.xml")
    if not isinstance(document, XmlDocument):
        return None
    at_run_time = "run_depend" if manifest.format.value == 1 else "exec_depend"
    tags = ["depend" if use.builds else at_run_time for use in uses]
    lines = [f"<{tag}>{use.package_name}</{tag}>" for tag, use in zip(tags, uses, strict=True)]
    others = [child for child in document.root.children if child.tag in DEPENDENCY_TAGS]
    edit = insert_behind(others[-1], lines) if others else append_to(document.root, lines)
    return Fix(Safety.SAFE, (edit,))


def _manifest(depends: str) -> str:
    return f"""<package format="2">
  <name>acme_rover_sensor_config_1</name>
  {depends}
</package>
"""


def _launch(name: str, end: str = "") -> str:
    return f'<launch><include file="$(find {name})/launch/a.launch"/></launch>{end}\n'


def _depends_on_plugin(mark: str = "") -> dict[str, str]:
    return {
        "package.xml": _manifest(f"<exec_depend>acme_rover_gazebo_plugin_1</exec_depend>{mark}"),
    }


def _package(name: str, *names: str) -> str:
    return _arm(*names).replace("acme_arm_bringup", name)


_PLUGIN = "<package><name>p</name></package>"


def _arm(*names: str, mark: str = "") -> str:
    depends = "".join(f"<exec_depend>{name}</exec_depend>" for name in names)
    return f"""<package format="3">{mark}
  <name>acme_arm_bringup</name>
  {depends}
  <export><build_type>ament_cmake</build_type></export>
</package>
"""


_BRIDGE = """        Node(package='ros_gz_bridge', executable='parameter_bridge'),
        IncludeLaunchDescription(PathJoinSubstitution([
            FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py'])),"""
_TELEOP = "        Node(package='teleop_twist_keyboard', executable='teleop_twist_keyboard'),"
_MAPPING = "        Node(package='rtabmap_slam', executable='rtabmap'),"
_NAVIGATION = """        IncludeLaunchDescription(PathJoinSubstitution([
            FindPackageShare('nav2_bringup'), 'launch', 'navigation_launch.py'])),"""
_COMMANDED = """        ExecuteProcess(
            cmd=['ros2', 'launch', 'slam_toolbox', 'online_async_launch.py']),"""
_HAND = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find acme_hand)/hand.xacro"/>@
</robot>
"""
_OLD = """<robot name="arm">
  <link name="base_link">
    <visual><geometry><mesh filename="package://acme_hand/hand.stl"/></geometry></visual>
  </link>
</robot>
"""
_OPTIONAL = """try:
    from cv_bridge import CvBridge
except ImportError:
    CvBridge = None
"""

_DRIVEN = """<robot name="arm">
  <ros2_control name="arm" type="system">
    <hardware><plugin>acme_driver/Arm</plugin></hardware>{}
  </ros2_control>
</robot>
"""
_DRIVER = {
    "../acme_driver/package.xml": "<package><name>acme_driver</name></package>",
    "../acme_driver/driver.xml": """<library path="acme_driver">
  <class name="acme_driver/Arm" base_class_type="hardware_interface::SystemInterface"/>
</library>
""",
}
_CONTROL = """controller_manager:
  ros__parameters:
    arm_controller:
      type: joint_trajectory_controller/JointTrajectoryController
"""
_BUILD = """project(acme_arm_bringup)
find_package(ament_cmake REQUIRED)
find_package(Eigen3 REQUIRED)
find_package({} REQUIRED)
find_package(rviz2 QUIET)
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
endif()
install(DIRECTORY launch DESTINATION share/${{PROJECT_NAME}})
ament_package()
"""
GOOD = [
    {"@ros2": _TELEOP, "package.xml": _arm("desktop")},
    {"@ros2": _MAPPING, "package.xml": _arm("rtabmap_ros")},
    {"@ros2": _COMMANDED, "package.xml": _arm("slam_toolbox")},
    {
        "@ros2": "        Node(package='gazebo_ros', executable='spawn_entity.py'),",
        "package.xml": _arm("ros_gz"),
        "@profile": "ros2",
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz", "rclcpp"),
        "CMakeLists.txt": _BUILD.format("rclcpp"),
    },
    {"@ros2": _BRIDGE, "package.xml": _arm("ros_gz_bridge", "ros_gz_sim")},
    {"@ros2": _BRIDGE, "package.xml": _arm("ros_gz")},
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz", "rclpy"),
        "acme_arm_bringup/log.py": "from rcl_interfaces.msg import Log\n",
    },
    {
        "@name": "ros_gz_bringup",
        "@urdf": True,
        "package.xml": _package("ros_gz_bringup", "ros_gz"),
        "../ros_gz_application/package.xml": _package("ros_gz_application"),
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz"),
        "config/arm.yaml": _CONTROL,
        "../acme_arm_control/package.xml": _arm("ros2_controllers").replace("_bringup", "_control"),
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz"),
        "urdf/arm.xacro": _DRIVEN.format(""),
        **_DRIVER,
        "../acme_arm_control/package.xml": _package("acme_arm_control", "acme_driver"),
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz"),
        "config/arm.yaml": _CONTROL,
        "urdf/arm.xacro": "<robot name='arm'><!-- $(find a)/config/arm.yaml --></robot>",
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz"),
        "docs/old.launch": '<launch><node pkg="nodelet" type="t" name="n"/></launch>',
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz", "image_geometry"),
        "acme_arm_bringup/look.py": f"import image_geometry\n{_OPTIONAL}",
    },
    {
        "launch/vehicle_topics.launch": _launch("x1_sensor_config_6"),
        "package.xml": _manifest("<exec_depend>x1_sensor_config_6</exec_depend>"),
    },
    {"launch/vehicle_topics.launch": "<launch><!-- $(find x1_sensor_config_6) --></launch>"},
    {
        "@ros2": True,
        "package.xml": _arm("robot_state_publisher", "xacro"),
        "../acme_hand/package.xml": "<package><name>acme_hand</name></package>",
        "urdf/old.urdf": _OLD,
    },
    _depends_on_plugin(),
    {
        **_depends_on_plugin(),
        "../acme_rover_gazebo_plugin_1/package.xml": _PLUGIN,
        "../acme_rover_gazebo_plugins_1/package.xml": _PLUGIN,
    },
    {**_depends_on_plugin(), "../acme_crawler_gazebo_plugin_1/package.xml": _PLUGIN},
]
BAD = [
    {"@ros2": _NAVIGATION, "package.xml": _arm("navigation2", mark="  <!-- ^ PKG007 -->")},
    {"@ros2": _TELEOP, "package.xml": _arm("ros_base", mark="  <!-- ^ PKG007 -->")},
    {"@ros2": _COMMANDED, "package.xml": _arm("ros_gz_sim", mark="  <!-- ^ PKG007 -->")},
    {"@ros2": _BRIDGE, "package.xml": _arm("ros_gz_bridge", mark="  <!-- ^ PKG007 -->")},
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz", mark="  <!-- ^ PKG007 -->"),
        "acme_arm_bringup/stop.py": "from geometry_msgs.msg import Twist\n",
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz", mark="  <!-- ^ PKG007 -->"),
        "acme_arm_bringup/look.py": "import sensor_msgs_py.point_cloud2 as clouds\n",
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz", mark="  <!-- ^ PKG007 -->"),
        "acme_arm_bringup/stop.py": "import rclpy\nfrom rclpy.node import Node\n",
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz", mark="  <!-- ^ PKG007 -->"),
        "CMakeLists.txt": _BUILD.format("rclcpp"),
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz", mark="  <!-- ^ PKG007 -->"),
        "config/arm.yaml": _CONTROL,
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz"),
        "../acme_hand/package.xml": _package("acme_hand"),
        "acme_arm_bringup/stop.py": "from acme_words.msg import Stop  # ^ PKG007\n",
    },
    # Info: the description brings its dependencies, and those of what it depends on.
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("acme_arm_tools", mark="  <!-- ^ PKG007 -->"),
        "../acme_arm_tools/package.xml": _package("acme_arm_tools", "acme_hand"),
        "../acme_hand/package.xml": _package("acme_hand", "ros_gz_bridge", "ros_gz_sim"),
    },
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz"),
        "../acme_hand/package.xml": "<package><name>acme_hand</name></package>",
        "urdf/arm.urdf.xacro": _HAND.replace("@", "  <!-- ^ PKG007 -->"),
    },
    {
        "launch/vehicle_topics.launch": _launch("x1_sensor_config_6", "  <!-- ^ PKG007 -->"),
        "package.xml": _manifest("<build_depend>x1_sensor_config_6</build_depend>"),
    },
    {
        "@ros2": "        Node(package='bridge_ros_gz', executable='a'),  # ^ PKG007",
        "package.xml": _arm("ros_gz"),
        "@profile": "ros2",
    },
    {"launch/vehicle_topics.launch": _launch("subt_ros"), "@reported": [".:1"]},
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz"),
        "urdf/arm.xacro": _DRIVEN.format("  <!-- ^ PKG007 -->"),
        **_DRIVER,
    },
    # Its own former name.
    {
        "@ros2": _BRIDGE,
        "package.xml": _arm("ros_gz"),
        "urdf/arm.urdf.xacro": _HAND.replace("@", "  <!-- ^ PKG007 -->").replace(
            "acme_hand", "arm_acme_bringup"
        ),
    },
    {
        "launch/a.launch": "<launch/>",
        "launch/b.launch": _launch("rover_description", "  <!-- ^ PKG007 -->"),
    },
    {
        "model.sdf": None,
        "launch/spawner.rb": None,
        "package.xml": '<package format="2"><name>a</name></package>  <!-- ^ PKG007 -->',
    },
    {
        **_depends_on_plugin("  <!-- ^ PKG007 -->"),
        "../acme_rover_ignition_gazebo_plugin_1/package.xml": _PLUGIN,
    },
]
