"""A model that MuJoCo refuses to load.

MuJoCo stops at the first fault that it finds, and in an included file it names neither the file nor
the line. Here each fault stands at its place. After a fault in an attribute the rest of the model
is judged without that attribute.

Attributes that MuJoCo has removed are the most common cause in older models: `collision` of
`<option>` (3.0.0), `apirate` (3.3.7), `convexhull` of `<compiler>` (3.2.5), and
`coordinate="global"` (2.3.4). Where requirements or a README state an earlier version, which may
read what this one refuses, it is a warning.

Fix: correct what the message names.
Source: MuJoCo 4.0.0, which compiles the model; its change log.
"""

import re

from checker.base.resources import version_of
from checker.package.mujoco_sign import mujoco_sign, numbers_of
from checker.package.package import Package
from checker.physics.compiled.model import CompiledModels
from checker.physics.compiled.refusals import explained
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_BY_VERSION = re.compile(
    r"unrecognized|invalid keyword|engine error|no longer|plugin \S+ not found|Lengthrange"
)
"""Messages about what another version may know."""
_OTHER_PLUGIN = re.compile(r"plugin (?!mujoco\.)\S+ not found")


@rule("MJC001", "mujoco-refuses", Severity.ERROR, Concern.ROBOT)
def check(package: Package, compiled: CompiledModels) -> Findings:
    """Report each fault for which MuJoCo refuses a model."""
    stated = mujoco_sign(package)
    ours = version_of("mujoco")
    is_earlier = stated is not None and numbers_of(stated.version) < numbers_of(ours)
    for model in compiled.models:
        for refusal in model.compiled.refusals:
            if _OTHER_PLUGIN.search(refusal.text):
                yield unchecked(f"{model.model.file} needs a plugin that is not here")
                continue
            fault = explained(model, refusal)
            by_version = stated is not None and is_earlier and _BY_VERSION.search(refusal.text)
            yield finding(
                fault.span,
                f"MuJoCo {ours} refuses {model.model.file}: {fault.message}"
                + (f" ({stated.words}, an earlier version)" if stated and by_version else ""),
                severity=Severity.WARNING if by_version else None,
                key=fault.message,
                fix=fault.fix,
                covered_by=("MJC002",),
            )
    for reason in compiled.missing:
        yield unchecked(reason)


_ARM = """<worldbody>
  <body name="upper">
    <joint name="shoulder"{}/>
    <geom size="0.1"/>
  </body>
</worldbody>{}"""

_MESH = """<asset><mesh name="hull.obj" file="hull.obj"/></asset>
<worldbody><geom type="mesh" mesh="hull.obj"/></worldbody>
"""
_HULL = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
GOOD = [
    {"@mjcf": _ARM.format("", "")},
    {"@mjcf": _MESH, "hull.obj": _HULL},
    {"@mjcf": '<include file="parts.xml"/>', "parts.xml": f"<part>{_ARM.format('', '')}</part>"},
]
BAD = [
    {"@mjcf": _ARM.format(' rnge="0 1"', "").replace("/>", "/><!-- ^ MJC001 -->", 1)},
    {"@mjcf": '<option apirate="50"/><!-- ^ MJC001 -->\n' + _ARM.format("", "")},
    {"@mjcf": _ARM.format("", '<actuator><motor joint="sholder"/></actuator><!-- ^ MJC001 -->')},
    {
        "@mjcf": '<include file="parts.xml"/>',
        "parts.xml": "<part>\n<option colision='all'/><!-- ^ MJC001 -->\n"
        + _ARM.format("", "")
        + "</part>",
    },
]
