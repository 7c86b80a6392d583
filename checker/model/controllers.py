"""Controllers of ros2_control, as parameter files configure them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from checker.base.record import Record
from checker.model.ros_parameters import MANAGER, NodeBlock, Parameter
from checker.source.text import Located, Span

_TYPE = re.compile(r"\w{1,200}/\w{1,200}\Z")
_LISTED = ".type"
_EVERY = "**"
_TRAJECTORIES = "joint_trajectory_controller/JointTrajectoryController"
_GAINS = ("p", "i", "d", "ff_velocity_scale")


class Controller(Record, eq=False):
    """A controller that parameter files configure.

    Attributes:
        name: The name as its node is called.
        type: The type, such as `diff_drive_controller/DiffDriveController`.
        parameters: The parameters of its own block and of those for every node, by name.
        own: Names of the parameters in its own block.
        listed: Whether the controller manager's block names it.
        span: The key of its block, else the place that states its type.
        block: The key of its own block; None if it has none.
    """

    name: str
    type: Located[str]
    parameters: Mapping[str, Parameter]
    own: frozenset[str]
    listed: bool
    span: Span
    block: Span | None = None

    @property
    def class_name(self) -> str:
        """Class of its type: `DiffDriveController`."""
        return self.type.value.rpartition("/")[2]

    @property
    def label(self) -> str:
        """Name in messages."""
        return f"controller {self.name!r}"

    @property
    def path(self) -> str:
        """A key that distinguishes it from other controllers of the robot."""
        return self.name

    @property
    def joints_without_gains(self) -> tuple[Located[str], ...]:
        """Joints that a JointTrajectoryController commands by a PID all of whose gains are 0.

        It has one for each joint if `velocity` or `effort` is its only command interface.
        """
        alone = [text.value for text in self.texts("command_interfaces")]
        if self.type.value != _TRAJECTORIES or alone not in (["velocity"], ["effort"]):
            return ()
        if alone == ["velocity"] and self.flag("open_loop_control", default=False):
            return ()
        joints = self.texts("command_joints", "joints")
        return tuple(joint for joint in joints if not self._has_gain(joint.value))

    def _has_gain(self, joint: str) -> bool:
        names = (f"gains.{joint}.{gain}" for gain in _GAINS)
        stated = [self.parameters[name] for name in names if name in self.parameters]
        return any(it.number is None or it.number.value for it in stated)

    def texts(self, *names: str) -> tuple[Located[str], ...]:
        """Return the texts of the first of these parameters that has any."""
        found = (self.parameters[name].texts for name in names if name in self.parameters)
        return next((texts for texts in found if texts), ())

    def number(self, *names: str) -> Located[float] | None:
        """Return the number of the first of these parameters that is one."""
        found = (self.parameters[name].number for name in names if name in self.parameters)
        return next((number for number in found if number is not None), None)

    def flag(self, name: str, *, default: bool) -> bool:
        """Return what a parameter of true or false states."""
        parameter = self.parameters.get(name)
        value = parameter.node.scalar if parameter is not None else None
        return value if isinstance(value, bool) else default


class ControllerFile(Record, eq=False):
    """A parameter file that is about controllers.

    Attributes:
        path: The path as the package lists it.
        blocks: What it gives to which nodes.
        loaded_by: What names it: the `<parameters>` of a Gazebo plugin, or a launch file; None when
            it is only found in the package.
        bare: Keys of controller managers below which `ros__parameters` is missing.
        refused: The key for whose value rcl refuses the file, if there is one.
    """

    path: str
    blocks: tuple[NodeBlock, ...]
    loaded_by: Span | None = None
    bare: tuple[Span, ...] = ()
    refused: Span | None = None

    @property
    def managers(self) -> tuple[NodeBlock, ...]:
        """The blocks of controller managers."""
        return tuple(block for block in self.blocks if block.node == MANAGER)


def controllers_of(files: Iterable[ControllerFile]) -> tuple[Controller, ...]:
    """Put together what files state about each controller.

    Of two types the last counts; what files of the other one state is left out.
    """
    blocks = [block for file in files for block in file.blocks]
    drafts: dict[str, _Draft] = {}
    stated: dict[tuple[str, str], str] = {}
    for name, parameter, listed in _types(blocks):
        kind = next(iter(parameter.texts), None)
        if kind is not None and _TYPE.match(kind.value):
            before = drafts.get(name)
            was_listed = before is not None and before.listed
            drafts[name] = _Draft(kind, listed or was_listed)
            stated[name, kind.span.source.file] = kind.value
    controllers = []
    for name, draft in drafts.items():
        own = draft.type.value
        agreed = [it for it in blocks if stated.get((name, it.span.source.file), own) == own]
        controllers.append(_controller(name, draft, agreed))
    return tuple(controllers)


class _Draft(Record, eq=False):
    type: Located[str]
    listed: bool


def _types(blocks: Sequence[NodeBlock]) -> Iterator[tuple[str, Parameter, bool]]:
    """Yield names of controllers with what states their type, and whether the manager does."""
    for block in blocks:
        for name, parameter in block.parameters.items():
            if name == "type" and block.node not in (MANAGER, _EVERY):
                yield block.node, parameter, False
            elif name.endswith(_LISTED) and block.node in (MANAGER, _EVERY):
                yield name.removesuffix(_LISTED), parameter, True


def _controller(name: str, draft: _Draft, blocks: Sequence[NodeBlock]) -> Controller:
    own = [block for block in blocks if block.node == name]
    parameters: dict[str, Parameter] = {}
    for block in (*(block for block in blocks if block.node == _EVERY), *own):
        parameters |= block.parameters
    names = frozenset(parameter for block in own for parameter in block.parameters)
    place = own[-1].span if own else None
    span = place or draft.type.span
    return Controller(name, draft.type, parameters, names, draft.listed, span, place)
