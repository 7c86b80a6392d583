"""Imports libraries, any of which may end the process (see `checker.base.child_process`)."""

from __future__ import annotations

import json
from collections.abc import Iterable
from importlib import import_module

from checker.base.child_process import Limits, ask
from checker.base.parts import WorkerFailed
from checker.base.sandbox.files import Files

_LIMITS = Limits(20.0, 16_000_000_000)
"""MuJoCo and Pinocchio map far more memory than they use."""
_MODULES = {
    "markdown-it-py": "markdown_it",
    "pillow": "PIL",
    "pin": "pinocchio",
    "pycollada": "collada",
    "pyelftools": "elftools",
    "pyyaml": "yaml",
}
"""Import names of distributions where they differ from the name of the distribution."""


def module_of(distribution: str) -> str:
    """Return what a distribution is imported as."""
    return _MODULES.get(distribution, distribution.replace("-", "_"))


def import_troubles(distributions: Iterable[str]) -> dict[str, str]:
    """Import libraries in a child process.

    Returns:
        Why a library cannot be imported, by its name; if the child crashes, `libraries` is
        the one at fault.
    """
    reply = ask(__name__, json.dumps(list(distributions)).encode(), _LIMITS)
    if isinstance(reply, WorkerFailed):
        return {"libraries": f"the process that imports them {reply.reason}"}
    troubles: dict[str, str] = json.loads(reply)
    return troubles


def answer(request: bytes, _files: Files) -> bytes:
    """Return what `import_troubles` does, as JSON, for a list of distributions as JSON."""
    troubles = {}
    for distribution in json.loads(request):
        try:
            import_module(module_of(distribution))
        except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever it is, it is what was looked for
            troubles[distribution] = f"{type(error).__name__}: {error}"
    return json.dumps(troubles).encode()
