"""Programs that the build of a package installs, as far as its build files name all of them."""

from __future__ import annotations

import re

from checker.package.package import Package
from checker.source.text import SourceText

_WORD = re.compile(r"[\w.-]+")
_CMAKE = re.compile(
    r"\bGLOB\b|\badd_subdirectory\b|\binclude\s{0,8}\(|\bforeach\b|\bExternalProject"
    r"|\bFetchContent|\b(?:add_executable|\w*register_node\w*|install)\s{0,8}\([^)]{0,5000}\$\{",
    re.IGNORECASE,
)
"""Among others a call with a variable, next to the name of the project."""
_PROJECT = re.compile(r"\$\{PROJECT_NAME\}|\$\{CMAKE_PROJECT_NAME\}")
_SETUP = re.compile(
    r"[\"']lib/|\bf[\"']|\.format\(|[\"']\s{0,8}%"
    r"|\bfor\s[\w\s,()]{1,60}\sin\b|\bscripts\s{0,8}=\s{0,8}[^\s\[=]"
)
"""Among others names that are put together, and scripts that are not listed."""
_NOT_PLAIN = {
    "CMakeLists.txt": _CMAKE,
    "setup.py": _SETUP,
    "setup.cfg": None,
    "pyproject.toml": None,
}
"""Build files, and what in them may install programs whose names they do not state."""
_RUNS_SETUP = re.compile(r"\b(?:ament_python_install_package|catkin_python_setup)\b")
_OF_CMAKE = "CMakeLists.txt"


def why_no_program(package: Package, name: str) -> str:
    """Return why the build of a package installs no program of a name; empty if it may."""
    build = _build_file(package)
    if build is None:
        return ""
    words = set(_WORD.findall(build.text))
    if name in words:
        return ""
    if f"{name}.py" in words:
        return f"{build.file} installs {name}.py, with the file extension"
    return f"nothing in {build.file} builds or installs it"


def _build_file(package: Package) -> SourceText | None:
    """Return the file that states what is installed; None if it does not state all."""
    sources = []
    for name, not_plain in _NOT_PLAIN.items():
        source = package.read(name) if package.exists(name) else None
        if isinstance(source, SourceText):
            plain = _PROJECT.sub(package.declared_name, source.text)
            if not_plain is not None and not_plain.search(plain):
                return None
            sources.append(SourceText(name, plain))
    if package.build_type == "ament_cmake" and sources and sources[0].file == _OF_CMAKE:
        # setup.py is run only where CMake says so.
        sources = sources if _RUNS_SETUP.search(sources[0].text) else sources[:1]
    text = "\n".join(source.text for source in sources)
    return SourceText(sources[0].file, text) if sources else None
