"""Launch graph of a launch file: nodes, remaps, parameters, and the parts that are not known.

Texts contain the values of roslaunch. What depends on the machine that launches (`$(env X)`,
`$(find p)`, `$(anon x)`) is kept as written, so a text with `$(` is not known.
"""

from __future__ import annotations

import enum
import posixpath
from collections.abc import Iterable, Mapping
from functools import cached_property

from msgspec import field

from checker.base.record import Record
from checker.launch.ros1.bridge import PASSES_NOTHING, Bridge
from checker.source.text import Located, Span

# Names of the ROS graph: how a relative, private or absolute name becomes absolute.


def resolve_name(name: str, namespace: str, node: str = "") -> str:
    """Return the absolute form of a name.

    Args:
        name: Absolute (`/a`), relative (`a`) or private (`~a`).
        namespace: Absolute namespace of the node or group.
        node: Name of the node, for private names.
    """
    if name.startswith("/"):
        parts = name.split("/")
    elif name.startswith("~"):
        parts = [*namespace.split("/"), node, *name[1:].split("/")]
    else:
        parts = [*namespace.split("/"), *name.split("/")]
    return "/" + "/".join(part for part in parts if part)


def apply_remaps(
    name: str, remaps: Iterable[tuple[str, str]], namespace: str, node: str = ""
) -> str:
    """Return the absolute name that a node gets for a name: the first remap of it counts.

    Args:
        name: The name as the node uses it.
        remaps: Source and target of each, in the forms that `resolve_name` takes.
        namespace: Absolute namespace of the node.
        node: Its name, for private names.
    """
    full_name = resolve_name(name, namespace, node)
    for source, target in remaps:
        if resolve_name(source, namespace, node) == full_name:
            return resolve_name(target, namespace, node)
    return full_name


_SIMULATOR = "gazebo_ros"
"""Package whose launch files start Gazebo Classic, and bridge nothing."""
_DESCRIPTION = "description.launch"
"""File that loads `robot_description` in every submission, and passes no topic."""


class LaunchFaultKind(enum.Enum):
    """Kind of a fault in a launch file."""

    UNDECLARED_ARG = "an arg is used but not declared"
    MISSING_ARG = "a required arg is not given"
    UNKNOWN_ARG = "an arg is given that the included file does not declare"
    CONSTANT_ARG = "an arg is given that the file sets to a constant"
    REPEATED_ARG = "an arg is declared twice"
    CONDITION = "a condition is neither true nor false"
    SUBSTITUTION = "a substitution cannot be read"
    MISSING_FILE = "an included file does not exist"
    INCLUDE_LOOP = "a file includes itself"
    BRIDGE = "an argument of a bridge cannot be read"
    LIMIT = "the launch file is larger than this reader supports"


class LaunchFault(Record, eq=False):
    """One fault of a launch file."""

    kind: LaunchFaultKind
    span: Span
    message: str


class Remap(Record, eq=False):
    """A `<remap>` that applies to a node.

    Attributes:
        source: The name that the node uses (`from`).
        target: The name that it gets (`to`).
        span: The start tag.
        inherited: Whether it is outside the node, in a group or in the file.
    """

    source: str
    target: str
    span: Span
    inherited: bool = False


class Node(Record, eq=False):
    """A node that the launch file starts; those that a condition leaves out are not here.

    Attributes:
        package: Package of the program (`pkg`).
        type: Name of the program.
        name: Name of the node, without its namespace.
        namespace: Absolute, `/` or `/X1`.
        args: Command line, substitutions made.
        remaps: The remaps in force: the node's own and those around it.
        span: The start tag.
        assumed_from: The file of the challenge's own package that is assumed to start the node
            (the span is that of its `<include>`); empty for a node that was read.
        words: The words of `args`, each with its place.
        usual: Whether it is assumed to bridge what most robots have: this one may do without.
    """

    package: str
    type: str
    name: str
    namespace: str
    args: str
    remaps: tuple[Remap, ...]
    span: Span
    assumed_from: str = ""
    words: tuple[Located[str], ...] = ()
    usual: bool = False

    @property
    def file(self) -> str:
        """The launch file of the node."""
        return self.span.source.file

    @property
    def full_name(self) -> str:
        """Namespace and name: `/X1/pose_tf_broadcaster`."""
        return resolve_name(self.name, self.namespace)

    def resolve(self, name: str) -> str:
        """Return the absolute name that the node gets for `name`."""
        remaps = ((remap.source, remap.target) for remap in self.remaps)
        return apply_remaps(name, remaps, self.namespace, self.name)


class Param(Record, eq=False):
    """A parameter that the launch file sets.

    Attributes:
        name: Absolute name; the namespace for a `<rosparam>` without `param`.
        value: The value, the command, the file name or the YAML text.
        kind: `value`, `command`, `textfile`, `binfile`, `yaml` or `load`.
        span: The start tag.
        text: The place of the text of a `<rosparam>`; None for other parameters.
    """

    name: str
    value: str
    kind: str
    span: Span
    text: Span | None = None


class EnvironmentVariable(Record, eq=False):
    """An `<env>` tag."""

    name: str
    value: str
    span: Span


class Include(Record, eq=False):
    """An `<include>` that was followed: its file by the path the reader knows it under."""

    file: str
    arguments: Mapping[str, str]
    span: Span


class UnresolvedInclude(Record, eq=False):
    """An `<include>` of a file that is not available.

    Attributes:
        package: Package of `$(find …)`; empty if the file is named otherwise.
        file: Path within the package, or what the attribute states.
        arguments: The passed arguments, by name.
        namespace: The namespace that the nodes of the file would have.
        reason: The reason why it is not available.
        span: The start tag.
    """

    package: str
    file: str
    arguments: Mapping[str, str]
    namespace: str
    reason: str
    span: Span


class LaunchGraph(Record, eq=False, dict=True):
    """All that a launch file starts, files that it includes among it.

    Attributes:
        nodes: The nodes in the order of the files.
        bridges: Topics that the nodes pass between ROS and Gazebo.
        dormant_bridges: The bridges of nodes that a condition leaves out.
        dormant_nodes: Nodes that a condition leaves out.
        params: Parameters set.
        environment: Environment variables set.
        includes: Files followed.
        unresolved_includes: Files not available.
        assumed_includes: Those of them whose nodes and bridges are here anyway, as they are
            assumed to be.
        dormant_includes: Files that a condition leaves out, and that were not read for it.
        arguments: Args that the entry file declares, with their values.
        undecided: Conditions whose value is not known here; what they guard is left out.
        faults: What is wrong.
        unread: The reasons why parts of what the robot starts are not known.
        unknown_commands: The reasons why the commands that start it are not known; then sample
            arguments represent theirs.
    """

    nodes: tuple[Node, ...] = ()
    bridges: tuple[Bridge, ...] = ()
    dormant_bridges: tuple[Bridge, ...] = ()
    dormant_nodes: tuple[Node, ...] = ()
    params: tuple[Param, ...] = ()
    environment: tuple[EnvironmentVariable, ...] = ()
    includes: tuple[Include, ...] = ()
    unresolved_includes: tuple[UnresolvedInclude, ...] = ()
    assumed_includes: tuple[UnresolvedInclude, ...] = ()
    dormant_includes: tuple[UnresolvedInclude, ...] = ()
    arguments: Mapping[str, Located[str]] = field(default_factory=dict)
    undecided: tuple[Located[str], ...] = ()
    faults: tuple[LaunchFault, ...] = ()
    unread: tuple[str, ...] = ()
    unknown_commands: str = ""

    @cached_property
    def unseen_bridges(self) -> tuple[str, ...]:
        """Reasons why topics may be passed that `bridges` and `dormant_bridges` do not contain."""
        assumed = set(self.assumed_includes)
        missing = (
            include
            for include in self.unresolved_includes
            if include not in assumed
            and include.package != _SIMULATOR
            and posixpath.basename(include.file) != _DESCRIPTION
        )
        reasons = [f"{file.file} is not read: {file.reason}" for file in missing]
        reasons += [
            f"the condition {condition.value!r} is not known before the launch"
            for condition in self.undecided
        ]
        reasons += [
            f"the topic {bridge.ign_topic!r} of bridge {bridge.node.name!r} is not known "
            "before the launch"
            for bridge in self.bridges
            if "$(" in bridge.ign_topic
        ]
        reasons += [
            f"{param.value}, which may name bridges, is not read"
            for param in self.params
            if param.name.endswith("/config_file")
        ]
        reasons += [
            f"node {node.name!r} of package {node.package} may bridge topics of Gazebo itself"
            for node in self.nodes
            if node.package not in PASSES_NOTHING
        ]
        return tuple(dict.fromkeys(reasons))
