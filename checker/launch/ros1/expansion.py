"""Expands launch XML to the launch graph as roslaunch does, without starting anything.

Scoping follows roslaunch: args and remaps of a group end with it, remaps reach into included
files, args do not unless they are passed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from checker.launch.ros1.assumed_files import assumed_bridges, assumed_nodes
from checker.launch.ros1.attributes import Reader, left_outside, split_words
from checker.launch.ros1.bridge import Bridge, read_bridges
from checker.launch.ros1.graph import (
    EnvironmentVariable,
    Include,
    LaunchFaultKind,
    LaunchGraph,
    Node,
    Param,
    Remap,
    UnresolvedInclude,
    resolve_name,
)
from checker.launch.ros1.launch_file import (
    Inclusion,
    MissingLaunchFile,
    ReadLaunch,
    read_inclusion,
)
from checker.launch.ros1.scope import LaunchFile, Scope, args_of
from checker.launch.ros1.substitution import is_known
from checker.package.references import PROVIDED
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

MAX_DEPTH = 60
_PARAM_KINDS = ("value", "command", "textfile", "binfile")


def expand_launch(
    document: XmlDocument, arguments: Mapping[str, str], read_launch: ReadLaunch
) -> LaunchGraph:
    """Expand a launch file.

    Args:
        document: The launch file that the command names.
        arguments: Args of the command line.
        read_launch: Finds included files.
    """
    arguments_given = MappingProxyType(dict(arguments))
    chain = ((document.source.file, frozenset(arguments_given.items())),)
    file = LaunchFile(document, arguments_given, None, overrides_constants=False, chain=chain)
    expansion = _Expansion(read_launch)
    expansion.expand(document.root, Scope(file, args_of(file)))
    return expansion.graph(file)


def _follow_nothing(package: str, path: str, from_file: str) -> str:
    return f"{path} of {package or from_file} is not started"


class _Expansion:
    """Visits the elements and collects the nodes they start."""

    def __init__(self, read_launch: ReadLaunch, *, asleep: bool = False) -> None:
        self._read_launch = read_launch
        self._asleep = asleep
        self._reader = Reader()
        self._nodes: list[Node] = []
        self._bridges: list[Bridge] = []
        self._dormant_bridges: list[Bridge] = []
        self._dormant_nodes: list[Node] = []
        self._params: list[Param] = []
        self._environment: list[EnvironmentVariable] = []
        self._includes: list[Include] = []
        self._unresolved: list[UnresolvedInclude] = []
        self._assumed: list[UnresolvedInclude] = []
        self._dormant_includes: list[UnresolvedInclude] = []
        self._unsure: set[str] = set()  # args on conditions that are not known
        self._handlers: dict[str, Callable[[Element, Scope], None]] = {
            "arg": self._arg,
            "env": self._env,
            "group": self._group,
            "include": self._include,
            "node": self._node,
            "param": self._param,
            "remap": self._remap,
            "rosparam": self._rosparam,
        }

    def graph(self, entry: LaunchFile) -> LaunchGraph:
        return LaunchGraph(
            nodes=tuple(self._nodes),
            bridges=tuple(self._bridges),
            dormant_bridges=tuple(self._dormant_bridges),
            dormant_nodes=tuple(self._dormant_nodes),
            params=tuple(self._params),
            environment=tuple(self._environment),
            includes=tuple(self._includes),
            unresolved_includes=tuple(self._unresolved),
            assumed_includes=tuple(self._assumed),
            dormant_includes=tuple(self._dormant_includes),
            arguments=MappingProxyType(entry.declared),
            undecided=tuple(self._reader.undecided),
            faults=tuple(self._reader.faults),
        )

    def expand(self, parent: Element, scope: Scope) -> bool:
        """Follow the elements below one; False if a limit keeps it from seeing them all."""
        if scope.depth > MAX_DEPTH:
            message = f"groups and files are nested more than {MAX_DEPTH} levels deep"
            self._reader.fault(LaunchFaultKind.LIMIT, parent, message)
            return False
        for element in parent.children:
            if not self._reader.charge(element, 1):
                return False
            handler = self._handlers.get(element.tag)
            enabled = self._reader.is_enabled(element, scope) if handler else False
            if handler and enabled:
                handler(element, scope)
            elif element.tag == "arg" and enabled is None:
                self._may_declare(element, scope)
            elif element.tag in ("group", "include", "node") and not self._asleep:
                self._read_dormant(element, scope)
        return True

    def _read_dormant(self, element: Element, scope: Scope) -> None:
        """Read what a condition leaves out for its bridges; includes in it are not followed."""
        dormant = _Expansion(_follow_nothing, asleep=True)
        dormant._handlers[element.tag](element, scope)
        self._dormant_bridges += dormant._bridges
        self._dormant_nodes += dormant._nodes
        assumed = set(dormant._assumed)
        self._dormant_includes += [
            include for include in dormant._unresolved if include not in assumed
        ]

    def _arg(self, element: Element, scope: Scope) -> None:
        name = element.get("name") or ""
        if scope.declares(name) and name not in self._unsure:
            message = f"the arg {name!r} is declared twice"
            self._reader.fault(LaunchFaultKind.REPEATED_ARG, element, message)
            return
        value = self._arg_value(element, name, scope)
        scope.args[name] = value
        scope.file.declared[name] = Located(value, element.span)

    def _may_declare(self, element: Element, scope: Scope) -> None:
        """Declare an arg on an unknown condition: usually another element declares it otherwise."""
        name = element.get("name") or ""
        if not scope.declares(name):
            self._unsure.add(name)
            scope.args[name] = scope.file.given.get(name, f"$(arg {name})")
            scope.file.declared[name] = Located(scope.args[name], element.span)

    def _arg_value(self, element: Element, name: str, scope: Scope) -> str:
        file = scope.file
        value = file.given.get(name)
        constant = self._reader.text(element, "value", scope)
        if constant is not None:
            if value is not None and not file.overrides_constants:
                message = f"the arg {name!r} is given, but {file.name} sets it to a constant"
                where = file.included_at or element
                self._reader.fault(LaunchFaultKind.CONSTANT_ARG, where, message)
            return constant.value
        default = self._reader.text(element, "default", scope)
        if value is not None:
            return value
        if default is not None:
            return default.value
        message = f"{file.name} requires the arg {name!r}, which is not given"
        self._reader.fault(LaunchFaultKind.MISSING_ARG, file.included_at or element, message)
        return f"$(arg {name})"

    def _env(self, element: Element, scope: Scope) -> None:
        name = self._reader.value(element, "name", scope)
        value = self._reader.value(element, "value", scope)
        self._environment.append(EnvironmentVariable(name, value, element.span))

    def _group(self, element: Element, scope: Scope) -> None:
        if self._reader.charge(element, len(scope.remaps)):
            self.expand(element, scope.inner(self._reader.value(element, "ns", scope)))

    def _remap(self, element: Element, scope: Scope) -> None:
        scope.remaps.append(self._read_remap(element, scope))

    def _read_remap(self, element: Element, scope: Scope) -> Remap:
        source = self._reader.value(element, "from", scope)
        span = scope.file.shown_at or element.span
        return Remap(source, self._reader.value(element, "to", scope), span)

    def _param(self, element: Element, scope: Scope, node: str = "") -> None:
        name = self._reader.value(element, "name", scope)
        full = resolve_name(f"~{name}" if node else name, scope.namespace, node)
        for kind in _PARAM_KINDS:
            text = self._reader.text(element, kind, scope)
            if text is not None:
                self._params.append(Param(full, text.value, kind, element.span))
                return

    def _rosparam(self, element: Element, scope: Scope, node: str = "") -> None:
        if self._reader.value(element, "command", scope, "load") != "load":
            return
        namespace = self._reader.value(element, "ns", scope)
        parts = (namespace, self._reader.value(element, "param", scope))
        name = "/".join(part for part in parts if part)
        full = resolve_name(f"~{name}" if node else name, scope.namespace, node)
        file = self._reader.text(element, "file", scope)
        if file is not None:
            self._params.append(Param(full, file.value, "load", element.span))
        else:
            text = element.raw_text
            self._params.append(Param(full, text, "yaml", element.span, element.text_span))

    def _node(self, element: Element, scope: Scope) -> None:
        if not self._reader.charge(element, len(element.children) + len(scope.remaps)):
            return
        name = self._reader.value(element, "name", scope)
        inner = scope.inner(self._reader.value(element, "ns", scope))
        own = self._inside_node(element, name, inner)
        node = Node(
            self._reader.value(element, "pkg", scope),
            self._reader.value(element, "type", scope),
            name,
            inner.namespace,
            self._reader.value(element, "args", scope),
            scope.remaps_with(own),
            scope.file.shown_at or element.span,
            words=self._words(element, scope),
        )
        self._nodes.append(node)
        self._read_bridges(node)

    def _inside_node(self, element: Element, name: str, scope: Scope) -> list[Remap]:
        """Read what is inside a node, and return its own remaps."""
        own: list[Remap] = []
        for child in element.children:
            if not self._reader.is_enabled(child, scope):
                continue
            match child.tag:
                case "remap":
                    own.append(self._read_remap(child, scope))
                case "param":
                    self._param(child, scope, name)
                case "rosparam":
                    self._rosparam(child, scope, name)
                case "env":
                    self._env(child, scope)
        return own

    def _words(self, element: Element, scope: Scope) -> tuple[Located[str], ...]:
        written = element.attribute("args") or left_outside(element).get("args")
        if written is None or not self._reader.charge(element, len(written.value) // 100):
            return ()
        result = tuple(split_words(written, scope))
        if (shown_at := scope.file.shown_at) is not None:
            result = tuple(Located(word.value, shown_at) for word in result)
        self._reader.charge(element, len(result))
        return result

    def _read_bridges(self, node: Node) -> None:
        for read in read_bridges(node, node.words):
            if isinstance(read, Bridge):
                self._bridges.append(read)
            elif is_known(read.value):
                message = f"{read.value!r} is not of the form topic@ros_type[ign_type"
                self._reader.fault(LaunchFaultKind.BRIDGE, read.span, message)

    def _include(self, element: Element, scope: Scope) -> None:
        inclusion = read_inclusion(self._reader, element, scope)
        document: XmlDocument | str = "its path is not known before the launch"
        if inclusion.path:
            from_file = scope.file.name
            document = self._read_launch(inclusion.package, inclusion.path, from_file)
        inner = scope.inner(self._reader.value(element, "ns", scope))
        if isinstance(document, XmlDocument):
            self._follow(inclusion, document, inner)
            return
        if isinstance(document, MissingLaunchFile):
            self._reader.fault(LaunchFaultKind.MISSING_FILE, inclusion.file.span, document)
        unresolved = inclusion.unresolved(inner.namespace, document)
        self._unresolved.append(unresolved)
        if not isinstance(document, MissingLaunchFile):
            self._assume(unresolved, element, inner)

    def _assume(self, include: UnresolvedInclude, element: Element, scope: Scope) -> None:
        """Add what a known template of the challenge starts."""
        nodes = assumed_nodes(include, scope.remaps)
        if nodes is None or not self._reader.charge(element, len(nodes) * (1 + len(scope.remaps))):
            return
        self._assumed.append(include)
        for node in nodes:
            self._nodes.append(node)
            self._bridges += assumed_bridges(node)

    def _follow(self, inclusion: Inclusion, document: XmlDocument, scope: Scope) -> None:
        arguments, span = inclusion.arguments, inclusion.span
        key = (document.source.file, frozenset(arguments.items()))
        chain = scope.file.chain
        if key in chain:
            message = f"{document.source.file} includes itself"
            self._reader.fault(LaunchFaultKind.INCLUDE_LOOP, inclusion.file.span, message)
            return
        self._includes.append(Include(document.source.file, arguments, span))
        shown_at = scope.file.shown_at or (span if inclusion.package in PROVIDED else None)
        file = LaunchFile(document, arguments, span, inclusion.passes_all, (*chain, key), shown_at)
        complete = self.expand(document.root, scope.of_file(file))
        if inclusion.passes_all or not complete:
            return
        for name, place in inclusion.argument_places.items():
            if name not in file.declared:
                message = f"{file.name} does not declare the arg {name!r}"
                self._reader.fault(LaunchFaultKind.UNKNOWN_ARG, place, message)
