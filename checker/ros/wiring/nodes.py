"""A node of a launch as the ROS graph sees it: its full name, its parameters, its topics."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property

from msgspec.structs import replace

from checker.base.record import Record
from checker.launch.ros1.graph import apply_remaps, resolve_name
from checker.launch.ros2.graph import Node, NodeKind, ParameterFile, is_known
from checker.model.ros_parameters import NodeBlock
from checker.ros.ros2_control.launched import Spawner, spawner_of
from checker.ros.ros2_control.robot_control import ControlReader
from checker.ros.wiring.facts import NodeFacts, node_facts, program_of
from checker.ros.wiring.inputs import Input, inputs
from checker.ros.wiring.parameters import LoadedFile, Setting, settings_of

_REFERENCE = re.compile(r"\{([\w.]+)\}")
_MUX = "twist_mux/twist_mux"
"""Reads the topics that a list of its parameters names."""
_DEEPEST = 4
"""Parameters whose defaults are the values of one another."""
_OWN_RULES = ("-r", "--remap", "-p", "--param", "--params-file", "__node", "__ns", "__name")
"""Beginnings of words by which a command line gives names and parameters too."""


class WiredNode(Record, eq=False, dict=True):
    """A node that a launch file starts.

    Attributes:
        node: The node as the launch file has it.
        files: Its parameter files.
        facts: What is known of its program; None for an unknown one.
    """

    node: Node
    files: tuple[LoadedFile, ...] = ()
    facts: NodeFacts | None = None

    @property
    def name(self) -> str:
        """Its name without the namespace; empty if it is not known."""
        if self.node.name is not None and self.node.name.value:
            return self.node.name.value if is_known(self.node.name.value) else ""
        return self.facts.name if self.facts is not None else ""

    @property
    def full_name(self) -> str:
        """Its namespace and name; empty if they are not known."""
        known = self.name and is_known(self.node.namespace) and not self._rules
        return resolve_name(self.name, self.node.namespace) if known else ""

    @property
    def label(self) -> str:
        """Name in messages."""
        return f"node {self.full_name or self.node.executable.value!r}"

    @property
    def program(self) -> str:
        """Its package and executable: `nav2_amcl/amcl`; of a component, those of the same node."""
        return program_of(self.node)

    @cached_property
    def spawner(self) -> Spawner | None:
        """The node as a spawner of controllers; None for any other node."""
        return spawner_of(self.node)

    @property
    def _rules(self) -> bool:
        return any(word.value.startswith(_OWN_RULES) for word in self.node.arguments)

    def reads(self, block: NodeBlock) -> bool:
        """Return whether a block of a parameter file applies to it."""
        return block.is_for(self.name, self.node.namespace)

    @property
    def knows_parameters(self) -> bool:
        """True if all sources of its parameters were read."""
        read = all(file.is_read for file in self.files)
        return bool(self.full_name) and read and not self.node.unread

    @cached_property
    def settings(self) -> Mapping[str, Setting]:
        """The parameters that it gets."""
        return settings_of(self.node, self.files, self.name, self.node.namespace)

    def fill_in(self, text: str) -> str | None:
        """Return a text of the table with the values of parameters; None if one is not known."""
        defaults = self.facts.defaults if self.facts is not None else {}
        for _ in range(_DEEPEST):
            for name in _REFERENCE.findall(text):
                setting = self.settings.get(name)
                value = defaults.get(name) if setting is None else setting.text
                if value is None:
                    return None
                text = text.replace(f"{{{name}}}", value)
        return None if _REFERENCE.search(text) else text

    def resolve(self, name: str) -> str:
        """Return the absolute topic that it gets for a name; empty if unknown."""
        remaps = ((remap.source, remap.target) for remap in self.node.remaps)
        topic = apply_remaps(name, remaps, self.node.namespace, self.name)
        known = is_known(topic) and not self._rules and not self.node.unread
        return topic if known else ""

    @cached_property
    def published_topics(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """The topics that it may publish, absolute, each with its types; those that are known."""
        facts = self.facts.publishes if self.facts is not None else {}
        filled = ((self.fill_in(topic), types) for topic, types in facts.items())
        resolved = ((self.resolve(topic), types) for topic, types in filled if topic)
        return tuple((topic, types) for topic, types in resolved if topic)

    @cached_property
    def passed_topics(self) -> tuple[tuple[str, str], ...]:
        """The topics on which it passes on the messages of others, each with the one that it reads.

        They are known where parameters state them, not the command line.
        """
        known = self.facts is not None and self.knows_parameters and not self.node.arguments
        pairs = self.facts.passes.items() if self.facts is not None and known else ()
        filled = ((self.fill_in(target), self.fill_in(source)) for target, source in pairs)
        named = (
            (self.resolve(target), self.resolve(source))
            for target, source in filled
            if target and source
        )
        return tuple((target, source) for target, source in named if target and source)

    @cached_property
    def read(self) -> tuple[Input, ...]:
        """The known topics that it reads, as it names them."""
        return tuple(inputs(self)) if self.knows_parameters else ()

    @property
    def knows_inputs(self) -> bool:
        """True if it reads nothing but what `read` names."""
        facts = self.facts
        if facts is None or facts.passes or self.program == _MUX:
            return False
        return not facts.subscribes or self.knows_parameters

    def publishes_more(self, message: str) -> str:
        """Return why it may publish a type on a topic not in `published_topics`; else nothing."""
        if self.facts is None:
            return f"what {self.program} publishes is not known"
        own = [types for types in self.facts.publishes.values() if message in types]
        known = sum(message in types for _, types in self.published_topics)
        more = {message, "*"}.intersection(self.facts.publishes_more)
        if len(own) > known or (more and not self.passed_topics):
            return f"some of the topics that {self.program} publishes are not known"
        return ""


def wired_node(node: Node, reader: ControlReader) -> WiredNode:
    """Return a node with its parameter files.

    Args:
        node: The node of the launch file.
        reader: The reader of the files of the package being checked.
    """
    files = tuple(_loaded(node, given, reader) for given in node.parameter_files)
    return WiredNode(node, files, node_facts().get(program_of(node)))


def _loaded(node: Node, given: ParameterFile, reader: ControlReader) -> LoadedFile:
    """Return a parameter file; for a component, launch reads it itself, and refuses nothing."""
    file = reader.file(given.path)
    is_component = node.kind is NodeKind.COMPONENT
    if file is None or (is_component and (node.name is None or file.refused is not None)):
        return LoadedFile(given)
    blocks = file.blocks
    if given.root.strip("/"):
        blocks = tuple(replace(b, name=f"/{given.root.strip('/')}{b.name}") for b in blocks)
    return LoadedFile(given, file.path, blocks, True, file.refused)


def spawned_names(nodes: Iterable[WiredNode]) -> list[str]:
    """Return the names of the controllers that the spawners among some nodes start."""
    spawners = (node.spawner for node in nodes if node.spawner is not None)
    return [name.value for spawner in spawners for name in spawner.names]
