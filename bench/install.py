"""Measure the size of an installation and the time to its first finding.

Run with `python -m bench.install`. Builds the wheel and installs it into new virtual environments,
first without extras, then with physics. What pip fetches counts: run it twice, so that its cache
contains all.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

ROOT = Path(__file__).parent.parent
SAMPLE = ROOT / "samples/broken_acme_scout"
EXTRAS = ("", "[physics]")


def timed(command: Sequence[str | Path], **environment: str) -> float:
    """Run a command, and return the seconds that it takes; findings are no failure."""
    started = perf_counter()
    done = subprocess.run(
        command, env=os.environ | environment, capture_output=True, text=True, check=False
    )
    assert done.returncode in (0, 1), done.stdout + done.stderr
    return perf_counter() - started


def main() -> None:
    """Print a line for each way to install."""
    print(f"{'extras':<12}{'install':>10}{'first check':>14}{'again':>10}{'size':>10}")
    with TemporaryDirectory() as folder:
        build = [sys.executable, "-m", "build", "--wheel", "--outdir", folder, ROOT]
        timed(build)
        (wheel,) = Path(folder).glob("*.whl")
        for extra in EXTRAS:
            _measure(Path(folder), wheel, extra)


def _measure(folder: Path, wheel: Path, extra: str) -> None:
    environment = folder / f"environment{extra}"
    timed([sys.executable, "-m", "venv", "--without-pip", environment])
    python = environment / "bin/python"
    pip = [sys.executable, "-m", "pip", "--python", python, "install", "--quiet"]
    constraints = ["-c", ROOT / "constraints.txt"]
    seconds = timed([*pip, *constraints, f"{wheel}{extra}"])
    check = [environment / "bin/subt-check", SAMPLE]
    first, again = (timed(check, SUBT_CHECK_CACHE=str(environment / "cache")) for _ in range(2))
    size = sum(path.lstat().st_size for path in environment.rglob("*") if path.is_file())
    columns = f"{seconds:>8.1f} s{first:>12.1f} s{again:>8.2f} s{size / 1e6:>7.0f} MB"
    print(f"{extra or 'none':<12}{columns}")


if __name__ == "__main__":
    main()
