"""Runs xacro over texts, inside the process that may do nothing else.

xacro's ways to reach files, packages and the environment lead to the given texts. Every
element remembers which element of which text it is a copy of.
"""

from __future__ import annotations

import encodings.utf_8
import fnmatch
import keyword
import posixpath
import re
import unicodedata
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property, wraps
from typing import Any
from xml.dom import expatbuilder, minidom

import xacro
from xacro import substitution_args

from checker.formats.xacro import melodic
from checker.formats.xacro.expression.bounds import (
    Allowance,
    Budget,
    ExpressionLimit,
    RefusedExpression,
)
from checker.formats.xacro.expression.builtins import functions
from checker.formats.xacro.expression.evaluation import Names, evaluate
from checker.formats.xacro.files import ROOT, package_in
from checker.formats.xacro.macro_names import macro_names
from checker.formats.xacro.needless_includes import (
    SKIPPED,
    calls_another,
    is_closed,
    reduce_to_robot,
    skip,
)
from checker.formats.xacro.symbols import EvalNames, global_symbols, text_value
from checker.formats.xacro.yaml_values import read

NODES_LIMIT = 50_000
"""Elements made while expanding one file, as many as of a file that is not expanded
(`checker.source.xml.ELEMENTS_LIMIT`); the largest real robot has 3 000."""
SIZE_LIMIT = 20_000_000
"""Characters of the expanded document."""
_LAZY = (expatbuilder, encodings.utf_8, unicodedata)
"""Modules that parsing would load later, when nothing can be loaded any more."""
_ORIGIN = "origin"
_PACKAGE = re.compile(r"[A-Za-z][\w.-]{0,200}")
_CAUSES = 20
_TOO_DEEP = "is nested too deeply: does a macro, or a file, use itself?"
_MESSAGE_LIMIT = 600
_SHOWN = 60
"""Characters of an expression that a message shows."""


class _Stopped(BaseException):
    """Ends the expansion past xacro, which catches every `Exception`; carries the outcome."""

    def __init__(self, outcome: dict[str, Any]) -> None:
        super().__init__()
        self.outcome = outcome


def expand(
    request: Mapping[str, Any],
    file: str,
    args: Mapping[str, str],
    *,
    as_melodic: bool = False,
    call: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Expand one file.

    Args:
        request: The texts.
        file: The one to expand.
        args: Arguments by name.
        as_melodic: As xacro 1.13 of ROS Melodic does, see `checker.formats.xacro.melodic`.
        call: What is added to the file, see `Wanted`.

    Returns:
        `xml` and `origins` (file and element number of each element, in order) with `files`, and
        `left`, packages that are not available, and `skipped`, their macros that are called; or
        `kind`, `message`, `at` and `through` of what is wrong; or `missing`, a path to give as
        well; or `unread`, why it cannot be known; or `refused`, what an expression uses that is
        outside of the language, with the `expression` and `at`.
    """
    expansion = _Expansion(request, as_melodic=as_melodic)
    try:
        return expansion.run(file, dict(args), call)
    except _Stopped as stopped:
        return stopped.outcome
    except RecursionError:
        return expansion.fault("recursion", _TOO_DEEP)
    except Exception as error:  # noqa: BLE001 - xacro raises whatever an expression does
        if expansion.left:
            return _unavailable(expansion.left[0])
        return expansion.fault(_kind(error), _message(error))


def _unavailable(package: str) -> dict[str, Any]:
    cure = "give its parent folder with --package-path DIR"
    return {"unread": f"package {package} is not available; {cure}"}


def _causes(error: BaseException | None) -> list[BaseException]:
    """Return an error and what it wraps, outermost first."""
    chain: list[BaseException] = []
    while error is not None and len(chain) < _CAUSES:
        chain.append(error)
        error = getattr(error, "exc", None)
    return chain


def _kind(error: BaseException) -> str:
    causes = _causes(error)
    if any(isinstance(cause, RecursionError) for cause in causes):
        return "recursion"
    if any(isinstance(cause, MemoryError) for cause in causes):
        return "limit"
    if any(isinstance(cause, _NeedsEnvironment) for cause in causes):
        return "environment"
    missing = any(isinstance(cause, substitution_args.ArgException) for cause in causes)
    return "argument" if missing else "expansion"


def _message(error: BaseException) -> str:
    """Return what is wrong: the innermost words, and the expression that they are about."""
    causes = _causes(error)
    suffixes = (getattr(cause, "suffix", None) for cause in reversed(causes))
    expression = next(filter(None, suffixes), "")
    inner = causes[-1]
    if isinstance(inner, MemoryError):
        message = "it needs more memory than allowed"
    elif isinstance(inner, RecursionError):
        message = _TOO_DEEP
    elif isinstance(inner, substitution_args.ArgException):
        message = f"arg {inner} is neither given nor has a default"
    else:
        outer = causes[-2] if isinstance(inner, FileNotFoundError) and causes[1:] else inner
        message = str(outer.args[0] if outer.args and outer is not inner else outer)
        message = message or type(inner).__name__
    return " ".join(f"{message} {expression}".split())[:_MESSAGE_LIMIT]


class _Expansion:
    """xacro, led to the given texts."""

    def __init__(self, request: Mapping[str, Any], *, as_melodic: bool) -> None:
        self._request = request
        self._as_melodic = as_melodic
        self._files: list[str] = sorted(request["texts"])
        self._numbers = {path: number for number, path in enumerate(self._files)}
        self._nodes = 0
        self._at: tuple[int, int] | None = None
        self._failed_at: tuple[int, int] | None = None
        self._through: list[str] = []
        self._allowance = Allowance()
        self.left: list[str] = []
        self._skipped: list[str] = []

    def run(
        self, file: str, args: dict[str, str], call: Mapping[str, Any] | None = None
    ) -> dict[str, Any]:
        """Expand the file with arguments by name."""
        self._lead_here()
        xacro.init_stacks(file)
        document = self._parse(None, file)
        if call is not None:
            self._add(document, file, call)
        xacro.process_doc(document, mappings=args, verbosity=0)
        root = document.documentElement
        skipped = root.getElementsByTagName(SKIPPED) if self._skipped else []
        if skipped and not reduce_to_robot(root, skipped):
            return _unavailable(self.left[0])
        text = root.toxml()
        if len(text) > SIZE_LIMIT:
            return self.fault("limit", f"it expands to more than {SIZE_LIMIT / 1e6:g} MB")
        if self.left and not is_closed(root):
            return _unavailable(self.left[0])
        found = {"xml": text, "origins": self._origins(root), "files": self._files}
        if self.left:
            found |= {"left": self.left, "skipped": self._skipped if skipped else []}
        return found

    def fault(self, kind: str, message: str) -> dict[str, Any]:
        """Return the outcome of an expansion that failed."""
        at = self._failed_at or self._at
        place = self._place(at)
        return {"kind": kind, "message": message, "at": place, "through": self._through[-5:]}

    def _place(self, at: tuple[int, int] | None) -> list[Any] | None:
        return None if at is None else [self._files[at[0]], at[1]]

    def _lead_here(self) -> None:
        """Replace in xacro what reaches out of the process. It is not used for anything else."""
        xacro.root_dir = ROOT
        xacro.parse = self._parse
        xacro.glob = self
        xacro.safe_eval = self._evaluate
        xacro.eval_text = self._text_value
        xacro.is_valid_name = _is_name
        xacro._global_symbols = global_symbols(self._load_yaml)
        if self._as_melodic:
            xacro._global_symbols = {**melodic.FUNCTIONS, **xacro._global_symbols, **melodic.LISTS}
            xacro.eval_all = melodic.with_global_macros(xacro.eval_all)
        xacro.handle_macro_call = self._skipping(xacro.handle_macro_call)
        for name in ("eval_all", "handle_macro_call"):
            setattr(xacro, name, self._watched(getattr(xacro, name)))
        xacro.check_attrs = self._noting(xacro.check_attrs)
        substitution_args._eval_find = _folder_of_package
        substitution_args._eval_env = _refuse_environment
        substitution_args._eval_optenv = _default_of
        substitution_args._eval = self._substituted

    @cached_property
    def _macros(self) -> frozenset[str]:
        return macro_names(self._request["texts"].values())

    def glob(self, pattern: str) -> list[str]:
        """Return the given paths that match a pattern: what `glob.glob` is to xacro."""
        return fnmatch.filter(self._files, posixpath.normpath(pattern))

    def _text(self, path: str) -> str:
        path = posixpath.normpath(path)
        if path in self._request["texts"]:
            return str(self._request["texts"][path])
        if path in self._request["faulty"]:
            raise _Stopped(
                {"kind": "malformed", "message": self._request["faulty"][path], "at": [path, -1]}
            )
        package = package_in(path)
        if package in self._request["beyond"]:
            raise _Stopped(_unavailable(package))
        if path in self._request["absent"] or not path.startswith(f"{ROOT}/"):
            raise FileNotFoundError(path)
        raise _Stopped({"missing": path})

    def _parse(self, source: Any, path: str | None = None) -> Any:
        """Return a text as a document whose elements know where they are."""
        if path is None:
            raise ValueError("only files of the package are read")
        del source
        package = package_in(path)
        if package in self._request["beyond"] and calls_another(self._request["texts"].values()):
            self.left.append(package)  # it may be needed for a macro that nothing calls
            return minidom.parseString("<robot/>")  # noqa: S318 - our own text
        try:
            # Our own reader has been through the text: no document types, no entities, no depth.
            document = minidom.parseString(self._text(path))  # noqa: S318
        except FileNotFoundError as error:
            xacro.filestack.pop()
            label = posixpath.normpath(path).removeprefix(f"{ROOT}/")
            raise xacro.XacroException(f"the file {label} does not exist", exc=error) from None
        if self._as_melodic:
            melodic.prefix(document.documentElement, self._macros)
        number = self._numbers[posixpath.normpath(path)]
        for index, element in enumerate(_elements(document.documentElement)):
            element.setUserData(_ORIGIN, (number, index), self)
        return document

    def _add(self, document: Any, file: str, call: Mapping[str, Any]) -> None:
        """Add a call of a macro to its file; what it makes is where the macro does."""
        root = document.documentElement
        if not root.getAttribute("name"):
            root.setAttribute("name", call["name"])
        number = self._numbers[posixpath.normpath(file)]
        added: Any = minidom.parseString(call["text"])  # noqa: S318 - our own text
        for child in added.documentElement.childNodes:
            node = document.importNode(child, True)
            for element in _elements(node):
                element.setUserData(_ORIGIN, (number, call["number"]), self)
            root.appendChild(node)

    def handle(self, _: int, key: str, data: tuple[int, int], __: Any, copy: Any) -> None:
        """Hand an element's origin on to its copy: what minidom calls for every clone."""
        self._nodes += 1
        if self._nodes > NODES_LIMIT:
            message = f"it expands to more than {NODES_LIMIT} elements"
            raise _Stopped(self.fault("limit", message))
        if copy is not None:
            copy.setUserData(key, data, self)

    def _evaluate(self, expression: str, names: Names) -> Any:
        """Evaluate `${…}`: what `safe_eval` is to xacro."""
        with self._ending(expression):
            return evaluate(expression, names, self._allowance)

    def _text_value(self, text: str, symbols: Any) -> Any:
        with self._ending(text):
            return text_value(text, symbols, self._allowance)

    def _substituted(self, expression: str, context: dict[str, Any]) -> str:
        """Evaluate `$(eval …)`, in which args are names."""
        if "__" in expression:
            message = "$(eval ...) may not contain double underscore expressions"
            raise substitution_args.SubstitutionException(message)
        return str(self._evaluate(expression, EvalNames(context, _OF_EVAL)))

    @contextmanager
    def _ending(self, expression: str) -> Iterator[None]:
        """End the expansion where an expression leaves the language, or its bounds."""
        try:
            yield
        except RefusedExpression as refusal:
            text = _shortened(expression)
            at = self._place(self._at)
            raise _Stopped({"refused": str(refusal), "expression": text, "at": at}) from None
        except ExpressionLimit as limit:
            self._through = _macros()
            message = f"the expression '{_shortened(expression)}' {limit}"
            raise _Stopped(self.fault("limit", message)) from None

    def _load_yaml(self, filename: str, budget: Budget) -> Any:
        path = xacro.abs_filename_spec(filename)
        try:
            text = self._text(path)
        except FileNotFoundError:
            label = path.removeprefix(f"{ROOT}/")[:200]
            name = _argument_in(path)
            if name is None:
                raise xacro.XacroException(f"the file {label} does not exist") from None
            reason = f"needs another value of the argument {name!r}: {label} does not exist"
            raise _Stopped({"unread": reason}) from None
        return read(text, budget)

    def _origins(self, root: Any) -> list[tuple[int, int]]:
        return [element.getUserData(_ORIGIN) or (-1, -1) for element in _elements(root)]

    def _skipping(self, work: Callable[..., Any]) -> Callable[..., Any]:
        """Skip calls of macros that only a package that is not available may define."""

        @wraps(work)
        def skipping(node: Any, *rest: Any) -> Any:
            name = skip(node, self._macros) if self.left else ""
            if name:
                self._skipped.append(name)
            return bool(name) or work(node, *rest)

        return skipping

    def _watched(self, work: Callable[..., Any]) -> Callable[..., Any]:
        """Remember at which element a function of xacro works, and at which it fails."""

        @wraps(work)
        def watched(node: Any, *rest: Any) -> Any:
            before = self._at
            self._note(node)
            try:
                result = work(node, *rest)
            except Exception:
                if self._failed_at is None:
                    self._failed_at = self._at
                    self._through = _macros()
                raise
            self._at = before
            return result

        return watched

    def _noting(self, work: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(work)
        def noting(node: Any, *rest: Any) -> Any:
            self._note(node)
            return work(node, *rest)

        return noting

    def _note(self, node: Any) -> None:
        origin = node.getUserData(_ORIGIN) if node is not None else None
        self._at = origin or self._at


def _macros() -> list[str]:
    """Return the names of the macros that are being expanded, outermost first."""
    return [str(macro.body.getAttribute("name"))[:80] for macro in xacro.macrostack or ()]


def _shortened(expression: str) -> str:
    text = " ".join(expression[: 10 * _SHOWN].split())
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"


def _is_name(name: str) -> bool:
    """Return whether a property may have that name: what xacro has Python's parser find out."""
    if not name.isidentifier() or keyword.iskeyword(name):
        return False
    return name.isascii() or unicodedata.normalize("NFKC", name) == name


def _elements(root: Any) -> list[Any]:
    """Return an element and all elements below it, in document order."""
    nodes, waiting = [], [root]
    while waiting:
        node = waiting.pop()
        if node.nodeType == node.ELEMENT_NODE:
            nodes.append(node)
            waiting.extend(reversed(node.childNodes))
    return nodes


def _argument_in(path: str) -> str | None:
    """Return the argument whose value is a part of a path; None if there is none."""
    parts = set(path.removeprefix(f"{ROOT}/").split("/")[1:])
    given = xacro.substitution_args_context.get("arg", {})
    return next((str(name)[:80] for name, value in given.items() if str(value) in parts), None)


def _folder_of_package(name: str) -> str:
    if not _PACKAGE.fullmatch(name):
        raise substitution_args.SubstitutionException(f"{name[:80]!r} is not a package name")
    return f"{ROOT}/{name}"


class _NeedsEnvironment(Exception):
    """Report that an environment variable is needed; none is known here."""


def _refuse_environment(name: str) -> str:
    message = f"it depends on the environment variable {name[:80]!r}, which is not available"
    raise _NeedsEnvironment(message)


def _default_of(_: str, default: str = "") -> str:
    return default


_OF_EVAL = functions(
    [
        ("find", lambda _, name: _folder_of_package(name)),
        ("env", lambda _, name: _refuse_environment(name)),
        ("optenv", lambda _, name, default="": _default_of(name, default)),
    ]
)
"""Further functions that `$(eval …)` may call."""
