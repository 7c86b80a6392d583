"""A dependency in package.xml that neither the ROS distribution nor rosdep has.

`rosdep install` ends with "Cannot locate rosdep definition", so that users who clone the package
cannot build it. A misspelt name is a warning, and so is one that another package has replaced in
the distribution that the package names, and one that never was a package: `ros2_control_node` is a
program of controller_manager, `ament_python` a build type, and `opencv-python` a name of pip, for
which rosdep has `python3-opencv`. So is a library that the distribution has by another name:
`orocos_kdl` by `orocos_kdl_vendor`. So are names that no distribution has ever had, in a repository
of several packages whose README, lists of repositories, scripts and containers do not name them.
Other names are infos: the package may be built from source that is not available here, for example
if only an older distribution has released it. Of Foxy and
Galactic it is not known what they have released: in packages for these, only names that they are
known not to have are reported. Dependencies with a `condition` are skipped.

Fix: correct the name; or add the source of the package to the workspace, and document that in the
README.
Source: ros/rosdistro, packages of the distributions and keys of rosdep (`ros_packages.json`);
ros2/ros2cli#428 and ros2/ros2_documentation#508, about `ament_python`;
DoosanRobotics/doosan-robot2#188 and autowarefoundation/vision_pilot#370, about Eigen3 and opencv.
"""

from collections.abc import Iterable, Iterator, Mapping

from checker.base.resources import table
from checker.package.distribution_sign import former_name
from checker.package.files_above import README, files_around
from checker.package.manifests import Dependency, Paperwork
from checker.package.mentions import has_word
from checker.package.nowhere import may_be_brought
from checker.package.package import Package
from checker.package.released import (
    ReleasedNames,
    distributions_with,
    is_listed,
    is_of_system,
    slip_of,
)
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rename, rule


@rule("PKG021", "dependency-not-found", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork, context: Context) -> Findings:
    """Report misspelt names one by one, and the others in one finding."""
    if paperwork.manifest is None or not is_listed(context.distro):
        return
    former, beside = former_name(package), package.workspace.packages
    distro = former or context.distro
    absent = [
        dependency
        for dependency in paperwork.manifest.dependencies
        if not dependency.is_conditional and not _is_found(package, dependency, context.distro)
        if not former or _never_had(dependency.package.value, beside)
    ]
    names, seen, others = ReleasedNames(context.distro), set[str](), list[Dependency]()
    for dependency in absent:
        name = dependency.package.value
        if name in seen:
            continue
        seen.add(name)
        if mistaken := table("removed_packages")["no_packages"].get(name):
            declared = paperwork.manifest.depends_on(mistaken.get("instead", ""))
            yield _no_package(dependency, mistaken, declared=declared)
            continue
        meant = slip_of(name, beside) or names.correction_of(name) or names.vendor_of(name)
        if meant is None or distributions_with(name):
            others.append(dependency)
        else:
            yield finding(
                dependency.package,
                f"neither {distro.capitalize()} nor rosdep has {name!r}; did you mean {meant!r}?",
                key=name,
                fix=rename(dependency.package, meant),
            )
    yield from _elsewhere(package, others, context, distro)


def _is_found(package: Package, dependency: Dependency, distro: str) -> bool:
    name = dependency.package.value
    return (
        not name
        or distro in distributions_with(name)
        or is_of_system(name)
        or package.workspace.package(name) is not None
    )


def _never_had(name: str, beside: Iterable[str]) -> bool:
    """Return whether it is known that no distribution before Humble had a package, either."""
    names = table("removed_packages")
    removed = names["names"].get(name, {"before_humble": True})
    is_older = removed.get("before_humble", False)
    return not is_older or name in names["no_packages"] or slip_of(name, beside) is not None


def _no_package(dependency: Dependency, mistaken: Mapping[str, str], *, declared: bool) -> Finding:
    """Report what is mistaken for a package; `declared`: whether the right one is there, too."""
    name, instead = dependency.package.value, mistaken.get("instead", "")
    cure = f"write {instead}" if instead and not declared else "remove this line"
    of = f" of {instead}" if mistaken["is"] == "a program" else ""
    return finding(
        dependency.package,
        f"{name} is no package and no key of rosdep, but {mistaken['is']}{of}, and `rosdep "
        f"install` stops: {cure}",
        key=name,
        fix=rename(dependency.package, instead) if instead and not declared else None,
    )


def _elsewhere(
    package: Package, dependencies: list[Dependency], context: Context, distro: str
) -> Iterator[Finding]:
    if dependencies:
        first, *others = dependencies
        names = ", ".join(map(_package_phrase, dependencies))
        noun = "packages" if others else "package"
        replaced = any(
            _replacement(it) and (context.distro_is_known or not _is_of_ros_2(it.package.value))
            for it in dependencies
        )
        nowhere = bool(package.other_packages) and not any(
            distributions_with(it.package.value) or _is_brought(package, it.package.value)
            for it in dependencies
        )
        yield finding(
            first.package,
            f"ROS 2 {distro.capitalize()} and rosdep have no {noun} {names}: "
            "expected in the workspace",
            severity=Severity.WARNING if replaced or nowhere else Severity.INFO,
            related=[(other.package, "and this") for other in others],
        )


def _is_brought(package: Package, name: str) -> bool:
    """Return whether a file around a package may bring another one, or a README names it."""
    readmes = files_around(package, README)
    return may_be_brought(package, name) or any(has_word(it.text, name) for it in readmes)


def _package_phrase(dependency: Dependency) -> str:
    """Return a name and what is known of it: what took its place, or which distribution has it."""
    name = dependency.package.value
    if instead := _replacement(dependency):
        return f"{name} (replaced by {instead})"
    having = [distro.capitalize() for distro in distributions_with(name)]
    return f"{name} ({having[-1]} has it)" if having else name


def _is_of_ros_2(name: str) -> bool:
    return any(distro != "noetic" for distro in distributions_with(name))


def _replacement(dependency: Dependency) -> str:
    removed = table("removed_packages")["names"].get(dependency.package.value)
    return removed["instead"] if removed is not None else ""


def _package(depends: str) -> dict[str, object]:
    manifest = f"""<package format="3">
  <name>acme_arm_bringup</name>
{depends}
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
    return {"@ros2": True, "package.xml": manifest, "@profile": "ros2"}


_MARK = "  <!-- ^ PKG021 -->"
GOOD = [
    _package("<depend>rclcpp</depend><exec_depend>robot_state_publisher</exec_depend>"),
    _package("<depend>eigen</depend><exec_depend>python3-numpy</exec_depend>"),
    _package('<depend condition="$ROS_VERSION == 1">roscpp</depend>'),
    {**_package("<depend>rclcpp</depend>"), "Dockerfile": "FROM ros:iron\n"},
    {
        **_package("<depend>joint_state_controller</depend><depend>acme_msgs</depend>"),
        "README.md": "Tested with ROS 2 Foxy.\n",
    },
    {
        **_package("<depend>acme_msgs</depend>"),
        "../acme_msgs/package.xml": "<package><name>acme_msgs</name></package>",
    },
]
BAD = [
    _package(f"<exec_depend>forward_position_controller</exec_depend>{_MARK}"),
    _package(f"<exec_depend>robot_state_publsher</exec_depend>{_MARK}"),
    _package(f"<exec_depend>gazebo_ros</exec_depend>{_MARK}"),
    _package(f"<depend>orocos_kdl</depend>{_MARK}"),
    {
        **_package(f"<exec_depend>acme_tolos</exec_depend>{_MARK}"),
        "../acme_tools/package.xml": "<package><name>acme_tools</name></package>",
        "README.md": "Tested with ROS 2 Foxy.\n",
    },
    _package(f"<exec_depend>rviz</exec_depend>{_MARK}"),
    {
        **_package(f"<exec_depend>rviz</exec_depend>{_MARK}"),
        "README.md": "Tested with ROS 2 Galactic.\n",
    },
    _package(f"<exec_depend>ros2_control_node</exec_depend>{_MARK}"),
    _package(f"<buildtool_depend>ament_python</buildtool_depend>{_MARK}"),
    _package(f"<depend>OpenCV</depend>{_MARK}"),
    _package(f"<exec_depend>pyserial</exec_depend>{_MARK}"),
    _package(f"<exec_depend>numpy</exec_depend>{_MARK}"),
    _package(f"<exec_depend>acme_drivers</exec_depend>{_MARK}\n<depend>acme_tools</depend>"),
]
