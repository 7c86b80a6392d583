"""Code in a spawner that has no effect.

A variable that nothing reads, or a condition that is always the same, is usually left over from
another robot's spawner, and hides what this one does.

Fix: remove the variable, or the branch that is never taken.
Source: SubT review findings. No accepted package that we checked has this fault.
"""

from collections import Counter
from collections.abc import Iterator, Sequence

from checker.launch.spawner.reader import Spawner
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.ruby import RubyNode

_ASSIGNMENTS = ("assignment", "operator_assignment")
_BRANCHES = ("if", "elsif", "unless", "if_modifier", "unless_modifier", "conditional")
_LITERALS = ("true", "false", "nil", "integer", "float", "string", "simple_symbol")
_OPERATIONS = ("binary", "unary", "parenthesized_statements")
_READING_ALL = ("binding", "eval", "local_variables")
"""Methods that use variables without naming them."""


@rule("SPW011", "leftover-code", Severity.WARNING, Concern.PAPERWORK)
def check(spawner: Spawner) -> Findings:
    """Report unused variables and constant conditions in the package's own Ruby files."""
    for tree in spawner.trees:
        nodes = tree.walk()
        if tree.source.file.startswith("../") or any(n.type == "ERROR" for n in nodes):
            continue
        for method in _methods(nodes):
            yield from _judge(method)


def _methods(nodes: Sequence[RubyNode]) -> Iterator[RubyNode]:
    """Yield the methods, in order; nested ones belong to the outer one."""
    end = 0
    for node in nodes:
        if node.type == "method" and node.start >= end:
            end = node.end
            yield node


def _judge(method: RubyNode) -> Iterator[Finding]:
    nodes = method.walk()
    assigned = [node for node in nodes if node.type in _ASSIGNMENTS and _target(node)]
    written = {node.fields["left"].start for node in assigned}
    read = {
        node.text.rstrip(":")
        for node in nodes
        if node.type in ("identifier", "hash_key_symbol") and node.start not in written
    }
    if not read.intersection(_READING_ALL):
        yield from _unused_variables(method, assigned, read)
    constants = _constants(assigned)
    for node in nodes:
        condition = node.fields.get("condition") if node.type in _BRANCHES else None
        if condition is not None and _is_constant(condition, constants):
            yield finding(condition, f"the condition {condition.text[:60]!r} is always the same")


def _target(assignment: RubyNode) -> str:
    """Return the local variable that is set; empty for anything else."""
    left = assignment.fields.get("left")
    return left.text if left is not None and left.type == "identifier" else ""


def _unused_variables(
    method: RubyNode, assigned: list[RubyNode], read: set[str]
) -> Iterator[Finding]:
    # The value of the last statement is what the method returns.
    last = method.fields["body"].parts[-1:] if "body" in method.fields else []
    for node in assigned:
        name = _target(node)
        returned = any(block.start <= node.start < block.end for block in last)
        if name not in read and not name.startswith("_") and not returned:
            yield finding(node, f"variable {name!r} is never used", key=f"unused {name}")


def _constants(assigned: list[RubyNode]) -> set[str]:
    """Return the variables that are set once, to a literal."""
    times = Counter(map(_target, assigned))
    return {
        _target(node)
        for node in assigned
        if times[_target(node)] == 1 and node.fields["right"].type in _LITERALS
    }


def _is_constant(condition: RubyNode, constants: set[str]) -> bool:
    """Return whether a condition contains only literals and constant variables."""
    waiting = [condition]
    while waiting:
        node = waiting.pop()
        if node.type in _OPERATIONS:
            waiting.extend(node.parts)
        elif node.type not in _LITERALS and node.text not in constants:
            return False
    return True


def _spawner(*lines: str) -> str:
    inside = "\n  ".join(lines)
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  {inside}
  "<spawn name='#{{_name}}'>#{{more}}</spawn>"
end

def rosExecutables(_name, _worldName)
  ""
end
"""


GOOD = [
    {"launch/spawner.rb": _spawner("more = ''", "more = '<a/>' if $enableGroundTruth")},
    {"launch/spawner.rb": _spawner("lidar = 3", "more = lidar > 2 && _x > 1 ? '<a/>' : ''")},
]
BAD = [
    {"launch/spawner.rb": _spawner("more = ''", "base = 0.3 # ^ SPW011")},
    {"launch/spawner.rb": _spawner("config = 6", "more = config == 6 ? 'a' : '' # ^ SPW011")},
]
