"""A command in the README that starts a launch file or a program which is not there.

`ros2 launch`, `roslaunch` and `ros2 run` end at once: the package has no such file, its build
installs no such program, or the package has another name by now. Often something was renamed, and
the first command that a user tries fails.

A launch file of a package that exists nowhere is reported of a README above several packages that
names the package only in such commands, where nothing else of the repository brings or uses it:
neither a submodule, a `.repos` file, a script or a container, nor another package. What stands in
an HTML comment is not shown, and does not count.

Fix: write the command with the names that exist; or write where the package comes from.
Source: ros2launch, `get_share_file_path_from_package`; roslaunch, `resource_exception`.
"""

import posixpath
import re
from collections import Counter
from collections.abc import Iterator, Sequence

from checker.package.files_above import README, files_above, own_files
from checker.package.installed_from_outside import is_from_outside, may_be_from_outside
from checker.package.nowhere import is_nowhere
from checker.package.package import Package
from checker.package.programs import why_no_program
from checker.package.released import distributions_with
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
from checker.source.text import SourceText, Span

_COMMAND = re.compile(
    r"\b(?:ros2[ \t]+launch|roslaunch)[ \t]+([a-z]\w{1,100})[ \t]+"
    r"([\w./-]{1,200}\.(?:py|xml|ya?ml|launch))\b"
)

_WORD = re.compile(r"[\w-]+")
_RUN = re.compile(r"\bros2[ \t]+run[ \t]+([a-z]\w{1,100})[ \t]+([\w.-]{1,100})")


@rule("PKG026", "documented-command-fails", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report commands whose package lacks the file, or whose file is in a package of another name.

    A README above several packages is judged for the package that has the name or the file.
    """
    if not package.exists("package.xml"):
        return
    every = (package, *package.other_packages)
    for source in own_files(package, README):
        yield from _launches(source, every)
        yield from _runs(source, every)
    for sources in files_above(package, README):
        for source in sources:
            yield from _launches(source, [package])
            yield from _runs(source, [package])
            if every[1:] and package.root == min(it.root for it in every):
                yield from _of_no_package(source, every)


def _launches(source: SourceText, packages: Sequence[Package]) -> Findings:
    for command in _COMMAND.finditer(source.text):
        name, file = (Span(source, *command.span(group)) for group in (1, 2))
        named = [it for it in packages if it.declared_name == name.text]
        of_folder = packages[0].workspace.package(name.text)  # where no package has the name
        likely = packages if of_folder is None else [it for it in packages if it is of_folder]
        holders = [it.declared_name for it in likely if _has(it, file.text)]
        lacks = bool(named) and not _has(named[0], file.text)
        if lacks and (why := may_be_from_outside(named[0], f"launch/{file.text}")):
            yield unchecked(f"{file.text} may be installed: {why}")
        elif lacks:
            yield finding(
                file, f"the command fails: {name.text} has no file {file.text}", key=file.text
            )
        elif holders and name.text not in holders and not distributions_with(name.text):
            yield finding(
                name,
                f"the command fails: there is no package {name.text}; {file.text} is in "
                f"{holders[0]}",
                key=f"{name.text} {file.text}",
                fix=replace_text(name, holders[0], Safety.UNSAFE),
            )


def _of_no_package(source: SourceText, packages: Sequence[Package]) -> Iterator[Finding]:
    """Report commands of packages that exist nowhere; judged once, for the first package."""
    commands = [*_COMMAND.finditer(source.text)]
    told = Counter(_WORD.findall(source.text))
    told -= Counter(word for it in commands for word in _WORD.findall(it.group()))
    for command in commands:
        name, file = command.groups()
        if (
            told[name]
            or any(_has(it, file) for it in packages)
            or not is_nowhere(packages[0], name)
        ):
            continue
        yield finding(
            Span(source, *command.span(1)),
            f"the command fails: this repository has no package {name}, and ROS has none: write "
            "where it comes from, or correct the name",
            key=name,
        )


def _runs(source: SourceText, packages: Sequence[Package]) -> Iterator[Finding]:
    for command in _RUN.finditer(source.text):
        name, program = (Span(source, *command.span(group)) for group in (1, 2))
        named = [it for it in packages if it.declared_name == name.text]
        missing = why_no_program(named[0], program.text) if named else ""
        if missing:
            yield finding(
                program,
                f"the command fails: {name.text} has no program {program.text!r}: {missing}",
                key=program.text,
            )


def _has(package: Package, path: str) -> bool:
    """Return whether a package has a file of this name, or the template that CMake makes it of."""
    name = posixpath.basename(path)
    names = (name, f"{name}.in")
    own = any(posixpath.basename(file.path) in names for file in package.index.files)
    return own or is_from_outside(package, f"launch/{name}")


def _readme(command: str) -> dict[str, object]:
    return {"@ros2": True, "README.md": f"# Arm\n\n```\n{command}\n```\n"}


def _above(name: str, more: str = "") -> dict[str, object]:
    """Return a README above two packages."""
    return {
        "@ros2": True,
        "../acme_tools/package.xml": "<package><name>acme_tools</name></package>",
        "../acme_tools/launch/tools.launch.py": "",
        "../README.md": f"Run `ros2 launch {name} sim.launch.py`. {more}\n",
    }


_FENCED = "```\nros2 launch acme_arm_bringup robot.launch.py\n```\n"
_MARK = "  <!-- ^ PKG026 -->"
GOOD = [
    _above("acme_sim", "The package acme_sim is that of our other repository."),
    {**_above("acme_sim"), "../acme.repos": "repositories: {}\n"},
    {**_above("acme_tools"), "../acme_tools/launch/sim.launch.py": ""},
    _above("nav2_bringup"),
    _readme("ros2 launch acme_arm_bringup arm.launch.py use_sim:=true"),
    _readme("ros2 launch nav2_bringup navigation_launch.py"),
    _readme("ros2 run rviz2 rviz2 -d view.rviz"),
    _readme("ros2 launch acme_arm_moveit_config move_group.launch.py"),
    {**_readme("ros2 launch acme_arm_bringup sim.launch.py"), "launch/sim.launch.py.in": ""},
    {"@ros2": True, "README.md": f"# Arm\n<!--\n{_FENCED}-->\n"},
]
BAD = [
    {**_above("acme_sim"), "@reported": ["../README.md:1"]},
    _readme(f"ros2 launch acme_arm_bringup robot.launch.py{_MARK}"),
    _readme(f"ros2 launch acme_arm arm.launch.py{_MARK}"),
    _readme(f"ros2 run acme_arm_bringup watch{_MARK}"),
    {"@ros2": True, "README.md": f"<!-- Arm -->\n{_FENCED}", "@reported": ["README.md:3"]},
]
