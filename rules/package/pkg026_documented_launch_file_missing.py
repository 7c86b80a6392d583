"""A command in the README that starts a launch file which is not there.

`ros2 launch` and `roslaunch` end at once: the package has no file of that name, or has another name
by now. Often a package or file was renamed, and the first command that a user tries fails.

Fix: write the command with the names that exist.
Source: ros2launch, `get_share_file_path_from_package`; roslaunch, `resource_exception`.
"""

import posixpath
import re
from collections.abc import Iterator, Sequence

from checker.package.files_above import files_above, own_files
from checker.package.package import Package
from checker.package.released import distributions_with
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.text import SourceText, Span

_README = re.compile(r"\A(?:\.\./)*readme(?:\.(?:md|rst|txt))?\Z")
_COMMAND = re.compile(
    r"\b(?:ros2[ \t]+launch|roslaunch)[ \t]+([a-z]\w{1,100})[ \t]+"
    r"([\w./-]{1,200}\.(?:py|xml|ya?ml|launch))\b"
)


@rule("PKG026", "documented-launch-file-missing", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report commands whose package lacks the file, or whose file is in a package of another name.

    A README above several packages is judged for the package that has the name or the file.
    """
    if not package.exists("package.xml"):
        return
    every = [package, *package.workspace.packages.values()]
    for source in own_files(package, _README):
        yield from _judged(source, every)
    for sources in files_above(package, _README):
        for source in sources:
            yield from _judged(source, [package])


def _judged(source: SourceText, packages: Sequence[Package]) -> Iterator[Finding]:
    for command in _COMMAND.finditer(source.text):
        name, file = (Span(source, *command.span(group)) for group in (1, 2))
        named = [it for it in packages if it.declared_name == name.text]
        holders = [it.declared_name for it in packages if _has(it, file.text)]
        if named and not _has(named[0], file.text):
            yield finding(
                file, f"the command fails: {name.text} has no file {file.text}", key=file.text
            )
        elif holders and not named and not _may_exist(packages[0], name.text):
            yield finding(
                name,
                f"the command fails: there is no package {name.text}; {file.text} is in "
                f"{holders[0]}",
                key=f"{name.text} {file.text}",
                fix=replace_text(name, holders[0], Safety.UNSAFE),
            )


def _has(package: Package, path: str) -> bool:
    """Return whether a package has a file of this name, or the template that CMake makes it of."""
    name = posixpath.basename(path)
    names = {posixpath.basename(file.path) for file in package.index.files}
    return name in names or f"{name}.in" in names


def _may_exist(package: Package, name: str) -> bool:
    found = package.workspace.package(name)  # by its name, or that of its folder
    is_named = found is not None and found.declared_name == name
    return is_named or bool(distributions_with(name))


def _readme(command: str) -> dict[str, object]:
    return {"@ros2": True, "README.md": f"# Arm\n\n```\n{command}\n```\n"}


_MARK = "  <!-- ^ PKG026 -->"
GOOD = [
    _readme("ros2 launch acme_arm_bringup arm.launch.py use_sim:=true"),
    _readme("ros2 launch nav2_bringup navigation_launch.py"),
    _readme("ros2 launch acme_arm_moveit_config move_group.launch.py"),
    {**_readme("ros2 launch acme_arm_bringup sim.launch.py"), "launch/sim.launch.py.in": ""},
]
BAD = [
    _readme(f"ros2 launch acme_arm_bringup robot.launch.py{_MARK}"),
    _readme(f"ros2 launch acme_arm arm.launch.py{_MARK}"),
]
