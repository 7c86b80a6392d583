"""A static model with a plugin that drives it.

A static model never moves: its joints are fixed, and no force or velocity changes its pose. The
plugin starts and subscribes to its topic, but commands have no effect.

Fix: remove `<static>`, in the model or in the `<include>` that sets it; or remove the plugin.
Source: SDFormat specification, model/static; what the plugin does in a static model is from memory.
"""

from checker.model.locomotion.drive import DRIVE_CLASSES
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("DRV013", "static-model-with-drive", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report plugins that drive a static model, or move its joints."""
    if not robot.is_static:
        return
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    moving = {plugin for plugin in robot.plugins if plugin.class_name in DRIVE_CLASSES}
    moving |= set(robot.driven_joints.values())
    static = robot.element.child("static") or robot.element
    for plugin in robot.plugins:
        if plugin in moving:
            yield finding(
                plugin,
                f"model {robot.name.value!r} is static, so {plugin.label} cannot move it",
                key="static",
                related=[(static, "says so")],
            )


def _rover(static: str, mark: str = "") -> str:
    return f"""
<link name="wheel"/>
<joint name="axle" type="revolute">
  <parent>base_link</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis>
</joint>
<plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">{mark}
  <left_joint>axle</left_joint>
</plugin>
<static>{static}</static>
"""


GOOD = [
    _rover("false"),
    "<static>true</static>",
]
BAD = [_rover("true", "  <!-- ^ DRV013 -->")]
