"""Real review findings: which faults are reported before their correction, and gone after it.

Run with `python -m bench.reviews` from the top folder; SUBT_CHECK_REVIEWS names the folder of
cases.
"""

from __future__ import annotations

import sys

from support.review_cases import OUT_OF_REACH, ReviewCase, review_cases

ROW = "{:<5} {:<5} {:<30} {:<30} {:<30} {}"


def row(case: ReviewCase) -> tuple[bool, str]:
    """Return whether a fault is found and gone after its correction, and its line of the table."""
    corrected = case.corrected()
    found_by = ", ".join(sorted({rule for rule, _, _ in corrected}))
    if not case.existing:
        found_by = "no rule yet"
    elif not corrected:
        found_by = OUT_OF_REACH.get(case.id, "not reported")
    yes = "yes" if corrected else "no"
    rules = ", ".join(case.rules)
    return bool(corrected), ROW.format(case.id, yes, found_by, rules, case.file, case.what)


def main() -> int:
    """Print the table and the total."""
    cases = review_cases()
    if not cases:
        print("no review cases: SUBT_CHECK_REVIEWS names no folder of them")
        return 2
    print(ROW.format("id", "found", "by", "rules", "file", "what"))
    total = 0
    for case in cases:
        found, line = row(case)
        total += found
        print(line, flush=True)
    print(f"{total} of {len(cases)} faults are reported, and gone once they are corrected")
    return 0


if __name__ == "__main__":
    sys.exit(main())
