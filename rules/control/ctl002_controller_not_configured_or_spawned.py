"""A controller that is spawned but not configured, or configured but never spawned.

If a controller has no configuration, its spawner ends with an error and the joint moves freely. A
controller that is never spawned does nothing: the joint is not controlled, although the YAML file
has a controller for it.

Fix: use the same name for the controller in the YAML file and in the spawner's args, state its
`type`, and load the file before the spawner starts.
Source: ros_control, `controller_manager::ControllerManager::loadController`: the type is read from
`<namespace>/<controller>/type`.
"""

from checker.base.words import Suggestions
from checker.finding import Fix
from checker.ros.control.controllers import Controller, ControlSystem
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule, unchecked
from checker.source.text import Span


@rule("CTL002", "controller-not-configured-or-spawned", Severity.ERROR, Concern.INTERFACE)
def check(control: ControlSystem) -> Findings:
    """Report controllers that are only in the YAML files or only in the spawners' args."""
    for fault in control.faults:
        yield finding(fault, fault.message)
    yield from _unconfigured_controllers(control)
    yield from _without_type(control)
    yield from _never_spawned(control)


def _unconfigured_controllers(control: ControlSystem) -> Findings:
    """Report spawned controllers; another rule reports those configured in another namespace."""
    missing = [
        spawned for spawned in control.spawned_controllers if spawned.name not in control.namesakes
    ]
    if not missing or any(fault.hides for fault in control.faults):
        return
    if control.unread:
        yield from map(unchecked, control.unread)
        return
    meant = _misspelt(control)
    lying = {
        controller.name: controller
        for controller in control.controllers
        if controller.loaded_by is None
    }
    for spawned in missing:
        unloaded, near = lying.get(spawned.name), meant.get(spawned.name)
        hint = f"; did you mean {near.name!r}?" if near is not None else ""
        if unloaded is not None:
            hint = (
                f"; {unloaded.span.source.file} configures it, but no launch file loads that file"
            )
        yield finding(
            spawned,
            f"controller {spawned.name!r} is spawned, but no loaded file configures it{hint}",
            related=[(near, f"{near.name!r} is configured here")] if near is not None else (),
            fix=_renamed(spawned.name, spawned.span, near.name) if near is not None else None,
        )


def _renamed(name: str, span: Span, meant: str) -> Fix | None:
    words = span.text.split(" ")
    if words.count(name) != 1:
        return None
    words[words.index(name)] = meant
    return replace_text(span, " ".join(words), Safety.UNSAFE)


def _misspelt(control: ControlSystem) -> dict[str, Controller]:
    """Return the controllers meant by names that are spawned but not configured."""
    names = Suggestions(control.namesakes)
    spawned = {controller.name for controller in control.spawned_controllers}
    near = {name: names.closest(name) for name in sorted(spawned - control.namesakes.keys())}
    return {name: control.namesakes[meant] for name, meant in near.items() if meant}


def _without_type(control: ControlSystem) -> Findings:
    for spawned in control.spawned_controllers:
        controller = control.namesakes.get(spawned.name)
        if controller is not None and controller.type is None:
            yield finding(
                controller,
                f"controller {controller.name!r} has no type, expected one such as "
                "'effort_controllers/JointPositionController'",
                key=f"type {controller.full_name}",
            )


def _never_spawned(control: ControlSystem) -> Findings:
    started = {controller.name for controller in (*control.spawned_controllers, *control.dormant)}
    # One that a spawner misspells is reported there.
    started |= {controller.name for controller in _misspelt(control).values()}
    idle = [
        controller
        for controller in control.controllers
        if controller.name not in started and _is_one(controller)
    ]
    if idle and control.unread:
        yield from map(unchecked, control.unread)
        return
    for controller in idle:
        yield finding(
            controller,
            f"controller {controller.name!r} is configured, but no launch file spawns it",
            severity=Severity.WARNING,
        )


def _is_one(controller: Controller) -> bool:
    """Return whether the mapping is certainly a controller: other things have a type, too."""
    return "controller" in controller.family


_CONFIG, _LAUNCH = "config/control.yaml", "launch/control.launch"
_STATES = """arm:
  state_controller:
    type: joint_state_controller/JointStateController
"""


def _shoulder(name: str, kind: str = "    type: effort_controllers/JointPositionController") -> str:
    return f"""{_STATES}  {name}
{kind}
    joint: shoulder
    pid: {{p: 10.0}}
"""


def _launch(args: str, more: str = "", find: str = "$(find acme_arm_description)/config") -> str:
    return f"""<launch>
  <rosparam file="{find}/control.yaml"/>{more}
  <node name="spawner" pkg="controller_manager" type="spawner" ns="arm" args="{args}
</launch>
"""


_BOTH = 'state_controller shoulder_controller"/>'
_MARK = "  <!-- ^ CTL002 -->"

GOOD = [
    {"@urdf": True},
    {
        "@urdf": True,
        _LAUNCH: _launch(
            f"--timeout 30 {_BOTH}",
            '\n  <rosparam ns="arm">\n    planner: {type: geometric/RRT}\n  </rosparam>',
        ),
    },
    {
        "@urdf": True,
        _CONFIG: _STATES,
        _LAUNCH: _launch(
            _BOTH,
            """
  <rosparam ns="arm/shoulder_controller" subst_value="true">
    type: effort_controllers/JointPositionController
    joint: shoulder
  </rosparam>""",
        ),
    },
    {
        "@urdf": True,
        _LAUNCH: _launch('state_controller"/>').replace(
            "</launch>",
            """  <node if="0" name="start" pkg="controller_manager" type="controller_manager"
        ns="arm" args="spawn shoulder_controller"/>
</launch>""",
        ),
    },
]
BAD = [
    {"@urdf": True, _LAUNCH: _launch('state_controller"/>'), _CONFIG: _shoulder("c:  # ^ CTL002")},
    {"@urdf": True, _LAUNCH: _launch(_BOTH + _MARK), _CONFIG: _shoulder("shoulder:  # ^ CTL002")},
    {"@urdf": True, _CONFIG: _shoulder("shoulder_controller:  # ^ CTL002", "    rate: 5")},
    {
        "@urdf": True,
        _LAUNCH: """<launch>
  <node name="spawner" pkg="controller_manager" type="spawner"
        args="--namespace=/arm state_controller shoulder_controller"/>  <!-- ^ CTL002 -->
</launch>
""",
    },
    {
        "@urdf": True,
        _LAUNCH: _launch(_BOTH + _MARK, find="$(find acme_arm_description)").replace(
            'yaml"/>', 'yaml"/>  <!-- ^ CTL002 -->'
        ),
    },
    {
        "@urdf": True,
        _CONFIG: "arm:\n  state_controller: {type: a/B\n  b: 1  # ^ CTL002\n",
    },
]
