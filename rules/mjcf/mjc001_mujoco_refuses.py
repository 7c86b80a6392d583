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
from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.resources import table, version_of
from checker.base.words import Suggestions
from checker.package.mujoco_sign import mujoco_sign, numbers_of
from checker.package.package import Package
from checker.physics.compiled.model import CompiledModel, CompiledModels, Refusal
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Span
from checker.source.xml import Element

_ATTRIBUTE = re.compile(r"unrecognized attribute: '([^']*)'")
_KEY = re.compile(r"^Error: (?:keyframe|invalid q)")
_TAIL = re.compile(r"\n?Element (?:name )?'.*", re.DOTALL)
_HEAD = re.compile(r"^(?:XML )?Error: (?:Schema \w+: )?")
_ID = re.compile(r"\bid = ?(\d+)|\bid (\d+)")
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
            element = _element(model, refusal)
            fault = _message(refusal, element)
            by_version = stated is not None and is_earlier and _BY_VERSION.search(refusal.text)
            yield finding(
                _place(refusal, element, model),
                f"MuJoCo {ours} refuses {model.model.file}: {fault}"
                + (f" ({stated.words}, an earlier version)" if stated and by_version else ""),
                severity=Severity.WARNING if by_version else None,
                key=fault,
                covered_by=("MJC002",),
            )
    for reason in compiled.missing:
        yield unchecked(reason)


def _element(model: CompiledModel, refusal: Refusal) -> Element | None:
    if refusal.line or not _KEY.search(refusal.text):
        element = model.element(refusal.line)
        # MuJoCo names the body of an <inertial>.
        inertial = element.child("inertial") if element and "inertia" in refusal.text else None
        return inertial or element
    # MuJoCo knows no line of a keyframe.
    number = _ID.search(refusal.text)
    keys = [*model.model.tagged("key")]
    at = int(number[1] or number[2]) if number else 0
    return keys[at] if at < len(keys) else None


def _place(refusal: Refusal, element: Element | None, model: CompiledModel) -> Span:
    if element is None:
        return model.model.document.root.span
    attribute = _ATTRIBUTE.search(refusal.text)
    named = attribute is not None and attribute[1] in element.attributes
    return element.attribute_name_span(attribute[1]) if attribute and named else element.span


def _message(refusal: Refusal, element: Element | None) -> str:
    text = " ".join(_HEAD.sub("", _TAIL.sub("", refusal.text)).split())
    if element is None:
        return text
    attribute = _ATTRIBUTE.search(refusal.text)
    hints = _hints(text, element, attribute[1] if attribute else None)
    return f"{text} in <{element.tag}>{''.join(hints)}"


def _hints(text: str, element: Element, attribute: str | None) -> Iterator[str]:
    names: Mapping[str, Any] = table("mjcf_names")
    if element.get("fullinertia") and "inertia" in text:
        yield "; fullinertia is in the order ixx iyy izz ixy ixz iyz, which is not that of URDF"
    if attribute is None:
        if element.tag not in names["elements"]:
            yield Suggestions(names["elements"]).hint(element.tag)
    elif attribute in names["removed"]:
        yield f", {names['removed'][attribute]}"
    else:
        yield Suggestions(names["elements"].get(element.tag, ())).hint(attribute)


_ARM = """<worldbody>
  <body name="upper">
    <joint name="shoulder"{}/>
    <geom size="0.1"/>
  </body>
</worldbody>{}"""

GOOD = [
    {"@mjcf": _ARM.format("", "")},
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
