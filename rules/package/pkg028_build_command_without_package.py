"""A command of ament in a CMakeLists.txt that finds no package of ament.

CMake stops with "Unknown CMake command", and colcon builds neither the package nor what needs it.

A file that includes others, or that finds a package of which the name begins with `ament`, is not
reported: these may bring the command.

Fix: write `find_package(ament_cmake REQUIRED)` behind `project(…)`.
Source: ament_cmake_core and ament_cmake_target_dependencies, which define these commands.
"""

from checker.package.manifests import Paperwork
from checker.rule import Concern, Findings, Severity, finding, rule

_COMMANDS = ("ament_package", "ament_target_dependencies", "ament_export_dependencies")
_INCLUDING = ("include", "add_subdirectory")


@rule("PKG028", "build-command-without-package", Severity.ERROR, Concern.PAPERWORK)
def check(papers: Paperwork) -> Findings:
    """Report the first command of ament that nothing has defined."""
    build = papers.build
    if build is None or papers.manifest is None or any(build.calls_of(*_INCLUDING)):
        return
    found = [call.arguments[0].value for call in build.find_packages]
    if any(name.startswith(("ament", "rosidl", "$")) or "common" in name for name in found):
        return
    for call in build.calls_of(*_COMMANDS):
        yield finding(
            call.span,
            f"colcon build stops: no find_package brings {call.name}(): write "
            "find_package(ament_cmake REQUIRED)",
        )
        return


def _build(found: str, mark: str = "") -> str:
    return f"""cmake_minimum_required(VERSION 3.8)
project(acme_arm_description)
{found}
install(DIRECTORY urdf DESTINATION share/${{PROJECT_NAME}})
ament_package(){mark}
"""


GOOD = [
    {"@ros2": True, "CMakeLists.txt": _build("find_package(ament_cmake REQUIRED)")},
    {"@ros2": True, "CMakeLists.txt": _build("find_package(nav2_common REQUIRED)")},
]
BAD = [
    {
        "@ros2": True,
        "CMakeLists.txt": _build("# find_package(ament_cmake REQUIRED)", "  # ^ PKG028"),
    },
]
