"""A detachable joint names a model or link that the world does not have.

The DetachableJoint system attaches its model to a link of another model. It looks for that model by
name at each step, and prints a warning while there is none; if the model has no such link, nothing
is attached. A robot that is spawned later may be the model: a warning.

Fix: write the name that the model has in this world; that of an include may differ from its file's.
Source: gz-sim, DetachableJoint system.
"""

from checker.base.words import Suggestions
from checker.model.world import World
from checker.rule import Concern, Findings, Severity, misspelt, rule

_CLASS = "DetachableJoint"
_OWN = "__model__"


@rule("WLD006", "joint-to-absent-model", Severity.WARNING, Concern.ROBOT)
def check(world: World) -> Findings:
    """Report names of models, and of their links, that are not in the world."""
    if world.unknown:
        return
    models = {model.name.value: model for model in world.models}
    for model in world.models:
        for plugin in model.plugins:
            child = next(plugin.at("child_model"), None)
            if plugin.class_name != _CLASS or child is None or "::" in child.value:
                continue
            other = model if child.value == _OWN else models.get(child.value)
            if other is None:
                message = f"world {world.name!r} has no model {child.value!r} to attach"
                yield misspelt(child, message, Suggestions(sorted(models)))
                continue
            link = next(plugin.at("child_link"), None)
            known = other.missing_parts or link is None or link.value in other.links_by_name
            if link is not None and not known:
                message = f"{other.name.value!r} has no link {link.value!r} to attach"
                yield misspelt(link, message, Suggestions(sorted(other.links_by_name)))


def _world(model: str = "box", link: str = "body", more: str = "") -> str:
    return f"""
<sdf version="1.9">
  <world name="hall">
    <model name="box"><link name="body"/></model>{more}
    <model name="gripper">
      <link name="hand"/>
      <plugin filename="gz-sim-detachable-joint-system" name="gz::sim::systems::DetachableJoint">
        <parent_link>hand</parent_link>
        <child_model>{model}
        <child_link>{link}
      </plugin>
    </model>
  </world>
</sdf>
"""


_MODEL, _LINK = "</child_model>", "</child_link>"
_MARK = "  <!-- ^ WLD006 -->"
GOOD = [
    _world(f"box{_MODEL}", f"body{_LINK}"),
    _world(f"crate{_MODEL}", f"body{_LINK}", "<include><uri>model://crate</uri></include>"),
]
BAD = [
    _world(f"crate{_MODEL}{_MARK}", f"body{_LINK}"),
    _world(f"box{_MODEL}", f"bodi{_LINK}{_MARK}"),
]
