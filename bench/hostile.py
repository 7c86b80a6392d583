"""Models that nobody wrote by hand: huge, deep, misspelt throughout. Each must end in findings.

Run with `make bench`. The figures are seconds for one check under a profile; what matters is that
none explodes and that no rule crashes.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from time import perf_counter

from checker.pipeline import check_package
from checker.settings import Settings

LONG = 10_000
VISUAL = "<visual name='v'><geometry/></visual>"


def chain(joints: int, *, closed: bool) -> str:
    """Return so many links, each tied to the one before it."""
    links = "".join(f"<link name='l{n}'/>" for n in range(joints + 1))
    ends = ((n, (n + 1) % joints if closed else n + 1) for n in range(joints))
    return links + "".join(
        f"<joint name='j{a}' type='revolute'><parent>l{a}</parent><child>l{b}</child>"
        "<axis><xyz>0 0 1</xyz></axis></joint>"
        for a, b in ends
    )


CASES: dict[str, Callable[[], str]] = {
    "names of 10 000 characters": lambda: (
        f"<link name='{'n' * LONG}'/><{'z' * LONG}/><joint name='{'j' * LONG}' type='{'t' * LONG}'>"
        f"<parent>{'p' * LONG}</parent><child>{'c' * LONG}</child></joint>"
    ),
    "100 000 visuals in one link": lambda: f"<link name='l'>{VISUAL * 100_000}</link>",
    "100 000 unknown elements": lambda: "".join(f"<foo{n}/>" for n in range(100_000)),
    "50 000 joints in a chain": lambda: chain(50_000, closed=False),
    "20 000 joints in a loop": lambda: chain(20_000, closed=True),
    "20 000 joints that end at nothing": lambda: "".join(
        f"<joint name='j{n}' type='fixed'><parent>x{n}</parent><child>y{n}</child></joint>"
        for n in range(20_000)
    ),
    "5 000 poses of 1e400 --5 0x10 1,5": lambda: "".join(
        f"<link name='l{n}'><pose>1e400 --5 0x10 1,5 nan inf</pose></link>" for n in range(5_000)
    ),
}


def measured(content: str, folder: Path) -> Iterator[str]:
    """Yield a line for each profile: seconds, findings, rules that could not run."""
    (folder / "package.xml").write_text("<package/>", "utf-8")
    model = f"<sdf version='1.6'><model name='m'>{content}</model></sdf>"
    (folder / "model.sdf").write_text(model, "utf-8")
    for profile in ("subt", "sdf"):
        started = perf_counter()
        (report,) = check_package(folder, Settings(profile=profile)).packages
        seconds = perf_counter() - started
        crashed = "CRASHED" if report.crashed else ""
        yield f"{profile:<5} {seconds:7.1f} s  {len(report.findings):7d} findings  {crashed}"


def main() -> None:
    """Measure and print everything."""
    for name, content in CASES.items():
        with tempfile.TemporaryDirectory() as folder:
            for line in measured(content(), Path(folder)):
                print(f"{name:<36} {line}")


if __name__ == "__main__":
    main()
