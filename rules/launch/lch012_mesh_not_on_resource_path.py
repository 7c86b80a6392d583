"""Gazebo does not find the meshes of a robot that a launch file spawns.

RViz finds `package://arm_description/meshes/link.dae` by the index of packages. Gazebo makes
`model://arm_description/meshes/link.dae` of it and looks below the folders of its resource path:
unless the folder above `share/arm_description` is one of them, the part is visible in RViz,
missing in Gazebo, and a collision of that shape touches nothing. It is an error if all wheels of
the robot have no other collision: it does not stand on them and does not drive.

It is reported of a launch file that starts Gazebo itself and was read in full, for packages that
are available, when no environment hook, no package.xml and no launch file there puts that folder on
the path, and no document or script names the path at all.

In Gazebo Classic the path is `GAZEBO_MODEL_PATH`. There, an `<export>` that puts the share folder
of its own package on the path is an error.

Fix: write `<gazebo_ros gazebo_model_path="${prefix}/.."/>` into `<export>` of the package.xml of
the package with the meshes: `gz_sim.launch.py`, and `gzserver.launch.py` of Gazebo Classic, read
it, and `${prefix}` is its share folder. A hook with the line
`prepend-non-duplicate;GZ_SIM_RESOURCE_PATH;share` works for `gz sim` too.
Source: libsdformat, parser_urdf.cc; gz-sim, resource paths; ros_gz_sim, gz_sim.launch.py; ros_gz
issue 132; gz-sim issue 1959, "geometry element of collision […] couldn't be created"; ros_gz issue
684 for a path that ends one level too deep.
"""

import re
from collections.abc import Container, Iterator

from checker.finding import Fix
from checker.formats.xacro.expanded import ExpandedText
from checker.model.robot import Robot
from checker.package.package import Package
from checker.ros.resource_path import resource_path
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Safety, Severity, finding, rule
from checker.source.xml import XmlDocument
from checker.source.xml_insertion import append_to

_LINE = '<gazebo_ros gazebo_model_path="${prefix}/.."/>'
_EXPORT = f"{_LINE} in <export> of the package.xml of"
_HOOK = "an environment hook with prepend-non-duplicate;{};share in"
_PATH, _CLASSIC_PATH = "GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH"
_NAMED = re.compile(r"(?:package|model)://([^/]+)/.")


@rule("LCH012", "mesh-not-on-resource-path", Severity.WARNING, Concern.INTERFACE)
def check(simulations: Simulations, package: Package) -> Findings:
    """Report each package once whose meshes are not on the resource path."""
    for simulation in simulations.launched:
        classic = bool(simulation.classic_robots)
        if simulation.graph is None or not (simulation.starts_gazebo or classic):
            continue
        path = resource_path(package, simulation.graph, classic=classic)
        if path.holds_packages:
            continue
        for spawned in simulation.classic_robots or simulation.robots:
            missing = _packages(package, spawned.robot)
            stands = not _rolls_on(spawned.robot, missing)
            for name, uri in missing.items():
                deep = path.inside(name)
                reason = (
                    f"share/{name} is on the resource path, and not the folder above it"
                    if deep is not None
                    else f"nothing puts the folder above share/{name} on the resource path"
                )
                hook = _HOOK.format(_CLASSIC_PATH if classic else _PATH)
                yield finding(
                    deep or spawned.node,
                    f"{uri} is visible in RViz and missing in Gazebo"
                    f"{'' if stands else ', where the wheels touch nothing'}: {reason}; expected "
                    f"{_EXPORT if simulation.reads_exports else hook} {name}",
                    severity=Severity.ERROR if (classic and deep) or not stands else None,
                    key=name,
                    fix=_fix(package, name) if simulation.reads_exports else None,
                )


def _rolls_on(robot: Robot, packages: Container[str]) -> bool:
    """Return whether all that the wheels of a robot touch are meshes of these packages."""
    moved = robot.locomotion
    wheels = [
        [shape.geometry.uri for link in wheel.body for shape in link.collisions]
        for wheel in (*moved.wheels, *moved.undriven)
    ]
    return bool(wheels) and all(
        uris and all(uri is not None and _holder_of(uri.value) in packages for uri in uris)
        for uris in wheels
    )


def _holder_of(uri: str) -> str:
    named = _NAMED.match(uri)
    return named[1] if named is not None else ""


def _fix(package: Package, name: str) -> Fix | None:
    """Return what adds the line to the checked package's own manifest."""
    manifest = package.xml("package.xml") if package.named(name) is package else None
    export = manifest.root.child("export") if isinstance(manifest, XmlDocument) else None
    if export is None or any(child.tag == "gazebo_ros" for child in export.children):
        return None
    return Fix(Safety.UNSAFE, (append_to(export, [_LINE]),))


def _packages(package: Package, robot: Robot) -> dict[str, str]:
    """Return the first mesh that is named by its package, of each available package."""
    return dict(reversed([*_mesh_packages(package, robot)]))


def _mesh_packages(package: Package, robot: Robot) -> Iterator[tuple[str, str]]:
    for shape in robot.shapes():
        uri = shape.geometry.uri
        named = _NAMED.match(uri.value) if uri is not None else None
        if uri is None or named is None:
            continue
        holder, source = package.named(named[1]), uri.span.source
        by_path = isinstance(source, ExpandedText) and source.states_path(uri.value)
        if holder is not None and holder.exists("package.xml") and not by_path:
            yield named[1], uri.value


_CREATE = 'Node(package="ros_gz_sim", executable="create",'
_URDF = """<robot name="rover">
  <link name="base_link">
    <visual><geometry>
      <mesh filename="package://acme_rover_bringup/meshes/base.dae"/>
    </geometry></visual>
  </link>
</robot>
"""
_WHEEL = """<link name="{0}_wheel">
  <collision><geometry>
    <mesh filename="package://acme_rover_bringup/meshes/wheel.stl"/>
  </geometry></collision>
</link>
<joint name="{0}_axle" type="continuous">
  <origin xyz="0 {1} 0"/>
  <parent link="base_link"/>
  <child link="{0}_wheel"/>
  <axis xyz="0 1 0"/>
</joint>
"""
_WHEELS = _WHEEL.format("left", 0.2) + _WHEEL.format("right", -0.2)
_ROLLING = _URDF.replace("</robot>", f"{_WHEELS}</robot>")
_FILES = {"@bridge": True, "urdf/rover.urdf": _URDF, "meshes/base.dae": "<COLLADA/>"}
_MANIFEST = """<package format="3">
  <name>acme_rover_bringup</name>
  <version>1.0.0</version>
  <description>A rover in Gazebo</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""
_BUILD = """project(acme_rover_bringup)
find_package(ament_cmake REQUIRED)
install(DIRECTORY config launch meshes urdf DESTINATION share/${PROJECT_NAME})
ament_environment_hooks("${CMAKE_CURRENT_SOURCE_DIR}/hooks/gazebo.dsv.in")
ament_package()
"""


def _launch_example(action: str) -> dict[str, object]:
    begin = "return LaunchDescription([\n"
    imported = "from launch.actions import IncludeLaunchDescription"
    return {
        **_FILES,
        "@launch": {
            begin: f"{begin}        {action},\n",
            imported: f"{imported}, AppendEnvironmentVariable",
        },
    }


def _export_example(path: str, mark: str = "") -> dict[str, object]:
    line = f'    <gazebo_ros gazebo_model_path="{path}"/>{mark}\n'
    return {**_FILES, "package.xml": _MANIFEST.replace("  </export>", f"{line}  </export>")}


def _hook_example(line: str) -> dict[str, object]:
    return {**_FILES, "CMakeLists.txt": _BUILD, "hooks/gazebo.dsv.in": f"{line}\n"}


_APPEND = "AppendEnvironmentVariable('GZ_SIM_RESOURCE_PATH', os.path.join(HERE, '..'))"
_PREPEND = "prepend-non-duplicate;GZ_SIM_RESOURCE_PATH;share"
_MARKED = {_CREATE: f"{_CREATE}  # ^ LCH012"}


def _classic(path: str, mark: str = "") -> dict[str, object]:
    launch = {
        'ros_gz_sim"), "launch", "gz_sim.launch.py': 'gazebo_ros"), "launch", "gazebo.launch.py',
        'Node(package="ros_gz_sim", executable="create"': (
            'Node(package="gazebo_ros", executable="spawn_entity.py"'
        ),
        '"-name", "rover"': '"-entity", "rover"',
    }
    return {**_export_example(path, mark), "@launch": launch, "@profile": "ros2-classic"}


GOOD = [
    {"@bridge": True},
    _classic("${prefix}/.."),
    _export_example("${prefix}/.."),
    _hook_example(_PREPEND),
    _launch_example(_APPEND),
    {**_FILES, "urdf/rover.urdf": _URDF.replace("package://acme_rover", "package://acme_arm")},
    {**_FILES, "README.md": "Set GZ_SIM_RESOURCE_PATH before you launch it.\n"},
    {**_FILES, "@launch": {"IncludeLaunchDescription(gazebo": "IncludeLaunchDescription(URDF"}},
]
BAD = [
    {**_FILES, "urdf/rover.urdf": _ROLLING, "@launch": _MARKED},
    {**_FILES, "@launch": _MARKED},
    _export_example("${prefix}", "  <!-- ^ LCH012 -->"),
    {**_hook_example(f"{_PREPEND}/@PROJECT_NAME@/models"), "@launch": _MARKED},
    _launch_example(_APPEND.replace("os.path.join(HERE, '..'))", "HERE)  # ^ LCH012\n        ")),
    _classic("${prefix}", "  <!-- ^ LCH012 -->"),
]
