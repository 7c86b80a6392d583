"""Controllers of ros_control: what YAML files configure and launch files spawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

from msgspec import field

from checker.base.record import Record
from checker.formats.urdf.description import Transmission
from checker.launch.ros1.graph import resolve_name
from checker.model.components import Joint, Plugin
from checker.model.ros_parameters import Parameter
from checker.ros.control.nodes import Spawned, SpawnedModel, StateListener, StatePublisher
from checker.source.text import Located, Span

IMMOBILE = ("fixed", "floating")
STATE_CONTROLLER = "JointStateController"
_PREFIX = "hardware_interface/"


class Gain(Record, eq=False):
    """A gain of a PID loop.

    Attributes:
        value: The value as a number; None if it is not a number, NaN if it is known at launch
            only.
        text: The text as written.
    """

    value: float | None
    text: str
    span: Span


class Controller(Record, eq=False):
    """A controller that a YAML text configures.

    Attributes:
        name: Path below the namespace, such as `arm_controller`.
        namespace: Absolute namespace it is loaded under, such as `/gurdy`.
        type: The type, such as `effort_controllers/JointPositionController`; None if not stated.
        joints: Names under `joint`, `joints` or the wheels of a drive.
        gains: The gains by joint, then `p`, `i`, `d`; a joint whose loop is not configured is
            absent.
        loaded_by: The `<rosparam>` that loads it; None if no launch file does.
        span: Its key.
        parameters: All that is configured for it, under names with dots between their levels.
    """

    name: str
    namespace: str
    type: Located[str] | None
    joints: tuple[Located[str], ...]
    gains: Mapping[str, Mapping[str, Gain]]
    span: Span
    loaded_by: Span | None = None
    parameters: Mapping[str, Parameter] = field(default_factory=dict)

    @property
    def full_name(self) -> str:
        """Namespace and name: `/gurdy/arm_controller`."""
        return resolve_name(self.name, self.namespace)

    @property
    def family(self) -> str:
        """Package of its type: `effort_controllers`; empty if not stated."""
        return self.type.value.partition("/")[0] if self.type else ""

    @property
    def kind(self) -> str:
        """Class of its type: `JointPositionController`; empty if not stated."""
        return self.type.value.partition("/")[2] if self.type else ""


class ControlPlugin(Record, eq=False):
    """The plugin `gazebo_ros_control`.

    Attributes:
        namespace: What `<robotNamespace>` states, absolute; None if it states nothing.
        parameter: What `<robotParam>` states, else `robot_description`.
    """

    plugin: Plugin
    namespace: Located[str] | None
    parameter: str

    @property
    def span(self) -> Span:
        """The start tag."""
        return self.plugin.span


class SimulatorGains(Record, eq=False):
    """Gains that `gazebo_ros_control` uses itself, by `pid_gains` in its namespace."""

    joint: str
    gains: Mapping[str, Gain]
    span: Span


class ParameterFault(Record, eq=False):
    """A file that a launch file names, and that is not there or cannot be read.

    Attributes:
        span: What names the file, or where its text cannot be read.
        message: What is wrong.
        hides: Whether the file may well configure what nothing else does.
    """

    span: Span
    message: str
    hides: bool = False


class ControlLaunch(Record, eq=False):
    """Effects of one launch file, with all that it includes, on control.

    Attributes:
        file: A launch file that no other one starts.
        spawned: Controllers that it starts.
        listeners: Nodes that turn joint states into transforms.
        models: Models that it spawns into Gazebo.
        state_publishers: Nodes that publish joint states.
        parameters: Absolute names of the parameters that it sets, `<rosparam>`s by their namespace.
        missing: Descriptions that it names and that do not exist.
    """

    file: str
    spawned: tuple[Spawned, ...]
    listeners: tuple[StateListener, ...]
    models: tuple[SpawnedModel, ...]
    state_publishers: tuple[StatePublisher, ...]
    parameters: frozenset[str]
    missing: tuple[ParameterFault, ...] = ()


class ControlSystem(Record, eq=False, dict=True):
    """Control of the joints of a URDF package.

    Attributes:
        robots: Names of the robots.
        joints: The joints by name, of all robots; None if the robots are not known.
        transmissions: The transmissions of all robots.
        plugins: Each use of `gazebo_ros_control`.
        publishes_states: Whether a Gazebo plugin publishes the joint states itself.
        has_manager: Whether any Gazebo plugin runs a controller manager.
        otherwise_moved: Names that plugins other than `gazebo_ros_control` mention.
        controllers: Configured in YAML that a launch file loads, or that is in the package.
        simulator_gains: The gains of `gazebo_ros_control` itself.
        launches: One for each launch file that no other one starts.
        dormant: Controllers started by nodes that a condition leaves out.
        faults: Files of parameters that launch files name and that do not exist.
        file: The file that describes the robot.
        unread_robot: The reasons why robots, joints and transmissions are not known; else empty.
        unread: The reasons why parts of what the launch files start and load are not known.
    """

    robots: tuple[Located[str], ...]
    joints: Mapping[str, Joint] | None
    transmissions: tuple[Transmission, ...]
    plugins: tuple[ControlPlugin, ...]
    publishes_states: bool
    has_manager: bool
    otherwise_moved: frozenset[str]
    controllers: tuple[Controller, ...]
    simulator_gains: tuple[SimulatorGains, ...]
    launches: tuple[ControlLaunch, ...]
    dormant: tuple[Spawned, ...] = ()
    faults: tuple[ParameterFault, ...] = ()
    file: str = ""
    unread_robot: str = ""
    unread: tuple[str, ...] = ()

    @cached_property
    def spawned_controllers(self) -> tuple[Spawned, ...]:
        """Controllers that launch files start; each place once."""
        distinct = {
            (controller.full_name, controller.span.source.file, controller.span.start): controller
            for launch in self.launches
            for controller in launch.spawned
        }
        return tuple(distinct.values())

    @cached_property
    def configured_controllers(self) -> Mapping[str, Controller]:
        """Controllers that launch files load, by full name; the last one counts."""
        return {
            controller.full_name: controller
            for controller in self.controllers
            if controller.loaded_by
        }

    @cached_property
    def namespaces(self) -> frozenset[str]:
        """Namespaces in which launch files start controllers."""
        return frozenset(controller.namespace for controller in self.spawned_controllers)

    @cached_property
    def models(self) -> tuple[SpawnedModel, ...]:
        """Models that launch files spawn; each place once."""
        distinct = {
            (model.node.span.source.file, model.node.span.start, model.model): model
            for launch in self.launches
            for model in launch.models
        }
        return tuple(distinct.values())

    def moves(self, name: str) -> bool:
        """Return whether a motor can move a joint, as far as known."""
        joint = (self.joints or {}).get(name)
        return joint is not None and joint.type.value not in IMMOBILE

    @cached_property
    def namesakes(self) -> Mapping[str, Controller]:
        """Controllers that launch files load, by name, whatever their namespace."""
        return {controller.name: controller for controller in self.configured_controllers.values()}

    def publishers(self, launch: ControlLaunch) -> Iterator[Spawned]:
        """Yield the controllers of a launch file that publish joint states."""
        for spawned in launch.spawned:
            controller = self.configured_controllers.get(spawned.full_name) or self.namesakes.get(
                spawned.name
            )
            if controller is not None and controller.kind == STATE_CONTROLLER:
                yield spawned

    @cached_property
    def interfaces(self) -> Mapping[str, Located[str]]:
        """The hardware interface of each joint, without `hardware_interface/` in front.

        Like Gazebo, it takes the joint's first, and the actuator's where the joint has none.
        """
        joints: dict[str, Located[str]] = {}
        for transmission in self.transmissions:
            ends = (*transmission.joints, *transmission.actuators)
            first = next((name for end in ends for name in end.interfaces), None)
            for joint in transmission.joints:
                named = next(iter(joint.interfaces), first)
                if named is not None:
                    plain = Located(named.value.removeprefix(_PREFIX), named.span)
                    joints.setdefault(joint.name.value, plain)
        return joints
