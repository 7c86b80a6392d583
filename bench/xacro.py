"""Seconds to expand all real xacro files: expressions evaluated here, and by xacro's own `eval`.

Run with `python -m bench.xacro` from the top folder; SUBT_CHECK_CORPUS, SUBT_CHECK_REVIEWS and
SUBT_CHECK_MODERN name folders of real packages, the samples are used without it. Machines
differ and are shared: compare the ratio, not seconds.
"""

from __future__ import annotations

import json
import os
import statistics
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

from checker.base.forked_work import run_in_fork
from checker.base.parts import WorkerFailed
from checker.formats.xacro.files import Gathered, path_of
from checker.package.inputs import open_input

ROOT = Path(__file__).parent.parent
FOLDERS = ("SUBT_CHECK_CORPUS", "SUBT_CHECK_REVIEWS", "SUBT_CHECK_MODERN")
RATIO = 1.5
"""Greatest time of the expansion, as a factor of that of xacro."""
REPEATS = 5
_SECONDS = 20
Request = tuple[dict[str, Any], str]


def by_interpreter() -> None:
    """Evaluate as the checker does."""


def by_python() -> None:
    """Evaluate as xacro does; only for files that one trusts, and in its own process."""
    import xacro

    from checker.formats.xacro import processor
    from checker.formats.xacro.expression.bounds import Budget

    safe_eval, create_global_symbols = xacro.safe_eval, xacro.create_global_symbols

    def symbols(load_yaml: Callable[[str, Budget], Any]) -> Any:
        xacro.load_yaml = lambda filename: load_yaml(filename, Budget())
        return create_global_symbols()

    processor.global_symbols = symbols
    processor.evaluate = lambda text, names, _: safe_eval(text, names)


def requests(folder: Path) -> list[Request]:
    """Return what the xacro files of the packages below a folder need, and their paths."""
    found = []
    for manifest in sorted(folder.rglob("package.xml")):
        if not any(manifest.parent.rglob("*.xacro")):
            continue
        with open_input(manifest.parent) as opened:
            for package in opened.packages:
                for file in package.index.with_suffix(".xacro", ".urdf"):
                    gathered = Gathered(package)
                    path = path_of(package, file.path)
                    gathered.follow([path])
                    if path in gathered.documents and "$" in gathered.sources[path].text:
                        found.append((gathered.request, path))
    return found


def seconds(request: Request, way: Callable[[], None]) -> tuple[float, bool]:
    """Return how long expanding a file takes in its own process, and whether it succeeds."""

    def work() -> bytes:
        import xacro

        from checker.formats.xacro import processor

        xacro.warning = xacro.print_location = lambda *_, **__: None
        way()
        started = process_time()
        outcome = processor.expand(*request, {})
        return json.dumps([process_time() - started, "xml" in outcome]).encode()

    result = run_in_fork(work, _SECONDS)
    if isinstance(result, WorkerFailed):
        raise SystemExit(f"{request[1]} {result.reason}")
    taken, succeeds = json.loads(result)
    return float(taken), bool(succeeds)


def main() -> None:
    """Print the medians and their ratio."""
    import_module("checker.formats.xacro.processor")  # once, before the forks
    named = [Path(os.environ[name]) for name in FOLDERS if os.environ.get(name)]
    found = [each for folder in named or [ROOT / "samples"] for each in requests(folder)]
    found = [each for each in found if seconds(each, by_interpreter)[1]]
    started = perf_counter()
    totals: dict[str, list[float]] = {"interpreter": [], "xacro's own eval": []}
    for _ in range(REPEATS):
        # One after the other for each file: what else the machine does meets both.
        pairs = [(seconds(each, by_interpreter)[0], seconds(each, by_python)[0]) for each in found]
        for total, part in zip(totals.values(), zip(*pairs, strict=True), strict=True):
            total.append(sum(part))
    medians = {name: statistics.median(total) for name, total in totals.items()}
    print(f"{len(found)} files, {REPEATS} times in {perf_counter() - started:.0f} s")
    for name, median in medians.items():
        print(f"{name:20} {median:8.3f} s")
    here, python = medians.values()
    print(f"{'ratio':20} {here / python:8.2f}   (at most {RATIO:g})")


if __name__ == "__main__":
    main()
