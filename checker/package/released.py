"""Names of packages that ROS distributions have released, and keys that rosdep resolves."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

from checker.base.resources import table
from checker.base.words import Suggestions


def distributions_with(name: str) -> tuple[str, ...]:
    """Return the ROS distributions that have released a package, ROS 1's Noetic last."""
    return _released().get(name, ())


def is_of_system(name: str) -> bool:
    """Whether rosdep installs something of the operating system by this name."""
    return name in _system()


def released_names(distro: str) -> Suggestions:
    """Return what a dependency may name in a distribution, to look for misspelt names in."""
    own = [name for name, having in _released().items() if distro in having]
    return Suggestions([*own, *_system()])


@cache
def _released() -> Mapping[str, tuple[str, ...]]:
    groups = table("ros_packages")["packages"].items()
    names = {name: tuple(key.split()) for key, packages in groups for name in packages}
    return MappingProxyType(names)


@cache
def _system() -> frozenset[str]:
    return frozenset(table("ros_packages")["system"])
