"""What `--fix` and `--diff` do and say."""

from __future__ import annotations

import posixpath
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from checker.finding import Safety
from checker.fixing.packages import FixedPackage, fix_paths
from checker.output import EXIT_CLEAN, EXIT_FINDINGS, say_progress, show, write
from checker.patching.patch import patch
from checker.report.report import ReportedFinding
from checker.report.wording import count, listed, plain


def show_patch(
    paths: Sequence[Path], wishes: Mapping[str, Any], allowed: Collection[Safety], output: str = ""
) -> int:
    """Print what fixing would change, or write it to a file; return 1 when there is something."""
    packages = fix_paths(paths, wishes, allowed, write=False)
    text = "".join(patch(each.fixed.files, _folder(each, packages)) for each in packages)
    if output:
        write(Path(output), text)
    else:
        show(text)
    return EXIT_FINDINGS if text else EXIT_CLEAN


def _folder(package: FixedPackage, packages: Sequence[FixedPackage]) -> str:
    """Return a package's folder as seen from here: `git apply` finds its files from here.

    What lies elsewhere is applied within the package, or within the folder of several.
    """
    shown = posixpath.normpath(Path(package.shown).as_posix())
    if shown == ".":
        return ""
    if shown.startswith(("/", "..")):
        return package.name if len(packages) > 1 else ""
    return shown


def apply_fixes(
    paths: Sequence[Path], wishes: Mapping[str, Any], allowed: Collection[Safety]
) -> None:
    """Fix files, and say on the standard error what was done."""
    for package in fix_paths(paths, wishes, allowed, write=True):
        for line in _summary(package):
            say_progress(f"{plain(package.shown)}: {line}")


def _summary(package: FixedPackage) -> Iterator[str]:
    fixed = package.fixed
    if fixed.findings:
        where = listed([plain(file.path) for file in fixed.files])
        yield f"fixed {count(len(fixed.findings), 'finding')} in {where} ({_rules(fixed.findings)})"
    else:
        yield "nothing to fix"
    if fixed.left:
        yield f"could not fix {count(len(fixed.left), 'finding')} ({_rules(fixed.left)})"
    if fixed.elsewhere:
        edits = [edit for each in fixed.elsewhere if each.fix for edit in each.fix.edits]
        files = sorted({plain(edit.place.file) for edit in edits})
        said = count(len(fixed.elsewhere), "finding")
        yield f"{said} to fix in {listed(files)}: check the package that contains it"
    if fixed.withheld:
        said = count(len(fixed.withheld), "finding")
        yield (
            f"{said} not fixed, because the fix changes behaviour ({_rules(fixed.withheld)}): see "
            "--diff --unsafe"
        )


def _rules(findings: Sequence[ReportedFinding]) -> str:
    return ", ".join(sorted({each.rule for each in findings}))
