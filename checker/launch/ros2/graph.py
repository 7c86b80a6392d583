"""The graph of ROS 2 launch files: all that they start, every item with its place.

Texts contain the values of the launch system. A share folder is a path below `ROOT`, so
that paths can be joined and looked up; `share_path` takes them apart. What is only known when it is
launched is kept as a substitution (`$(env HOME)`, `$(var ur_type)`, `$(command xacro …)`): a text
that still contains `$(` is not known.
"""

from __future__ import annotations

import enum
import posixpath
from collections.abc import Mapping, Sequence

from msgspec import field

from checker.base.record import Record
from checker.formats.xacro.files import ROOT
from checker.launch.ros1.graph import Remap
from checker.source.text import Located, Span

SHARE = ROOT
"""The folder above all share folders: what `package://` and `model://` start from."""


def is_known(text: str) -> bool:
    """Return whether a text does not depend on the machine that launches."""
    return "$(" not in text


GAZEBO = ("ros_gz_sim", "ros_ign_gazebo")
"""Packages that start Gazebo, and spawn models in it."""
CLASSIC_PACKAGE = "gazebo_ros"
"""The same of Gazebo Classic."""


class SharePath(Record):
    """A file or folder below the share folder of a package, as it is installed.

    Attributes:
        package: Name of the package.
        path: The path below its share folder, such as `urdf/arm.urdf`; empty for the folder itself.
    """

    package: str
    path: str

    @property
    def full_path(self) -> str:
        """The path below `ROOT`, see `share_path`."""
        return f"{ROOT}/{self.package}/{self.path}"

    def __str__(self) -> str:
        """Return it as a launch file in XML writes it."""
        return f"$(find-pkg-share {self.package})/{self.path}".rstrip("/")


def share_path(text: str) -> SharePath | None:
    """Take a path below a share folder apart; None for any other text, or one that is not known."""
    if not text.startswith(f"{ROOT}/") or not is_known(text):
        return None
    package, _, path = posixpath.normpath(text).removeprefix(f"{ROOT}/").partition("/")
    return SharePath(package, path) if package and package != ".." else None


def display_path(text: str) -> str:
    """Return a text for messages: share folders as a launch file in XML writes them."""
    if text == SHARE:
        return "share"
    parts = text.split(f"{ROOT}/")
    rest = (part.partition("/") for part in parts[1:])
    return parts[0] + "".join(
        f"$(find-pkg-share {name}){slash}{path}" for name, slash, path in rest
    )


class LaunchFaultKind(enum.Enum):
    """Kind of a fault in a launch file."""

    SYNTAX = "the file cannot be parsed"
    NO_DESCRIPTION = "the file describes no launch"
    UNDEFINED_NAME = "a name of Python is not defined"
    UNDECLARED_ARGUMENT = "an argument is used but not declared"
    LATE_ARGUMENT = "an argument is used before it is declared"
    UNKNOWN_CHOICE = "a value is not one of the choices"
    SUBSTITUTION = "a substitution cannot be read"
    ACTION = "an element is not an action"
    ATTRIBUTE = "an attribute or keyword is not known, or missing"
    CONDITION = "a condition is neither true nor false"
    CALL = "a value that is no function is called"
    COMPARISON = "a substitution is tested as if it were its value"
    INCLUDE_LOOP = "a file includes itself"
    LIMIT = "the launch file is larger than this reader supports"


class LaunchFault(Record, eq=False):
    """One fault of a launch file.

    Attributes:
        kind: What sort of fault it is.
        span: Its place.
        message: Present tense; the whole sentence.
        name: The argument, substitution, keyword or tag that it is about.
    """

    kind: LaunchFaultKind
    span: Span
    message: str
    name: str = ""


class Unread(Record, eq=False):
    """An action, or a part of one, that this reader cannot evaluate.

    Attributes:
        reason: The end of a sentence.
        span: Its place.
        by_default: Whether the defaults of all arguments lead to it.
    """

    reason: str
    span: Span
    by_default: bool = True


class Condition(Record, eq=False):
    """An `IfCondition` or `UnlessCondition` around an action.

    Attributes:
        text: What is tested, substitutions made, with the defaults of arguments.
        wanted: The truth value that lets the action count; False of `UnlessCondition`.
        holds: Whether the action counts; None if that is not known before the launch.
        written: Whether no substitution takes part, so that it is the same in every launch.
    """

    text: Located[str]
    wanted: bool
    holds: bool | None
    written: bool = False


class Argument(Record, eq=False):
    """A declared argument.

    Attributes:
        name: The name as `name:=value` gives it.
        default: The default with the substitutions made; None if it must be given.
        choices: Values that are allowed; empty for all.
        description: The description for `ros2 launch --show-args`.
        conditions: Those around the declaration.
        span: The declaration.
    """

    name: str
    default: Located[str] | None
    choices: tuple[str, ...]
    description: str
    conditions: tuple[Condition, ...]
    span: Span


Plain = str | int | float | bool | None | list["Plain"] | dict[str, "Plain"]


class Parameter(Record, eq=False):
    """One parameter of a node.

    Attributes:
        name: The name with dots for nested mappings.
        value: Text, number, truth value or list; a text may contain `$(`.
        substituted: Whether substitutions made the value: launch reads such a text as YAML.
        as_text: Whether it is kept as a text (`ParameterValue(…, value_type=str)`).
        span: The value where it is written, else its name.
    """

    name: str
    value: Plain
    substituted: bool
    as_text: bool
    span: Span


class ParameterFile(Record, eq=False):
    """A YAML file of parameters.

    Attributes:
        path: Its path; see `share_path`.
        substitutes: Whether substitutions in the file are made (`allow_substs`).
        span: The place of the path.
        root: A key that is put above all others of the file: `root_key` of a `RewrittenYaml`.
        replacements: Texts of the file, each with what a `ReplaceString` writes in its place.
    """

    path: str
    substitutes: bool
    span: Span
    root: str = ""
    replacements: tuple[tuple[str, str], ...] = ()


Parameters = tuple[Parameter | ParameterFile, ...]
"""The parameters of a node, in order: later ones count."""


class NodeKind(enum.StrEnum):
    """Kind of a node."""

    NODE = "node"
    LIFECYCLE = "lifecycle node"
    CONTAINER = "container"
    COMPONENT = "component"
    INCLUDED = "node of an included file that is only known"


class Started(Record, eq=False, kw_only=True):
    """Conditions and place of an action that starts something.

    Attributes:
        conditions: Its own and those around it.
        certain: Whether it is outside of tests and loops that could not be decided.
        after: Whether an event or a timer starts it.
        exit_of: The action whose end starts it, if one does.
        span: The call or start tag.
    """

    conditions: tuple[Condition, ...] = ()
    certain: bool = True
    after: bool = False
    exit_of: Span | None = None
    span: Span

    @property
    def file(self) -> str:
        """The launch file of it."""
        return self.span.source.file

    @property
    def starts(self) -> bool | None:
        """True if it counts with the defaults of all arguments; None if that is not known."""
        if any(condition.holds is False for condition in self.conditions):
            return False
        unsure = not self.certain or any(c.holds is None for c in self.conditions)
        return None if unsure else True


class Node(Started, eq=False, kw_only=True):
    """A node, container, lifecycle node, or a component that is loaded into a container.

    Attributes:
        kind: What sort of node it is.
        package: Package of the program.
        executable: The program; of a component, its class.
        name: The name of the node; None for the program's own.
        namespace: Absolute, `/` or `/r1`; it may contain `$(`.
        arguments: Words of the command line, `--ros-args` and what follows among them.
        parameters: The parameters in force: of scopes around it first, then its own.
        remaps: The remaps in force; its own first.
        environment: Variables set for it alone.
        unread: The reasons why its arguments, parameters or remaps may not be complete.
    """

    kind: NodeKind = NodeKind.NODE
    package: Located[str]
    executable: Located[str]
    name: Located[str] | None = None
    namespace: str = "/"
    arguments: tuple[Located[str], ...] = ()
    parameters: Parameters = ()
    remaps: tuple[Remap, ...] = ()
    environment: Mapping[str, str] = field(default_factory=dict)
    unread: tuple[Unread, ...] = ()

    @property
    def program(self) -> tuple[str, str]:
        """Package and name of the program."""
        return self.package.value, self.executable.value

    def parameter(self, name: str) -> Parameter | None:
        """Return the parameter of a name that counts, among those that are in the launch file."""
        named = (p for p in reversed(self.parameters) if isinstance(p, Parameter))
        return next((p for p in named if p.name == name), None)

    @property
    def parameter_files(self) -> tuple[ParameterFile, ...]:
        """YAML files of parameters, in order."""
        return tuple(p for p in self.parameters if isinstance(p, ParameterFile))


class Process(Started, eq=False, kw_only=True):
    """A command that is neither a node nor an included file, as `ros2 run` and `ros2 launch` are.

    Attributes:
        words: The command line, taken apart as a shell does; a word may contain `$(`.
        commands: The words of each command that it runs: a line for a shell may contain several.
            Those that are read as nodes or included files are left out.
        spawns: Nodes that put the same models into Gazebo, or start the same controllers.
    """

    words: tuple[Located[str], ...]
    commands: tuple[Sequence[Located[str]], ...] = ()
    spawns: tuple[Node, ...] = ()


class Include(Started, eq=False, kw_only=True):
    """An included launch file.

    Attributes:
        target: Its path; see `share_path`.
        arguments: The passed arguments, by name.
        path: The file as the package lists it; empty if it is not available.
        accepts: Names of arguments that the file, or one that it includes, declares or uses; None
            when that is not known, as of a file that could not be read in full.
        reason: The reason why the file is not read; empty if it is.
        nodes: The nodes that the file starts, if it is not read but known.
        commanded: Whether `ros2 launch` starts it, as users do: it is a launch of its own, too.
    """

    target: Located[str]
    arguments: Mapping[str, Located[str]] = field(default_factory=dict)
    path: str = ""
    accepts: frozenset[str] | None = None
    reason: str = ""
    nodes: tuple[Node, ...] = ()
    commanded: bool = False

    @property
    def is_unknown(self) -> bool:
        """True if the file was not read, and is unknown."""
        return bool(self.reason) and self.accepts is None


class EnvironmentChange(Started, eq=False, kw_only=True):
    """An environment variable that is set for what starts after it.

    Attributes:
        name: The name of the variable.
        value: What is set, or added; empty if it is removed.
        mode: `set`, `append`, `prepend` or `unset`.
    """

    name: str
    value: Located[str]
    mode: str


class FileUse(Record, eq=False):
    """A path of a share folder that is named anywhere, in an action that counts or in none.

    Attributes:
        text: The path; see `share_path`.
        certain: Whether it is used in every launch, as far as known.
    """

    text: Located[str]
    certain: bool = True


class LaunchGraph(Record, eq=False, dict=True):
    """All that a launch file starts with the defaults of its arguments, included files among it.

    Items that a condition leaves out are included: see `starts` of each item.

    Attributes:
        file: The launch file.
        arguments: Arguments that it declares, those of included files after its own.
        nodes: Nodes and components, in order.
        processes: Commands.
        includes: Files, whether they were read or not.
        environment: Variables set.
        files: Paths of share folders that are opened or read when the file is launched.
        used: Names of arguments that it or an included file reads.
        faults: What is wrong.
        unread: What could not be evaluated, by place.
    """

    file: str
    arguments: tuple[Argument, ...] = ()
    nodes: tuple[Node, ...] = ()
    processes: tuple[Process, ...] = ()
    includes: tuple[Include, ...] = ()
    environment: tuple[EnvironmentChange, ...] = ()
    files: tuple[FileUse, ...] = ()
    used: frozenset[str] = frozenset()
    faults: tuple[LaunchFault, ...] = ()
    unread: tuple[Unread, ...] = ()

    @property
    def nodes_and_spawns(self) -> tuple[Node, ...]:
        """The nodes, and those that do what commands do: see `Process.spawns`."""
        return (*self.nodes, *(node for process in self.processes for node in process.spawns))


class Ros2Launch(Record, eq=False):
    """The ROS 2 launch files of a package that no other of its files includes.

    Attributes:
        entries: A graph each.
        unread: The reasons why launch files are left out.
    """

    entries: tuple[LaunchGraph, ...] = ()
    unread: tuple[str, ...] = ()

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The nodes of all files; one that several files start comes as often."""
        return tuple(node for graph in self.entries for node in graph.nodes)
