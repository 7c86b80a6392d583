"""Optional extras: physics, the service, the language server, and the server for assistants.

Only this module decides whether an extra of `pyproject.toml` is installed, without importing it.
"""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec

from checker.base.errors import CheckerError
from checker.base.record import Record
from checker.base.system import FORKS


class Extra(Record):
    """An extra of the distribution.

    Attributes:
        name: The name as pip knows it.
        modules: What of it is imported; without one of them the extra is not installed.
        forks: Whether it needs a system on which processes fork.
    """

    name: str
    modules: tuple[str, ...]
    forks: bool = False

    @property
    def is_installed(self) -> bool:
        """True if all its modules can be found."""
        return all(map(_is_found, self.modules))

    @property
    def missing_message(self) -> str:
        """State that it is not installed, and the remedy, as a sentence without its dot."""
        return f"{self.name} is not installed: {self.remedy}"

    @property
    def remedy(self) -> str:
        """The command that installs it."""
        return f"pip install 'subt-check[{self.name}]'"

    def require_for(self, what: str) -> None:
        """Raise unless it is installed.

        Args:
            what: The feature that needs it, as the beginning of a sentence.

        Raises:
            MissingExtra: It is not.
            CheckerError: The system cannot run it.
        """
        if self.forks and not FORKS:
            where = "on Linux and macOS; on Windows, use WSL or a container"
            raise CheckerError(f"{what} runs {where}")
        if not self.is_installed:
            raise MissingExtra(self, what)


class MissingExtra(CheckerError):
    """A feature was requested that only an extra provides.

    Attributes:
        extra: The extra.
    """

    def __init__(self, extra: Extra, what: str) -> None:
        super().__init__(extra, what)
        self.extra, self.what = extra, what

    def __str__(self) -> str:
        """Return the feature that needs it, and the remedy."""
        name, remedy = self.extra.name, self.extra.remedy
        return f"{self.what} needs the extra {name!r}, which is not installed: {remedy}"


PHYSICS = Extra(
    "physics",
    (
        *("collada", "fast_simplification", "mujoco", "numpy", "PIL", "pinocchio"),
        *("scipy", "trimesh", "yourdfpy"),
    ),
)
"""Reads meshes, weighs robots, computes the views of their sensors, drives and draws them."""
SERVICE = Extra(
    "service",
    (
        *("blake3", "dbos", "fastapi", "httpx", "multipart"),
        *("prometheus_client", "psycopg", "sqlalchemy", "uvicorn"),
    ),
    forks=True,
)
"""Serves checks, and sends packages to such a service."""
S3 = Extra("s3", ("obstore",))
"""Keeps uploads and results of a service in S3, for several machines."""
EDITOR = Extra("editor", ("lsprotocol", "pygls"))
"""Reports faults to editors while a package is written."""

MCP = Extra("mcp", ("mcp",))
"""Lets assistants check packages over the Model Context Protocol."""


@cache
def _is_found(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except (ImportError, ValueError):
        return False
