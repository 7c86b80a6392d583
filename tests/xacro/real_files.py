"""Real xacro files, expanded with each expression evaluated twice: here, and by Python."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from checker.base.forked_work import run_in_fork
from checker.base.parts import WorkerFailed
from checker.formats.xacro.files import Gathered, path_of
from checker.package.inputs import open_input
from checker.package.package import Package

_SECONDS = 20
_ROUNDS = 6
Request = dict[str, Any]


def packages_in(folder: Path) -> list[Path]:
    """Return the folders of packages that hold xacro files."""
    found = {path.parent for path in folder.rglob("package.xml")}
    found |= {path.parent for path in folder.rglob("model.config")}
    return [path for path in sorted(found) if any(path.rglob("*.xacro"))]


def requests(folder: Path) -> Iterator[tuple[Gathered, str]]:
    """Yield each xacro file of the packages below a folder, with what it includes."""
    for path in packages_in(folder):
        with open_input(path) as opened:
            for package in opened.packages:
                yield from _of_package(package)


def _of_package(package: Package) -> Iterator[tuple[Gathered, str]]:
    for file in package.index.with_suffix(".xacro", ".urdf"):
        gathered = Gathered(package)
        path = path_of(package, file.path)
        gathered.follow([path])
        if path in gathered.documents and "$" in gathered.sources[path].text:
            yield gathered, path


def compared(gathered: Gathered, path: str) -> dict[str, Any]:
    """Return `number` of expressions evaluated for a file, and those that differ, as `others`."""
    for _ in range(_ROUNDS):
        request = gathered.request
        result = run_in_fork(lambda request=request: _compare(request, path), _SECONDS)  # type: ignore[misc]
        assert not isinstance(result, WorkerFailed), (path, result)
        found: dict[str, Any] = json.loads(result)
        if "missing" not in found:
            return found
        gathered.follow([found["missing"]])
    return found


def _compare(request: Request, path: str) -> bytes:
    from checker.formats.xacro import processor
    from tests.xacro import oracle

    native = processor.evaluate
    found: dict[str, Any] = {"number": 0, "others": []}

    def both(text: str, names: Any, allowance: Any) -> Any:
        expected = oracle.native_outcome(text, names)
        try:
            value = native(text, names, allowance)
        except Exception as error:
            _note(found, text, expected, type(error).__name__)
            raise
        _note(found, text, expected, oracle.shown(value))
        return value

    processor.evaluate = both
    oracle.read_yaml_as(request["texts"])
    outcome = processor.expand(request, path, {})
    if "missing" in outcome:
        found["missing"] = outcome["missing"]
    return json.dumps(found).encode()


def _note(found: dict[str, Any], text: str, expected: str, here: str) -> None:
    found["number"] += 1
    if here != expected:
        found["others"].append((text, expected, here))
