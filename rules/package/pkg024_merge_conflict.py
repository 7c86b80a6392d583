"""A merge conflict that was committed.

Git writes both versions of the lines with marks between them: `<<<<<<<`, `=======` and `>>>>>>>`.
Nothing reads a file with these marks: CMake stops, launch files and robots do not load. In a Python
module that no other file of its package names, nor a launch file, it is a warning.

Fix: keep one of the versions, and remove the three marks.
Source: Git, "How conflicts are presented".
"""

import posixpath
import re

from checker.package.mentions import has_word
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import SourceText, Span

_FILES = (
    *("cmakelists.txt", ".cmake", ".xml", ".py", ".launch", ".yaml", ".yml", ".rb"),
    *(".urdf", ".xacro", ".sdf", ".world", ".config", ".srdf", ".gazebo", ".cpp", ".hpp"),
)
_NAMING = (".py", ".cfg", ".toml", "cmakelists.txt", ".sh")
"""Files that import or install a module."""
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
            yield finding(
                mark,
                f"{file.path} has a merge conflict: nothing can read the file",
                severity=Severity.WARNING if _is_unused_module(file.path, package) else None,
            )


def _is_unused_module(path: str, package: Package) -> bool:
    """Return whether a file is a module of a Python package that nothing imports or starts."""
    folder, name = posixpath.split(path)
    stem, ending = posixpath.splitext(name)
    is_module = ending == ".py" and package.exists(posixpath.join(folder, "__init__.py"))
    if not is_module or stem.startswith("__") or stem in package.workspace.launch_words:
        return False
    others = (
        package.read(it.path) for it in package.index.with_suffix(*_NAMING) if it.path != path
    )
    return not any(isinstance(it, SourceText) and has_word(it.text, stem) for it in others)


def _example(text: str) -> dict[str, object]:
    return {"@ros2": True, "config/arm.yaml": text}


GOOD = [_example("a: 1\n"), _example("a: |\n  <<<<<<< one\n  =======\n  >>>>>>> other\n")]
_CONFLICTING = "<<<<<<< HEAD  # ^ PKG024\nb = 1\n=======\nb = 2\n>>>>>>> other\n"
BAD = [
    {"@ros2": True, "arm/__init__.py": "", "arm/tools.py": _CONFLICTING},
    _example("a: 1\n<<<<<<< HEAD  # ^ PKG024\nb: 1\n=======\nb: 2\n>>>>>>> other\n"),
]
