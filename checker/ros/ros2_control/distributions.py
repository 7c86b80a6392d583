"""Hardware components and controllers of ros2_control in a ROS 2 distribution."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cache
from typing import Any

from msgspec import convert, field

from checker.base.record import Record
from checker.base.resources import table
from checker.package.package import Package
from checker.rule import Context

DEFAULT = "jazzy"
ORDER = ("humble", "iron", "jazzy", "kilted", "lyrical", "rolling")
_CUT_FROM = {"lyrical": "rolling", "iron": "humble"}
"""Distributions without their own column in the tables, and the one that they are like."""
_GAZEBO_PACKAGES = ("gz_ros2_control", "ign_ros2_control", "gazebo_ros2_control")
_MOCK_PACKAGES = ("mock_components", "fake_components")
_COMPLETE = (*_GAZEBO_PACKAGES, *_MOCK_PACKAGES)
"""Packages of hardware components all of whose classes are in the table."""


def distribution_of(context: Context) -> str:
    """Return the ROS 2 distribution to judge for: the context's, else that of its release."""
    of_release = {
        entry["gazebo"]: entry["distro"]
        for entry in reversed(table("gazebo_releases")["ros"])
        if entry["distro"] != "iron"
    }
    return context.distro or of_release.get(context.release, DEFAULT)


def named_distribution(package: Package, context: Context) -> str:
    """Return the ROS 2 distribution that the user or the package names; empty if neither does."""
    sign = package.distribution_sign
    named = sign.distro if sign is not None else ""
    return context.distro if context.distro_is_known else named


def is_from(distribution: str, first: str) -> bool:
    """Return whether a distribution is one, or a later one."""
    return ORDER.index(distribution) >= ORDER.index(first)


def _column(distribution: str) -> str:
    return _CUT_FROM.get(distribution, distribution)


class HardwareClass(Record):
    """A class of hardware components that is known by its name.

    Attributes:
        distros: The distributions that have it; empty for a name that represents no class.
        evidence: The evidence for the entry; `memory` is not enough for an error.
    """

    name: str
    package: str
    distros: tuple[str, ...]
    note: str
    evidence: str

    def exists_in(self, distribution: str) -> bool:
        """Return whether a distribution has it."""
        return bool({"*", distribution, _column(distribution)} & set(self.distros))


@cache
def hardware_classes() -> Mapping[str, HardwareClass]:
    """Return the known classes of hardware components by their names."""
    known = convert(table("ros2_control_hardware")["plugins"], tuple[HardwareClass, ...])
    return {entry.name: entry for entry in known}


def is_of_gazebo(plugin: str) -> bool:
    """Return whether a hardware class only works within Gazebo's process."""
    package = plugin.partition("/")[0]
    return package in _GAZEBO_PACKAGES or package.endswith(_GAZEBO_PACKAGES)


def is_mock(plugin: str) -> bool:
    """Return whether a hardware class only repeats its commands as states."""
    return plugin.partition("/")[0] in _MOCK_PACKAGES


def has_every_class(package: str) -> bool:
    """Return whether all hardware classes of a package are known."""
    return package in _COMPLETE


class KnownParameter(Record, rename={"distros": "in"}):
    """A parameter of a controller type.

    Attributes:
        type: `double`, `string_array`, …
        distros: The distributions that know it; all of its controller when empty.
        default: Its default; None if it has none.
        default_by: Its default in distributions that have another one.
        validation: Names of its validators.
    """

    type: str = ""
    distros: tuple[str, ...] = ()
    default: Any = None
    default_by: Mapping[str, Any] = {}
    validation: tuple[str, ...] = ()

    def default_in(self, distribution: str) -> Any:
        """Return its default in a distribution; None if it has none."""
        return self.default_by.get(_column(distribution), self.default)


class ControllerType(Record):
    """A controller type of ros2_controllers.

    Attributes:
        package: The package that exports it.
        distros: The distributions that have it.
        joint_params: Parameters that name joints.
        sensor_params: Parameters that name a sensor or gpio of `<ros2_control>`.
        required: Parameters without which it cannot be configured, and where.
        params: All its parameters by name; `<joints>` in a name represents each of that list.
        interface: Command interface of its joints; empty if the parameters state it.
    """

    package: str
    distros: tuple[str, ...]
    joint_params: tuple[str, ...]
    sensor_params: tuple[str, ...]
    required: Mapping[str, tuple[str, ...]]
    params: Mapping[str, KnownParameter]
    interface: str = field(default="")

    def exists_in(self, distribution: str) -> bool:
        """Return whether a distribution has it."""
        return _column(distribution) in self.distros

    def known_in(self, name: str, distribution: str) -> bool:
        """Return whether a parameter exists in a distribution."""
        parameter = self.parameter(name)
        return parameter is not None and (
            not parameter.distros or _column(distribution) in parameter.distros
        )

    def parameter(self, name: str) -> KnownParameter | None:
        """Return a parameter by its name, in whatever distribution it exists."""
        found = self.params.get(name)
        if found is not None:
            return found
        matching = (known for known in self.params if "<" in known and _fits(known, name))
        return next((self.params[known] for known in matching), None)

    def lacking(self, stated: Collection[str], distribution: str) -> list[str]:
        """Return the parameters without which it cannot be configured and which are not stated."""
        return [
            name
            for name in sorted({*self.required, *self.params})
            if "<" not in name and name not in stated and self.requires(name, distribution)
        ]

    def requires(self, name: str, distribution: str) -> bool:
        """Return whether it cannot be configured without a parameter."""
        if _column(distribution) in self.required.get(name, ()):
            return True
        known = self.params.get(name)
        # Where spellings changed, either of two may be stated.
        return (
            known is not None
            and not known.distros
            and known.default == 0.0
            and "gt<>" in known.validation
        )


def _fits(known: str, name: str) -> bool:
    """Return whether a name is that of a parameter for each entry of a list; it may have dots."""
    before, _, rest = known.partition("<")
    after = rest.partition(">")[2]
    inner = len(name) > len(before) + len(after)
    return inner and name.startswith(before) and name.endswith(after)


@cache
def controller_types() -> Mapping[str, ControllerType]:
    """Return the controller types of ros2_controllers by their names."""
    return convert(table("ros2_controllers")["controllers"], dict[str, ControllerType])


COMMON_PARAMETERS = frozenset(
    ("type", "update_rate", "is_async", "use_sim_time", "params_file", "node_options_args")
) | {"fallback_controllers", "thread_priority"}
"""Parameters of every controller."""
