"""A parameter or remap in the command line of a node that ROS 2 cannot read.

Behind `--ros-args`, the word after `-p` or `-r` is `name:=value`. The node ends at its start with
`Couldn't parse parameter override rule` (or `remap rule`) if `:=` is missing, or the name starts
with a dash.

Fix: write `-p name:=value`, `-r from:=to`, as two words. In a launch file, `parameters` and
`remappings` of the node do the same.
Source: rcl, `rcl_parse_arguments`; ROS 2 design, "ROS command line arguments".
"""

import re
from collections.abc import Iterator
from itertools import pairwise

from checker.launch.ros2.graph import Node, Ros2Launch, display_path, is_known
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located

_START, _END = "--ros-args", "--"
_KINDS = {"-p": "name", "--param": "name", "-r": "from", "--remap": "from"}
"""Options with an assignment, and what stands in front of `:=` there."""
_ASSIGNED = re.compile(r"\s*:?\s*=\s*|:\s+")


@rule("LCH031", "unreadable-ros-argument", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report words behind `-p` and `-r` that are no assignment."""
    for graph in launch.entries:
        for node in graph.nodes:
            for option, word in pairwise(_ros_arguments(node)):
                if option.value in _KINDS and not _is_read(word.value):
                    yield finding(
                        word,
                        f"{node.executable.value} ends at its start, since it cannot read "
                        f"'{option.value} {display_path(word.value):.150}': "
                        f"write {option.value} {_meant(word.value, _KINDS[option.value])}",
                    )


def _ros_arguments(node: Node) -> Iterator[Located[str]]:
    """Yield the words behind `--ros-args`."""
    for_ros = False
    for word in node.arguments:
        if word.value in (_START, _END):
            for_ros = word.value == _START
        elif for_ros:
            yield word


def _is_read(text: str) -> bool:
    """Return whether a word may be an assignment; true if it is not known before the launch."""
    if text.startswith("-"):
        return False
    return ":=" in text.lstrip(":") or not is_known(text)


def _meant(text: str, kind: str) -> str:
    """Return the assignment that a word is meant as."""
    name, *value = _ASSIGNED.split(text.lstrip("-"), maxsplit=1)
    if not (name and value):
        return f"{kind}:=value" if kind == "name" else f"{kind}:=to"
    return f"{name}:={display_path(value[0]):.150}"


_NODE = "        Node(package='acme_arm', executable='guard', arguments=['--ros-args', @]),"


def _given(words: str, mark: str = "") -> dict[str, object]:
    return {"@ros2": f"{_NODE.replace('@', words)}{mark}"}


_MARK = "  # ^ LCH031"
GOOD = [
    _given("'-p', 'rate:=10', '-r', 'cmd_vel:=/arm/cmd_vel'"),
    _given("'--param', ['config:=', in_package('config', 'arm.yaml')], '--log-level', 'debug'"),
    _given("'-p', LaunchConfiguration('more')"),
    _given("'-p', 'rate:=10', '--', '-p', 'plain'"),
]
BAD = [
    _given("'-p', '-rate:=10'", _MARK),
    _given("'-p', 'rate=10'", _MARK),
    _given("'--remap', 'cmd_vel'", _MARK),
    _given("'-r', '-p', 'rate:=10'", _MARK),
    {
        "@ros2": True,
        "launch/guard.launch.xml": """<launch>
  <node pkg="acme_arm" exec="guard" args="--ros-args -p -rate=10"/> <!-- ^ LCH031 -->
</launch>
""",
    },
]
