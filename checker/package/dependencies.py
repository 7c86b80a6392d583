"""Other packages that a package uses: in its spawner, its launch files and its models."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.finding import Place
from checker.package.files_above import README, files_around
from checker.package.package import Package
from checker.package.references import Reference, ReferenceKind
from checker.package.released import distributions_with
from checker.package.submissions import is_same_robot
from checker.source.cmake import CMakeFile, read_cmake
from checker.source.text import SourceText, Span
from checker.source.xml import Element, XmlDocument

if TYPE_CHECKING:
    from checker.package.package import Package


# Which plugin libraries a package ships or builds, and which packages lend it theirs.


_OUTPUT_NAME = "OUTPUT_NAME"
_CARRIES_NO_PLUGIN = re.compile(
    r"(?:ignition-|gz-|ros_|subt_).*|.*_msgs|catkin|genmsg|message_\w*|nodelet|python.*"
    r"|robot_state_publisher|joint_state_publisher|ros\w*|rviz|std_srvs|tf2?(?:_ros)?|urdf|xacro"
)


class AvailablePackages(Record):
    """The packages whose libraries a package can load.

    Attributes:
        at_hand: The package itself first, then what it depends on, directly or not.
        missing: Names of packages that it depends on and that are not available.
    """

    at_hand: tuple[Package, ...]
    missing: tuple[str, ...]

    @property
    def unknown(self) -> list[str]:
        """Names of missing ones that may contain plugins, unlike tools and messages of ROS."""
        return [name for name in self.missing if not _CARRIES_NO_PLUGIN.fullmatch(name)]

    def libraries(self) -> frozenset[str]:
        """Return the names of all libraries, without `lib` and `.so`."""
        return frozenset(name for package in self.at_hand for name in libraries_of(package))


def available_packages(package: Package) -> AvailablePackages:
    """Follow dependencies and loaded Ruby files through the workspace."""
    at_hand = {package.name: package}
    missing: dict[str, None] = {}
    waiting = [package]
    while waiting:
        for other in _needs(waiting.pop()):
            dependency = package.workspace.package(other.package_name)
            if dependency is None:
                missing[other.package_name] = None
            elif dependency.name not in at_hand:
                at_hand[dependency.name] = dependency
                waiting.append(dependency)
    return AvailablePackages(tuple(at_hand.values()), tuple(missing))


def _needs(package: Package) -> Iterator[Reference]:
    yield from (
        reference
        for reference in package.references
        if reference.kind is not ReferenceKind.ROSLAUNCH
    )
    if package.base is not None:
        yield package.base


def libraries_of(package: Package) -> Iterator[str]:
    """Yield the libraries that a package ships or that its CMake files build."""
    for file in package.index.with_suffix(".so"):
        yield file.path.rsplit("/", 1)[-1].removeprefix("lib")[: -len(".so")]
    for file in package.index.with_suffix("cmakelists.txt"):
        source = package.read(file.path)
        if isinstance(source, SourceText):
            yield from _built(read_cmake(source))


def _built(build: CMakeFile) -> Iterator[str]:
    """Yield the names of targets, and those that properties give to their files."""
    for library in build.libraries:
        yield library.name.value
    for call in build.calls_of("set_target_properties"):
        words = [word.value for word in call.arguments]
        if _OUTPUT_NAME in words[:-1]:
            yield words[words.index(_OUTPUT_NAME) + 1]


_PATH = r"(?:/{1,4}([\w./-]{1,300})(?![\w./$%{-]))?"
"""A path behind a package, where all of it is written."""
_FIND = re.compile(r"(\$\(find\s{1,8}([A-Za-z][\w-]{0,199})\s{0,8}\))" + _PATH)
_MODEL = re.compile(r"((?:model|package)://([a-z][a-z0-9_]{0,199}_sensor_config_\d{1,4})/)")
"""Submissions alone: other models, and those on Fuel in upper case, come from elsewhere."""


class Use(Record):
    """One place at which a package is used.

    Attributes:
        how: The text that uses it.
        path: The path of the file in it that is used; empty if that is not written.
        builds: Whether the build uses it.
    """

    package_name: str
    place: Place
    how: str
    path: str = ""
    builds: bool = False


def uses_of(package: Package, *, of_ros_1: bool = True) -> Iterator[Use]:
    """Yield the packages that the spawner, launch files and the model name; comments do not count.

    Launch files that are not well-formed are left out.

    Args:
        package: The package that uses them.
        of_ros_1: Whether its files `*.launch` are of ROS 1, so that they count.
    """
    for reference in package.references:
        if reference.kind is not ReferenceKind.DEPENDENCY and not reference.by_sibling:
            how = f"{reference.kind} {reference.package_name} {reference.file}".strip()
            yield Use(reference.package_name, reference.place, how)
    for file in package.index.with_suffix(*((".launch",) if of_ros_1 else ()), ".sdf"):
        document = package.xml(file.path)
        if isinstance(document, XmlDocument):
            is_launch = file.path.lower().endswith(".launch")
            for element in document.elements:
                yield from _in_launch_file(element) if is_launch else _in_model(element)


def _in_launch_file(element: Element) -> Iterator[Use]:
    for name, value in element.attributes.items():
        for match in _FIND.finditer(value):
            yield Use(match[2], _place(element, name, match), match[1], match[3] or "")
        if name == "pkg" and element.tag in ("node", "test") and "$" not in value:
            yield Use(value, _place(element, name), f"pkg={value}")
    for match in _FIND.finditer(element.value):
        yield Use(match[2], element.text.span.place(), match[1], match[3] or "")


def _place(element: Element, attribute: str, match: re.Match[str] | None = None) -> Place:
    """Return the place of an attribute's value, or of the part that a pattern matched in it."""
    span = (element.attribute(attribute) or element).span
    if match is not None and span.text == match.string:
        first, last = (span.start + at for at in match.span())
        span = Span(span.source, first, last, span.holder)
    return span.place()


def _in_model(element: Element) -> Iterator[Use]:
    if element.tag == "uri" and (match := _MODEL.match(element.value)):
        yield Use(match[2], element.text.span.place(), match[1])


_SHARED = re.compile(
    r"(?:\$\(find\s{1,8}([A-Za-z][\w-]{0,199})\s{0,8}\)|package://([\w-]{1,200}))" + _PATH
)
_MESSAGES = re.compile(r"^[ \t]{0,40}from[ \t]{1,8}([a-z]\w{0,199})\.(?:msg|srv|action)[ \t]", re.M)
_MODULES = re.compile(
    r"^(?:from|import)[ \t]{1,8}"
    r"(cv_bridge|image_geometry|message_filters|rclpy|sensor_msgs_py|tf_transformations)\b",
    re.M,
)
"""Packages of ROS whose module in Python has the package's name; an indented import is optional."""


def uses_in_ros2(package: Package) -> Iterator[Use]:
    """Yield the packages that descriptions of robots and nodes in Python name.

    Launch files are evaluated, see `used_packages`.
    """
    for file in package.index.with_suffix(".urdf", ".xacro"):
        document = package.xml(file.path)
        for element in document.elements if isinstance(document, XmlDocument) else ():
            for name, value in element.attributes.items():
                for match in _SHARED.finditer(value):
                    place = _place(element, name, match)
                    yield Use(match[1] or match[2], place, match[0], match[3] or "")
    for file in package.index.with_suffix(".py"):
        source = package.read(file.path)
        if isinstance(source, SourceText):
            found = (*_MESSAGES.finditer(source.text), *_MODULES.finditer(source.text))
            for match in found:
                if not package.exists(match[1]):
                    yield Use(match[1], Span(source, *match.span(1)).place(), match[0].strip())


def uses_in_build(package: Package) -> Iterator[Use]:
    """Yield the packages of ROS, and of the workspace, that CMakeLists.txt requires."""
    source = package.read("CMakeLists.txt")
    for call in read_cmake(source).find_packages if isinstance(source, SourceText) else ():
        name, *words = (word.value for word in call.arguments)
        is_tool = name.startswith("ament_")
        is_known = distributions_with(name) or package.workspace.package(name) is not None
        if "REQUIRED" in words and is_known and not (is_tool or call.conditional):
            place = call.arguments[0].span.place()
            yield Use(name, place, f"find_package({name} REQUIRED)", builds=True)


_CLONED = re.compile(
    r"\bgit\s{1,4}clone\s[^\n]{0,200}?([\w.-]{1,100}?)(?:\.git)?[\s`]{0,4}$", re.MULTILINE
)
"""The name of a repository at the end of a command: `git clone https://github.com/acme/arm.git`."""


def former_names(package: Package, uses: Iterable[Use]) -> frozenset[str]:
    """Return names of packages that exist nowhere, and all of whose files this package has.

    It was renamed, and still uses its own files by the name that it had. None where a README tells
    to clone several repositories: one of these may have the package, and copies of the files.

    Args:
        package: The package that uses them.
        uses: What it uses.
    """
    cloned = {it for readme in files_around(package, README) for it in _CLONED.findall(readme.text)}
    if len(cloned) > 1:
        return frozenset()
    own: dict[str, bool] = {}
    for use in uses:
        name = use.package_name
        if use.path and package.workspace.package(name) is None:
            own[name] = own.get(name, True) and package.exists(use.path)
    return frozenset(name for name, every in own.items() if every and not distributions_with(name))


# What a package takes from another robot's package although it has the file itself.


_TAKEN = re.compile(
    r"(?:\$\(find\s{1,8}(?P<found>\w{1,200}_sensor_config_\d{1,4})\s{0,8}\)"
    r"|package://(?P<named>\w{1,200}_sensor_config_\d{1,4}))/{1,4}(?P<path>[\w./-]{1,300})(?![\w./$%{-])"
)


def duplicate_files(package: Package) -> Iterator[Use]:
    """Yield the files of other robots' packages that this package has under the same path.

    Launch files and robot descriptions are searched. A file that a package's own file of that path
    takes from elsewhere builds on it; and what package.xml declares of the same team is meant.
    """
    for file in package.index.with_suffix(".launch", ".urdf", ".xacro", ".sdf"):
        source = package.read(file.path)
        if not isinstance(source, SourceText) or "_sensor_config_" not in source.text:
            continue
        document = package.xml(file.path)
        for element in document.elements if isinstance(document, XmlDocument) else ():
            for text in (*element.attributes.values(), element.value):
                for match in _TAKEN.finditer(text):
                    name, path = match["found"] or match["named"], match["path"]
                    own = package.index.find(path) if path != file.path else None
                    if own is not None and own.is_file and _is_foreign(package, name):
                        yield Use(name, _place_of(element, text), match.group())


def _place_of(element: Element, text: str) -> Place:
    """Return the place of the attribute that contains a text, else that of the element's text."""
    names = (name for name, value in element.attributes.items() if value == text)
    name = next(names, None)
    return element.text.span.place() if name is None else _place(element, name)


def _is_foreign(package: Package, name: str) -> bool:
    """Return whether a package is of another robot, and not used on purpose."""
    if is_same_robot(name, package.name) or (package.base and package.base.package_name == name):
        return False
    same_team = name.casefold().split("_")[0] == package.name.casefold().split("_")[0]
    return not same_team or not any(
        reference.package_name == name and reference.kind is ReferenceKind.DEPENDENCY
        for reference in package.references
    )
