"""Count how many findings on real packages are true, by rule and source.

Run with `python -m bench.precision [--with-trial]` from the top folder. The variables
SUBT_CHECK_CORPUS and SUBT_CHECK_MODERN name folders of packages; the URDF files come with PyPI's
example-robot-data. The judgements are in `support/judged/`.
"""

from __future__ import annotations

import sys
from collections import Counter, defaultdict
from collections.abc import Iterator

from checker.finding import Severity
from support.judgements import HERE, by_check, findings, folder_of, judgements, places

VERDICTS = ("true", "arguable", "false", "not judged")
ROW = "{:<9} {:<8} {:<8} {:>6} {:>9} {:>6} {:>11} {:>7}"


def verdicts(source: str, *, trial: bool) -> Iterator[tuple[Severity, str, str]]:
    """Yield severity, rule and verdict of each error and warning that is reported now."""
    known = {(it.path, it.profile, it.place): it for it in judgements(source)}
    for path, profile in by_check(source):
        for found in findings(source, path, profile, trial=trial):
            if found.severity is Severity.INFO:
                continue
            keys = ((path, profile, at) for at in places(found))
            judged = [known[key] for key in keys if key in known]
            same = [it.verdict for it in judged if it.severity is found.severity]
            yield found.severity, found.rule, same[0] if same else "not judged"


def share(counts: Counter[str]) -> str:
    """Return the share of true findings among those that are judged."""
    judged = sum(counts[verdict] for verdict in VERDICTS[:3])
    return f"{counts['true'] / judged:.0%}" if judged else "-"


def main() -> int:
    """Print a line for each rule of each source, and the totals."""
    print(ROW.format("source", "severity", "rule", *VERDICTS, "share"))
    for source in sorted(file.stem for file in HERE.glob("*.json")):
        if folder_of(source) is None:
            print(f"{source}: its packages are not there")
            continue
        counts: dict[tuple[str, str], Counter[str]] = defaultdict(Counter)
        for severity, rule, verdict in verdicts(source, trial="--with-trial" in sys.argv):
            counts[severity, rule][verdict] += 1
            counts[severity, "all"][verdict] += 1
        for (severity, rule), found in sorted(counts.items()):
            numbers = (found[verdict] for verdict in VERDICTS)
            print(ROW.format(source, severity, rule, *numbers, share(found)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
