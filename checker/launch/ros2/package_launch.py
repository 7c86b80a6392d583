"""The ROS 2 launch files of a package."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from checker.base.parts import NotAvailable
from checker.launch.ros2.graph import LaunchFaultKind, LaunchGraph, Ros2Launch
from checker.launch.ros2.package_files import PYTHON_ENTRY
from checker.package.mentions import has_word
from checker.package.package import Package
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

FILES_LIMIT = 150
OTHERS_LIMIT = 20
"""Launch files of other packages that are read for one that they name."""
_YAML = re.compile(r"^launch\s{0,8}:", re.MULTILINE)
_ROS_1 = re.compile(r"""<node\b[^>]{0,1000}\stype\s{0,8}=""")
_ROS_2 = re.compile(r"""\$\((?:find-pkg-share|var)\s|<node\b[^>]{0,1000}\sexec\s{0,8}=""")
_CATKIN = re.compile(r"\bcatkin\b")
_BUILT_BY_AMENT = re.compile(r"\bament_(?:cmake|python)\b|<build_type>\s{0,20}(?:ament_|cmake)")


def ros2_launch(
    package: Package, arguments: Mapping[str, str] | None = None
) -> Ros2Launch | NotAvailable:
    """Read the launch files of a package that no other of its files includes.

    Args:
        package: The package being checked.
        arguments: The arguments of the command line.
    """
    files = [*launch_files(package)]
    if not files:
        return NotAvailable("the package has no ROS 2 launch files", applicable=False)
    unread = []
    if len(files) > FILES_LIMIT:
        unread.append(f"only {FILES_LIMIT} of {len(files)} launch files are read")
    graphs: dict[str, LaunchGraph] = {}
    for file in files[:FILES_LIMIT]:
        graphs[file] = _read(package, file, arguments)
        if any(fault.kind is LaunchFaultKind.LIMIT for fault in graphs[file].faults):
            unread.append(f"{file} and the following files are too large to read")
            break
    return Ros2Launch(tuple(_outermost(graphs)), tuple(unread))


def _outermost(graphs: Mapping[str, LaunchGraph]) -> list[LaunchGraph]:
    """Return the graphs of files that no other one includes; of a circle all."""
    included = {
        include.path
        for file, graph in graphs.items()
        for include in graph.includes
        if include.path != file and not include.commanded
    }
    return [graphs[file] for file in graphs if file not in included] or [*graphs.values()]


def launch_graphs(package: Package) -> list[LaunchGraph]:
    """Return what the launch files of a package start, and those of others that name it."""
    own = ros2_launch(package)
    entries = () if isinstance(own, NotAvailable) else own.entries
    return [*entries, *(graph for _, graph in launches_naming(package))]


def launches_naming(package: Package) -> Iterator[tuple[Package, LaunchGraph]]:
    """Yield the launch files of other available packages that name a package, each with its own.

    So are those that include such a file, in whatever package.

    Args:
        package: The package that should be named, as in `FindPackageShare("arm_description")`.
    """
    others = package.other_packages if built_by_ament(package) and not package.only else ()
    texts = {
        (other, file): source.text
        for other in filter(built_by_ament, others)
        for file in launch_files(other)
        if isinstance(source := other.read(file), SourceText)
    }
    found = [it for it, text in texts.items() if has_word(text, package.declared_name)]
    for holder, included in found:  # which grows
        found += [
            (other, file)
            for (other, file), text in texts.items()
            if posixpath.basename(included) in text
            and (other is holder or has_word(text, holder.declared_name))
            and (other, file) not in found
        ]
    read = found[:OTHERS_LIMIT]
    for holder in dict.fromkeys(other for other, _ in read):
        graphs = {file: _read(holder, file) for other, file in read if other is holder}
        yield from ((holder, graph) for graph in _outermost(graphs))


def launch_files(package: Package) -> Iterator[str]:
    """Yield the launch files of ROS 2, those of packages within left out."""
    if package.only:
        return
    for entry in package.index.files:
        path = entry.path
        lower = path.lower()
        if package.lies_in_unit(path):
            continue
        if lower.endswith(".py") and "launch" in lower:
            if _holds(package, path, PYTHON_ENTRY):
                yield path
        elif lower.endswith(".launch") and _holds(package, path, PYTHON_ENTRY):
            yield path
        elif lower.endswith((".launch.yaml", ".launch.yml", "_launch.yaml", "_launch.yml")):
            if _holds(package, path, _YAML):
                yield path
        elif (
            lower.endswith((".launch", ".xml")) and "launch" in lower and is_ros2_xml(package, path)
        ):
            yield path


def _holds(package: Package, path: str, pattern: re.Pattern[str]) -> bool:
    source = package.read(path)
    return isinstance(source, SourceText) and pattern.search(source.text) is not None


def is_ros2_xml(package: Package, path: str) -> bool:
    """Return whether an XML file is a launch file of ROS 2, not of ROS 1."""
    source = package.read(path)
    if not isinstance(source, SourceText) or "<launch" not in source.text:
        return False
    document = package.xml(path)
    if isinstance(document, XmlDocument) and document.root.tag != "launch":
        return False
    if _ROS_1.search(source.text) or not built_by_ament(package):
        return False
    # A package of both keeps the files of both.
    return not _holds(package, "package.xml", _CATKIN) or _ROS_2.search(source.text) is not None


def is_left_from_ros1(package: Package, folder: str) -> bool:
    """Return whether a folder of a package of ROS 2 has only launch files of ROS 1."""
    files = [it.path for it in package.index.files if it.path.startswith(f"{folder}/")]
    return is_ros2_only(package) and all(
        path.endswith((".launch", ".xml")) and _holds(package, path, _ROS_1) for path in files
    )


def built_by_ament(package: Package) -> bool:
    """Return whether package.xml states that the package is one of ROS 2."""
    return _holds(package, "package.xml", _BUILT_BY_AMENT)


def is_ros2_only(package: Package) -> bool:
    """Return whether package.xml states a package of ROS 2 that ROS 1 cannot build."""
    return built_by_ament(package) and not _holds(package, "package.xml", _CATKIN)


def _read(package: Package, file: str, arguments: Mapping[str, str] | None = None) -> LaunchGraph:
    """Read a launch file; packages without any need not load what evaluates them."""
    from checker.launch.ros2.reader import read_launch

    return read_launch(package, file, arguments)
