"""Launch files in XML and YAML: the same actions as in Python, written as elements."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Protocol

from checker.base.files import NotReadable
from checker.base.record import Record
from checker.launch.ros2.actions.gathered import Gathered
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import LaunchFault, LaunchFaultKind, Unread
from checker.launch.ros2.substitution_text import AttributeText, split_words
from checker.launch.ros2.values import Made, Unknown, Value
from checker.package.package import Package
from checker.source.text import Located, SourceText, Span
from checker.source.xml import Element, Tagged, XmlDocument
from checker.source.xml_positions import XmlFault
from checker.source.yaml import YamlNode, read_yaml


class Entity(Protocol):
    """An element of a launch file."""

    @property
    def tag(self) -> str:
        """Its name."""

    @property
    def span(self) -> Span:
        """Its start tag, or key."""

    def get(self, name: str) -> Located[str] | None:
        """Return an attribute."""

    def children(self, tag: str = "") -> list[Entity]:
        """Return the elements below it, of one name or of all."""


class XmlEntity(Tagged, Record, eq=False):
    """An element of an XML launch file."""

    element: Element

    @property
    def tag(self) -> str:
        """Its name."""
        return self.element.tag

    def get(self, name: str) -> Located[str] | None:
        """Return an attribute."""
        return self.element.attribute(name)

    def children(self, tag: str = "") -> list[Entity]:
        """Return the elements below it."""
        return [XmlEntity(child) for child in self.element.children if tag in ("", child.tag)]


class YamlEntity(Record, eq=False):
    """An element of a YAML launch file: a key and its content."""

    tag: str
    span: Span
    node: YamlNode

    def get(self, name: str) -> Located[str] | None:
        """Return a scalar of a mapping."""
        value = self.node.get(name) if self.node.kind == "mapping" else None
        if value is None or value.kind != "scalar" or value.scalar is None:
            return None
        span = value.span
        if span.text[:1] in "'\"" and span.text[-1:] == span.text[:1] and len(span.text) > 1:
            span = Span(span.source, span.start + 1, span.end - 1)
        text = value.scalar
        return Located(str(text).lower() if isinstance(text, bool) else str(text), span)

    def children(self, tag: str = "") -> list[Entity]:
        """Return the items of a list below a key, or of the list that it contains itself."""
        if self.node.kind == "mapping":
            if tag:
                held = self.node.get(tag)
                items = held.items if held is not None and held.kind == "sequence" else ()
                return [YamlEntity(tag, item.span, item) for item in items]
            held = self.node.get("children") or self.node.get("launch")
            return [] if held is None else [*_single_keys(held)]
        return [child for child in _single_keys(self.node) if tag in ("", child.tag)]


def _single_keys(node: YamlNode) -> Iterator[YamlEntity]:
    for item in node.items:
        for key, value in item.entries[:1]:
            yield YamlEntity(str(key.scalar), key.span, value)


def read_markup(package: Package, source: SourceText, context: Context, found: Gathered) -> Value:
    """Return the actions of an XML or YAML launch file."""
    if source.file.endswith((".yaml", ".yml")):
        root = _yaml_root(source, found)
    else:
        root = _xml_root(package, source, found)
    if root is None:
        return Unknown("the launch file is not read", source.whole())
    return [*Markup(context, found).actions(root)]


def _yaml_root(source: SourceText, found: Gathered) -> Entity | None:
    document = read_yaml(source)
    for fault in document.faults[:1]:
        found.faults.append(LaunchFault(LaunchFaultKind.SYNTAX, fault.span, fault.message))
    if document.root is None or document.root.get("launch") is None:
        return None
    return YamlEntity("launch", document.root.span, document.root)


def _xml_root(package: Package, source: SourceText, found: Gathered) -> Entity | None:
    document = package.xml(source.file)
    if isinstance(document, XmlDocument):
        return XmlEntity(document.root) if document.root.tag == "launch" else None
    if isinstance(document, XmlFault):
        fault = LaunchFault(LaunchFaultKind.SYNTAX, document.span, document.message)
        found.faults.append(fault)
    elif isinstance(document, NotReadable):
        found.unread.append(Unread(f"{source.file} {document.reason}", source.whole()))
    return None


class Markup:
    """Makes actions of elements."""

    def __init__(self, context: Context, found: Gathered) -> None:
        """Take what substitutions need."""
        self._context = context
        self._found = found

    def actions(self, entity: Entity) -> Iterator[Value]:
        """Yield the actions below an element."""
        for child in entity.children():
            self._context.allowance.spend()
            with self._context.allowance:
                yield self._action(child)

    def text(self, entity: Entity, name: str) -> Value:
        """Return an attribute with its substitutions; None if it is absent."""
        written = entity.get(name)
        if written is None:
            return None
        return AttributeText(written, self._context.allowance, self._report).value()

    def command_words(self, entity: Entity, name: str) -> list[Value] | None:
        """Return the words of an attribute that is a command line."""
        written = entity.get(name)
        if written is None:
            return None
        return split_words(written, self._context.allowance, self._report)

    def _report(self, kind: LaunchFaultKind, span: Span, message: str, name: str) -> None:
        self._found.faults.append(LaunchFault(kind, span, message, name))

    def _action(self, entity: Entity) -> Value:
        tag = entity.tag.replace("-", "_")
        work = _TAGS.get(tag)
        if work is None:
            if tag in _NOTHING:
                return None
            return Unknown(f"<{entity.tag}> is not evaluated", entity.span)
        made = work(self, entity)
        given = {**self.attributes(entity, **_READ_ALONE), **made.values}
        values = {name: value for name, value in given.items() if value is not None}
        for attribute, name in (("if", "IfCondition"), ("unless", "UnlessCondition")):
            test = self.text(entity, attribute)
            if test is not None:
                where = entity.get(attribute)
                span = where.span if where is not None else entity.span
                values["condition"] = Made(name, {"predicate_expression": test}, span)
        return Made(made.name, values, entity.span)

    def attributes(self, entity: Entity, /, **names: str) -> dict[str, Value]:
        """Return attributes by the names of the arguments that they represent."""
        return {name: self.text(entity, attribute) for name, attribute in names.items()}

    # Parts of elements.

    def pairs(self, entity: Entity, tag: str, first: str, second: str) -> list[Value]:
        """Return what children with two attributes state."""
        children = entity.children(tag)
        pairs = [(self.text(child, first), self.text(child, second)) for child in children]
        return [pair for pair in pairs if None not in pair]

    def parameters(self, entity: Entity) -> list[Value]:
        """Return the parameters of a node."""
        entries: list[Value] = []
        for child in entity.children("param"):
            file = self.text(child, "from")
            if file is None:
                entries.append(self._parameter(child))
                continue
            allowed = child.get("allow_substs")
            substitutes = allowed is not None and allowed.value.lower() in ("true", "1")
            values = {"param_file": file, "allow_substs": substitutes}
            entries.append(Made("ParameterFile", values, child.span))
        return entries

    def _parameter(self, entity: Entity) -> Value:
        name = self.text(entity, "name")
        if name is None:
            return Unknown("a parameter has no name", entity.span)
        key = name if not isinstance(name, list) else tuple(name)
        if entity.get("value") is None:
            nested: dict[Value, Value] = {}
            for child in entity.children("param"):
                inner = self._parameter(child)
                if isinstance(inner, dict):
                    nested |= inner
            return {key: nested}
        value = self.text(entity, "value")
        kind = entity.get("type")
        if kind is not None:
            values = {"value": value, "value_type": kind.value}
            value = Made("ParameterValue", values, span=entity.span)
        return {key: value}

    def node(self, entity: Entity) -> Made:
        """Return a node."""
        values = self.attributes(
            entity, package="pkg", executable="exec", name="name", namespace="namespace"
        )
        arguments = self.command_words(entity, "args")
        rest = self.command_words(entity, "ros_args")
        values |= {
            "arguments": arguments,
            "ros_arguments": rest,
            "parameters": self.parameters(entity),
            "remappings": self.pairs(entity, "remap", "from", "to"),
            "additional_env": dict(_hashable(self.pairs(entity, "env", "name", "value"))),
        }
        if entity.tag == "node_container":
            values["composable_node_descriptions"] = self.components(entity)
        name = {"node": "Node", "lifecycle_node": "LifecycleNode"}.get(entity.tag)
        return Made(name or "ComposableNodeContainer", values, entity.span)

    def components(self, entity: Entity) -> list[Value]:
        """Return the components of a container."""
        components = []
        for child in entity.children("composable_node"):
            values = self.attributes(
                child, package="pkg", plugin="plugin", name="name", namespace="namespace"
            )
            values["parameters"] = self.parameters(child)
            values["remappings"] = self.pairs(child, "remap", "from", "to")
            kept = {name: value for name, value in values.items() if value is not None}
            components.append(Made("ComposableNode", kept, child.span))
        return components

    def load(self, entity: Entity) -> Made:
        """Return components for a container."""
        values: dict[str, Value] = {
            "target_container": self.text(entity, "target"),
            "composable_node_descriptions": self.components(entity),
        }
        return Made("LoadComposableNodes", values, entity.span)

    def argument(self, entity: Entity) -> Made:
        """Return the declaration of an argument."""
        values = self.attributes(
            entity, name="name", default_value="default", description="description"
        )
        choices = [self.text(choice, "value") for choice in entity.children("choice")]
        values["choices"] = choices or None
        return Made("DeclareLaunchArgument", values, entity.span)

    def include(self, entity: Entity) -> Made:
        """Return an include."""
        pairs = [
            *self.pairs(entity, "arg", "name", "value"),
            *self.pairs(entity, "let", "name", "value"),
        ]
        file = self.text(entity, "file")
        if file is None:
            file = Unknown("an include names no file", entity.span)
        values = {"launch_description_source": file, "launch_arguments": pairs}
        return Made("IncludeLaunchDescription", values, entity.span)

    def group(self, entity: Entity) -> Made:
        """Return a group."""
        scoped = entity.get("scoped")
        values: dict[str, Value] = {
            "actions": [*self.actions(entity)],
            "scoped": scoped is None or scoped.value.lower() not in ("false", "0"),
        }
        return Made("GroupAction", values, entity.span)

    def timer(self, entity: Entity) -> Made:
        """Return a timer."""
        return Made("TimerAction", {"actions": [*self.actions(entity)]}, entity.span)

    def command(self, entity: Entity) -> Made:
        """Return a command."""
        shell = entity.get("shell")
        values = {"cmd": self.command_words(entity, "cmd"), "shell": shell.value if shell else None}
        return Made("ExecuteProcess", values, entity.span)


def _hashable(pairs: list[Value]) -> Iterator[tuple[Value, Value]]:
    for name, value in pairs:
        yield (tuple(name) if isinstance(name, list) else name), value


def _simple(kind: str, /, **names: str) -> Callable[[Markup, Entity], Made]:
    """Return the work of a tag whose attributes are the arguments of a class."""

    def work(markup: Markup, entity: Entity) -> Made:
        return Made(kind, markup.attributes(entity, **names), entity.span)

    return work


def _append_environment(markup: Markup, entity: Entity) -> Made:
    values = markup.attributes(entity, name="name", value="value", prepend="prepend")
    return Made("AppendEnvironmentVariable", values, entity.span)


_TAGS: Mapping[str, Callable[[Markup, Entity], Made]] = MappingProxyType(
    {
        "arg": Markup.argument,
        "let": _simple("SetLaunchConfiguration", name="name", value="value"),
        "unlet": _simple("UnsetLaunchConfiguration", name="name"),
        "node": Markup.node,
        "lifecycle_node": Markup.node,
        "node_container": Markup.node,
        "load_composable_node": Markup.load,
        "include": Markup.include,
        "group": Markup.group,
        "executable": Markup.command,
        "set_env": _simple("SetEnvironmentVariable", name="name", value="value"),
        "append_env": _append_environment,
        "unset_env": _simple("UnsetEnvironmentVariable", name="name"),
        "push_ros_namespace": _simple("PushRosNamespace", namespace="namespace"),
        "set_parameter": _simple("SetParameter", name="name", value="value"),
        "set_parameters_from_file": _simple("SetParametersFromFile", filename="filename"),
        "set_use_sim_time": _simple("SetUseSimTime", value="value"),
        "set_remap": _simple("SetRemap", src="from", dst="to"),
        "timer": Markup.timer,
        "ros_timer": Markup.timer,
        "ros_gz_bridge": _simple(
            "RosGzBridge",
            bridge_name="bridge_name",
            config_file="config_file",
            namespace="namespace",
            bridge_params="bridge_params",
        ),
        "gz_server": _simple("GzServer", world_sdf_file="world_sdf_file"),
        "shutdown": _simple("Shutdown", reason="reason"),
    }
    | dict.fromkeys(
        ("log", "log_info", "log_debug", "log_warning", "log_error"),
        _simple("LogInfo", msg="message"),
    )
)
_NOTHING = frozenset(
    {"reset", "reset_env", "set_ros_log_dir", "push_env", "pop_env"}
    | {"push_launch_configurations", "pop_launch_configurations", "choice", "description"}
)
_READ_ALONE = MappingProxyType(
    {
        name: name
        for name in (
            *("output", "launch-prefix", "respawn", "respawn_delay", "respawn_max_retries", "cwd"),
            *("emulate_tty", "sigterm_timeout", "sigkill_timeout", "exec_name", "period"),
            # <gz_server> and <ros_gz_bridge>
            *("world_sdf_string", "initial_sim_time", "verbosity_level", "container_name"),
            *("create_own_container", "use_composition", "use_respawn", "log_level"),
        )
    }
)
"""Attributes that matter for the arguments that they read alone."""
