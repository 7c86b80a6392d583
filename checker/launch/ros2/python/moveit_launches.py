"""The stock launch descriptions of `moveit_configs_utils`, as its functions make them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType

from checker.formats.xacro.files import ROOT
from checker.launch.ros2.actions.node_parameters import MOVEIT
from checker.launch.ros2.python import moveit
from checker.launch.ros2.python.call import Call, Work
from checker.launch.ros2.python.expressions import each
from checker.launch.ros2.values import (
    FilePath,
    Made,
    PlacedText,
    Unknown,
    Value,
    add_place,
    chosen_value,
)
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml
from checker.source.yaml import read_yaml

_MOVE_GROUP = MappingProxyType(
    {
        "allow_trajectory_execution": "true",
        "publish_monitored_planning_scene": "true",
        "capabilities": "",
        "disable_capabilities": "",
        "monitor_dynamics": "false",
    }
)
"""Arguments of move_group with their defaults."""
_ALWAYS = ("rsp", "move_group")
"""Launch files of the package that the demo includes without a condition."""


class _Stock:
    """A call of such a function: what it makes is where the call is."""

    def __init__(self, call: Call) -> None:
        configs = chosen_value(call.first("moveit_config"))
        if not isinstance(configs, Made) or configs.name != "MoveItConfigs":
            reason = configs.reason if isinstance(configs, Unknown) else "MoveIt's is not known"
            raise call.not_known(reason)
        self.call = call
        self.configs = configs
        self.folder = f"{ROOT}/{configs.values['package']}"

    def made(self, kind: str, /, **values: Value) -> Made:
        placed = {key: add_place(value, self.call.span) for key, value in values.items()}
        return Made(kind, placed, self.call.span)

    def argument(self, name: str, default: str) -> Made:
        return self.made("DeclareLaunchArgument", name=name, default_value=default)

    def given(self, name: str) -> Made:
        return self.made("LaunchConfiguration", variable_name=name)

    def when(self, name: str, kind: str = "IfCondition") -> Made:
        return self.made(kind, predicate_expression=self.given(name))

    def node(self, package: str, executable: str, **values: Value) -> Made:
        return self.made("Node", package=package, executable=executable, **values)

    def debuggable(self, package: str, executable: str, **values: Value) -> list[Value]:
        """Return a node that starts in a debugger if the argument `debug` is true."""
        without = self.when("debug", "UnlessCondition")
        node = self.node(package, executable, condition=without, **values)
        return [self.argument("debug", "false"), node]

    def parameters(self, name: str) -> Value:
        return moveit.parameters(self.call.run, self.configs, name)

    @property
    def rest(self) -> Value:
        """The parameters that the builder reads from its other files."""
        return {"moveit": Unknown(MOVEIT, self.call.span)}

    def source(self, path: str) -> SourceText | None:
        source = self.call.run.world.read(f"{self.folder}/{path}", self.call.span)
        return source if isinstance(source, SourceText) else None


def _state_publisher(stock: _Stock) -> Iterator[Value]:
    yield stock.argument("publish_frequency", "15.0")
    frequency = {"publish_frequency": stock.given("publish_frequency")}
    parameters = [stock.parameters("robot_description"), frequency]
    yield stock.node("robot_state_publisher", "robot_state_publisher", parameters=parameters)


def _rviz(stock: _Stock) -> Iterator[Value]:
    yield stock.argument("rviz_config", f"{stock.folder}/config/moveit.rviz")
    arguments = ["-d", stock.given("rviz_config")]
    yield from stock.debuggable("rviz2", "rviz2", arguments=arguments, parameters=[stock.rest])


def _assistant(stock: _Stock) -> Iterator[Value]:
    arguments = [f"--config_pkg={stock.folder}"]
    name = "moveit_setup_assistant"
    yield from stock.debuggable(name, name, arguments=arguments)


def _static_transforms(stock: _Stock) -> Iterator[Value]:
    source = stock.source(f"config/{stock.configs.values['robot']}.srdf")
    document = parse_xml(source) if source is not None else None
    joints = document.root.all("virtual_joint") if isinstance(document, XmlDocument) else ()
    for number, joint in enumerate(joints):
        given = (joint.attribute(name) for name in ("parent_frame", "child_link"))
        parent, child = (PlacedText(it.value, it.span) if it else "" for it in given)
        yield stock.node(
            "tf2_ros",
            "static_transform_publisher",
            name=f"static_transform_publisher{number}",
            arguments=["--frame-id", parent, "--child-frame-id", child],
        )


def _spawners(stock: _Stock) -> Iterator[Value]:
    source = stock.source("config/moveit_controllers.yaml")
    root = read_yaml(source).root if source is not None else None
    names: list[Value] = []
    match root.plain() if root is not None else None:
        case {"moveit_simple_controller_manager": {"controller_names": [*given]}}:
            names = [str(name) for name in given]
    for name in (*names, "joint_state_broadcaster"):
        yield stock.node("controller_manager", "spawner", arguments=[name])


def _warehouse(stock: _Stock) -> Iterator[Value]:
    path, reset = "moveit_warehouse_database_path", "reset"
    yield stock.argument(path, f"{stock.folder}/default_warehouse_mongo_db")
    yield stock.argument(reset, "false")
    parameters = {"database_path": stock.given(path), "reset": stock.given(reset)}
    yield stock.node(
        "warehouse_ros_mongo", "mongo_wrapper_ros.py", parameters=[parameters, stock.rest]
    )


def _move_group(stock: _Stock) -> Iterator[Value]:
    for name, default in _MOVE_GROUP.items():
        yield stock.argument(name, default)
    settings = {name: stock.given(name) for name in _MOVE_GROUP}
    parameters = [stock.parameters("robot_description"), stock.rest, settings]
    yield from stock.debuggable("moveit_ros_move_group", "move_group", parameters=parameters)


def _demo(stock: _Stock) -> Iterator[Value]:
    given = [*stock.call.arguments[1:], *stock.call.named.values()]
    folder = next((v.text for v in map(chosen_value, given) if isinstance(v, FilePath)), "")
    launch = f"{folder or stock.folder}/launch"

    def included(name: str, condition: Value = None) -> Made:
        path = add_place(f"{launch}/{name}.launch.py", stock.call.span)
        source = stock.made("PythonLaunchDescriptionSource", launch_file_path=path)
        values = {"launch_description_source": source, "condition": condition}
        return stock.made("IncludeLaunchDescription", **values)

    for name, default in {"db": "false", "debug": "false", "use_rviz": "true"}.items():
        yield stock.argument(name, default)
    if stock.call.run.world.exists(f"{launch}/static_virtual_joint_tfs.launch.py"):
        yield included("static_virtual_joint_tfs")
    yield from map(included, _ALWAYS)
    yield included("moveit_rviz", stock.when("use_rviz"))
    if stock.call.run.world.exists(f"{launch}/warehouse_db.launch.py"):
        yield included("warehouse_db", stock.when("db"))
    controllers = f"{stock.folder}/config/ros2_controllers.yaml"
    yield stock.node(
        "controller_manager",
        "ros2_control_node",
        parameters=[stock.parameters("robot_description"), controllers],
    )
    yield included("spawn_controllers")


def _described(actions: Callable[[_Stock], Iterator[Value]]) -> Work:
    def work(call: Call) -> Value:
        stock = _Stock(call)
        return stock.made("LaunchDescription", initial_entities=[*actions(stock)])

    return work


def _boolean_argument(call: Call) -> Value:
    """Return the argument that `DeclareBooleanLaunchArg` declares."""
    values = dict(zip(("name",), call.arguments, strict=False)) | call.named
    default = chosen_value(values.get("default_value"))
    if isinstance(default, bool):
        values["default_value"] = call.placed(str(default).lower())
    return Made("DeclareLaunchArgument", values, call.span)


def _debuggable(call: Call) -> Value:
    """Add the node that `add_debuggable_node` adds where its condition is not met."""
    names = ("ld", "package", "executable", "condition_name", "commands_file", "extra_debug_args")
    values = dict(zip(names, call.arguments, strict=False)) | call.named
    description = chosen_value(values.pop("ld", None))
    if not isinstance(description, Made) or description.name != "LaunchDescription":
        raise call.not_known("the launch description is not known")
    name = values.get("condition_name", call.placed("debug"))
    debug = Made("LaunchConfiguration", {"variable_name": name}, call.span)
    values["condition"] = Made("UnlessCondition", {"predicate_expression": debug}, call.span)
    kept = {key: value for key, value in values.items() if key not in names[3:]}
    before = description.values.get("initial_entities")
    entities = each(call.run, before, call.node) if before is not None else []
    node = call.run.guarded([Made("Node", kept, call.span)])
    description.values["initial_entities"] = [*entities, *node]
    return None


_LAUNCHES = {
    "rsp": _state_publisher,
    "moveit_rviz": _rviz,
    "setup_assistant": _assistant,
    "static_virtual_joint_tfs": _static_transforms,
    "spawn_controllers": _spawners,
    "warehouse_db": _warehouse,
    "move_group": _move_group,
    "demo": _demo,
}
FUNCTIONS: Mapping[str, Work] = MappingProxyType(
    {
        f"moveit_configs_utils.launches.generate_{name}_launch": _described(actions)
        for name, actions in _LAUNCHES.items()
    }
    | {
        f"moveit_configs_utils.{module}.{name}": work
        for module in ("launch_utils", "launches")
        for name, work in {
            "DeclareBooleanLaunchArg": _boolean_argument,
            "add_debuggable_node": _debuggable,
        }.items()
    }
)
"""The functions by their dotted path in imports. Source: moveit_configs_utils of MoveIt 2."""
