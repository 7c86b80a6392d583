"""What each type of node means: the whole subset on one screen."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from checker.expand.spawner.evaluator.assignment import VARIABLES
from checker.expand.spawner.evaluator.calls import CALLS
from checker.expand.spawner.evaluator.expressions import EXPRESSIONS
from checker.expand.spawner.evaluator.interpreter import Handler
from checker.expand.spawner.evaluator.operators import OPERATORS
from checker.expand.spawner.evaluator.statements import STATEMENTS

HANDLERS: Mapping[str, Handler] = MappingProxyType(
    {**EXPRESSIONS, **VARIABLES, **OPERATORS, **STATEMENTS, **CALLS}
)
