"""One topic that a bridge of ROS 2 passes, and the faults of its notation."""

from __future__ import annotations

import enum
import re

from checker.base.record import Record
from checker.launch.ros1.bridge import Direction
from checker.launch.ros2.graph import Node, display_path
from checker.source.text import Located, Span

GZ_PREFIXES = ("gz.msgs.", "ignition.msgs.")
_GRAMMAR = "<topic>@<ros type>@<gz type>, with [ or ] for the second @"
MARKS = {"@": Direction.BOTH, "[": Direction.TO_ROS, "]": Direction.TO_IGN}
_FILE = re.compile(r"(?:@|\w{1,40}:?=)?([^@=]{1,500}\.ya?ml)\Z")
_SERVICE = re.compile(r"/srv/")


class BridgeFaultKind(enum.Enum):
    """Kind of the fault."""

    ARGUMENT = "the bridge ends at an argument that it cannot read"
    UNREADABLE = "the file is not valid YAML"
    NO_SEQUENCE = "the file is not a sequence"
    DROPPED = "an entry is left out"
    UNKNOWN_KEY = "a key is ignored"


class BridgeFault(Record, eq=False):
    """One fault of an argument or a file.

    Attributes:
        message: The whole sentence.
        meant: What to write in its place; empty if it is not known.
    """

    kind: BridgeFaultKind
    span: Span
    message: str
    meant: str = ""

    @property
    def is_elsewhere(self) -> bool:
        """True if it is in another package than the one that is checked."""
        return self.span.source.file.startswith("../")


class Passed(Record, eq=False):
    """One topic as an argument or an entry writes it.

    Attributes:
        gz_topic: The topic on Gazebo's side.
        ros_topic: The topic on ROS's side, before remaps.
        ros_type: The type, such as `sensor_msgs/msg/Imu`.
        gz_type: The type, such as `gz.msgs.IMU`.
        direction: The direction of messages.
        way: The place of the direction.
        overrides_frame: Whether the bridge puts another frame into the messages.
    """

    gz_topic: Located[str]
    ros_topic: Located[str]
    ros_type: Located[str]
    gz_type: Located[str]
    direction: Direction
    way: Span
    overrides_frame: bool = False


class BridgedService(Record, eq=False):
    """One service as an argument or an entry writes it.

    Attributes:
        name: The name on both sides.
        ros_type: The type, such as `ros_gz_interfaces/srv/ControlWorld`.
        gz_types: Gazebo's messages of request and reply, as far as they are stated.
    """

    name: Located[str]
    ros_type: Located[str]
    gz_types: tuple[Located[str], ...] = ()

    @property
    def is_own(self) -> bool:
        """True if it is written in the package that is checked."""
        return not self.ros_type.span.source.file.startswith("../")


class BridgeEntry(Record, eq=False):
    """One topic that a bridge passes.

    Attributes:
        passed: The name as it is written.
        gz_topic: Absolute, on Gazebo's side; empty if it is not known before the launch.
        ros_topic: Absolute, on ROS's side, after remaps; empty if it is not known.
        remapped: Whether a remap gives it another name in ROS.
        node: The node that bridges it; None for a file that no available launch file names.
    """

    passed: Passed
    gz_topic: str
    ros_topic: str
    remapped: bool
    node: Node | None

    @property
    def gz_name(self) -> str:
        """The Gazebo message without its package: `IMU`."""
        return gz_name(self.passed.gz_type.value)

    @property
    def direction(self) -> Direction:
        """Direction of the messages."""
        return self.passed.direction

    @property
    def counts(self) -> bool:
        """True if it is bridged with the defaults of all arguments."""
        return self.node is None or self.node.starts is True

    @property
    def is_own(self) -> bool:
        """True if it is written in the package that is checked."""
        return not self.passed.gz_type.span.source.file.startswith("../")


def gz_name(gz_type: str) -> str:
    """Return a Gazebo message without its package; as it is where it has another one."""
    prefix = next((p for p in GZ_PREFIXES if gz_type.startswith(p)), "")
    return gz_type.removeprefix(prefix)


def named_file(argument: str) -> str:
    """Return the path of the YAML file that an argument is meant to give; empty if it is none."""
    found = _FILE.match(argument)
    return found[1] if found else ""


def read_argument(word: Located[str]) -> Passed | BridgedService | BridgeFault:
    """Read an argument of `parameter_bridge`."""

    def fault(reason: str, expected: str = f"expected {_GRAMMAR}") -> BridgeFault:
        reason = f"{reason}; {expected}"
        return BridgeFault(
            BridgeFaultKind.ARGUMENT,
            word.span,
            f"parameter_bridge ends at the argument {display_path(word.value)!r:.200}: {reason}",
        )

    if file := named_file(word.value):
        name = file.rpartition("/")[2]
        cure = f"write '--ros-args', '-p', 'config_file:=…/{name}'"
        return fault("it is a file, not a topic", cure)
    topic, at, rest = word.value.partition("@")
    if not (topic and at):
        return fault("it names no topic" if at else "it has no '@'")
    if _SERVICE.search(rest):
        kind, *messages = (Located(text, word.span) for text in rest.split("@"))
        return BridgedService(Located(topic, word.span), kind, tuple(messages))
    # The program looks for a second @ first, then for [, then for ].
    mark = next((mark for mark in MARKS if rest.find(mark) > 0), None)
    if mark is None:
        return fault("it has no second '@', '[' or ']' between the types")
    ros_type, _, gz_type = rest.partition(mark)
    if not gz_type or any(other in gz_type for other in MARKS):
        return fault("it names no message of Gazebo" if not gz_type else "it has too many marks")

    def located(text: str) -> Located[str]:
        return Located(text, word.span)

    return Passed(
        located(topic), located(topic), located(ros_type), located(gz_type), MARKS[mark], word.span
    )
