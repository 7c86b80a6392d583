"""A model or an include inside the robot's model.

Ignition Gazebo Dome does not simulate nested models: their links are missing in the simulation.
This does not concern the `<include>` that `launch/spawner.rb` emits, which is required.

`--fix --unsafe` flattens the model: link `wrist` of a nested model `arm` becomes link `arm__wrist`,
in the same place. It also edits files that name the link; topics of its sensors change with the
name. No accepted package that we checked has this fault.

Fix: flatten the model, so that all links and joints are directly in one `<model>`.
Source: Model Migration Guide, step 9: "Flattening the model file is necessary because nested
models are not yet supported."
"""

from collections.abc import Iterator

from checker.finding import Edit, Fix
from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.flattening.flatten import Flattening, obstacle
from checker.formats.sdf.flattening.names import SUFFIXES, FlatNames, mentions
from checker.model.robot import Robot
from checker.package.package import Package
from checker.rule import Concern, Findings, Safety, Severity, finding, rule
from checker.source.text import SourceText
from checker.source.xml import Element


@rule("SDF010", "nested-model", Severity.ERROR, Concern.PORTABILITY)
def check(sdf: SdfDocument, robot: Robot, package: Package) -> Findings:
    """Report `<model>` and `<include>` below a model."""
    nested = list(_nested_elements(sdf, robot))
    if not nested:
        return
    reason = obstacle(robot)
    names = FlatNames.from_robot(robot)
    named = [] if reason else list(_named_elsewhere(package, names))
    edits = () if reason else (*Flattening(robot, names).edits, *(edit for _, edit in named))
    for number, (child, message) in enumerate(nested):
        yield finding(
            child,
            f"{message}; --fix cannot flatten it: {reason}" if reason else message,
            key="nested",
            related=[
                (edit.place, f"names {scoped}, which becomes {names.flat_name(scoped)}")
                for scoped, edit in named
                if number == 0
            ],
            fix=Fix(Safety.UNSAFE, edits) if edits else None,
        )


def _nested_elements(sdf: SdfDocument, robot: Robot) -> Iterator[tuple[Element, str]]:
    """Yield the nested elements of the robot, each with its message."""
    whole = robot.element.position
    for child in sdf.elements():
        model = child.parent
        if model is None or model.tag != "model" or not whole.start <= model.position.start:
            continue
        if child.position.end > whole.end:
            continue
        if child.tag == "model":
            yield (
                child,
                f"model {child.get('name') or ''!r} is nested in model {model.get('name')!r}",
            )
        elif child.tag == "include":
            uri = child.child("uri")
            what = uri.text.value if uri is not None else "a model"
            yield child, f"{what} is included in model {model.get('name')!r}"


def _named_elsewhere(package: Package, names: FlatNames) -> Iterator[tuple[str, Edit]]:
    for file in package.index.with_suffix(*SUFFIXES):
        source = package.read(file.path)
        if isinstance(source, SourceText):
            yield from mentions(source, names)


GOOD = ['<link name="arm"/>']
BAD = [
    """
<model name="arm">  <!-- ^ SDF010 -->
  <link name="wrist"/>
</model>
""",
    "<include><uri>model://arm</uri></include>  <!-- ^ SDF010 -->",
    {
        "@fragment": """
<include>  <!-- ^ SDF010 -->
  <uri>models/arm</uri>
  <name>left</name>
  <pose>0 0.2 0 0 0 0</pose>
</include>
<joint name="shoulder" type="fixed">
  <parent>base_link</parent>
  <child>left::upper</child>
</joint>
""",
        "models/arm/model.sdf": """<sdf version="1.6">
  <model name="arm">
    <link name="upper"/>
  </model>
</sdf>
""",
        "launch/vehicle_topics.launch": """<launch>
  <arg name="name"/>
  <arg name="world_name"/>
  <node pkg="tf" type="publisher" name="tf" args="left::upper"/>
</launch>
""",
    },
]
