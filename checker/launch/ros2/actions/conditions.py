"""Conditions of launch actions, with the defaults of arguments."""

from __future__ import annotations

from collections.abc import Iterator

from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import Condition, LaunchFaultKind, display_path, is_known
from checker.launch.ros2.substitutions import perform, truth_of
from checker.launch.ros2.values import Made, Unknown, Value, chosen_value, span_of
from checker.source.text import Located


def read_conditions(made: Made, context: Context) -> Iterator[Condition]:
    """Yield the condition of an action, with the defaults of arguments."""
    condition = chosen_value(made.values["condition"])
    if isinstance(condition, Unknown):
        yield Condition(Located(condition.reason, condition.span), wanted=True, holds=None)
        return
    if not isinstance(condition, Made):
        span = span_of(condition, made.span)
        yield Condition(Located("a condition", span), wanted=True, holds=None)
        return
    enabling_truth = condition.name not in ("UnlessCondition", "LaunchConfigurationNotEquals")
    if "predicate_expression" in condition.values:
        value = condition.values["predicate_expression"]
    else:
        value = _comparison(condition)
    text = perform(value, context, condition.span)
    if isinstance(text, Unknown):
        located = Located(text.reason, condition.span)
        yield Condition(located, enabling_truth, None)
        return
    truth = truth_of(text) if is_known(text) else None
    written = isinstance(chosen_value(value), str)
    if truth is None and is_known(text):
        message = f"the condition is {display_path(text)[:80]!r}: expected true, false, 1 or 0"
        context.fault(LaunchFaultKind.CONDITION, condition.span, message, str(text)[:80])
    holds = None if truth is None else truth is enabling_truth
    yield Condition(Located(str(text), condition.span), enabling_truth, holds, written)


def _comparison(condition: Made) -> Made:
    """Return the comparison that an older condition makes."""
    values = condition.values
    left: Value = values.get("left")
    right: Value = values.get("right")
    if "launch_configuration_name" in values:
        name = values["launch_configuration_name"]
        left = Made("LaunchConfiguration", {"variable_name": name, "default": ""}, condition.span)
        right = values.get("expected_value")
    return Made("EqualsSubstitution", {"left": left, "right": right}, condition.span)
