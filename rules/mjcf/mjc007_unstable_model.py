"""A model of MuJoCo whose state becomes NaN or huge within its first second.

The model is simulated for one second from its first keyframe, with the commands of that keyframe,
or from its reference pose. MuJoCo resets such a model to the start and prints a warning, so that
the robot only seems to twitch. Causes are servos that are too stiff for the time step, inertias
that are far too small, negative damping, and shapes that overlap at the start. A joint that is
faster than 500 rad/s or m/s is a warning: something falls past the ground, or is shot away.

Fix: give the joints `armature`, choose `integrator="implicitfast"`, or a smaller `timestep`.
Source: MuJoCo 4.0.0, mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC.
"""

from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_FASTEST = 500.0


@rule("MJC007", "unstable-model", Severity.ERROR, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report models that MuJoCo cannot simulate for a second."""
    compiled = model.compiled
    if model.compiled.lacks_meshes:
        yield unchecked(
            f"{model.model.file} is not simulated: {next(iter(model.text.absent.values()))}"
        )
        return
    options = next(model.model.tagged("option"), model.model.document.root)
    if compiled.trouble:
        yield finding(
            options,
            f"{model.model.file} cannot be simulated: its {compiled.trouble} is NaN or huge "
            f"after {compiled.time:.3g} s, with a time step of {compiled.timestep:g} s",
        )

    elif compiled.fastest > _FASTEST:
        yield finding(
            options,
            f"{model.model.file} has a joint that reaches {compiled.fastest:.3g} rad/s or m/s "
            f"within {compiled.time:.3g} s, expected at most {_FASTEST:g}",
            severity=Severity.WARNING,
        )


def _arm(armature: str, mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<option timestep="0.01"/>{mark}
<worldbody><body><joint name="tilt" axis="0 1 0" armature="{armature}"/>
<geom size="0.01" mass="0.001"/></body></worldbody>
<actuator><position joint="tilt" kp="5000" ctrlrange="1 2"/></actuator>
<keyframe><key ctrl="1"/></keyframe>"""
    }


GOOD = [_arm("1")]
BAD = [_arm("0", "<!-- ^ MJC007 -->")]
