"""Nodes for control: spawners, robot_state_publisher, spawn_model."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType

from checker.base.record import Record
from checker.launch.ros1.graph import Node, resolve_name
from checker.launch.ros1.substitution import is_known
from checker.source.text import Located, Span

STATES = "joint_states"
_ONE_VALUE = frozenset({"--namespace", "--timeout", "--wait-for", "--shutdown-timeout"})
"""Options of controller_manager's programs that are followed by a value."""
_STARTING = frozenset({"spawn", "start"})
_LISTENERS = frozenset({"robot_state_publisher", "state_publisher"})
_SOURCES = ("joint_state_publisher", "joint_state_publisher_gui")

_FIND = re.compile(r"\$\(find\s{1,8}[\w.-]{1,200}\)")

_SPAWN_MODEL: Mapping[str, int] = MappingProxyType(
    {
        **dict.fromkeys(("-x", "-y", "-z", "-R", "-P", "-Y"), 1),
        **dict.fromkeys(("-file", "-param", "-database", "-model", "-wait"), 1),
        **dict.fromkeys(("-gazebo_namespace", "-reference_frame", "-robot_namespace"), 1),
        **dict.fromkeys(("-urdf", "-sdf", "-stdin", "-package_to_model", "-b", "-unpause"), 0),
        "-J": 2,
    }
)
"""Options of gazebo_ros's spawn_model, each with the number of words behind it."""


class Spawned(Record, eq=False):
    """A controller that a spawner node of a launch file starts.

    Attributes:
        name: The name as in the node's args.
        namespace: Absolute namespace of its controller manager.
        node: The node.
        span: The word in the args, else the node.
    """

    name: str
    namespace: str
    node: Node
    span: Span

    @property
    def full_name(self) -> str:
        """Namespace and name: `/gurdy/arm_controller`."""
        return resolve_name(self.name, self.namespace)

    @property
    def states_topic(self) -> str:
        """Absolute topic on which it publishes joint states, if it does so."""
        return resolve_name(STATES, self.namespace)


class StateListener(Record, eq=False):
    """A node that turns joint states into transforms.

    Attributes:
        node: The node.
        topic: Absolute topic it listens to.
        span: The remap that states it, else the node.
    """

    node: Node
    topic: str
    span: Span


class StatePublisher(Record, eq=False):
    """A node that publishes joint states.

    Attributes:
        node: The node.
        topic: Absolute topic on which it publishes them.
    """

    node: Node
    topic: str

    @property
    def is_source(self) -> bool:
        """True for a joint_state_publisher; False for a relay."""
        return self.node.package in _SOURCES

    @property
    def span(self) -> Span:
        """The node's start tag."""
        return self.node.span


class SpawnedModel(Record, eq=False):
    """A model that gazebo_ros's `spawn_model` puts into Gazebo.

    Attributes:
        node: The node.
        options: The first word after each option; empty for a flag.
        stray: Words that belong to no option.
    """

    node: Node
    options: Mapping[str, Located[str]]
    stray: tuple[Located[str], ...]

    @property
    def span(self) -> Span:
        """The node's start tag."""
        return self.node.span

    @property
    def model(self) -> str:
        """Name that the model gets; empty if none is stated."""
        return self._word("-model")

    @property
    def namespace(self) -> str:
        """Absolute namespace that plugins get which state none."""
        return resolve_name(self._word("-robot_namespace") or "", self.node.namespace)

    @property
    def parameter(self) -> str:
        """Absolute name of the parameter that contains the description; empty if none does."""
        word = self._word("-param")
        return resolve_name(word, self.node.namespace, self.node.name) if word else ""

    @property
    def is_known(self) -> bool:
        """True if only folders of packages depend on the machine that launches."""
        return is_known(_FIND.sub("", self.node.args))

    def _word(self, option: str) -> str:
        value = self.options.get(option)
        return value.value if value is not None else ""


def read_spawned(node: Node) -> Iterator[Spawned | str]:
    """Yield the controllers that a node starts; a text states why some are not known."""
    if node.package != "controller_manager" or node.type not in ("spawner", "controller_manager"):
        return
    names, options = _parted(node.words, _ONE_VALUE)
    if node.type == "controller_manager":
        names = names[1:] if names and names[0].value in _STARTING else []
    namespace = resolve_name(options.get("--namespace", ""), node.namespace)
    for word in names:
        if not is_known(word.value) or not is_known(namespace):
            yield f"node {node.name} starts {word.value[:80]}, which is known only at launch"
        elif word.value.endswith((".yaml", ".yml")):
            yield f"node {node.name} starts the controllers of {word.value[:80]}"
        else:
            yield Spawned(word.value, namespace, node, word.span)


def _parted(
    words: Iterable[Located[str]], with_value: frozenset[str]
) -> tuple[list[Located[str]], dict[str, str]]:
    """Part a command line into names and options; `a:=b` is for ROS itself."""
    names: list[Located[str]] = []
    options: dict[str, str] = {}
    awaited = ""
    for word in words:
        if ":=" in word.value:
            continue
        if awaited:
            options[awaited], awaited = word.value, ""
        elif word.value.startswith("-"):
            option, assigned, value = word.value.partition("=")
            if assigned:
                options[option] = value
            elif option in with_value:
                awaited = option
        else:
            names.append(word)
    return names, options


def read_listener(node: Node) -> StateListener | None:
    """Return what a robot_state_publisher listens to; None for any other node."""
    if node.package != "robot_state_publisher" or node.type not in _LISTENERS:
        return None
    wanted = resolve_name(STATES, node.namespace)
    for remap in node.remaps:
        if resolve_name(remap.source, node.namespace, node.name) == wanted:
            topic = resolve_name(remap.target, node.namespace, node.name)
            return StateListener(node, topic, remap.span)
    return StateListener(node, wanted, node.span)


def read_state_publisher(node: Node) -> StatePublisher | None:
    """Return where a node publishes joint states; None for any other node.

    A relay counts for every type: its topics are the user's choice.
    """
    if node.package in _SOURCES:
        return StatePublisher(node, node.resolve(STATES))
    if node.package == "topic_tools" and node.type == "relay" and len(node.words) > 1:
        return StatePublisher(node, node.resolve(node.words[1].value))
    return None


def read_model(node: Node) -> SpawnedModel | None:
    """Return the model that a `spawn_model` puts into Gazebo; None for any other node."""
    if node.package != "gazebo_ros" or node.type not in ("spawn_model", "spawn_urdf"):
        return None
    options: dict[str, Located[str]] = {}
    stray: list[Located[str]] = []
    words = [word for word in node.words if ":=" not in word.value]
    at = 0
    while at < len(words):
        word, at = words[at], at + 1
        taken = _SPAWN_MODEL.get(word.value)
        if taken is None:
            stray.append(word)
            continue
        options[word.value] = _first_behind(words, at, word, taken)
        at += taken
    return SpawnedModel(node, MappingProxyType(options), tuple(stray))


def _first_behind(
    words: Sequence[Located[str]], at: int, option: Located[str], taken: int
) -> Located[str]:
    if not taken or at >= len(words):
        return Located("", option.span, stated=False)
    return words[at]
