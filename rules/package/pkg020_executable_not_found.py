"""An executable of setup.py that `ros2 run` cannot start.

Its module or function does not exist, or `packages` leaves its Python package out, so Python ends
with an ImportError; or setup.cfg does not install it into `lib/<package>`, the only folder that
`ros2 run` and launch files search. None of these faults shows before the robot is started, and a
package that is left out is found after `colcon build --symlink-install`. Where no launch file names
the executable, it is a warning. The folder is not judged where setup.py has commands of its own
(`cmdclass`).

Fix: correct the `console_scripts` entry, written `name = package.module:function`; in setup.cfg
write `install_scripts=$base/lib/<package>` below `[install]` and `script_dir=$base/lib/<package>`
below `[develop]`.
Source: ROS 2 documentation, "Developing a ROS 2 package": setup.cfg is needed so that `ros2 run`
finds executables; setuptools, entry points.
"""

import ast
import re
from collections.abc import Iterator

from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.setup_py import Executable, SetupFile
from checker.source.text import SourceText, Span

_INSTALL = re.compile(r"^[ \t]*install[_-]scripts[ \t]*[=:][ \t]*(\S+)", re.MULTILINE)
_DEVELOP = re.compile(r"^[ \t]*script[_-]dir[ \t]*[=:][ \t]*(\S+)", re.MULTILINE)
_LIMIT = 1_000_000
"""Characters of a module that is parsed."""


@rule("PKG020", "executable-not-found", Severity.ERROR, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Look up the modules and functions of executables, and where they are installed."""
    setup = package.setup
    if setup is None or package.build is not None or not setup.plain:
        return
    for executable in setup.executables:
        if message := _fault(package, executable):
            quoted = (f'"{executable.name}"', f"'{executable.name}'")
            is_started = any(map(package.workspace.launches_with, quoted))
            yield finding(
                executable,
                f"executable {executable.name!r} cannot start: {message}",
                severity=None if is_started else Severity.WARNING,
            )
    if setup.executables and not setup.has_commands:
        yield from _misplaced_executables(package, setup)


def _fault(package: Package, executable: Executable) -> str:
    """Return why a module or function cannot be imported; empty if it can, or may."""
    top, _, rest = executable.module.partition(".")
    path = executable.module.replace(".", "/")
    if not (package.exists(top) or package.exists(f"{top}.py")):
        own = f"{package.declared_name}/{rest.replace('.', '/')}.py"
        meant = f"; did you mean {own[:-3].replace('/', '.')!r}?"
        return f"there is no module {executable.module!r}{meant}" if package.exists(own) else ""
    file = next(
        (file for file in (f"{path}.py", f"{path}/__init__.py") if package.exists(file)), ""
    )
    if not file:
        return "" if package.exists(path) else f"{path}.py does not exist"
    if left := _left_out(package, executable.module):
        return f"packages of setup.py leaves out {left!r}: add it, or write find_packages()"
    function = executable.function.partition(".")[0]
    names = _names(package.read(file)) if function else None
    if names is None or function in names:
        return ""
    return f"{file} has no {function!r}"


def _left_out(package: Package, module: str) -> str:
    """Return the Python package of a module if `packages` lists others and leaves it out."""
    setup, holder = package.setup, module.rpartition(".")[0]
    listed = setup.packages if setup is not None else None
    if listed is None or not holder or {module, holder} & listed:
        return ""
    return holder


def _names(source: object) -> set[str] | None:
    """Return the names that a module has; None if not all of them are known."""
    if not isinstance(source, SourceText) or len(source.text) > _LIMIT:
        return None
    try:
        tree = ast.parse(source.text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    names = set()
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                names.add(node.name)
            case ast.alias(name="*"):
                return None
            case ast.alias():
                names.add(node.asname or node.name.partition(".")[0])
            case ast.Name(ctx=ast.Store()):
                names.add(node.id)
    return None if {"__getattr__", "globals", "setattr"} & _possible_modules(tree) else names


def _possible_modules(tree: ast.Module) -> set[str]:
    """Return what may give a module names that are not written: functions that it calls or has."""
    called = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return called | {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def _misplaced_executables(package: Package, setup: SetupFile) -> Iterator[Finding]:
    """Report executables that setup.cfg installs into another folder than `lib/<package>`."""
    name = package.declared_name
    source = package.read("setup.cfg")
    text = source.text if isinstance(source, SourceText) else ""
    if _INSTALL.search(text) is None:
        yield finding(
            setup,
            f"setup.cfg has no install_scripts: executables are installed into bin, and ros2 run "
            f"looks into lib/{name}; expected install_scripts=$base/lib/{name}",
            key="no folder",
        )
    for pattern, severity in ((_INSTALL, None), (_DEVELOP, Severity.WARNING)):
        match = pattern.search(text)
        if match is not None and isinstance(source, SourceText):
            folder = match[1].rstrip("/")
            if not folder.endswith(f"/lib/{name}"):
                yield finding(
                    Span(source, *match.span(1)),
                    f"executables are put into {folder}, where ros2 run does not find them: "
                    f"expected $base/lib/{name}",
                    severity=severity,
                )


_SETUP = """from setuptools import setup
setup(name="acme_arm", entry_points={"console_scripts": [
    "talker = acme_arm.talker:main",
]})
"""
_CFG = """[develop]
script_dir=$base/lib/acme_arm
[install]
install_scripts=$base/lib/acme_arm
"""
_PACKAGE = {
    "@name": "acme_arm",
    "package.xml": """<package format="3">
  <name>acme_arm</name>
  <export><build_type>ament_python</build_type></export>
</package>
""",
    "CMakeLists.txt": None,
    "setup.py": _SETUP,
    "setup.cfg": _CFG,
    "acme_arm/__init__.py": "",
    "acme_arm/talker.py": "def main():\n    pass\n",
}
_MARK = '",  # ^ PKG020'

_DEEP = {
    **_PACKAGE,
    "acme_arm/nodes/__init__.py": "",
    "acme_arm/nodes/talker.py": "def main():\n    pass\n",
}


def _listing(packages: str, mark: str = "") -> str:
    deep = _SETUP.replace('acme_arm.talker:main",', f'acme_arm.nodes.talker:main",{mark}')
    return deep.replace("entry_points", f"packages={packages}, entry_points")


GOOD = [
    _PACKAGE,
    {**_DEEP, "setup.py": _listing('["acme_arm", "acme_arm.nodes"]')},
    {**_DEEP, "setup.py": _listing("find_packages()")},
    {**_PACKAGE, "acme_arm/talker.py": "from acme_arm.nodes import *\n"},
    {**_PACKAGE, "acme_arm/talker.py": "import other as main\n"},
    # A module of another distribution may be there.
    {**_PACKAGE, "setup.py": _SETUP.replace("acme_arm.talker", "acme_tools.speech")},
    {**_PACKAGE, "setup.py": _SETUP.replace("setup(", 'setup(package_dir={"": "src"}, ', 1)},
    {
        **_PACKAGE,
        "setup.cfg": None,
        "setup.py": _SETUP.replace("setup(", 'setup(cmdclass={"install": Install}, ', 1),
    },
]
BAD = [
    {**_DEEP, "setup.py": _listing('["acme_arm"]', "  # ^ PKG020")},
    {**_PACKAGE, "setup.py": _SETUP.replace('talker:main",', f"speaker:main{_MARK}")},
    {**_PACKAGE, "setup.py": _SETUP.replace('main",', f"run{_MARK}")},
    # The package was renamed.
    {**_PACKAGE, "setup.py": _SETUP.replace('acme_arm.talker:main",', f"arm.talker:main{_MARK}")},
    {
        **_PACKAGE,
        "setup.cfg": _CFG.replace("lib/acme_arm", "lib/arm  # ^ PKG020"),
    },
    {**_PACKAGE, "setup.cfg": None, "setup.py": _SETUP.replace(": [\n", ": [  # ^ PKG020\n")},
]
