"""A model that cannot be spawned, or is spawned where its controllers do not expect it.

`spawn_model` needs a name, a format and a description that exists; without one of them the robot
never appears in Gazebo. A plugin without `<robotNamespace>` runs its controller manager in the
namespace in which the model is spawned; controllers started in another namespace wait forever.

Fix: give `-urdf`, `-model <name>` and `-param robot_description` (loaded before) or `-file`, and
the `-robot_namespace` of the controllers.
Source: gazebo_ros, `spawn_model`; gazebo_ros_api_plugin, `walkChildAddRobotNamespace`.
"""

from collections.abc import Iterable

from checker.base.words import Suggestions
from checker.finding import Fix
from checker.ros.control.controllers import ControlPlugin, ControlSystem
from checker.ros.control.nodes import SpawnedModel
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule, unchecked
from checker.source.text import Span
from checker.source.xml_insertion import append_to

FORMATS = ("-urdf", "-sdf")
SOURCES = ("-param", "-file", "-database", "-stdin")


@rule("CTL008", "invalid-spawn-model-call", Severity.ERROR, Concern.INTERFACE)
def check(control: ControlSystem) -> Findings:
    """Report calls of spawn_model that fail, or that do not fit the controllers."""
    for launch in control.launches:
        for fault in launch.missing:
            yield finding(fault, fault.message)
    for model in control.models:
        if not model.is_known:
            yield unchecked(f"what node {model.node.name} spawns is known only at launch")
            continue
        yield from _incomplete(control, model)
        yield from _without_parameter(control, model)
        yield from _misspelt_names(control, model)
        yield from _elsewhere(control, model)


def _incomplete(control: ControlSystem, model: SpawnedModel) -> Findings:
    needs = (("-model <name>", ("-model",)), (" or ".join(FORMATS), FORMATS))
    for words, options in (*needs, (" or ".join(SOURCES[:2]), SOURCES)):
        if not any(option in model.options for option in options):
            yield finding(
                model,
                f"node {model.node.name!r} calls spawn_model without {words}, so it spawns nothing",
                fix=_named(control, model) if options == ("-model",) else None,
            )


def _named(control: ControlSystem, model: SpawnedModel) -> Fix | None:
    """Return the fix that calls the model like the only robot, unless another one is."""
    robots = {robot.value for robot in control.robots} - {each.model for each in control.models}
    source = model.options.get("-param") or model.options.get("-file")
    if source is None or len(robots) != 1 or len(control.robots) != 1:
        return None
    end = Span(source.span.source, source.span.end, source.span.end)
    return Fix(Safety.UNSAFE, (end.replacement(f" -model {robots.pop()}"),))


def _without_parameter(control: ControlSystem, model: SpawnedModel) -> Findings:
    names = {name for launch in control.launches for name in launch.parameters}
    if not model.parameter or model.parameter in names:
        return
    if control.unread:
        yield from map(unchecked, control.unread)
        return
    suggestions = Suggestions(names)
    yield finding(
        model.options["-param"],
        f"node {model.node.name!r} spawns the model from parameter {model.parameter}, which no "
        f"launch file sets{suggestions.hint(model.parameter)}",
        fix=_other_parameter(model, suggestions),
    )


def _other_parameter(model: SpawnedModel, names: Suggestions) -> Fix | None:
    """Return the fix that writes the parameter that is meant, with or without its `/`."""
    span, meant = model.options["-param"].span, names.correction(model.parameter)
    own = model.parameter.lstrip("/")
    if not meant or span.text.count(own) != 1:
        return None
    return replace_text(span, span.text.replace(own, meant.lstrip("/")), Safety.UNSAFE)


def _misspelt_names(control: ControlSystem, model: SpawnedModel) -> Findings:
    """Report a name that is close to, but not, the robot's name or its namespace."""
    known = {robot.value for robot in control.robots}
    known |= {namespace.rpartition("/")[2] for namespace in control.namespaces}
    near = Suggestions(sorted(known - {""})).closest(model.model)
    if "-model" in model.options and near and not _same(model.model, known):
        yield finding(
            model.options["-model"],
            f"node {model.node.name!r} spawns the model as {model.model!r}; did you mean {near!r}?",
            severity=Severity.WARNING,
        )


def _same(name: str, known: Iterable[str]) -> bool:
    """Return whether a name is a known one, perhaps with a number or more words around it."""
    plain = name.rstrip("0123456789_").lower()
    return any(
        namespace
        and (
            namespace.lower() in name.lower()
            or plain in (namespace.rstrip("0123456789_").lower(), "")
        )
        for namespace in known
    )


def _elsewhere(control: ControlSystem, model: SpawnedModel) -> Findings:
    """Report a model whose plugin runs the controller manager where no controller is started."""
    silent = [plugin for plugin in control.plugins if plugin.namespace is None]
    if not silent or "-sdf" in model.options or not control.namespaces:
        return
    if model.namespace not in control.namespaces:
        yield finding(
            model.options.get("-robot_namespace", model),
            f"node {model.node.name!r} spawns the model in namespace {model.namespace!r}, so "
            "gazebo_ros_control runs there, but the controllers are started in "
            f"{', '.join(map(repr, sorted(control.namespaces)))}",
            related=[(silent[0], "states no <robotNamespace>")],
            fix=_stated(silent[0], control),
        )


def _stated(plugin: ControlPlugin, control: ControlSystem) -> Fix | None:
    """Return the fix that states the only namespace in which controllers are started."""
    if len(control.namespaces) != 1:
        return None
    line = f"<robotNamespace>{min(control.namespaces)}</robotNamespace>"
    return Fix(Safety.UNSAFE, (append_to(plugin.plugin.element, [line]),))


_SPAWN = "launch/spawn.launch"
_FIND = "$(find acme_arm_description)"


def _example(args: str, file: str = "arm.urdf") -> str:
    mark = "  <!-- ^ CTL008 -->"
    description = f'<param name="robot_description" textfile="{_FIND}/urdf/{file}"/>'
    node = (
        f'<node name="spawn" pkg="gazebo_ros" type="spawn_model" args="{args.replace("|", "")}"/>'
    )
    return f"""<launch>
{description}{mark if "none" in file else ""}
{node}{mark if "|" in args else ""}
</launch>
"""


_SILENT = '<gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo>'
_USUAL = "-urdf -param robot_description -model arm"

GOOD = [
    {"@urdf": True},
    {
        "@urdf": True,
        _SPAWN: _example("-z 0.2 -urdf -param /robot_description -model arm_1 -unpause"),
    },
    {"@urdf": True, _SPAWN: _example(f"-urdf -file {_FIND}/urdf/arm.urdf -model left_arm -x -0.5")},
    {"@urdf": _SILENT, _SPAWN: _example(f"{_USUAL} -robot_namespace arm")},
    {
        "@urdf": True,
        _SPAWN: _example(_USUAL, "none.urdf").replace("  <!-- ^ CTL008 -->", ""),
        "Dockerfile": "RUN xacro arm.xacro > /ws/src/acme_arm_description/urdf/none.urdf\n",
    },
]
BAD = [
    {"@urdf": True, _SPAWN: _example("|-urdf -param robot_description", "arm.urdf")},
    {"@urdf": True, _SPAWN: _example("|-param robot_description -model arm")},
    {"@urdf": True, _SPAWN: _example("|-urdf -model arm")},
    {"@urdf": True, _SPAWN: _example("|-urdf -param robot_descripton -model arm")},
    {"@urdf": True, _SPAWN: _example(f"|-urdf -file {_FIND}/urdf/none.urdf -model arm")},
    {"@urdf": True, _SPAWN: _example(_USUAL, "none.urdf")},
    {"@urdf": True, _SPAWN: _example("|-urdf -param robot_description -model arrm")},
    {"@urdf": _SILENT, _SPAWN: _example(f"|{_USUAL} -robot_namespace robot")},
    {
        "@urdf": _SILENT,
        _SPAWN: _example(_USUAL),
        "@reported": ["launch/spawn.launch:3"],
    },
]
