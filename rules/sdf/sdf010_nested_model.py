"""A model or an include inside the robot's model.

Ignition Gazebo Dome does not simulate nested models: their links are not there. The `<include>`
that `launch/spawner.rb` emits is another matter and must be there.

No accepted package at hand shows it.

Fix: flatten the model, so that all links and joints stand directly in one `<model>`.
Source: Model Migration Guide, step 9: "Flattening the model file is necessary because nested
models are not yet supported."
"""

from checker.model.sdf.document import SdfDocument
from checker.rule import Findings, Severity, finding, rule


@rule("SDF010", "nested-model", Severity.ERROR)
def check(sdf: SdfDocument) -> Findings:
    """Report `<model>` and `<include>` below a model."""
    for element in sdf.elements():
        if element.tag != "model":
            continue
        for child in element.children:
            if child.tag == "model":
                name = child.get("name") or ""
                yield finding(child, f"model {name!r} is nested in model {element.get('name')!r}")
            elif child.tag == "include":
                uri = child.child("uri")
                what = uri.text.value if uri is not None else "a model"
                yield finding(child, f"{what} is included in model {element.get('name')!r}")


GOOD = ['<link name="arm"/>']
BAD = [
    """
<model name="arm">  <!-- ^ SDF010 -->
  <link name="wrist"/>
</model>
""",
    "<include><uri>model://arm</uri></include>  <!-- ^ SDF010 -->",
]
