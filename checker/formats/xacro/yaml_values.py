"""Reads YAML as `load_yaml` of xacro does, bounded: aliases and merges may not explode."""

from __future__ import annotations

import io
import re
from typing import Any

import yaml
from xacro import ConstructUnits, YamlListWrapper

from checker.formats.xacro.expression.bounds import Budget, ExpressionLimit
from checker.formats.xacro.expression.values import weigh

LENGTH_LIMIT = 50_000
"""Characters of one file."""
NODES_LIMIT = 10_000
"""Values and keys of one file, those that merging adds included."""
_LEVELS_LIMIT = 50
_NUMBER_LIMIT = 400
"""Characters of a number."""
_MERGE = "tag:yaml.org,2002:merge"
_NUMBERS = ("tag:yaml.org,2002:int", "tag:yaml.org,2002:float")


class _Loader(yaml.SafeLoader):
    """PyYAML's loader of plain values, which counts the nodes that it makes."""

    nodes = 0
    levels = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        self._count(1)
        self.levels += 1
        _check_levels(self.levels)
        node: Any = super().compose_node(parent, index)
        self.levels -= 1
        is_number = isinstance(node, yaml.ScalarNode) and node.tag in _NUMBERS
        if is_number and len(node.value) > _NUMBER_LIMIT:
            raise ExpressionLimit(f"reads a number of more than {_NUMBER_LIMIT} characters")
        return node

    def flatten_mapping(self, node: Any) -> None:
        for key, value in node.value:
            if key.tag == _MERGE:
                merged = value.value if isinstance(value, yaml.SequenceNode) else [value]
                for part in merged:
                    if isinstance(part, yaml.MappingNode):
                        self.flatten_mapping(part)
                        self._count(len(part.value))
        super().flatten_mapping(node)

    def _count(self, nodes: int) -> None:
        self.nodes += nodes
        if self.nodes > NODES_LIMIT:
            raise ExpressionLimit(f"reads YAML of more than {NODES_LIMIT} values")


for _unit in ConstructUnits:
    _Loader.add_constructor(_unit.value.tag, _unit.constructor)


def read(text: str, budget: Budget) -> Any:
    """Return what a YAML text contains, wrapped as xacro does.

    Raises:
        ExpressionLimit: It is too long or contains too much.
        RefusedExpression: It contains values that expressions do not need, such as `!!binary`.
        yaml.YAMLError: It is no YAML, or has a tag that nothing is known of.
    """
    if len(text) > LENGTH_LIMIT:
        raise ExpressionLimit(f"reads YAML of more than {LENGTH_LIMIT} characters")
    budget.spend(len(text))
    _check_brackets(text)
    value = yaml.load(io.StringIO(text), _Loader)  # noqa: S506 - a loader of plain values
    weigh(value, budget)
    return YamlListWrapper.wrap(value)


def _check_levels(levels: int) -> None:
    if levels > _LEVELS_LIMIT:
        raise ExpressionLimit(f"reads YAML that is nested more than {_LEVELS_LIMIT} levels deep")


def _check_brackets(text: str) -> None:
    """Count brackets before they are read, for which PyYAML takes the square of their number."""
    levels = 0
    for bracket in re.findall(r"[\[{\]}]", text):
        levels = levels + 1 if bracket in "[{" else max(levels - 1, 0)
        _check_levels(levels)
