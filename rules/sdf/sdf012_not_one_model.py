"""A model file that does not contain exactly one movable model with links.

The simulator spawns one model of the file. With a world around it, a second model, or
`<static>true`, it spawns another robot than intended, or one that cannot move. Every parser refuses
a model without links. Worlds and static models are faults of submissions only. No accepted package
that we checked has this fault.

Fix: keep one `<model>` directly below `<sdf>`; put worlds in `worlds/`.
Source: Model Migration Guide, step 3; SDFormat specification 1.8, "only one model at the root";
libsdformat: "A model must have at least one link."
"""

from collections.abc import Iterator

from checker.formats.sdf.document import SdfDocument, sdf_version
from checker.model.robot import states_static
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule


@rule("SDF012", "not-one-model", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument, package: Package, context: Context) -> Findings:
    """Report what prevents a model file from being one robot."""
    if sdf.root.tag != "sdf":
        return  # SDF005 says so.
    yield from _second_models(sdf, context)
    yield from _without_links(sdf)
    if context.release and not any(sdf.root.child(tag) for tag in _SPAWNED):
        yield finding(sdf.root, "the file contains no model")
    if context.is_subt and package.kind is not PackageKind.WORLD:
        yield from _no_robot(sdf)


def _second_models(sdf: SdfDocument, context: Context) -> Iterator[Finding]:
    models = sdf.root.all("model")
    # Before 1.8 a file could hold several; spawning takes the first.
    forbidden = context.release or sdf_version(sdf.document) >= (1, 8)
    for model in models[1:]:
        yield finding(
            model,
            f"model {model.get('name')!r} is next to model {models[0].get('name')!r}, expected "
            "one model in the file",
            severity=None if forbidden else Severity.WARNING,
            related=[(models[0], "the first model")],
        )


def _without_links(sdf: SdfDocument) -> Iterator[Finding]:
    for element in sdf.elements():
        if element.tag != "model" or states_static(element):
            continue
        # <model> of an actor's or a world's state describes no model.
        described = element.parent is None or element.parent.tag in ("sdf", "world", "model")
        if described and not any(child.tag in _WITH_LINKS for child in element.children):
            yield finding(element, f"model {element.get('name')!r} has no link")


_WITH_LINKS = ("link", "model", "include")
_SPAWNED = ("model", "world", "include", "actor", "light")


def _no_robot(sdf: SdfDocument) -> Iterator[Finding]:
    for world in sdf.root.all("world"):
        yield finding(
            world, f"world {world.get('name')!r} is in the model file, expected only a model"
        )
    for model in sdf.root.all("model"):
        static = model.child("static")
        if static is not None and states_static(model):
            yield finding(static, f"model {model.get('name')!r} is static: it cannot move")


_ROVER = '<model name="rover"><link name="base_link"/></model>'
GOOD = [
    f'<sdf version="1.6">{_ROVER}</sdf>',
    '<link name="arm"/><static>0</static>',
]
BAD = [
    '<sdf version="1.6"/>  <!-- ^ SDF012 -->',
    '<sdf version="1.6"><model name="rover"/></sdf>  <!-- ^ SDF012 -->',
    f"""
<sdf version="1.6">
  {_ROVER}
  {_ROVER}  <!-- ^ SDF012 -->
</sdf>
""",
    f"""
<sdf version="1.6">
  <world name="cave">  <!-- ^ SDF012 -->
    {_ROVER}
  </world>
</sdf>
""",
    """
<link name="arm"/>
<static>true</static>  <!-- ^ SDF012 -->
""",
]
