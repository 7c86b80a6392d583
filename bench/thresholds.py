"""Compare the numbers in rules with the values of real robots.

Run with `python -m bench.thresholds FOLDER [--only RULE,…]` from the top folder. Each rule that
compares a value with a number is run with options that make it report every value; the values are
read from its messages. So they are what the rule compares, without the values that it skips. FOLDER
gets one page a rule, with the values, those that are judged and the numbers drawn in; a table of
the values beyond each number is printed.

Robots: submissions (SUBT_CHECK_CORPUS), packages of ROS 2 and Gazebo (SUBT_CHECK_MODERN) and the
URDF files of example-robot-data on PyPI (installed, or SUBT_CHECK_URDFS). Verdicts: support/judged.
"""

from __future__ import annotations

import argparse
import sys
from collections import defaultdict
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

from bench.distribution import Distribution, Value, page
from bench.measures import MEASURES, Measure
from checker.finding import Place
from checker.pipeline import check_package
from checker.rulebook.discovery import all_rules
from checker.settings import Settings
from support.judgements import folder_of, judgements

PROFILES = {"corpus": "subt", "modern": "", "urdf": "urdf"}
"""Profiles by source of packages; without one, the content of a package decides."""
_FAULTS = "bugs/*/before"
_NO_ROBOTS = ("bugs", "repro")
ROW = "{:<7} {:<24} {:>9} {:>6} {:>7} {:>5} {:>9} {:>6} {:>8} {:>10} {:>10}"
HEAD = ("number", "values", "beyond", "true", "arguable", "false", "unjudged", "last", "first")

Key = tuple[str, str, int]
Options = dict[str, dict[str, Any]]


def packages(source: str) -> list[Path]:
    """Return the paths to check of a source of packages."""
    root = folder_of(source)
    if root is None:
        return []
    if source == "urdf":
        return sorted(root.rglob("*.urdf"))
    folders = [path for path in root.iterdir() if path.is_dir() and path.name not in _NO_ROBOTS]
    return sorted([*folders, *root.glob(_FAULTS)])


def verdicts() -> dict[Key, str]:
    """Return what is judged, by rule, file and line."""
    known: dict[Key, str] = {}
    for source in PROFILES:
        root = folder_of(source)
        for each in judgements(source) if root is not None else ():
            assert root is not None
            checked = root / each.path
            folder = checked if checked.is_dir() else checked.parent
            file = str((folder / each.place.file).resolve())
            known[each.place.rule, file, each.place.line] = each.verdict
    return known


def rounds(measures: Sequence[Measure]) -> list[Options]:
    """Return options for as many runs as the rule needs that is measured in most ways."""
    ways: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for measure in measures:
        if measure.options not in ways[measure.rule]:
            ways[measure.rule].append(measure.options)
    most = max(map(len, ways.values()), default=0)
    return [
        {rule: options[number] for rule, options in ways.items() if number < len(options)}
        for number in range(most)
    ]


Said = tuple[str, str, str, Place]
"""Rule, message, file and place."""


def said(path: Path, profile: str, options: Options) -> list[Said]:
    """Return what rules report of a package, place by place."""
    settings = Settings(select=tuple(options), options=options, trial=False)
    if profile:
        settings = settings.with_overrides(profile=profile)
    return [
        (finding.rule, place.message or finding.message, _file(package.path, place), place)
        for package in check_package(path, settings).packages
        for finding in package.findings
        for place in finding.places
        if not place.note
    ]


def _file(folder: str, place: Place) -> str:
    return str((Path(folder) / place.file).resolve())


def distributions(measures: Sequence[Measure]) -> list[Distribution]:
    """Measure all packages that are there."""
    known, options = verdicts(), rounds(measures)
    numbers = {rule.id: rule.options for rule in all_rules()}
    tasks = [
        (path, profile, each)
        for source, profile in PROFILES.items()
        for path in packages(source)
        for each in options
    ]
    values: dict[Measure, dict[tuple[str, str], Value]] = {measure: {} for measure in measures}
    with ProcessPoolExecutor() as pool:
        results = pool.map(said, *zip(*tasks, strict=True)) if tasks else ()
        for (_, _, used), found in zip(tasks, results, strict=True):
            for rule, message, file, place in found:
                for measure in measures:
                    value = measure.of(rule, message) if used[rule] == measure.options else None
                    if value is not None:
                        verdict = known.get((rule, file, place.line), "")
                        text = f"{file}:{place.line} {message}"
                        # The same part of another version of a robot adds nothing.
                        part = (Path(file).name, message)
                        if verdict or part not in values[measure]:
                            values[measure][part] = Value(value, verdict, text)
    return [
        Distribution(
            measure,
            {name: float(numbers[measure.rule][name]) for name in measure.numbers},
            tuple(sorted(values[measure].values(), key=lambda each: each.number)),
        )
        for measure in measures
    ]


def table(found: Sequence[Distribution]) -> Iterator[str]:
    """Yield a line for each number of each rule."""
    yield ROW.format("rule", "option", *HEAD)
    for each in found:
        for name, number in each.numbers.items():
            beyond, within = each.parted(name)
            counts = [
                sum(value.verdict == verdict for value in beyond)
                for verdict in ("true", "arguable", "false", "")
            ]
            last, first = (f"{side[0].number:.3g}" if side else "-" for side in (within, beyond))
            yield ROW.format(
                each.measure.rule, name, f"{number:g}", len(each.values), len(beyond), *counts,
                last, first,
            )  # fmt: skip


def main() -> int:
    """Write a page for each rule and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    only = {*arguments.only.split(",")} - {""}
    found = distributions([each for each in MEASURES if not only or each.rule in only])
    if not any(each.values for each in found):
        print("no values: the variables name no folders of real packages")
        return 2
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for rule in dict.fromkeys(each.measure.rule for each in found):
        own = [each for each in found if each.measure.rule == rule]
        (arguments.folder / f"{rule}.html").write_text(page(rule, own), "utf-8")
    print(*table(found), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
