"""The parts of one package that rules request; each is made once, on the first request."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from functools import cache
from importlib import import_module
from typing import TypeVar, cast

from msgspec import field
from msgspec.structs import replace

from checker.base.allowance import Allowance, Exceeded
from checker.base.cache import NO_CACHE, Cache
from checker.base.output import Stages
from checker.base.parts import Ask, NotAvailable, Provider, providers_in, type_name
from checker.base.record import Record
from checker.base.resources import PACKAGE
from checker.formats.xacro.expansion import Expander, XacroArguments, xacro_server
from checker.model.devices.known import KnownDevices, known_devices
from checker.package.package import Package
from checker.physics.mesh.process import MeshServer, mesh_server
from checker.report.scene.processes import NO_PROCESSES, StartedProcesses

T = TypeVar("T")

PROVIDERS = (
    *("launch.parts", "model.parts", "robots.parts", "robots.urdf_parts", "ros.parts"),
    *("formats.mjcf.models", "physics.compiled.compiling", "physics.parts"),
)
"""Modules that make parts whose types are defined elsewhere."""

_ASK = type_name(Ask)


class Subject(Record, eq=False):
    """One package under review.

    Attributes:
        package: The package.
        cache: The cache of results that take long.
        stages: Called with a message when a long step starts.
        devices: Sensor devices of which figures are known.
        processes: Processes that wait for something to do.
        xacro_args: Arguments for xacro, before those that launch files give.
        allowance: What each part, and each rule, may use.
        ends: The processes to stop when the check ends.
    """

    package: Package
    cache: Cache = NO_CACHE
    stages: Stages = field(default_factory=Stages)
    devices: KnownDevices = field(default_factory=known_devices)
    processes: StartedProcesses = NO_PROCESSES
    xacro_args: Mapping[str, str] = field(default_factory=dict)
    allowance: Allowance = field(default_factory=Allowance)
    ends: ExitStack = field(default_factory=ExitStack)
    _made: dict[str, tuple[object, ...] | NotAvailable] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Store the inputs of parts."""
        given: dict[type, object] = {
            Package: self.package,
            Cache: self.cache,
            Stages: self.stages,
            KnownDevices: self.devices,
            StartedProcesses: self.processes,
            ExitStack: self.ends,
            XacroArguments: XacroArguments(self.xacro_args),
            Expander: Expander(self.cache, self.processes.xacro or xacro_server()),
            MeshServer: MeshServer(self.processes.meshes or mesh_server()),
        }
        for kind, part in given.items():
            self._made.setdefault(type_name(kind), (part,))

    def part(self, kind: str) -> Sequence[object] | NotAvailable:
        """Return the part whose type has this name; a file may contain several robots.

        Raises:
            LookupError: A rule requests something that is not a part of a package.
        """
        if kind in self._made:
            return self._made[kind]
        try:
            with self.allowance.piece():
                return self._part(kind)
        except Exceeded as exceeded:
            missing = NotAvailable(f"{_words(kind)} cannot be had: it {exceeded.reason}")
            self._made[kind] = missing
            return missing

    def one(self, kind: type[T]) -> T | NotAvailable:
        """Return the part of a type; the first one where there are several."""
        had = self.all(kind)
        return had if isinstance(had, NotAvailable) else had[0]

    def all(self, kind: type[T]) -> tuple[T, ...] | NotAvailable:
        """Return all parts of a type; at least one."""
        return cast("tuple[T, ...] | NotAvailable", self._part(type_name(kind)))

    def cached_parts(self, kind: type[T]) -> tuple[T, ...]:
        """Return a part that has been made; nothing if it was not requested or is missing."""
        had = self._made.get(type_name(kind), ())
        return () if isinstance(had, NotAvailable) else cast("tuple[T, ...]", had)

    def _part(self, kind: str) -> tuple[object, ...] | NotAvailable:
        if kind not in self._made:
            provider = _provider(kind)
            if provider is None:
                raise LookupError(f"{kind} is not a part of a package")
            self._made[kind] = self._make(provider)
        return self._made[kind]

    def _make(self, provider: Provider) -> tuple[object, ...] | NotAvailable:
        arguments: dict[str, object] = {}
        for name, need in provider.needs.items():
            had = (self,) if need.kind == _ASK else self._part(need.kind)
            if isinstance(had, NotAvailable):
                if not need.optional:
                    return had
                arguments[name] = had
            else:
                arguments[name] = had if need.several else had[0]
        made = provider.function(**arguments)
        return made if isinstance(made, NotAvailable | tuple) else (made,)

    def with_part(self, part: object, kept: Collection[type] | None = None) -> Subject:
        """Return the same package with another part instead of its own.

        Args:
            part: The part.
            kept: Types of the parts made so far that do not depend on it; None for all.
        """
        names = self._made if kept is None else map(type_name, kept)
        known = {name: self._made[name] for name in names if name in self._made}
        return replace(self, _made={**known, type_name(type(part)): (part,)})

    def with_package(self, package: Package) -> Subject:
        """Return the same of another state of the package."""
        return replace(self, package=package, ends=ExitStack(), _made={})

    @contextmanager
    def parts_of(self, package: Package) -> Iterator[Subject]:
        """Return the parts of another package, to compare with."""
        other = Subject(package)
        try:
            yield other
        finally:
            other.close()

    def close(self) -> None:
        """End the processes that are still running or waiting."""
        self.processes.stop()
        for reader in self.cached_parts(MeshServer):
            reader.server.stop()
        for expander in self.cached_parts(Expander):
            expander.server.stop()
        self.ends.close()


def _words(kind: str) -> str:
    """Return the name of a part's type as words: "the launch graph"."""
    name = kind.rpartition(":")[2]
    return f"the {re.sub('(?<!^)(?=[A-Z])', ' ', name).lower()}"


def _provider(kind: str) -> Provider | None:
    """Return what makes a part: it is in the module of the type, or in one of `PROVIDERS`."""
    modules = (kind.partition(":")[0], *(f"{PACKAGE}.{name}" for name in PROVIDERS))
    return next((found[kind] for found in map(_providers, modules) if kind in found), None)


@cache
def _providers(module: str) -> dict[str, Provider]:
    return providers_in(import_module(module))
