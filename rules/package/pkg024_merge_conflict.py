"""A merge conflict that was committed.

Git writes both versions of the lines with marks between them: `<<<<<<<`, `=======` and `>>>>>>>`.
Nothing reads a file with these marks: CMake stops, launch files and robots do not load.

Fix: keep one of the versions, and remove the three marks.
Source: Git, "How conflicts are presented".
"""

import re

from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import SourceText, Span

_FILES = (
    *("cmakelists.txt", ".cmake", ".xml", ".py", ".launch", ".yaml", ".yml", ".rb"),
    *(".urdf", ".xacro", ".sdf", ".world", ".config", ".srdf", ".gazebo", ".cpp", ".hpp"),
)
_CONFLICT = re.compile(
    r"^<{7} [^\n]*\n(?:[^\n]*\n){0,2000}?={7}\r?\n(?:[^\n]*\n){0,2000}?>{7} ", re.M
)


@rule("PKG024", "merge-conflict", Severity.ERROR, Concern.ROBOT)
def check(package: Package) -> Findings:
    """Report the first conflict of each file."""
    for file in package.index.with_suffix(*_FILES):
        source = package.read(file.path)
        # Few files have the last mark, so the search for all takes no time.
        if not isinstance(source, SourceText) or "\n>>>>>>> " not in source.text:
            continue
        if conflict := _CONFLICT.search(source.text):
            mark = Span(source, conflict.start(), conflict.start() + 7)
            yield finding(mark, f"{file.path} has a merge conflict: nothing can read the file")


def _example(text: str) -> dict[str, object]:
    return {"@ros2": True, "config/arm.yaml": text}


GOOD = [_example("a: 1\n"), _example("a: |\n  <<<<<<< one\n  =======\n  >>>>>>> other\n")]
BAD = [
    _example("a: 1\n<<<<<<< HEAD  # ^ PKG024\nb: 1\n=======\nb: 2\n>>>>>>> other\n"),
]
