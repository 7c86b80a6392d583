"""SRDF files, with the robots that they can belong to."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import islice

from checker.base.parts import NotAvailable, part
from checker.base.record import Record
from checker.formats.srdf.names import names_of
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.reader import read_urdf
from checker.formats.xacro.expanded import ExpandedText
from checker.formats.xacro.expansion import Expander, Expansions, Outcome, Wanted
from checker.formats.xacro.files import ROOT, local_path
from checker.launch.ros2.descriptions import loaded_descriptions
from checker.launch.ros2.graph import Ros2Launch
from checker.model.robot import Robot
from checker.package.package import Package
from checker.robots.urdf_files import UrdfFiles
from checker.source.xml import Element, XmlDocument
from checker.source.yaml import read_root

_ASSISTANT = ".setup_assistant"
_SRDF = ".srdf.xacro"
_ROBOTS_LIMIT = 8
_FILES_LIMIT = 400
_SRDF_LIMIT = 20
_NOT_THE_TREE = re.compile(r"<!--.*?-->|<(ros2_control|transmission)\b.*?</\1>", re.DOTALL)
"""What names joints and makes none."""
_COMPUTED = re.compile(r"\$[{(][^{}()]{0,200}[})]")
_ATTRIBUTE = re.compile(r"""\b([\w:]{1,60})\s{0,4}=\s{0,4}["']([^"'<>]{1,200})["']""")


class SemanticDescription(Record, eq=False, dict=True):
    """An SRDF file.

    Attributes:
        file: Its path as the package lists it.
        root: Its `<robot>`.
        robots: The robots that it may describe; none where that is not known.
        is_loaded: Whether a launch file of the workspace names it.
    """

    file: str
    root: Element
    robots: tuple[Robot, ...]
    is_loaded: bool

    @property
    def robot(self) -> str:
        """The name of the robot."""
        return (self.root.get("name") or "").strip()

    @cached_property
    def names(self) -> Mapping[str, frozenset[str]]:
        """The parts that it may name, by kind: `link`, `joint`, `group`."""
        joints = (name for robot in self.robots for name in robot.joints_by_name)
        return {
            "link": frozenset(name for robot in self.robots for name in robot.links_by_name),
            "joint": frozenset((*joints, *names_of(self.root, "virtual_joint"))),
            "group": names_of(self.root, "group"),
        }

    def lacks(self, kind: str, name: str) -> bool:
        """Return whether no robot has a part, whatever arguments xacro is given."""
        if name in self.names[kind]:
            return False
        if kind == "group" or _bare(name) in map(_bare, self.names[kind]):
            return True
        return not any(_may_be(name, parts) for parts in self._computed)

    @cached_property
    def _computed(self) -> list[list[str]]:
        """What is known of the names that the xacro files of the robots may make."""
        texts = (_NOT_THE_TREE.sub("", text) for text in self._written)
        found = {pair for text in texts for pair in _ATTRIBUTE.findall(text)}
        values = {value for attribute, value in found if attribute != "reference"}
        parts = map(_COMPUTED.split, values)
        return [known for known in parts if any(known)]

    @property
    def _written(self) -> Iterator[str]:
        sources = (robot.document.source for robot in self.robots)
        for source in sources:
            if isinstance(source, ExpandedText):
                yield from (written.text for written in source.gathered.sources.values())


def _bare(name: str) -> str:
    """Return a name without what only a slip makes another name."""
    return name.replace("_", "").lower()


def _may_be(name: str, known: list[str]) -> bool:
    """Return whether a name has the known parts of a computed one, in their order."""
    first, *others = known
    if not others:
        return name == first
    *middle, last = others
    if not name.startswith(first):
        return False
    end = len(first)
    for piece in middle:
        if (at := name.find(piece, end)) < 0:
            return False
        end = at + len(piece)
    return name.endswith(last) and end + len(last) <= len(name)


@part
def semantic_descriptions(
    package: Package,
    files: UrdfFiles | NotAvailable,
    launch: Ros2Launch | NotAvailable,
    expander: Expander,
) -> tuple[SemanticDescription, ...] | NotAvailable:
    """Return the SRDF files; those that are xacro as they are without arguments."""
    own = [] if isinstance(files, NotAvailable) else [*files.descriptions, *files.others]
    found = []
    for path, document in _documents(package, expander):
        root = document.root
        name = (root.get("name") or "").strip()
        # A file of macros alone expands to nothing.
        if root.tag == "robot" and root.children:
            same = [it for it in own if it.robot.name.value == name]
            robots = _Robots(package, expander, launch).robots(path, name, same)
            found.append(SemanticDescription(path, root, robots, _is_named(package, path, name)))
    return tuple(found) or NotAvailable("the package has no SRDF", applicable=False)


def _documents(package: Package, expander: Expander) -> Iterator[tuple[str, XmlDocument]]:
    for path in _own(package, ".srdf"):
        if isinstance(document := package.xml(path), XmlDocument):
            yield path, document
    paths = [*islice(_own(package, _SRDF), _SRDF_LIMIT)]
    wanted = [Wanted(path, {}) for path in paths]
    outcomes = Expansions(package, wanted, expander).outcomes() if wanted else ()
    for path, outcome in zip(paths, outcomes, strict=True):
        if isinstance(outcome, XmlDocument) and not _lacks_includes(outcome):
            yield path, outcome


def _own(package: Package, suffix: str) -> Iterator[str]:
    """Yield the files of a kind that are in no package below the package's folder."""
    paths = (entry.path for entry in package.index.with_suffix(suffix))
    return (path for path in paths if not package.lies_in_unit(path))


def _is_named(package: Package, path: str, robot: str) -> bool:
    """Return whether a launch file names a file, or gives MoveIt the name of its robot."""
    file, quoted = path.rpartition("/")[2], (f'"{robot}"', f"'{robot}'")
    return any(
        file in text or ("MoveItConfigsBuilder" in text and any(it in text for it in quoted))
        for text in package.workspace.launch_texts.values()
    )


class _Robots(Record, eq=False):
    """Finds the robots of SRDF files of a package."""

    package: Package
    expander: Expander
    launch: Ros2Launch | NotAvailable

    def robots(self, path: str, name: str, own: list[UrdfDescription]) -> tuple[Robot, ...]:
        """Return the robots that a file may belong to; none if one of them is not known."""
        wanted = [*self._loaded(), *self._assistants(path)]
        namesakes = [*islice(self._named(name), _ROBOTS_LIMIT + 1)]
        if not own and not wanted:
            wanted = namesakes
        unique = list({f"{it.path} {sorted(it.args.items())}": it for it in wanted}.values())
        if len(unique) > _ROBOTS_LIMIT or not name:
            return ()
        read = [*(it.document for it in own), *self._expanded(unique)]
        whole = [it for it in read if isinstance(it, XmlDocument) and _is_whole(it)]
        if len(whole) < len(read):
            return ()
        seen = {*(it.path for it in unique), *(it.document.source.file for it in own)}
        others = self._expanded([it for it in namesakes if it.path not in seen])
        whole += [it for it in others if isinstance(it, XmlDocument) and _is_whole(it)]
        return tuple(map(read_urdf, whole))

    def _expanded(self, wanted: list[Wanted]) -> Sequence[Outcome]:
        """Return what xacro makes of files."""
        return Expansions(self.package, wanted, self.expander).outcomes() if wanted else ()

    def _loaded(self) -> Iterator[Wanted]:
        """Yield the descriptions that the launch files of ROS 2 load."""
        graphs = () if isinstance(self.launch, NotAvailable) else self.launch.entries
        for graph in graphs:
            for each in loaded_descriptions(self.package, graph):
                path = local_path(self.package, each.load.path)
                if path is not None and path.endswith((".urdf", ".xacro")):
                    known = {k: v for k, v in each.load.args.items() if k not in each.unknown}
                    yield Wanted(path, known)

    def _assistants(self, path: str) -> Iterator[Wanted]:
        """Yield the description from which MoveIt's assistant made a file."""
        root = read_root(self.package.read(_ASSISTANT))
        match _lower(root.plain()) if root is not None else None:
            case {
                "moveit_setup_assistant_config": {
                    "srdf": {"relative_path": str(srdf)},
                    "urdf": {"relative_path": str(urdf), **more},
                }
            } if srdf == path:
                package = str(more.get("package") or self.package.root.name)
                local = local_path(self.package, f"{ROOT}/{package}/{urdf}")
                if local is not None and self.package.exists(local):
                    yield Wanted(local, _args(more))

    def _named(self, name: str) -> Iterator[Wanted]:
        """Yield the descriptions in the workspace of a robot with this name."""
        files = (
            (other, file.path)
            for other in self.package.workspace.packages.values()
            for file in other.index.with_suffix(".urdf", ".xacro")
            if not file.path.endswith(_SRDF)
        )
        for other, path in islice(files, _FILES_LIMIT):
            document = other.xml(path)
            root = document.root if isinstance(document, XmlDocument) else None
            if root is not None and root.tag == "robot" and root.get("name") == name:
                yield Wanted(path if other is self.package else f"../{other.name}/{path}", {})


def _lower(data: object) -> object:
    """Return data whose keys are in lower case, as MoveIt's assistant writes them today."""
    if not isinstance(data, Mapping):
        return data
    return {str(key).lower(): _lower(value) for key, value in data.items()}


def _args(more: Mapping[object, object]) -> dict[str, str]:
    words = (word.partition(":=") for word in str(more.get("xacro_args") or "").split())
    return {name: value for name, assigned, value in words if assigned}


def _is_whole(document: XmlDocument) -> bool:
    is_robot = document.root.tag == "robot" and document.root.child("link") is not None
    return is_robot and not _lacks_includes(document)


def _lacks_includes(document: XmlDocument) -> bool:
    source = document.source
    return isinstance(source, ExpandedText) and bool(source.left or source.skipped)
