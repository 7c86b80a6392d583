"""A keyframe whose numbers are fewer than those of the model.

MuJoCo fills missing numbers with those of the reference pose, without a message. Often a scene puts
an object in front of the robot, so that the first numbers of the robot's keyframe are taken for
the object: the robot starts in another pose than the author had in mind. Versions before 3.3 refuse
such a model. More numbers than needed are an error of MuJoCo itself.

`qpos` has 7 numbers for each free joint (position, then quaternion w x y z), 4 for each ball joint
and 1 for each other one; `ctrl` has one for each actuator.

Fix: state all numbers, in the order of the bodies of the whole model.
Source: MuJoCo 4.0.0, tried; google-deepmind/mujoco#2040, #2365.
"""

from checker.formats.mjcf.values import numbers
from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule

_SIZES = {"qpos": "nq", "qvel": "nv", "act": "na", "ctrl": "nu"}
_WHAT = {
    "qpos": "coordinates",
    "qvel": "velocities",
    "act": "states of actuators",
    "ctrl": "actuators",
}


@rule("MJC005", "key-size", Severity.ERROR, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report vectors of keyframes that are too short."""
    if model.compiled.refusals:
        return
    for element in model.model.tagged("key"):
        for name, size in _SIZES.items():
            value, stated = element.attribute(name), numbers(element, name)
            needed = model.compiled.sizes[size]
            if value is not None and stated is not None and len(stated) < needed:
                yield finding(
                    value,
                    f"{name} of keyframe {element.get('name') or ''!r} has {len(stated)} "
                    f"numbers, but {model.model.file} has {needed} {_WHAT[name]}: MuJoCo takes "
                    "them for the first ones and fills the rest with the reference pose",
                )


def _scene(key: str) -> dict[str, str]:
    return {
        "@mjcf": '<worldbody><body name="ball"><freejoint/><geom size="0.1"/></body></worldbody>\n'
        '<include file="arm_parts.xml"/>',
        "arm_parts.xml": '<mujoco><worldbody><body name="arm"><joint/><geom size="0.1"/></body>'
        f"</worldbody>\n<keyframe>\n{key}\n</keyframe></mujoco>",
    }


GOOD = [_scene('<key name="home" qpos="1 0 0.1 1 0 0 0 0.5"/>'), _scene('<key name="home"/>')]
BAD = [_scene('<key name="home" qpos="0.5"/><!-- ^ MJC005 -->')]
