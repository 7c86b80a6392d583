"""A process of little memory that evaluates hostile expressions: prints what became of each."""

from __future__ import annotations

import json
import resource
import sys
from pathlib import Path
from time import process_time
from typing import Any

import xacro

from checker.formats.xacro.expression.bounds import Budget
from checker.formats.xacro.expression.builtins import FUNCTIONS
from checker.formats.xacro.expression.evaluation import evaluate
from checker.formats.xacro.symbols import global_symbols
from checker.formats.xacro.yaml_values import read
from tests.effort import slowness
from tests.xacro import hostile_expressions as hostile

MEMORY = 200_000_000


def names() -> dict[str, Any]:
    """Return the names of a xacro file, with a few values; new ones, since some are changed."""

    def load_yaml(name: str, budget: Budget) -> Any:
        if name not in hostile.YAML:
            raise FileNotFoundError(name)
        return read(hostile.YAML[name], budget)

    return {
        **FUNCTIONS,
        **global_symbols(load_yaml),
        "p": [3, 1, 2],
        "d": {"a": 1},
        "y": xacro.YamlDictWrapper(a={"b": [1]}),
        "yl": xacro.YamlListWrapper([{"b": 1}]),
    }


def outcome(expression: str) -> tuple[str, str, float]:
    """Return the name of what came or was raised, what it says, and the processor's seconds."""
    found = names()
    started = process_time()
    try:
        value = evaluate(expression, found)
        kind, said = "value", repr(value)[:80]
    except Exception as error:  # noqa: BLE001 - whatever it is
        kind, said = type(error).__name__, str(error)[:200]
    return kind, said, process_time() - started


def measured(field: str) -> int:
    """Return bytes of memory of this process, by the name that Linux has for them."""
    status = Path("/proc/self/status").read_text("ascii").splitlines()
    return next(int(line.split()[1]) for line in status if line.startswith(f"{field}:")) * 1024


if __name__ == "__main__":
    xacro.substitution_args_context["arg"] = {}
    used = measured("VmSize")
    resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
    before = measured("VmRSS")
    groups = (hostile.REFUSED, hostile.LIMITED, hostile.ERRORS)
    done = [[outcome(each) for each in group] for group in groups]
    grown = measured("VmHWM") - before
    json.dump({"done": done, "grown": grown, "slowness": slowness()}, sys.stdout)
