"""An input of robot_localization that is not used as it is written.

The filter takes the topics `odom0`, `odom1`, … (`imu`, `pose`, `twist` likewise) until a number is
missing. With each belongs `odom0_config`: fifteen truth values in five rows, for x y z, roll pitch
yaw, their velocities, and the accelerations. The node does not count them: of a shorter list it
reads on behind the end, and the sensor's use is left to chance. Numbers or texts in place of truth
values end the node. A topic without a list is not used ("all update variables are false"), nor is
a list without a topic: an info where the topic is commented out in the file, as of a sensor that is
not used for now.

Fix: write fifteen of `true` and `false`; number the topics from 0 without a gap.
Source: robot_localization, src/ros_filter.cpp, `loadUpdateConfig` and `loadParams`.
"""

import re
from collections.abc import Collection, Iterator

from checker.model.ros_parameters import NodeBlock, Parameter
from checker.package.package import Package
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

_CONFIG = re.compile(r"((?:odom|imu|pose|twist)\d{1,3})_config\Z")
_TOPIC = re.compile(r"(odom|imu|pose|twist)(\d{1,3})\Z")
_VALUES = 15


@rule("WIR025", "invalid-filter-input", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report lists that are not of fifteen truth values, and what is without its other half."""
    blocks = [
        block
        for file in package.index.with_suffix(".yaml", ".yml")
        for block in blocks_in(package, file.path, "_config")
        if any(map(_CONFIG.match, block.parameters))
    ]
    given = {name for block in blocks for name in block.parameters}
    launched = package.workspace.launch_words
    for block in blocks:
        for name, parameter in block.parameters.items():
            if match := _CONFIG.match(name):
                yield from _judged(block.node, name, parameter)
                is_used = parameter.type != "bool_array" or _is_used(parameter)
                if match[1] not in {*given, *launched} and is_used:
                    yield _without_topic(block.node, match[1], parameter)
        yield from _unused_topics(block, given | launched)


def _without_topic(node: str, topic: str, parameter: Parameter) -> Finding:
    """Return the finding of a list whose topic is missing."""
    lines = map(str.strip, parameter.key.source.text.splitlines())
    left_out = any(it.startswith("#") and it.lstrip("# ").startswith(f"{topic}:") for it in lines)
    lack = f"{topic} is commented out" if left_out else f"there is no {topic}"
    return finding(
        parameter.key,
        f"{node} does not use {parameter.name}: {lack}; write `{topic}:` with the topic",
        severity=Severity.INFO if left_out else None,
    )


def _judged(node: str, name: str, parameter: Parameter) -> Iterator[Finding]:
    items = parameter.node.items
    if parameter.node.kind != "sequence" or not parameter.is_known or not items:
        return
    if parameter.type not in ("bool_array", ""):
        yield finding(
            parameter,
            f"{node} ends when it starts: {name} is a list of {parameter.type[:-6]} values, "
            f"expected {_VALUES} of true and false",
            severity=Severity.ERROR,
            key=name,
        )
    elif len(items) != _VALUES:
        effect = (
            "what is behind the end is left to chance"
            if len(items) < _VALUES
            else "the others are not read"
        )
        yield finding(
            parameter,
            f"{name} of {node} has {len(items)} values, expected {_VALUES}, in five rows of "
            f"three: {effect}",
            key=name,
        )


def _is_used(parameter: Parameter) -> bool:
    return any(item.scalar is True for item in parameter.node.items)


def _unused_topics(block: NodeBlock, given: Collection[str]) -> Iterator[Finding]:
    for topic, parameter in block.parameters.items():
        match = _TOPIC.match(topic)
        if match is None or not parameter.texts:
            continue
        before = (f"{match[1]}{number}" for number in range(int(match[2])))
        missing = next((it for it in before if it not in given), "")
        if missing:
            cause = f"there is no {missing}, and the node reads no number after a missing one"
        elif f"{topic}_config" not in given:
            cause = f"write `{topic}_config:` with {_VALUES} of true and false"
        else:
            continue
        yield finding(parameter.key, f"{block.node} does not use {topic}: {cause}")


_ROW = "false, false, false"


def _filter(more: str, mark: str = "", rows: int = 5) -> dict[str, object]:
    values = ", ".join([_ROW] * (rows - 1) + ["true, false, false"])
    return {
        "@bridge": True,
        "config/ekf.yaml": f"""ekf_filter_node:
  ros__parameters:
    two_d_mode: true
    imu0: imu/data
    imu0_config: [{values}]{mark}
    {more}
""",
    }


_MARK = "  # ^ WIR025"
GOOD = [
    _filter("frequency: 30.0"),
    _filter(f"odom0: odom\n    odom0_config: [{', '.join([_ROW] * 5)}]"),
    _filter(f"odom0_config: [{', '.join([_ROW] * 5)}]"),
]
BAD = [
    _filter("frequency: 30.0", _MARK, rows=4),
    _filter("frequency: 30.0", _MARK, rows=6),
    _filter(f"odom0: odom{_MARK}"),
    _filter(f"odom0_config: [{', '.join(['1, 0, 0'] * 5)}]{_MARK}\n    odom0: odom"),
    _filter(f"odom0_config: [{', '.join(['true, true, true'] * 5)}]{_MARK}"),
    _filter(f"imu2: imu/raw{_MARK}"),
    _filter(f"#odom0: odom\n    odom0_config: [{', '.join(['true, true, true'] * 5)}]{_MARK}"),
]
