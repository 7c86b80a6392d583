"""A launch file names a file that its package does not have.

An included file is not started; a node that gets the path ends, or runs without its parameters. The
name of an included file is written in full, `robot.launch.py` and not `robot`. The parts of a list,
as in `[share, 'worlds/a.world']`, are joined without a `/`. Worlds and parameters in packages that
are not available are not checked, nor is what a setup.py that computes its `data_files` may
install, or a CMakeLists.txt from outside of its package; files that the build generates are not
checked, nor those that a node writes by the name of its parameter: `output_file`. Launch skips a
parameter file whose path is empty.
MoveItConfigsBuilder stops without the SRDF, kinematics.yaml and joint_limits.yaml. Where a
condition leaves the action out, for files that only RViz shows or that `.gitignore` excludes, for
files of a node that has a parameter about saving, and for paths passed to a launch file that is not
available, unless it starts Gazebo, this is a warning. So it is where a README tells users to put
files of their own into that folder: `map_saver_cli -f src/acme_rover/maps/mine`.

A package that no ROS distribution has and package.xml does not declare, and of which every file
that is used is in this package, is taken as the former name of this package, unless a README tells
to clone several repositories.

Fix: correct the path, or add the file.
Source: launch, `PythonLaunchDescriptionSource`: a file that does not exist raises an error;
moveit_configs_utils, `MoveItConfigsBuilder`; ROS 2 issues ros2/ros2#1401, HarvestX/MG400_ROS2#200.
"""

import posixpath
from collections.abc import Iterator

from checker.finding import Fix
from checker.launch.ros2.graph import LaunchGraph, Ros2Launch, SharePath
from checker.launch.ros2.named_paths import (
    NamedPath,
    is_missing,
    lies_elsewhere,
    may_be_installed,
    named_paths,
    unavailable,
    without_slash,
)
from checker.launch.ros2.used_packages import every_use
from checker.package.dependencies import former_names
from checker.package.git_ignored import ignored_by
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.package.user_files import put_there_by
from checker.rule import (
    Concern,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)

_DATA = (".yaml", ".yml", ".world", ".sdf")


@rule("LCH001", "launch-references-missing-file", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package, paperwork: Paperwork) -> Findings:
    """Report files in share folders of available packages that are not there.

    What one node needs is as severe where another names it that does not start by default.
    """
    graphs = [(graph, [*named_paths(graph)]) for graph in launch.entries]
    needed = {str(named.path) for _, paths in graphs for named in paths if named.needed}
    former = paperwork.undeclared(former_names(package, every_use(package, launch)))
    for graph, paths in graphs:
        for named in paths:
            if named.path.package in former:
                yield _misnamed(package, named)
                continue
            if (meant := without_slash(package, named.path)) is not None:
                yield _joined(named, meant)
                continue
            is_data = named.needed and named.path.path.endswith(_DATA)
            if is_data and (why := unavailable(package, named.path)):
                yield unchecked(f"{named.path} is not read: {why}")
            elif not is_missing(package, named.path):
                continue
            elif why := may_be_installed(package, named.path):
                yield unchecked(f"{named.path} may be installed: {why}")
            else:
                what = "the included file" if named.include else "the file"
                found = lies_elsewhere(package, named.path)
                hint = f": {found} is not installed there" if found else _others(package, named)
                ignored = ignored_by(package, named.path.path)
                kept_out = f": {ignored} keeps it out of the repository" if ignored else ""
                readme = put_there_by(package, named.path.package, named.path.path)
                own = f"; {readme} tells users to put such a file there" if readme else ""
                yield finding(
                    named,
                    f"{what} {named.path} does not exist{hint or kept_out or own}",
                    severity=None
                    if str(named.path) in needed and not ignored and not readme
                    else Severity.WARNING,
                    fix=None if found or ignored else _renamed(package, named),
                )
        yield from _empty_paths(graph)


def _misnamed(package: Package, named: NamedPath) -> Finding:
    former, name = named.path.package, package.declared_name
    return finding(
        named,
        f"the launch stops: there is no package {former!r}, and this package has "
        f"{named.path.path}: write {name}",
        severity=None if named.needed else Severity.WARNING,
        key=former,
    )


def _joined(named: NamedPath, meant: SharePath) -> Finding:
    """Return the finding about parts of a path that are joined without a `/`."""
    return finding(
        named,
        f"the file {named.path} does not exist: launch joins the parts of a list without '/'; "
        f"write '/' before the second part for {meant}",
        severity=None if named.needed else Severity.WARNING,
    )


def _others(package: Package, named: NamedPath) -> str:
    """Return the end of a message with the file that may be meant."""
    meant = _meant(package, named)
    folder = posixpath.dirname(named.path.path) or "the package"
    return f"; {folder} has {meant}" if meant else ""


def _renamed(package: Package, named: NamedPath) -> Fix | None:
    """Return the fix that names the file that is meant, where only its ending differs."""
    meant, name = _meant(package, named), posixpath.basename(named.path.path)
    text = named.span.text
    if meant.partition(".")[0] != name.partition(".")[0] or text.count(name) != 1:
        return None
    return replace_text(named, text.replace(name, meant), Safety.UNSAFE)


def _meant(package: Package, named: NamedPath) -> str:
    """Return the name of the file that may be meant, else an empty text.

    It is the only one of that kind in the folder, or the only one whose name differs by its first
    word, as where a package is renamed: `rover_base.xacro` and `robot_base.xacro`.
    """
    folder, suffix = posixpath.dirname(named.path.path), posixpath.splitext(named.path.path)[1]
    holder = package.named(named.path.package)
    files = holder.index.with_suffix(suffix) if holder is not None else ()
    places = (posixpath.split(file.path) for file in files)
    there = [name for around, name in places if around == folder]
    words = posixpath.basename(named.path.path).partition("_")[2]
    if len(there) > 1 and words:
        there = [name for name in there if name.partition("_")[2] == words]
    return there[0] if len(there) == 1 else ""


def _empty_paths(graph: LaunchGraph) -> Iterator[Finding]:
    """Report parameter files whose path is empty."""
    for node in graph.nodes:
        empty = [file for file in node.parameter_files if not file.path.strip()]
        if empty and node.starts is True:
            yield finding(
                empty[0],
                f"{node.executable.value} runs without its parameters: the path of its parameter "
                "file is '', expected a file",
                severity=Severity.WARNING,
                key=node.executable.value,
            )


_STATE = """        Node(package='p', executable='e', parameters=[
            in_package('config', 'arm.yaml')]),"""
_WORLD = """        IncludeLaunchDescription(PathJoinSubstitution([
            FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py']), launch_arguments={
                'gz_args': ['-r ', in_package('worlds', 'hall.sdf')]}.items()),"""

_CLASSIC = """        DeclareLaunchArgument('world', default_value=[
            get_package_share_directory('acme_arm_bringup'), '@/hall.world']),
        IncludeLaunchDescription(PathJoinSubstitution([
            FindPackageShare('gazebo_ros'), 'launch', 'gazebo.launch.py']), launch_arguments={
                'world': LaunchConfiguration('world')}.items()),  # ^ LCH001"""

_WHEN = """
        Node(package='p', executable='f', condition=IfCondition('false'), parameters=[
            in_package('config', 'arms.yaml')]),  # ^ LCH001"""
_MOVEIT = """from launch import LaunchDescription
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigsBuilder


def generate_launch_description():
    configs = MoveItConfigsBuilder('arm', package_name='acme_arm_bringup').to_moveit_configs()
    return LaunchDescription([Node(package='moveit_ros_move_group', executable='move_group',
                                   parameters=[configs.to_dict()])])
"""

_WRITTEN = """        Node(package='p', executable='e', parameters=[{
            'output.file':
                os.path.join(get_package_share_directory('acme_arm_bringup'), 'maps', 'a.pcd'),
            'rate': 5}]),"""
_SAVED = _WRITTEN.replace("output.file", "map").replace("'a.pcd'),", "'a.pcd'),  # ^ LCH001")

_VIEW = "os.path.join(get_package_share_directory('acme_arm_bringup'), 'rviz', 'view.rviz')"
_IF_THERE = f"""        Node(package='rviz2', executable='rviz2',
             arguments=['-d', {_VIEW}] if os.path.exists({_VIEW}) else []),
        Node(package='rviz2', executable='rviz2', name='second',
             arguments=['-d', {_VIEW}] if os.access({_VIEW}, os.R_OK) else []),
        Node(package='rviz2', executable='rviz2', name='third', arguments=['-d', {_VIEW}],
             condition=IfCondition(str(os.path.isfile({_VIEW})))),"""

_OF_MOVEIT = {
    "config/arm.srdf": '<robot name="arm"/>',
    "config/kinematics.yaml": "{}\n",
    "config/joint_limits.yaml": "{}\n",
}
_FORMER = "os.path.join(get_package_share_directory('acme_arm'), 'config', 'arm.yaml')"
_OF_FORMER_NAME = _STATE.replace("in_package('config', 'arm.yaml')", _FORMER)
GOOD = [
    {"@ros2": True},
    {"@ros2": _WRITTEN},
    {"@ros2": _IF_THERE},
    # MoveIt takes the robot from a topic where its usual file is missing.
    {"@ros2": True, "launch/move_group.launch.py": _MOVEIT, **_OF_MOVEIT},
    {"@ros2": _STATE},
    {
        "@ros2": _WORLD,
        "worlds/hall.sdf": '<sdf version="1.9"><world name="hall"/></sdf>',
        "CMakeLists.txt": """project(acme_arm_bringup)
install(DIRECTORY config launch urdf worlds DESTINATION share/${PROJECT_NAME})
ament_package()
""",
    },
    {"@ros2": _STATE.replace("'config', 'arm.yaml'", "'maps', 'saved'")},
    {
        "@ros2": """        IncludeLaunchDescription(PythonLaunchDescriptionSource(
            os.path.join(get_package_share_directory('nav2_bringup'), 'launch', 'x.launch.py'))),"""
    },
]
_COMPUTED = """from glob import glob
from setuptools import setup

setup(name="acme_arm_bringup", data_files=[
    ("share/acme_arm_bringup/" + path.partition("/")[0], [path]) for path in glob("assets/**/*")])
"""
_NAMED_AS_A_FOLDER = """
        DeclareLaunchArgument('view', default_value=os.path.join(  # ^ LCH001
            FindPackageShare('acme_arm_bringup').find('acme_arm_bringup'), 'rviz/urdf.rviz')),
        Node(package='rviz2', executable='rviz2',
             arguments=['-d', LaunchConfiguration('view')]),"""
BAD = [
    {"@ros2": _CLASSIC.replace("@", "/worlds")},
    {"@ros2": _CLASSIC.replace("@", "worlds"), "worlds/hall.world": "<sdf version='1.6'/>"},
    {"@ros2": _NAMED_AS_A_FOLDER, "urdf/arm.urdf": '<robot name="arm"/>'},
    {
        "@ros2": True,
        "launch/move_group.launch.py": _MOVEIT.replace("_configs()", "_configs()  # ^ LCH001"),
        **_OF_MOVEIT,
        "config/arm.srdf": None,
    },
    {"@ros2": f"{_OF_FORMER_NAME}  # ^ LCH001"},
    {"@ros2": f"{_WORLD}  # ^ LCH001", "CMakeLists.txt": None, "setup.py": _COMPUTED},
    {"@ros2": _SAVED},
    {"@ros2": "        Node(package='p', executable='e', parameters=['']),  # ^ LCH001"},
    {
        "@ros2": """        DeclareLaunchArgument('params', default_value=''),  # ^ LCH001
        Node(package='p', executable='e', parameters=[LaunchConfiguration('params')]),"""
    },
    {"@ros2": f"{_WORLD}  # ^ LCH001"},
    {"@ros2": _STATE.replace("arm.yaml')]),", "arms.yaml')]),  # ^ LCH001")},
    {"@ros2": _STATE.replace("arm.yaml')]),", "arms.yaml')]),  # ^ LCH001") + _WHEN},
    {
        "@ros2": """        IncludeLaunchDescription(PythonLaunchDescriptionSource(
            in_package('launch', 'view.launch.py'))),  # ^ LCH001"""
    },
    {
        "@ros2": """        Node(package='rviz2', executable='rviz2', arguments=[
            '-d', in_package('rviz', 'view.rviz')]),  # ^ LCH001"""
    },
    {
        "@ros2": """        Node(package='p', executable='e', parameters=[{'robot_description':
            Command(['xacro ', in_package('urdf', 'hand.urdf.xacro'), ' a:=1'])}]),  # ^ LCH001"""
    },
    {
        "@ros2": True,
        "launch/view.launch.xml": """<launch>
  <include file="$(find-pkg-share acme_arm_bringup)/launch/arm.launch"/> <!-- ^ LCH001 -->
</launch>
""",
    },
]
