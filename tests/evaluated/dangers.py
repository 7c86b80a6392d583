"""Calls that evaluate, load or open what a stranger may have written, found in the source."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from typing import TypeAlias

Test: TypeAlias = Callable[[ast.Call, str], bool]

_MODULES = {"pickle", "marshal", "shelve", "dill", "cloudpickle", "ctypes", "imp", "runpy", "pty"}
_BUILTINS = {"eval", "exec", "compile", "__import__", "globals", "breakpoint"}
_SHELLS = ("os.system", "os.popen", "os.exec", "os.spawn", "os.posix_spawn", "subprocess.getoutput")
_YAML_LOADS = {"load", "load_all", "full_load", "full_load_all", "unsafe_load", "unsafe_load_all"}
_YAML_READS = {"yaml.compose", "yaml.parse", "yaml.scan"}
_LXML_READS = {"fromstring", "parse", "XML", "HTML", "iterparse", "fromstringlist"}
_OTHER_XML = ("ET.", "ElementTree.", "minidom.", "sax.", "pulldom.", "objectify.")
_NUMPY_FILES = {"load", "loadtxt", "genfromtxt", "fromfile", "memmap", "fromregex", "DataSource"}
_PATTERNS = {"compile", "search", "match", "fullmatch", "findall", "finditer", "sub", "split"}


def _keyword(call: ast.Call, name: str) -> ast.expr | None:
    return next((each.value for each in call.keywords if each.arg == name), None)


def _is(call: ast.Call, name: str, value: object) -> bool:
    given = _keyword(call, name)
    return isinstance(given, ast.Constant) and given.value is value


def _is_text(node: ast.expr | None) -> bool:
    """Whether an expression is a text that stands in the source."""
    return isinstance(node, ast.Constant) and isinstance(node.value, str | bytes)


def _is_own(node: ast.expr) -> bool:
    """Whether an expression is a text of the source, or a constant that holds some."""
    while isinstance(node, ast.Attribute | ast.Subscript | ast.Call):
        node = node.func if isinstance(node, ast.Call) else node.value
    return _is_text(node) or (isinstance(node, ast.Name) and node.id.isupper())


def _first(call: ast.Call) -> ast.expr | None:
    return call.args[0] if call.args else None


def _method(called: str) -> str:
    return called.rpartition(".")[2]


def _weak_parser(call: ast.Call, called: str) -> bool:
    if called != "etree.XMLParser":
        return False
    hardened = _is(call, "resolve_entities", False) and _is(call, "no_network", True)
    weakened = ("load_dtd", "dtd_validation", "attribute_defaults")
    return not hardened or any(_keyword(call, n) and not _is(call, n, False) for n in weakened)


def _by_name(call: ast.Call, called: str) -> bool:
    return called in {"getattr", "setattr", "delattr"} and not _is_text(call.args[1])


def _unsafe_xml(call: ast.Call, called: str) -> bool:
    reads = _method(called) in _LXML_READS
    return reads and (
        called.startswith(_OTHER_XML) or (called.startswith("etree.") and len(call.args) < 2)
    )


_OF_TEXTS = {
    "an attribute by its name",
    "a format that is put together",
    "a pattern that is put together",
}
"""No danger while a module is loaded: no stranger's text is there yet."""

DANGERS: dict[str, Test] = {
    "code made of a text": lambda _, called: called in _BUILTINS,
    "a command in a shell": lambda call, called: (
        called.startswith(_SHELLS)
        or (_keyword(call, "shell") is not None and not _is(call, "shell", False))
    ),
    "YAML that makes objects": lambda call, called: (
        (called.startswith("yaml.") and _method(called) in _YAML_LOADS)
        or (called in _YAML_READS and _keyword(call, "Loader") is None and len(call.args) < 2)
    ),
    "a picture of any format": lambda call, called: (
        called == "Image.open" and not isinstance(_keyword(call, "formats"), ast.Tuple)
    ),
    "a template made of a text": lambda _, called: (
        _method(called) in {"from_string", "Template", "NativeEnvironment", "NativeTemplate"}
    ),
    "templates that do not escape": lambda call, called: (
        _method(called) == "Environment" and _keyword(call, "autoescape") is None
    ),
    "a module by its name": lambda call, called: (
        _method(called) == "import_module" and not _is_text(_first(call))
    ),
    "an attribute by its name": _by_name,
    "an XML parser that reaches out": _weak_parser,
    "XML by a parser of another kind": _unsafe_xml,
    "an XPath that is put together": lambda call, called: (
        _method(called) in {"xpath", "find_all", "XPath", "XSLT"} and not _is_text(_first(call))
    ),
    "numbers by a reader of any kind": lambda _, called: (
        called.startswith(("np.", "numpy.")) and _method(called) in _NUMPY_FILES
    ),
    "a mesh by its suffix": lambda call, called: (
        called.startswith("trimesh.")
        and _method(called).startswith("load")
        and not _is_text(_keyword(call, "file_type"))
    ),
    "a format that is put together": lambda call, called: (
        _method(called) in {"format", "format_map"}
        and isinstance(call.func, ast.Attribute)
        and not _is_own(call.func.value)
    ),
    "a time in a form of its own": lambda call, called: (
        _method(called) in {"strptime", "strftime"}
        and not any(_is_text(each) for each in call.args)
    ),
    "an archive unpacked unseen": lambda _, called: (
        _method(called) == "extractall" or called == "shutil.unpack_archive"
    ),
    "a pattern that is put together": lambda call, called: (
        called.startswith("re.") and _method(called) in _PATTERNS and not _is_text(_first(call))
    ),
    "a pattern of file names": lambda _, called: _method(called) in {"fnmatch", "fnmatchcase"},
    "a place that can be guessed": lambda _, called: called == "tempfile.mktemp",
}


def _imported(node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (each.name for each in node.names)
    elif isinstance(node, ast.ImportFrom):
        yield node.module or ""


def _run_on_loading(tree: ast.Module) -> set[ast.Call]:
    """Return the calls that run when the module is loaded, where no stranger's text is."""
    found: set[ast.Call] = set()
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            continue
        if isinstance(node, ast.Call):
            found.add(node)
        waiting += ast.iter_child_nodes(node)
    return found


def dangers_in(text: str) -> Iterator[tuple[str, int]]:
    """Yield each danger in a module's text, and its line."""
    tree = ast.parse(text)
    on_loading = _run_on_loading(tree)
    for node in ast.walk(tree):
        for module in _imported(node):
            if module.partition(".")[0] in _MODULES:
                yield "a module that makes objects of bytes", getattr(node, "lineno", 0)
        if isinstance(node, ast.Call):
            called = ast.unparse(node.func)
            for danger, is_one in DANGERS.items():
                if is_one(node, called) and not (node in on_loading and danger in _OF_TEXTS):
                    yield danger, node.lineno
